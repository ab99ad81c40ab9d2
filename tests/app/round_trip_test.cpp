// Reads the JSON that the program writes back as the same bytes, whatever was asked.
#include <doctest/doctest.h>

#include <string>

#include "tests/support/program.h"
#include "vkhausdorff/answer.h"

namespace {

using namespace vkh::test;

std::string rectangle(const std::string& width, const std::string& z) {
  return "v 0 0 " + z + "\nv " + width + " 0 " + z + "\nv " + width + " 1 " + z + "\nv 0 1 " + z +
         "\nf 1 2 3\nf 1 3 4\n";
}

const Words& pair() {
  static const Words files = {write_file("a.obj", rectangle("1", "0")),
                              write_file("b.obj", rectangle("2", "0.1"))};
  return files;
}

/// Runs the program, and returns its JSON's line.
std::string line_of(const std::string& command, const Words& more) {
  const std::string out = run(Words{command} + pair() + Words{"--json"} + more).out;
  REQUIRE(out.ends_with('\n'));
  return out.substr(0, out.size() - 1);
}

TEST_CASE("distances are read back byte for byte") {
  const std::string certificate = folder() / "proof.vhc";
  for (const Words& more :
       {Words{}, Words{"--symmetric"}, Words{"--symmetric", "--tol", "1e-9diag", "--waves", "1"},
        Words{"--verify"}, Words{"--stats", "--bands", "0.05abs,1%", "--effort", "1000"},
        Words{"--stats", "--symmetric", "--effort", "100"}, Words{"--certificate", certificate},
        Words{"--symmetric", "--certificate", certificate}, Words{"--device", "0,0"},
        Words{"--part", "1/2"}, Words{"--part", "0/2", "--known-lower", "0.1abs"},
        Words{"--unit", "mm", "--tol", "0.01in"}, Words{"--time", "1ms", "--symmetric"}}) {
    CAPTURE(more);
    const std::string line = line_of("distance", more);
    CHECK(vkh::to_json(vkh::answer_from_json(line)) == line);
  }
}

TEST_CASE("verdicts are read back byte for byte") {
  const std::string limits = write_file("limits.csv", "1,0.05\n"),
                    wide = write_file("wide.csv", "1,0.5\n");
  for (const Words& more :
       {Words{"--max", "0.2abs"}, Words{"--max", "0.05abs"}, Words{"--max", "0.1abs"},
        Words{"--max", "5%", "--symmetric"}, Words{"--max", "0.2abs", "--symmetric"},
        Words{"--max", "3mm", "--unit", "in"}, Words{"--max", "0.2abs", "--face-max", limits},
        Words{"--max", "0.2abs", "--face-max", wide},
        Words{"--max", "0.2abs", "--symmetric", "--face-max-b", wide},
        Words{"--max", "0.2abs", "--area", "99.5%"}, Words{"--max", "0.05abs", "--area", "50%"},
        Words{"--max", "0.2abs", "--symmetric", "--area", "0.9"}}) {
    CAPTURE(more);
    const std::string line = line_of("gate", more);
    CHECK(vkh::to_json(vkh::answer_from_json(line)) == line);
  }
}

TEST_CASE("failures are read back byte for byte") {
  const Outcome outcome = run({"distance", "gone.obj", pair()[1], "--json"});
  const std::string line = outcome.out.substr(0, outcome.out.find('\n'));
  CHECK(vkh::to_json(vkh::failure_from_json(line)) == line);
}

}  // namespace
