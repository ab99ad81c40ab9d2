// The gate: verdicts, exit codes and words; units; the files for build servers; and the end of its
// time. Runs the real program, $VKH_PROGRAM.
#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <utility>

#include "tests/files/gltf_document.h"
#include "tests/files/las_file.h"
#include "tests/shapes/shapes.h"
#include "tests/support/answer_line.h"
#include "tests/support/program.h"

namespace {

using nlohmann::json;
using namespace vkh::test;

std::string square(const std::string& name, double width, double z) {
  std::ostringstream obj;
  obj << "v 0 0 " << z << "\nv " << width << " 0 " << z << "\nv " << width << " 1 " << z
      << "\nv 0 1 " << z << "\nf 1 2 3\nf 1 3 4\n";
  return write_file(name, obj.str());
}
/// A quarter apart.
std::string square_a() { return square("gate_a.obj", 1, 0); }
std::string square_b() { return square("gate_b.obj", 1, 0.25); }
/// A square in the plane of A and twice as long: 0 from A to it, 1 back.
std::string long_one() { return square("gate_long.obj", 2, 0); }

Outcome gate(const std::string& max, Words more = {}) {
  Words words = {"gate", square_a(), square_b(), "--max", max};
  words.insert(words.end(), more.begin(), more.end());
  return run(words);
}

bool starts_with(const std::string& text, const std::string& begin) {
  CAPTURE(text);
  return text.starts_with(begin);
}

// A is a quarter under B, which looks up.
TEST_CASE("limits over B and under it") {
  const Outcome pass = gate("+0.1abs,-0.3abs");
  CHECK(pass.exit_code == 0);
  CHECK(pass.out.find("): every point of A is within 0.1 over B and 0.3 under it, proven (over B") <
        pass.out.find('\n'));
  CHECK(pass.out.find("A to B only: what A lacks of B is a question from B to A") !=
        std::string::npos);
  const Outcome fail = gate("+0.3abs,-0.2abs");
  CHECK(fail.exit_code == 1);
  CHECK(starts_with(fail.out, "FAIL  0.25 under B at ("));
  CHECK(fail.out.find(" under B at (") < fail.out.find(") on face "));
  CHECK(fail.out.find(" of A, limit 0.2. Check the inputs: ") < fail.out.find('\n'));
  CHECK(gate("+0.1abs,-0.3abs", {"--area=99%"}).exit_code == 2);
  CHECK(gate("+0.1abs,-0.3abs", {"--symmetric"}).err.find("ask for each direction separately") !=
        std::string::npos);
  CHECK(gate("+0.1abs").exit_code == 2);
  CHECK(gate("+0.1abs,+0.3abs").exit_code == 2);
}

/// Points far from the origin, whose conversion from inches rounds each by up to 1.5e-6 mm.
Outcome gate_far_points(const std::string& a, const std::string& b, const std::string& max,
                        Words more = {}) {
  Words words = {"gate",
                 write_file("far_inch.xyz", a),
                 write_file("far_mm.xyz", b),
                 "--points",
                 "both",
                 "--unit-a",
                 "in",
                 "--unit-b",
                 "mm",
                 "--max",
                 max};
  words.insert(words.end(), more.begin(), more.end());
  return run(words);
}

// Exact: A is at x = 25400000101.6 and 25400000152.4, its diagonal is 50.8, and h is 50.800001; as
// it is held the diagonal is 50.800003.
TEST_CASE("a limit in % of an A that was rounded decides nothing that A's rounding leaves open") {
  const std::string a = "1000000004 0 0\n1000000006 0 0\n";
  const std::string b = "25400000101.6 0 50.800001\n25400000152.4 0 50.800001\n";
  CHECK(gate_far_points(a, b, "100%").exit_code == 3);
  CHECK(gate_far_points(a, b, "100%", {"--area", "90%"}).exit_code == 3);
  CHECK(gate_far_points(a, b, "100.0001%").exit_code == 0);
  CHECK(gate_far_points(a, b, "99.9999%").exit_code == 1);
  const std::string longer = "1000000006 0 0\n1000000009 0 0\n";  // 76.2 across, and 1e-6 nearer
  const std::string above = "25400000152.4 0 76.199999\n25400000228.6 0 76.199999\n";
  CHECK(gate_far_points(longer, above, "100%").exit_code == 3);
}

// Exact: the diagonal is 2804 times the scale, the limit twice that, and h is less by 2.3e-13 of
// it.
TEST_CASE("a limit in % of a LAS file's offsets decides nothing that they leave open") {
  Las las;
  las.put(131, std::array{0.001, 0.001, 0.001});
  las.put(155, std::array{4e6, 0.0, 0.0});
  las.put_points({{98, 0, 0}, {2902, 0, 0}});
  const std::string a = write_file("far.las", las.bytes());
  const std::string b = write_file("far.xyz",
                                   "4000000.098 0 5.607999999769032\n"
                                   "4000002.902 0 5.607999999769032\n");
  const auto exit_code = [&](const std::string& max) {
    return run({"gate", a, b, "--points", "both", "--max", max}).exit_code;
  };
  CHECK(exit_code("200%") == 3);
  CHECK(exit_code("201%") == 0);
  CHECK(exit_code("199%") == 1);
}

/// A cube about (at, 0, 0), whose faces look outward or inward.
std::string cube_text(double at, double half, bool is_inward, int before = 0) {
  std::ostringstream obj;
  for (int i = 0; i < 8; ++i)
    obj << "v " << at + (i & 1 ? half : -half) << ' ' << (i & 2 ? half : -half) << ' '
        << (i & 4 ? half : -half) << '\n';
  const int faces[6][4] = {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5},
                           {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}};
  for (const auto& f : faces) {
    for (const int k : {2, 3}) {
      const int second = f[is_inward ? k : k - 1], third = f[is_inward ? k - 1 : k];
      obj << "f " << before + f[0] << ' ' << before + second << ' ' << before + third << '\n';
    }
  }
  return obj.str();
}

// A is a tenth under the faces of B.
TEST_CASE("a B that is inside out is said first where sides have limits, since over is inside it") {
  const std::string a = write_file("inner.obj", cube_text(0, 0.9, false)),
                    b = write_file("right.obj", cube_text(0, 1, false)),
                    flipped = write_file("flipped.obj", cube_text(0, 1, true)),
                    part = write_file("part.obj",
                                      cube_text(0, 1, false) + cube_text(2.5, 0.2, true, 8));
  const Words limits = {"--max=+0.25abs,-0.05abs"};
  const Outcome right = run(Words{"gate", a, b} + limits);
  CHECK(right.exit_code == 1);
  CHECK(right.out.find("inside out") == std::string::npos);
  const std::string junit = folder() / "flipped.xml";
  const Outcome wrong = run(Words{"gate", a, flipped, "--junit=" + junit} + limits);
  CHECK(wrong.exit_code == 0);
  const std::string first =
      "PASS  if the inputs are right (B is inside out, so that over means "
      "inside it): every point of A is within 0.25 over B and 0.05 under it";
  CHECK(starts_with(wrong.out, first));
  CHECK(wrong.out.find("\n  side of B  it has an inside, which decides, and is inside out: over "
                       "means inside it\n") != std::string::npos);
  const std::string xml = read_file(junit);
  CHECK(xml.find(first) != std::string::npos);
  CHECK(xml.find("\ninside-out: B is inside out") != std::string::npos);
  const json answer = answer_in(run(Words{"gate", a, flipped, "--json"} + limits).out);
  CHECK(answer["directions"][0]["signed"]["inside_out"] == "all");
  CHECK(answer["notes"][0]["code"] == "inside-out");
  CHECK(run(Words{"gate", a, part} + limits)
            .out.find("a part of B is inside out, so that over means inside it") !=
        std::string::npos);
  // Without limits of sides no verdict hangs on it: a note is enough.
  const Outcome distance = run({"distance", a, flipped, "--signed", "--symmetric"});
  CHECK(distance.out.substr(0, distance.out.find('\n')).find("inside out") == std::string::npos);
  CHECK(distance.out.find("\n  note       inside-out: B is inside out") != std::string::npos);
  CHECK(distance.out.find("A is inside out") == std::string::npos);
  CHECK(run({"distance", flipped, b, "--signed", "--symmetric"})
            .out.find("\n  note       inside-out: A is inside out") != std::string::npos);
}

TEST_CASE("faces of B that are against each other have no sides") {
  const std::string b =
      write_file("against.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\n");
  const Outcome refused = run({"distance", square_a(), b, "--signed"});
  CHECK(refused.exit_code == 4);
  CHECK(refused.err.find("faces 0 and 1: oriented against each other at the edge from (") !=
        std::string::npos);
  CHECK(run({"distance", square_a(), b}).exit_code == 0);
}

TEST_CASE("PASS, FAIL and UNDECIDED: words first, and the exit code") {
  const Outcome pass = gate("0.3abs");
  CHECK(pass.exit_code == 0);
  // The boxes are far apart for their size, which each first line says.
  const std::string odd =
      "the boxes of A and B do not meet, and their centres are 0.25 apart, A's by (0, 0, -0.25)";
  const std::string odd_pass = "PASS  if the inputs are right (" + odd + "): ";
  CHECK(starts_with(pass.out, odd_pass + "every point of A is within 0.3 of B, proven ("));
  CHECK(
      starts_with(gate("0.3abs", {"--worst"}).out,
                  odd_pass + "every point of A is within 0.3 of B, proven (largest deviation 0.2"));
  const Outcome fail = gate("0.2abs");
  CHECK(fail.exit_code == 1);
  CHECK(pass.out.find("). A to B only; --symmetric also finds what A lacks of B\n") !=
        std::string::npos);
  CHECK(starts_with(fail.out, "FAIL  at least 0.2"));
  CHECK(fail.out.find(" from A to B at (") != std::string::npos);
  CHECK(fail.out.find(") on face ") != std::string::npos);
  CHECK(fail.out.find(" of A, limit 0.2. Check the inputs: " + odd + "\n") != std::string::npos);
  CHECK(gate("0.3abs", {"--symmetric"}).out.find("A to B only") == std::string::npos);
  const Outcome undecided = gate("0.25abs");
  CHECK(undecided.exit_code == 3);
  CHECK(starts_with(undecided.out, "UNDECIDED  the limit 0.25 lies in [0.2"));
  const Outcome early = gate("0.251abs", {"--time", "1ms"});
  CHECK(early.exit_code == 3);
  CHECK(early.out.find("ask for more --time") != std::string::npos);
}

TEST_CASE("a limit is required, and no number alone") {
  for (const Words& words : {Words{"gate", square_a(), square_b()},
                             Words{"gate", square_a(), square_b(), "--max", "0.3"},
                             Words{"gate", square_a(), square_b(), "--max", "0abs"}}) {
    const Outcome outcome = run(words);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.find("--max") != std::string::npos);
  }
}

TEST_CASE("a share of the area of what has none is refused") {
  const std::string line = write_file("gate_line.obj", "v 0 0 0\nv 1 0 0\nv 3 0 0\nf 1 2 3\n");
  const Outcome none = run({"gate", line, square_b(), "--max", "9abs", "--area", "99%"});
  CHECK(none.exit_code == 4);
  CHECK(none.err.find(line + ": faces without area; expected a surface") != std::string::npos);
}

TEST_CASE("both directions: what is beyond may be a point of B") {
  const Words pair = {"gate", square_a(), long_one(), "--max", "0.5abs"};
  CHECK(run(pair).exit_code == 0);
  Words both = pair;
  both.emplace_back("--symmetric");
  const Outcome outcome = run(both);
  CHECK(outcome.exit_code == 1);
  CHECK(starts_with(outcome.out, "FAIL  at least 0.9"));
  CHECK(outcome.out.find(" from B to A at (") != std::string::npos);
  CHECK(
      outcome.out.find(
          " of B, limit 0.5. Check the inputs: A's extent in x is 50 % of B's; the boxes' centres "
          "are 0.5 apart, A's by (-0.5, 0, 0)\n") != std::string::npos);
  both[4] = "1.01abs";
  CHECK(run(both).exit_code == 0);
}

TEST_CASE("units: what the files are in, and what a length is in") {
  CHECK(gate("7mm", {"--unit", "in"}).exit_code == 0);  // 0.2756 in
  CHECK(gate("6mm", {"--unit", "in"}).exit_code == 1);
  const Outcome unknown = gate("6mm");
  CHECK(unknown.exit_code == 2);
  CHECK(unknown.err.find("say so with --unit, or give the length") != std::string::npos);
  CHECK(gate("6mm", {"--unit", "miles"}).exit_code == 2);
  CHECK(gate("6mm", {"--unit", "inch"}).err.find("--unit 'inch': did you mean in?") !=
        std::string::npos);
  CHECK(gate("0,1mm", {"--unit", "in"}).err.find("did you mean 0.1mm?") != std::string::npos);
  for (const Words& apart : {Words{"--max", "0.1", "mm"}, Words{"--max=0.1", "mm"}}) {
    const Outcome outcome = run(Words{"gate", square_a(), square_b()} + apart);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.find("--max '0.1 mm': write 0.1mm, without a blank") != std::string::npos);
  }
  const std::string line = gate("7mm", {"--unit", "in"}).out;
  CHECK(line.find("): every point of A is within 7 mm of B, proven (") != std::string::npos);
  CHECK(line.substr(0, line.find('\n')).find("). A to B only") != std::string::npos);
  const json r = answer_in(gate("7mm", {"--unit", "in", "--json"}).out);
  CHECK(r["interval"]["unit"] == "in");
  CHECK(r["max"]["within"].get<double>() < 7 / 25.4);
  CHECK(r["max"]["beyond"].get<double>() > 7 / 25.4);
  CHECK(r["max"]["beyond"].get<double>() == doctest::Approx(7 / 25.4).epsilon(1e-14));
}

TEST_CASE("the object says what was asked, the verdict and the words") {
  const json pass = answer_in(gate("0.3abs", {"--json"}).out);
  CHECK(pass["verdict"] == "pass");
  CHECK(pass["command"] == "gate");
  CHECK(pass["max"]["requested"] == "0.3abs");
  CHECK(starts_with(pass["words"].get<std::string>(), "PASS"));
  CHECK(pass["interval"]["upper"].get<double>() <= 0.3);
  const json fail = answer_in(gate("0.2abs", {"--json"}).out);
  CHECK(fail["verdict"] == "fail");
  CHECK(fail["interval"]["lower"].get<double>() > 0.2);
  const json& witness = fail["directions"][0]["witness"];
  CHECK(witness["to"]["point"][2].get<double>() - witness["from"]["point"][2].get<double>() ==
        doctest::Approx(0.25));
  CHECK(answer_in(gate("0.25abs", {"--json"}).out)["verdict"] == "undecided");
}

TEST_CASE("an answer that is given early forgets no limit, and verifies no witness that is not") {
  const Words narrow = {"--face-max", write_file("narrow.csv", "0,0.01\n1,0.01\n")};
  for (const char* time : {"1ms", "100ms"}) {
    CAPTURE(time);
    const int code = gate("10abs", narrow + Words{"--time", time, "--no-cache"}).exit_code;
    CHECK((code == 3 || code == 1));
  }
  const Outcome none =
      run({"distance", square_a(), square_b(), "--waves", "0", "--verify", "--json"});
  CHECK((none.exit_code == 0 || none.exit_code == 3));
  CHECK(json::accept(none.out));
}

TEST_CASE("no printed end of an interval is on the other side of the limit") {
  const Outcome outcome = gate("0.2499999abs");
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("[0.2499,") == std::string::npos);
  CHECK(starts_with(outcome.out, "FAIL  0.25 from A to B at ("));
}

TEST_CASE("a FAIL tells no upper end, and --worst goes on to the farthest point") {
  const Outcome plain = gate("0.01abs"), worst = gate("0.01abs", {"--worst", "--json"});
  CHECK(starts_with(plain.out, "FAIL  at least "));
  CHECK(plain.out.find("\n  interval ") == std::string::npos);
  CHECK(worst.exit_code == 1);
  const json answer = answer_in(worst.out);
  const double lower = answer["interval"]["lower"], upper = answer["interval"]["upper"];
  CHECK(lower >= 0.24);
  CHECK(upper <= 1.002 * lower);
  CHECK(answer["status"] == "limit");
  CHECK(starts_with(answer["words"], "FAIL  0.2"));
}

TEST_CASE("too little memory is said") {
  const auto notes = [](const char* memory) {
    const json answer = answer_in(gate("0.3abs", {"--json", "--memory", memory}).out);
    std::vector<std::string> texts;
    for (const json& note : answer["notes"]) {
      if (note["code"] == "memory") texts.push_back(note["text"]);
    }
    return texts;
  };
  const std::vector<std::string> of_one = notes("1");
  REQUIRE(of_one.size() == 1);
  CHECK(starts_with(of_one[0], "--memory is less than a search"));
  CHECK(notes("16MiB").empty());
}

TEST_CASE("inputs are named by their SHA-256, where the build has a library for it") {
  const std::string known = write_file("known.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const json r = answer_in(run({"distance", known, square_a(), "--json"}).out);
  const json& digest = r["inputs"][0]["sha256"];
  if (digest.is_null()) return;
  CHECK(digest == "697b00ab13410c52a542d2e9c63711fcc04e9cbf6c0d3439a9b43cc812e6e713");
  CHECK(r["inputs"][1]["sha256"] != digest);
  CHECK(r["inputs"][0]["files"] == json::array());
  const json demo = answer_in(run({"demo", "--waves", "1", "--json"}).out);
  CHECK(demo["inputs"][0]["sha256"].is_null());
  CHECK(demo["inputs"][0]["files"].is_null());
}

TEST_CASE("--github: an annotation, and the run's summary after what is there") {
  const std::string summary = write_file("summary.md", "before\n");
  setenv("GITHUB_STEP_SUMMARY", summary.c_str(), 1);
  const Outcome fail = gate("0.2abs", {"--github"});
  CHECK(fail.exit_code == 1);
  CHECK(starts_with(fail.out, "::error file="));
  CHECK(fail.out.find(",title=vkhausdorff gate::FAIL") != std::string::npos);
  CHECK(starts_with(gate("0.3abs", {"--github"}).out, "::notice"));
  const Outcome undecided = gate("0.25abs", {"--github", "--json"});
  CHECK(starts_with(undecided.err, "::warning"));  // beside the object there is no room
  CHECK(json::accept(undecided.out));
  const std::string text = read_file(summary);
  CHECK(starts_with(text, "before\n### :x: vkhausdorff gate\n"));
  CHECK(text.find(":white_check_mark:") != std::string::npos);
  // An output that cannot be written costs neither the answer nor its words.
  setenv("GITHUB_STEP_SUMMARY", (folder() / "no/such/file").c_str(), 1);
  const Outcome lost = gate("0.3abs", {"--github"});
  CHECK(lost.exit_code == 6);
  CHECK(lost.out.find("PASS") != std::string::npos);
  unsetenv("GITHUB_STEP_SUMMARY");
}

TEST_CASE("build servers are told what became of polygons and bodies") {
  const std::string quad =
      write_file("quad,.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 2\n");
  const std::string junit = folder() / "notes.xml", summary = write_file("notes.md", "");
  setenv("GITHUB_STEP_SUMMARY", summary.c_str(), 1);
  const Outcome outcome =
      run({"gate", quad, square_b(), "--max", "0.3abs", "--github", "--junit=" + junit});
  unsetenv("GITHUB_STEP_SUMMARY");
  CHECK(outcome.exit_code == 0);
  const std::string note = "A: polygons: 1 face of more than three corners was triangulated";
  const std::string annotation = outcome.out.substr(0, outcome.out.find('\n'));
  CHECK(annotation.find("%0A" + note) != std::string::npos);
  CHECK(annotation.find("points, polylines") != std::string::npos);
  CHECK(read_file(summary).find("| note | `" + note + "` |") != std::string::npos);
  const std::string xml = read_file(junit), begin = "<system-out>PASS";
  const size_t at = xml.find(begin);
  REQUIRE(at != std::string::npos);
  CHECK(xml.substr(at, xml.find("</system-out>") - at).find("\n" + note) != std::string::npos);
}

TEST_CASE("--polygons any answers for every triangulation, and not for figures of one") {
  const std::string bent =
      write_file("bent.obj", "v 0 0 0\nv 1 0 0.1\nv 1 1 0\nv 0 1 0.1\nf 1 2 3 4\n");
  const Words pair = {"distance", bent, bent, "--polygons", "any"};
  const Outcome outcome = run(pair);
  CHECK(outcome.exit_code == 3);  // it is never narrower than that
  CHECK(outcome.out.find("the surface is known to within 0.101: the interval is wider by it") !=
        std::string::npos);
  CHECK(outcome.out.find("NOT CLOSED (precision): a surface is known to within 0.101, which no "
                         "smaller --tol narrows") != std::string::npos);
  CHECK(run({"gate", bent, bent, "--max", "0.15abs"}).exit_code == 0);
  const Outcome open = run({"gate", bent, bent, "--max", "0.15abs", "--polygons", "any"});
  CHECK(open.exit_code == 3);
  CHECK(open.out.find("; no smaller --tol helps: a surface is known to within 0.101") !=
        std::string::npos);
  CHECK(run({"gate", bent, bent, "--max", "0.3abs", "--polygons", "any"}).exit_code == 0);
  // The picture is a map by cells, and what the polygons leave open is not resolved.
  const auto unresolved = [](const Words& words) {
    const Outcome drawn = run(words);
    CAPTURE(drawn.err);
    REQUIRE((drawn.exit_code == 0 || drawn.exit_code == 3));
    return Json::parse(drawn.out)["directions"][0]["map"]["unresolved"].get<double>();
  };
  const Words drawing = {"--json", "--image", folder() / "bent.png"};
  const std::string flat =
      write_file("flat.obj", "v 0 0 0\nv 1 0 0.001\nv 1 1 0\nv 0 1 0.001\nf 1 2 3 4\n");
  const Words any = {"--polygons", "any"};
  CHECK(unresolved(Words{"distance", flat, flat} + any + drawing) == doctest::Approx(1));
  CHECK(unresolved(Words{"distance", flat, flat} + drawing) == 0);
  for (const Words& more : {Words{"--stats"}, Words{"--report", folder() / "bent.html"},
                            Words{"--certificate", folder() / "bent.vhc"}}) {
    const Outcome refused = run(pair + more);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("--polygons any: areas and certificates are of one triangulation") !=
          std::string::npos);
  }
}

TEST_CASE("--bodies all measures what a scene hides, and build servers are told") {
  Document scene = triangle_document();
  const Json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
  scene.json["scenes"] = {{{"nodes", {0, 1}}}};
  scene.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 9}}, {"extensions", hidden}});
  const std::string a = write_file("hidden.gltf", scene.text()),
                    b = write_file("shown.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto told = [&](const Words& more) {
    return run(Words{"gate", a, b, "--max", "1m", "--github"} + more);
  };
  const std::string left = "A: bodies: left out: 1 hidden node",
                    included = "A: bodies: included, though not shown: 1 hidden node";
  const Outcome solid = told({});
  CHECK(solid.exit_code == 0);
  CHECK(solid.out.find("%0A" + left) != std::string::npos);
  const Outcome all = told({"--bodies", "all"});
  CHECK(all.exit_code == 1);
  CHECK(all.out.find("%0A" + included) != std::string::npos);
  const Outcome wrong = told({"--bodies", "none"});
  CHECK(wrong.exit_code == 2);
  CHECK(wrong.err.find("--bodies 'none': expected solid or all") != std::string::npos);
}

TEST_CASE("names that would break a line, a terminal or XML are escaped") {
  const std::string odd = square("ev\x1b[31m<i>&\"l\n,:%.obj", 1, 0), junit = folder() / "odd.xml";
  const Outcome outcome =
      run({"gate", odd, square_b(), "--max", "0.2abs", "--github", "--junit=" + junit});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find('\x1b') == std::string::npos);
  CHECK(outcome.out.find("%2C%3A%25.obj,title=") != std::string::npos);
  const std::string xml = read_file(junit);
  CHECK(xml.find("&lt;i&gt;&amp;&quot;l\\x0a,:%.obj") != std::string::npos);
  CHECK(xml.find('\x1b') == std::string::npos);
  const Outcome missing = run({"gate", "no\x1b[31m.obj", odd, "--max", "0.2abs"});
  CHECK(missing.exit_code == 4);
  CHECK(missing.err.find('\x1b') == std::string::npos);
}

TEST_CASE("--junit: one test case, its failure, or why there is no verdict") {
  const std::string junit = folder() / "gate.xml";
  const auto written = [&](const std::string& max) {
    gate(max, {"--junit", junit});
    return read_file(junit);
  };
  CHECK(written("0.3abs").find("failures=\"0\" errors=\"0\"") != std::string::npos);
  const std::string fail = written("0.2abs");
  CHECK(fail.find("failures=\"1\" errors=\"0\"") != std::string::npos);
  CHECK(fail.find("<failure type=\"beyond the limit\" message=\"FAIL") != std::string::npos);
  CHECK(written("0.25abs").find("<error type=\"undecided\"") != std::string::npos);
  run({"gate", "missing.obj", square_a(), "--max", "1abs", "--junit=" + junit});
  CHECK(read_file(junit).find("<error type=\"no answer\" message=\"missing.obj: ") !=
        std::string::npos);
}

/// The processor time of a run after `signal`, in seconds; its object is checked.
double latency(const Words& words, int signal, int after_ms) {
  const double before = processor_seconds_of_ended();
  const Running running = start(words);
  wait_until_caught(running, signal);
  std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
  const double at_signal = processor_seconds(running);
  kill(running.process, signal);
  const Outcome outcome = finish(running);
  const double seconds = processor_seconds_of_ended() - before - at_signal;
  CAPTURE(outcome.err);
  CHECK(outcome.signal == 0);
  CHECK(outcome.exit_code == 3);
  REQUIRE(json::accept(outcome.out));
  const json r = answer_in(outcome.out);
  CHECK(r["status"] == "cancelled");
  const json& interval = r["interval"];
  CHECK(interval["lower"].get<double>() <= 1);
  if (!interval["upper"].is_null()) CHECK(interval["upper"].get<double>() >= 0.99);
  return seconds;
}

std::string sphere(const std::string& name, double radius) {
  std::ostringstream text;
  text.precision(17);
  const auto mesh = icosphere(radius, 7);
  for (const auto& v : mesh.vertices) text << "v " << v.x << " " << v.y << " " << v.z << "\n";
  for (const auto& f : mesh.faces)
    text << "f " << f.x + 1 << " " << f.y + 1 << " " << f.z + 1 << "\n";
  return write_file(name, text.str());
}

TEST_CASE("Ctrl-C and SIGTERM are heard at any time, and leave a true interval") {
  // Every facet of a sphere is as far from another about it, and in little memory they are refined
  // a few at a time: half a minute on a fast machine. The processor time shows how soon it ends:
  // other programs do not lengthen it.
  const Words words = {"distance",
                       sphere("inner.obj", 1),
                       sphere("outer.obj", 2),
                       "--tol",
                       "1e-13",
                       "--memory",
                       "1",
                       "--json",
                       "--no-cache"};
  for (const auto& [signal, after_ms] : {std::pair{SIGINT, 0}, {SIGTERM, 500}, {SIGINT, 2000}}) {
    const int after = after_ms;
    CAPTURE(after);
    CHECK(latency(words, signal, after) < 5);  // 0.2 s
  }
}

TEST_CASE("--time counts from the program's start") {
  for (const char* time : {"1ms", "400ms"}) {
    CAPTURE(time);
    const double before = processor_seconds_of_ended();
    const Outcome outcome =
        run({"demo", "--tol", "1e-13", "--memory", "1", "--json", "--no-cache", "--time", time});
    CHECK(processor_seconds_of_ended() - before < 5);
    CHECK(outcome.exit_code == 3);
    const json r = answer_in(outcome.out);
    CHECK(r["status"] == "time");
    CHECK(r["interval"]["lower"].get<double>() <= 0.0361167);
  }
}

}  // namespace
