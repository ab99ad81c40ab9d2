// The program as people and scripts meet it: exit codes, purity of stdout, JSON, spellings. Runs
// the real program, $VKH_PROGRAM, on files written here.
#include <doctest/doctest.h>
#include <sys/types.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/support/answer_line.h"
#include "tests/support/program.h"
#include "vkhausdorff/answer.h"
#include "vkhausdorff/solver.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace vkh::test;

std::string rectangle(double width, double z) {
  std::ostringstream obj;
  obj << "v 0 0 " << z << "\nv " << width << " 0 " << z << "\nv " << width << " 1 " << z
      << "\nv 0 1 " << z << "\nf 1 2 3\nf 1 3 4\n";
  return obj.str();
}

/// Unit squares a quarter apart: both directions are 1/4.
std::string square_a() { return write_file("a.obj", rectangle(1, 0)); }
std::string square_b() { return write_file("b.obj", rectangle(1, 0.25)); }
/// A square in the unit square's plane and twice as long: 0 from the square to it, 1 from it to the
/// square.
std::string long_rectangle() { return write_file("long.obj", rectangle(2, 0)); }

Words keys(const json& object) {
  Words names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

Words sorted(Words names) {
  std::sort(names.begin(), names.end());
  return names;
}

double hex(const json& object, const char* key) {
  return std::strtod(object.at(key).get<std::string>().c_str(), nullptr);
}

/// Checks an answer, or one direction of it; `tolerance`: if it must be closed to that.
void check_interval(const json& answer, double truth, double tolerance = INFINITY) {
  const json& object = answer.at("interval");
  const double lower = hex(object, "lower_hex"), upper = hex(object, "upper_hex");
  CHECK(lower <= truth);
  CHECK(truth <= upper);
  CHECK(object.at("lower").get<double>() <= lower);
  CHECK(object.at("upper").get<double>() >= upper);
  CHECK(object.at("lower").get<double>() == doctest::Approx(lower).epsilon(1e-15));
  CHECK(object.at("upper").get<double>() == doctest::Approx(upper).epsilon(1e-15));
  if (answer.contains("tolerance")) tolerance = answer.at("tolerance").at("absolute").get<double>();
  if (answer.at("status") == "closed") CHECK(upper - lower <= tolerance * (1 + 1e-15));
}

/// One line on stderr, nothing on stdout.
void check_refused(const Words& words, int exit_code, const std::string& mentions) {
  const Outcome outcome = run(words);
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == exit_code);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.starts_with("vkhausdorff: "));
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.find(mentions) != std::string::npos);
  CHECK(outcome.err.find("internal error") == std::string::npos);
}

TEST_CASE("usage errors: exit code 2 and one line") {
  const Words pair = {"distance", square_a(), square_b()};
  check_refused({}, 2, "subcommand");
  check_refused(
      {"distanse", "a", "b"}, 2,
      "'distanse': expected distance, gate, metrics, batch, merge, simplify, demo or doctor");
  check_refused({"distance"}, 2, "A is required");
  check_refused({"distance", square_a()}, 2, "B is required");
  check_refused(pair + Words{"third.obj"}, 2, "third.obj");
  check_refused(pair + Words{"--frobnicate"}, 2, "--frobnicate");
  check_refused(pair + Words{"--tolerance", "0.1"}, 2, "'--tolerance': did you mean --tol?");
  check_refused(pair + Words{"--symetric"}, 2, "did you mean --symmetric?");
  check_refused({"gaet", "a", "b"}, 2, "did you mean gate?");
  check_refused(pair + Words{"--max", "0.1mm"}, 2,
                "unknown option '--max': it is of gate, batch and simplify");
  check_refused(pair + Words{"--junit", "j.xml"}, 2,
                "unknown option '--junit': it is of gate, batch and merge");
  check_refused(pair + Words{"--json=-"}, 2, "--json '-': expected the name of a file");
  for (const char* tol : {"0", "-1", "nan", "inf", "1e-6km", "abs", "%", "1,5", "1e-400", ""}) {
    check_refused(pair + Words{"--tol", tol}, 2, "--tol");
  }
  for (const char* memory : {"0", "2X", "-1MiB", "much", "1e30TiB", "0.1"}) {
    check_refused(pair + Words{"--memory", memory}, 2, "--memory");
  }
  for (const char* time : {"0", "-1s", "1d", "inf", "soon", ""}) {
    check_refused(pair + Words{"--time", time}, 2, "--time");
  }
  for (const char* waves : {"-1", "1.5", "4294967296", "few"}) {
    check_refused(pair + Words{"--waves", waves}, 2, "--waves");
  }
  check_refused(pair + Words{"--disable", "gravity"}, 2, "'gravity': expected one of");
}

TEST_CASE("bad input: exit code 4, one line that names the file") {
  const std::string a = square_a();
  const std::string empty = write_file("empty.obj", "");
  const std::string out_of_range = write_file("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  const std::string not_a_number = write_file("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string points = write_file("points.obj", "v 0 0 0\nv 1 0 0\n");
  for (const std::string& bad :
       {folder() / "missing.obj", empty, out_of_range, not_a_number, points}) {
    check_refused({"distance", bad, a}, 4, bad);
    // The object has it, too.
    const Outcome outcome = run({"distance", a, bad, "--json"});
    CHECK(outcome.exit_code == 4);
    const json failure = answer_in(outcome.out);
    CHECK(failure["schema"] == "vkhausdorff.answer/2");
    CHECK(failure["error"]["code"] == 4);
    CHECK(failure["error"]["file"] == bad);
    CHECK("vkhausdorff: " + failure["error"]["message"].get<std::string>() + "\n" == outcome.err);
  }
}

TEST_CASE("a file that is not there has no place in it") {
  const Outcome outcome = run({"distance", "gone.obj", square_a(), "--json"});
  CHECK(outcome.exit_code == 4);
  const json error = answer_in(outcome.out).at("error");
  CHECK(error.at("message").get<std::string>().starts_with("gone.obj: no such file; expected "));
  CHECK(error.at("file") == "gone.obj");
  CHECK(error.at("place").is_null());
}

TEST_CASE("an A of one point is measured, and a note says what its diagonal is for") {
  const std::string point = write_file("point.obj", "v 0.5 0.5 2\nf 1 1 1\n");
  const json r = answer_in(run({"distance", point, square_b(), "--json"}).out);
  check_interval(r, 1.75);
  const json& notes = r.at("notes");
  const auto on_tolerance = std::find_if(notes.begin(), notes.end(),
                                         [](const json& n) { return n["code"] == "tolerance"; });
  REQUIRE(on_tolerance != notes.end());
  CHECK((*on_tolerance)["text"].get<std::string>().starts_with("A is one point"));
  const Outcome table = run({"distance", point, square_b(), "--tol", "1e-6abs"});
  CHECK(table.exit_code == 0);
  CHECK(table.out.find("tolerance: ") == std::string::npos);
  CHECK(table.out.find(" of diag(A)") == std::string::npos);
  CHECK(run({"gate", point, square_b(), "--max", "1.8abs"}).exit_code == 0);
}

TEST_CASE("a device that is not there: exit code 5") {
  check_refused({"distance", square_a(), square_b(), "--device", "no such device"}, 5, "device");
  check_refused({"distance", square_a(), square_b(), "--device", "12345"}, 5, "device");
}

TEST_CASE("help and version are answers, not errors") {
  const Outcome help = run({"--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.out.find("distance") != std::string::npos);
  CHECK(help.out.find("doctor") != std::string::npos);
  CHECK(run({"distance", "--help"}).out.find("--tol") != std::string::npos);
  CHECK(run({"help"}).out == help.out);
  CHECK(run({"-V"}).out == run({"--version"}).out);
  CHECK(run({"distance", "--help"}).out.find("--waves") == std::string::npos);
  CHECK(run({"distance", "--help-all"}).out.find("--waves") != std::string::npos);
  CHECK(run({"help", "gate"}).out == run({"gate", "--help"}).out);
  const std::string all = run({"--help-all"}).out;
  for (const char* command : {"distance", "gate", "batch", "merge", "demo", "doctor"})
    CHECK(all.find(std::string("Usage: vkhausdorff ") + command) != std::string::npos);
  for (const Words& words : {Words{"--help"}, Words{"--help-all"}, Words{"distance", "--help"},
                             Words{"gate", "--help"}}) {
    std::istringstream lines(run(words).out);
    for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 100);
  }
  const Outcome version = run({"--version"});
  CHECK(version.exit_code == 0);
  CHECK(version.out == std::string("vkhausdorff ") + vkh::program_version() + "\n");
}

const Words kAnswerKeys =
    sorted({"schema", "version", "words", "status", "stop_reason", "interval", "directions",
            "inputs", "notes", "boxes", "tolerance", "options", "device", "driver", "times",
            "command", "arguments", "host", "started"});
const Words kDirectionKeys =
    sorted({"from", "to", "status", "stop_reason", "interval", "known_lower", "witness", "times",
            "counts", "stages", "culled", "wave_stats"});

// Runs on a CPU device.
const Words kOffUnlessAsked = {"u4",       "group_walk",  "sort", "packet", "largest_first",
                               "u3_paper", "split_twice", "wide"};

TEST_CASE("distance --json: one object of the schema and nothing else on stdout") {
  const std::string a = square_a(), b = square_b();
  for (const Words& words : {Words{"distance", a, b, "--json"}, Words{"distance", "--json", a, b},
                             Words{"distance", a, b, "--json", "--verbose"}}) {
    const Outcome outcome = run(words);
    REQUIRE(outcome.exit_code == 0);
    const json r = answer_in(outcome.out);
    CHECK(keys(r) == kAnswerKeys);
    CHECK(r["schema"] == "vkhausdorff.answer/2");
    CHECK(r["version"] == vkh::program_version());
    CHECK(r["status"] == "closed");
    check_interval(r, 0.25);
    CHECK(keys(r["tolerance"]) ==
          sorted({"requested", "absolute", "unit", "diagonal_of", "diagonal"}));
    REQUIRE(r["inputs"].size() == 2);
    const json& mesh = r["inputs"][0];
    CHECK(keys(mesh) ==
          sorted({"name", "path", "sha256", "files", "vertices", "faces", "unreferenced",
                  "degenerate", "duplicate", "polygons", "delta", "unit", "notes"}));
    CHECK(mesh["delta"] == 0);
    CHECK(mesh["unit"].is_null());
    CHECK(mesh["path"] == a);
    CHECK(mesh["faces"] == 2);
    CHECK(mesh["vertices"] == 4);
    CHECK(r["inputs"][1]["path"] == b);
    CHECK(r["arguments"] == words);
    CHECK(r["command"] == "distance");
    CHECK(r["device"]["name"].get<std::string>() != "");
    CHECK(keys(r["times"]) == sorted({"read_ms", "start_ms", "total_ms"}));
    CHECK(r["times"]["read_ms"].get<double>() > 0);
    CHECK(r["times"]["total_ms"].get<double>() >= r["times"]["start_ms"].get<double>());
    REQUIRE(r["directions"].size() == 1);
    const json& direction = r["directions"][0];
    CHECK(keys(direction) == kDirectionKeys);
    check_interval(direction, 0.25);
    CHECK(keys(direction["culled"]) ==
          sorted({"exact", "u1", "u2", "ha", "u3", "u4", "lower_raised", "precision"}));
    const json& options = r["options"];
    CHECK(options["preset"] == "default");
    CHECK(options["switched_off"] == kOffUnlessAsked);
    CHECK(options["switched_on"].size() + kOffUnlessAsked.size() == vkh::switch_names().size());
  }
}

TEST_CASE("the witness proves lower") {
  const json r = answer_in(run({"distance", square_a(), square_b(), "--json"}).out);
  const json& witness = r["directions"][0]["witness"];
  const json &a = witness["from"], &b = witness["to"];
  CHECK(a["face"].get<uint64_t>() < 2);
  CHECK(b["face"].get<uint64_t>() < 2);
  double weight = 0, squared = 0;
  for (size_t i = 0; i < 3; ++i) {
    weight += a["barycentric"][i].get<double>();
    const double d = a["point"][i].get<double>() - b["point"][i].get<double>();
    squared += d * d;
  }
  CHECK(weight == doctest::Approx(1));
  CHECK(std::sqrt(squared) == doctest::Approx(0.25).epsilon(1e-5));
  CHECK(std::sqrt(squared) >= hex(r["interval"], "lower_hex") * (1 - 1e-6));
}

TEST_CASE("--verify: the host's own check, in JSON and in the table, both ways") {
  const Words pair = {"distance", square_a(), square_b(), "--verify"};
  const json r = answer_in(run(pair + Words{"--json"}).out)["directions"][0]["verified"];
  CHECK(r["witness"] == true);
  CHECK(r["coverage"] == true);
  CHECK(r["closed"].get<double>() <= 1.0);
  CHECK(r["faces"]["wrong"] == 0);
  CHECK(hex(r, "distance_lower_hex") <= hex(r, "distance_upper_hex"));
  const Outcome table = run(pair + Words{"--symmetric"});
  CHECK(table.exit_code == 0);
  CHECK(table.out.find("lower holds") != table.out.rfind("lower holds"));
  CHECK(table.out.find("nothing is lost") != std::string::npos);
}

TEST_CASE("the table says interval, tolerance, meshes and device") {
  const std::string a = square_a();
  const Outcome outcome = run({"distance", a, square_b()});
  CHECK(outcome.exit_code == 0);
  for (const std::string& word :
       {std::string("interval"), std::string("closed"), std::string("1e-6 of diag(A)"), a,
        std::string("2 faces"), std::string("witness"), std::string("device")}) {
    CAPTURE(word);
    CHECK(outcome.out.find(word) != std::string::npos);
  }
  CHECK(outcome.out.starts_with("every point of A is within 0.25"));
  CHECK(std::count(outcome.out.begin(), outcome.out.end(), '\n') <= 15);
  const Outcome verbose = run({"distance", a, square_b(), "--verbose"});
  CHECK(verbose.out.find("candidates closed by") != std::string::npos);
}

TEST_CASE("--json=FILE: the table on stdout, the object in the file") {
  const std::string file = folder() / "out.json";
  const Outcome outcome = run({"distance", square_a(), square_b(), "--json=" + file});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("interval") != std::string::npos);
  CHECK(!json::accept(outcome.out));
  check_interval(answer_in(read_file(file)), 0.25);
}

TEST_CASE("a file name that is no UTF-8 does not cost the JSON") {
  const std::string odd = write_file("caf\xe9.obj", rectangle(1, 0));
  const json r = answer_in(run({"distance", odd, square_b(), "--json"}).out);
  check_interval(r, 0.25);
}

TEST_CASE("tolerance spellings resolve to the same thing and are told") {
  const double diagonal = std::sqrt(2.0);
  struct Spelling {
    const char* text;
    double absolute;
  };
  for (const Spelling& s : {Spelling{"1e-3", 1e-3 * diagonal}, Spelling{"0.1%", 1e-3 * diagonal},
                            Spelling{"0.02abs", 0.02}, Spelling{"0.02 abs", 0.02}}) {
    CAPTURE(s.text);
    const Words words = {"distance", square_a(), square_b(), "--tol", s.text};
    const json r = answer_in(run(words + Words{"--json"}).out);
    const json& tolerance = r["tolerance"];
    CHECK(tolerance["requested"] == s.text);
    CHECK(tolerance["absolute"].get<double>() == doctest::Approx(s.absolute).epsilon(1e-12));
    CHECK(tolerance["diagonal"].get<double>() == doctest::Approx(diagonal).epsilon(1e-12));
    CHECK(tolerance["diagonal_of"].is_null() == (std::string(s.text).back() == 's'));
    check_interval(r, 0.25);
    const std::string table = run(words).out;
    const bool is_length = std::string(s.text).ends_with("abs");
    CHECK(table.find("tolerance  " + std::string(is_length ? "0.02 in the files' unit\n"
                                                           : s.text)) != std::string::npos);
    CHECK((table.find("diag(A) = 1.41421356") != std::string::npos) ==
          (s.text[0] != '0' || s.text[2] == '1'));
  }
}

TEST_CASE("a mesh against itself is [0, nearly 0]") {
  const std::string a = square_a();
  const Outcome outcome = run({"distance", a, a, "--json", "--symmetric"});
  CHECK(outcome.exit_code == 0);
  const json r = answer_in(outcome.out);
  CHECK(r["interval"]["lower"] == 0);
  CHECK(r["interval"]["lower_hex"] == "0x0p+0");
  check_interval(r, 0);
}

TEST_CASE("--symmetric: the larger of two directions, and both of them") {
  const std::string a = square_a(), b = long_rectangle();
  const Outcome outcome = run({"distance", a, b, "--symmetric", "--json"});
  CHECK(outcome.exit_code == 0);
  const json r = answer_in(outcome.out);
  CHECK(r["schema"] == "vkhausdorff.answer/2");
  CHECK(r["status"] == "closed");
  check_interval(r, 1);
  CHECK(keys(r) == kAnswerKeys);  // one shape for both
  REQUIRE(r["directions"].size() == 2);
  const json &there = r["directions"][0], &back = r["directions"][1];
  CHECK(keys(there) == kDirectionKeys);
  CHECK(keys(back) == kDirectionKeys);
  CHECK(there["from"] == "a");
  CHECK(back["from"] == "b");
  CHECK(back["to"] == "a");
  // One tolerance for both, from the diagonal of the first mesh.
  const double absolute = r["tolerance"]["absolute"].get<double>();
  CHECK(absolute == doctest::Approx(1e-6 * std::sqrt(2.0)).epsilon(1e-12));
  CHECK(r["tolerance"]["diagonal_of"] == "a");
  check_interval(there, 0, absolute);
  check_interval(back, 1, absolute);
  const std::string table = run({"distance", a, b, "--symmetric"}).out;
  CHECK(table.find("h(A,B)  ") != std::string::npos);
  CHECK(table.find("h(B,A)  ") != std::string::npos);
}

TEST_CASE("switches are echoed, one option or several, before or after the files") {
  const Words names = vkh::switch_names();
  REQUIRE(names.size() >= 2);
  const std::string a = square_a(), b = square_b(), both = names[0] + "," + names[1];
  for (const Words& words :
       {Words{"distance", "--disable", both, a, b, "--json"},
        Words{"distance", a, b, "--json", "--disable", names[0], "--disable", names[1]}}) {
    const json r = answer_in(run(words).out);
    Words off = {names[0], names[1]};
    off.insert(off.end(), kOffUnlessAsked.begin(), kOffUnlessAsked.end());
    CHECK(r["options"]["switched_off"] == off);
    check_interval(r, 0.25);
  }
  const Words paper = {"distance", a, b, "--json", "--preset", "paper", "--disable", "sort"};
  const json r = answer_in(run(paper).out);
  CHECK(r["options"]["preset"] == "paper");
  CHECK(r["options"]["switched_on"] ==
        Words{"thin", "u4", "warm_start", "packet", "defer", "u3_paper"});
  check_interval(r, 0.25);
  const Outcome wrong = run({"distance", a, b, "--preset", "pape"});
  CHECK(wrong.exit_code == 2);
  CHECK(wrong.err.find("default, paper or baseline-gpu") != std::string::npos);
}

TEST_CASE("a budget that is too small: exit code 3 and a true interval") {
  const Outcome outcome = run({"demo", "--tol", "1e-7", "--waves", "1", "--json"});
  CHECK(outcome.exit_code == 3);
  const json r = answer_in(outcome.out);
  CHECK(r["status"] == "waves");
  const json& open = r["interval"];
  CHECK(hex(open, "upper_hex") - hex(open, "lower_hex") > r["tolerance"]["absolute"].get<double>());
  const Outcome table = run({"demo", "--tol", "1e-7", "--waves", "1"});
  CHECK(table.exit_code == 3);
  CHECK(table.out.find("NOT CLOSED") != std::string::npos);
}

TEST_CASE("coverage: how much of B is far from A, where both ways are surveyed") {
  const std::string half = write_file("half.obj", rectangle(1, 0)),
                    whole = write_file("whole.obj", rectangle(2, 0));
  const auto coverage = [](const Words& words) {
    const json notes = answer_in(run(Words{"distance"} + words).out)["notes"];
    const auto found = std::find_if(notes.begin(), notes.end(),
                                    [](const json& note) { return note["code"] == "coverage"; });
    return found == notes.end() ? 0.0 : (*found)["value"].get<double>();
  };
  // Beyond x = 1 + sqrt(2) / 100, by a hundredth of A's diagonal, lie 49.3 % of B.
  const double share = coverage({half, whole, "--symmetric", "--stats", "--json"});
  CHECK(share <= (1 - std::sqrt(2.0) / 100) / 2);
  CHECK(share >= 0.48);
  CHECK(coverage({half, whole, "--stats", "--json"}) == 0);
  CHECK(coverage({whole, whole, "--symmetric", "--stats", "--json"}) == 0);
}

TEST_CASE("an option that is gone is refused by its name, with what to do instead") {
  check_refused({"doctor", "--device-report", "x.json"}, 2,
                "--device-report is gone: 'doctor --json=FILE'");
  check_refused({"demo", "--image", "x.png", "--field-by", "faces"}, 2,
                "--field-by is gone: leave it out");
}

TEST_CASE("doctor lists devices and passes its own check") {
  const Outcome outcome = run({"doctor"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  for (const std::string word : {"usable", "chosen", "driver", "loader", "self-check", "passed"}) {
    CAPTURE(word);
    CHECK(outcome.out.find(word) != std::string::npos);
  }
}

}  // namespace
