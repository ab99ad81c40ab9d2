// distance --part, --known-lower, and several devices, as people and scripts meet them.
#include <doctest/doctest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "host/answer/merge_parts.h"
#include "tests/shapes/shapes.h"
#include "tests/support/answer_line.h"
#include "tests/support/program.h"

namespace {

using nlohmann::json;
using namespace vkh::test;

std::string obj_text(const vkh::Mesh& mesh) {
  std::ostringstream text;
  text.precision(17);
  for (const glm::dvec3& v : mesh.vertices) text << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const glm::uvec3& f : mesh.faces)
    text << "f " << f.x + 1 << ' ' << f.y + 1 << ' ' << f.z + 1 << '\n';
  return text.str();
}

/// 1152 faces against 128, a file each.
const Words& pair() {
  static const Words files = {write_file("field.obj", obj_text(height_field(24, 1))),
                              write_file("coarse.obj", obj_text(height_field(24, 3)))};
  return files;
}

Outcome distance(const Words& more) { return run(Words{"distance"} + pair() + more); }

double hex(const json& answer, const char* key) {
  return std::strtod(answer["interval"][key].get<std::string>().c_str(), nullptr);
}

json part(size_t index, size_t count, const Words& more = {}) {
  const std::string which = std::to_string(index) + "/" + std::to_string(count);
  const Outcome outcome = distance(Words{"--json", "--part", which} + more);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  return answer_in(outcome.out);
}

}  // namespace

TEST_CASE("all parts are A, and say which they are") {
  const json whole = answer_in(distance({"--json"}).out);
  std::vector<vkh::WrittenAnswer> parts;
  for (size_t i = 0; i < 3; ++i) {
    const json one = part(i, 3, {"--verify"});
    CHECK(one["part"] == json({{"index", i}, {"count", 3}}));
    CHECK(one["words"].get<std::string>().starts_with("every point of part " + std::to_string(i) +
                                                      "/3 of A is within "));
    CHECK(one["tolerance"] == whole["tolerance"]);
    CHECK(one["inputs"] == whole["inputs"]);
    CHECK(one["directions"][0]["verified"]["witness"] == true);
    CHECK(one["directions"][0]["verified"]["faces"]["whole"] == 1152 / 3);
    const size_t face = one["directions"][0]["witness"]["from"]["face"];
    CHECK(face / (1152 / 3) == i);
    parts.push_back({"part", std::to_string(i), vkh::Json::parse(one.dump())});
  }
  if (whole["inputs"][0]["sha256"].is_null()) return;  // a build without a library for it
  const json merged = json::parse(vkh::to_json(vkh::merge_parts(parts)));
  CHECK(merged["status"] == "closed");
  CHECK(hex(merged, "lower_hex") <= hex(whole, "upper_hex"));
  CHECK(hex(merged, "upper_hex") >= hex(whole, "lower_hex"));
  CHECK(merged["directions"][0]["verified"]["faces"]["whole"] == 1152);
  CHECK(merged["arguments"] == json(Words{"distance"} + pair() + Words{"--json", "--verify"}));
}

TEST_CASE("the table says that it is a part") {
  const Outcome outcome = distance({"--part", "1/3"});
  CHECK(outcome.out.find("\n  part       1 of 3, from 0: ") != std::string::npos);
  CHECK(outcome.out.find("\n  known  ") == std::string::npos);
}

TEST_CASE("what other parts have shown is enough: exit code 0") {
  const json pruned = part(1, 3, {"--known-lower", "0.5abs"});
  CHECK(pruned["status"] == "pruned");
  CHECK(pruned["directions"][0]["known_lower"].get<double>() == doctest::Approx(0.5));
  CHECK(pruned["directions"][0]["known_lower"].get<double>() <= 0.5);
  const Outcome table = distance({"--part", "1/3", "--known-lower", "0.5abs"});
  CHECK(table.exit_code == 0);
  CHECK(table.out.find("\n  known      0.5 in the files' unit\n") != std::string::npos);
}

TEST_CASE("what cannot be had of a part") {
  const auto refused = [](const Words& words, const char* why) {
    const Outcome outcome = distance(words);
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out == "");
    CHECK(outcome.err.find(why) != std::string::npos);
  };
  for (const char* wrong : {"3/3", "-1/3", "1", "1/", "/3", "1/3x", "a/b", "1/0", "1.5/3"})
    refused({"--part", wrong}, "--part '");
  refused({"--part", ""}, "--part: '' is no value");
  refused({"--part", "0/1153"}, "A has 1152 faces, too few for 1153 parts");
  refused({"--known-lower", "1abs"}, "ask for a --part");
  refused({"--part", "0/2", "--known-lower", "1"}, "--known-lower '1'");
  refused({"--part", "0/2", "--known-lower", "1mm"}, "--known-lower");
  for (const Words& more : std::vector<Words>{{"--symmetric"},
                                              {"--stats"},
                                              {"--bands", "1abs"},
                                              {"--field-tol", "1%"},
                                              {"--field", "x.ply"},
                                              {"--image", "x.png"},
                                              {"--report", "x.html"},
                                              {"--certificate", "x.vhc"}})
    refused(Words{"--part", "0/2"} + more, "is all that is to be had of a part");
  const Outcome gate = run(Words{"gate"} + pair() + Words{"--max", "1abs", "--part", "0/2"});
  CHECK(gate.exit_code == 2);
}

TEST_CASE("--time leaves a true interval of a part, which says so") {
  const Outcome outcome = distance({"--part", "0/3", "--time", "1ms", "--json"});
  CHECK(outcome.exit_code == 3);
  const json one = answer_in(outcome.out);
  CHECK(one["part"]["count"] == 3);
  CHECK(one["words"].get<std::string>().find("part 0/3 of A") != std::string::npos);
}

TEST_CASE("several devices: two of one, all, and what cannot be") {
  const json alone = answer_in(distance({"--json"}).out);
  const Outcome two = distance({"--device", "0,0", "--json", "--verify"});
  CHECK(two.exit_code == 0);
  const json both = answer_in(two.out);
  CHECK(both["status"] == "closed");
  CHECK(both["more_devices"].size() == 1);
  CHECK(both["more_devices"][0] == both["device"]);
  CHECK(hex(both, "lower_hex") <= hex(alone, "upper_hex"));
  CHECK(hex(both, "upper_hex") >= hex(alone, "lower_hex"));
  CHECK(both["directions"][0]["verified"]["faces"]["whole"] == 1152);
  const json all = answer_in(distance({"--device", "all", "--json"}).out);
  CHECK(all["status"] == "closed");
  CHECK(part(1, 2, {"--device", "0,0"})["part"]["index"] == 1);
  CHECK(distance({"--device", "0,"}).exit_code == 2);
  CHECK(distance({"--device", "0,99"}).exit_code == 5);
  const Outcome symmetric = distance({"--device", "0,0", "--symmetric"});
  CHECK(symmetric.exit_code == 2);
  CHECK(symmetric.err.find("--symmetric") != std::string::npos);
  CHECK(distance({"--device", "0,0", "--stats", "--time", "20s"}).exit_code == 0);
  CHECK(distance({"--device", "0,0", "--time", "1ms"}).exit_code == 3);
}

TEST_CASE("merge makes one answer of all parts, and of nothing less") {
  Words files;
  for (size_t i = 0; i < 3; ++i) {
    files.push_back(folder() / ("part-" + std::to_string(i) + ".json"));
    distance({"--part", std::to_string(i) + "/3", "--json=" + files.back()});
  }
  if (json::parse(read_file(files[0]))["inputs"][0]["sha256"].is_null()) return;
  const std::string out = folder() / "merged.json";
  const Outcome outcome = run(Words{"merge"} + files + Words{"--out", out});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.starts_with("every point of A is within "));
  const std::string text = read_file(out);
  CHECK(vkh::to_json(vkh::answer_from_json(text)) + "\n" == text);
  const json merged = json::parse(text);
  CHECK(merged["status"] == "closed");
  CHECK(merged["parts"] == 3);
  const Outcome missing = run({"merge", files[0], files[2], "--out", out});
  CHECK(missing.exit_code == 4);
  CHECK(missing.err.find("without part 1; expected all 3 parts") != std::string::npos);
  const std::string garbage = write_file("garbage.json", "{\n");
  CHECK(run({"merge", files[0], garbage, "--out", out}).exit_code == 4);
  CHECK(run(Words{"merge"} + files + Words{"--out", files[0]}).exit_code == 2);
  CHECK(run(Words{"merge"} + files + Words{"--out", out, "--reproducible"}).exit_code == 2);
}
