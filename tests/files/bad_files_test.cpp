// Every file of the corpus that tests/files/malformed writes has the outcome of its case, read in
// process and, a few, by the program. The same holds for the files of the shared collection, if
// that is there.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/support/error_line.h"
#include "tests/support/program.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace {

using vkh::InputError;
using vkh::ReadMesh;
using vkh::test::check_error_line;

/// One case of the corpus.
struct Case {
  std::filesystem::path path;
  std::string expected;  ///< R, or A and the count of faces; Q, or P, for a file read as points
  std::string says;      ///< stands in the refusal or in a note
};

// Written by tests/files/malformed/write.py, which CTest runs before this test.
std::vector<Case> corpus() {
  const char* folder = std::getenv("VKH_MALFORMED");
  REQUIRE_MESSAGE(folder,
                  "VKH_MALFORMED has to name the folder that tests/files/malformed/write.py wrote");
  std::ifstream manifest(std::filesystem::path(folder) / "manifest.tsv");
  std::vector<Case> cases;
  std::string name, expected, says;
  while (std::getline(manifest, name, '\t') && std::getline(manifest, expected, '\t') &&
         std::getline(manifest, says)) {
    cases.push_back({std::filesystem::path(folder) / name, expected, says});
  }
  return cases;
}

void check_case(const Case& file) {
  CAPTURE(file.path);
  const bool points = file.expected[0] == 'P' || file.expected[0] == 'Q';
  std::string outcome = points ? "Q" : "R", said;
  try {
    const ReadMesh mesh = vkh::read_mesh(file.path, {.points = points});
    CHECK(mesh.are_points == points);
    outcome = (points ? "P" : "A") + std::to_string(mesh.faces.size());
    for (const std::string& note : lines_of(mesh.notes)) said += note + "\n";
  } catch (const InputError& error) {
    said = error.what();
    check_error_line(said, file.path.string());
    CHECK(said.size() < file.path.string().size() + 200);
  }
  CAPTURE(said);
  CHECK(outcome == file.expected);
  CHECK(said.find(file.says) != std::string::npos);
}

std::vector<std::string> csv_cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool in_quotes = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && in_quotes && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[i++];
    } else if (line[i] == '"') {
      in_quotes = !in_quotes;
    } else if (line[i] == ',' && !in_quotes) {
      cells.emplace_back();
    } else if (line[i] != '\r') {
      cells.back() += line[i];
    }
  }
  return cells;
}

// Our outcome if the manifest leaves a choice, or begins with the word for the other half of it.
const std::map<std::string, bool> kAcceptedByChoice = {
    {"obj_1e-200_coords.obj", true},            // the solver's frame rescales
    {"obj_1e200_coords.obj", true},             // the same
    {"obj_nan_unreferenced.obj", true},         // dropped, as in binary PLY
    {"real_assimp_concave_polygon.obj", true},  // cut along its outline
    {"real_assimp_longline.obj", false},        // its first face crosses itself
    {"real_assimp_face_texcoord_oob.ply", false},
    {"real_assimp_malformed2.obj", true},  // an empty face is ignored and noted
    {"stl_count_too_small.stl", false},    // a part of a model must not pass for the whole
};

void check_bad_file(const std::filesystem::path& path, const std::vector<std::string>& row) {
  const std::string file = row[0];
  const auto choice = kAcceptedByChoice.find(file);
  const bool accepted =
      choice != kAcceptedByChoice.end() ? choice->second : row[6].starts_with("ACCEPT");
  CAPTURE(file);
  try {
    const ReadMesh mesh = vkh::read_mesh(path);
    REQUIRE_MESSAGE(accepted, "accepted with " << mesh.faces.size() << " faces");
    CHECK(mesh.counts.faces == mesh.faces.size());
    if (!row[4].empty()) CHECK(mesh.counts.faces == std::stoull(row[4]));
  } catch (const InputError& error) {
    REQUIRE_MESSAGE(!accepted, error.what());
    check_error_line(error.what(), path.string());
  }
}

std::filesystem::path shared_folder() {
  if (const char* folder = std::getenv("VKH_SHARED")) return folder;
  return std::filesystem::path(__FILE__).parent_path() / "../../shared";
}

}  // namespace

TEST_CASE("every malformed file is refused or read whole, as its case says") {
  const std::vector<Case> cases = corpus();
  CHECK(cases.size() > 600);
  CHECK(std::count_if(cases.begin(), cases.end(),
                      [](const Case& file) { return file.expected[0] == 'P'; }) > 50);
  for (const Case& file : cases) check_case(file);
}

// A refusal by the program: exit code 4, and one line that names the file. This runs one file in
// twelve.
TEST_CASE("the program refuses malformed files in one line" * doctest::test_suite("program")) {
  const std::vector<Case> cases = corpus();
  size_t refused = 0;
  for (size_t i = 0; i < cases.size(); i += 12) {
    if (cases[i].expected != "R") continue;
    CAPTURE(cases[i].path);
    const auto outcome = vkh::test::run({"distance", cases[i].path.string(), "no_such_file.obj"});
    CHECK(outcome.exit_code == 4);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find(cases[i].path.string() + ": ") != std::string::npos);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    ++refused;
  }
  CHECK(refused > 20);
}

TEST_CASE("every file of the shared collection does what its line of the manifest says") {
  const auto folder = shared_folder() / "bad";
  if (!std::filesystem::exists(folder)) {
    MESSAGE("not tested: no folder " << folder);
    return;
  }
  std::ifstream manifest(folder / "manifest.csv");
  REQUIRE(manifest);
  std::string line;
  std::getline(manifest, line);
  std::set<std::string> listed = {"manifest.csv"};
  while (std::getline(manifest, line)) {
    const auto row = csv_cells(line);
    REQUIRE(row.size() == 7);
    listed.insert(row[0]);
    check_bad_file(folder / row[0], row);
  }
  CHECK(listed.size() > 100);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    CHECK(listed.count(entry.path().filename().string()) == 1);
  }
}
