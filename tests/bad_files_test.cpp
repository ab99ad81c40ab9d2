// Every file of the shared collection of bad files does what its manifest's line says.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "host/error.h"
#include "host/mesh_io.h"
#include "tests/support/error_line.h"

namespace {

using vkh::InputError;
using vkh::Mesh;
using vkh::test::check_error_line;

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

// What we do where the manifest leaves a choice, or begins with the word for the other half of it.
const std::map<std::string, bool> kAcceptedByChoice = {
    {"obj_1e-200_coords.obj", true},            // the solver's frame rescales
    {"obj_1e200_coords.obj", true},             // likewise
    {"obj_nan_unreferenced.obj", false},        // text that says nan is refused wherever it stands
    {"real_assimp_concave_polygon.obj", true},  // fanned, and the note says what that means
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
    const Mesh mesh = vkh::read_mesh(path);
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

TEST_CASE("every file of the bad-file manifest does what its line says") {
  const auto folder = shared_folder() / "bad";
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

int main(int argc, char** argv) {
  if (!std::filesystem::exists(shared_folder() / "bad")) {
    std::printf("skipped: no folder %s\n", (shared_folder() / "bad").c_str());
    return 77;  // what CTest takes for skipped
  }
  return doctest::Context(argc, argv).run();
}
