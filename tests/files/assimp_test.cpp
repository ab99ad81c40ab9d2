// Scenes as assimp reads them: the same triangles as a set, up to its rounding to float. Documents
// of our own, and every sample below $VKH_SAMPLES (Khronos', the 3MF consortium's), which are read
// alike or refused by name. The test is skipped if assimp's program is not there (Debian:
// assimp-utils).
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "tests/files/gltf_document.h"
#include "tests/shapes/shapes.h"
#include "tests/support/files.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

using namespace vkh;
using namespace vkh::test;

namespace {

namespace fs = std::filesystem;
using Triangle = std::array<glm::dvec3, 3>;

bool has_assimp() { return std::system("assimp version >/dev/null 2>&1") == 0; }

/// Debian's assimp 5.2 takes the integers of quantised positions for floats.
bool is_quantised(const std::string& path) {
  return read_file(path).find("KHR_mesh_quantization") != std::string::npos;
}

/// The file as assimp converts it, its nodes' transforms applied: a binary STL of floats.
std::optional<Mesh> by_assimp(const std::string& path) {
  const std::string out = folder() / "assimp.stl";
  fs::remove(out);
  const std::string command =
      "timeout 120 assimp export '" + path + "' '" + out + "' -fstlb -ptv >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0 || !fs::exists(out)) return std::nullopt;
  try {
    return read_mesh(out);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> out;
  for (const glm::uvec3& f : mesh.faces)
    out.push_back({mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]});
  return out;
}

/// The largest distance of corners, in the best of the six orders.
double apart(const Triangle& s, const Triangle& t) {
  std::array<int, 3> order = {0, 1, 2};
  double best = INFINITY;
  do {
    double worst = 0;
    for (size_t c = 0; c < 3; ++c)
      worst = std::max(worst, glm::distance(s[c], t[static_cast<size_t>(order[c])]));
    best = std::min(best, worst);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

/// The triangles of one set that have a partner of their own in the other.
class Partners {
 public:
  Partners(const std::vector<Triangle>& all, double within) : all_(all), within_(within) {
    used_.resize(all.size());
    for (size_t i = 0; i < all.size(); ++i) cells_[cell_of(all[i], {0, 0, 0})].push_back(i);
  }

  bool take(const Triangle& t) {
    for (int n = 0; n < 27; ++n) {
      const auto cell = cells_.find(cell_of(t, {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1}));
      if (cell == cells_.end()) continue;
      for (const size_t i : cell->second) {
        if (used_[i] || apart(t, all_[i]) > within_) continue;
        used_[i] = true;
        return true;
      }
    }
    return false;
  }

 private:
  using Cell = std::array<int64_t, 3>;
  Cell cell_of(const Triangle& t, const glm::ivec3& off) const {
    const glm::dvec3 centre = (t[0] + t[1] + t[2]) / 3.0 / (2 * within_);
    Cell cell{};
    for (int i = 0; i < 3; ++i)
      cell[static_cast<size_t>(i)] = static_cast<int64_t>(std::floor(centre[i])) + off[i];
    return cell;
  }

  const std::vector<Triangle>& all_;
  double within_;
  std::vector<bool> used_;
  std::map<Cell, std::vector<size_t>> cells_;
};

/// The difference of two sets; empty if both are the same.
std::string difference(const Mesh& ours, const Mesh& theirs) {
  if (ours.faces.size() != theirs.faces.size()) {
    return std::to_string(ours.faces.size()) + " faces, and " +
           std::to_string(theirs.faces.size()) + " by assimp";
  }
  double size = 0;
  for (const glm::dvec3& v : ours.vertices) size = std::max(size, glm::length(v));
  const std::vector<Triangle> all = triangles_of(theirs);
  Partners partners(all, 1e-5 * size + 1e-30);
  size_t alone = 0;
  for (const Triangle& t : triangles_of(ours)) alone += partners.take(t) ? 0 : 1;
  return alone == 0 ? "" : std::to_string(alone) + " faces without a partner";
}

/// One row of the table.
struct Outcome {
  bool is_read = false, is_like_assimp = false, is_unknown_to_assimp = false;
  std::string text;
};

Outcome outcome_of(const std::string& path) {
  Outcome out;
  Mesh ours;
  try {
    ours = read_mesh(path);
  } catch (const InputError& error) {
    out.text = std::string("refused: ") + std::string(error.what()).substr(path.size() + 2);
    return out;
  }
  out.is_read = true;
  char text[96];
  std::snprintf(text, sizeof text, "%zu faces, delta %.2g %s: ", ours.faces.size(), ours.delta,
                ours.unit.c_str());
  std::optional<Mesh> theirs;
  if (!is_quantised(path)) theirs = by_assimp(path);
  out.is_unknown_to_assimp = !theirs;
  const std::string apart = theirs ? difference(ours, *theirs) : "assimp does not read it";
  out.is_like_assimp = theirs && apart.empty();
  out.text = text + (apart.empty() ? "as assimp" : apart);
  return out;
}

void check_like_assimp(const char* name, const Document& document) {
  CAPTURE(name);
  const Outcome out = outcome_of(write_file(name, document.text()));
  CAPTURE(out.text);
  CHECK(out.is_like_assimp);
}

Document sphere_document() {
  Document document;
  const Mesh mesh = icosphere(1, 2);
  std::vector<float> xyz;
  for (const glm::dvec3& v : mesh.vertices)
    for (int i = 0; i < 3; ++i) xyz.push_back(static_cast<float>(v[i]));
  std::vector<uint16_t> corners;
  for (const glm::uvec3& f : mesh.faces)
    for (int i = 0; i < 3; ++i) corners.push_back(static_cast<uint16_t>(f[i]));
  const size_t positions = document.add_positions(xyz);
  document.add_mesh(positions, {{"indices", document.add_indices(corners)}});
  return document;
}

}  // namespace

TEST_CASE("documents of our own") {
  if (!has_assimp()) {
    MESSAGE("not tested: assimp is not there (Debian: assimp-utils)");
    return;
  }
  Document document = sphere_document();
  check_like_assimp("plain.gltf", document);
  document.json["nodes"] = {
      {{"children", {1, 2}}, {"rotation", {0.5, 0.5, -0.5, 0.5}}, {"scale", {1, 2, 3}}},
      {{"mesh", 0}, {"translation", {1, 2, 3}}, {"children", {3}}},
      {{"mesh", 0}, {"matrix", {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 0.1, 0, 5, 6, 7, 1}}},
      {{"mesh", 0}, {"rotation", {0.1825742, 0.3651484, 0.5477226, 0.7302967}}}};
  check_like_assimp("nested.gltf", document);
  Document strip;
  const size_t positions = strip.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 1});
  strip.add_mesh(positions, {{"mode", 5}});
  check_like_assimp("strip.gltf", strip);
  strip.json["meshes"][0]["primitives"][0]["mode"] = 6;
  check_like_assimp("fan.gltf", strip);
}

TEST_CASE("a difference is seen") {
  const Mesh mesh = icosphere(1, 1);
  CHECK(difference(mesh, mesh).empty());
  Mesh moved = mesh;
  moved.vertices[3].x += 1e-4;
  CHECK(!difference(mesh, moved).empty());
  moved = mesh;
  moved.faces[0] = moved.faces[1];
  CHECK(difference(mesh, moved) == "1 faces without a partner");
}

TEST_CASE("samples") {
  const char* samples = std::getenv("VKH_SAMPLES");
  if (samples == nullptr || !fs::exists(samples) || !has_assimp()) {
    MESSAGE("not tested: no $VKH_SAMPLES, or no assimp");
    return;
  }
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(samples)) {
    const std::string extension = entry.path().extension().string();
    if ((extension == ".gltf" || extension == ".glb" || extension == ".3mf") &&
        entry.is_regular_file())
      paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  size_t read = 0, alike = 0, unknown = 0;
  for (const std::string& path : paths) {
    const Outcome out = outcome_of(path);
    std::printf("%s | %s\n", path.c_str() + std::string(samples).size(), out.text.c_str());
    read += out.is_read ? 1 : 0;
    alike += out.is_like_assimp ? 1 : 0;
    unknown += out.is_unknown_to_assimp ? 1 : 0;
  }
  std::printf("%zu samples: %zu read, %zu of them as assimp, %zu that assimp does not read\n",
              paths.size(), read, alike, unknown);
  CHECK(alike + unknown == read);
}
