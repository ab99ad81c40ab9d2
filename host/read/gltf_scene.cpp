#include "host/read/gltf_scene.h"

#include <algorithm>
#include <cmath>

#include "host/base/reject.h"
#include "vkhausdorff/note.h"

namespace vkh::gltf {
namespace {

// More levels than any file that people made has; a level takes 200 bytes.
constexpr size_t kMostLevels = 256;
// A unit quaternion of floats is off by 1e-7, one that was typed by 1e-4.
constexpr double kUnitWithin = 1e-3;

}  // namespace

Scene::Scene(const MeshSource& source, const Model& model) : source_(source), model_(model) {
  choose();
  check_trees();
  check_rotations();
  note_hidden();
}

void Scene::fail(uint32_t node, const std::string& what, const std::string& expected) const {
  reject(source_.name, place_of("nodes", node), what, expected);
}

void Scene::choose() {
  const size_t count = model_.scenes.size();
  const bool has_default = model_.scene != kNone;
  const uint32_t chosen = has_default ? model_.scene : 0;
  if (chosen >= count) {
    reject(source_.name, "scene " + std::to_string(chosen), "there is none", "a scene");
  }
  if (model_.scenes[chosen] != kNone) roots_ = model_.roots[model_.scenes[chosen]];
  if (count == 1) return;
  notes_.push_back(note_of(
      NoteCode::kScene, "scene " + std::to_string(chosen) + " of " + std::to_string(count) +
                            (has_default ? " read: the default" : " read: none is the default")));
}

const NodeDetail* Scene::detail_of(uint32_t node) const {
  const uint32_t detail = model_.nodes[node];
  return detail == kNone ? nullptr : &model_.details[detail];
}

template <class Enter>
void Scene::walk(const Enter& enter) const {
  std::vector<Level> levels;
  levels.push_back({.nodes = roots_, .next = 0, .map = {}});
  while (!levels.empty()) {
    Level& level = levels.back();
    if (level.next == level.nodes.count) {
      levels.pop_back();
      continue;
    }
    const uint32_t node = model_.indices[level.nodes.begin + level.next++];
    Level below;
    const bool is_entered = enter(node, level.map, below.map);
    const NodeDetail* detail = detail_of(node);
    if (!is_entered || detail == nullptr || detail->children.count == 0) continue;
    if (levels.size() == kMostLevels)
      fail(node, "it lies " + std::to_string(kMostLevels) + " levels deep", "fewer levels");
    below.nodes = detail->children;
    levels.push_back(below);
  }
}

// Each node has one parent, or is a root once: so a traversal ends, and costs no more than the
// file.
void Scene::check_trees() {
  std::vector<bool> seen(model_.nodes.size());
  walk([&](uint32_t node, const scene::Affine&, scene::Affine&) {
    if (node >= seen.size()) fail(node, "there is none", "a node that is there");
    if (seen[node]) fail(node, "it has two parents, or is its own ancestor", "trees of nodes");
    seen[node] = true;
    return true;
  });
}

void Scene::check_rotations() {
  uint64_t off = 0;
  walk([&](uint32_t node, const scene::Affine&, scene::Affine&) {
    const NodeDetail* detail = detail_of(node);
    if (detail == nullptr || detail->placing == kNone) return true;
    const uint32_t at = model_.placings[detail->placing].rotation;
    if (at == kNone) return true;
    const auto& n = model_.numbers;
    const double length2 = scene::squared_length({n[at], n[at + 1], n[at + 2], n[at + 3]});
    if (!(std::abs(length2 - 1) <= kUnitWithin)) ++off;
    return true;
  });
  if (off > 0) {
    notes_.push_back(
        note_of(NoteCode::kRotations,
                counted(off, "rotation") +
                    " of a length other than 1 read as the rotation of that direction"));
  }
}

bool Scene::is_hidden(uint32_t node) const {
  const NodeDetail* detail = detail_of(node);
  return detail != nullptr && detail->is_hidden;
}

void Scene::note_hidden() {
  uint64_t count = 0;
  walk([&](uint32_t node, const scene::Affine&, scene::Affine&) {
    if (is_hidden(node)) ++count;
    return !is_hidden(node);
  });
  if (count == 0) return;
  const char* fate = is_all() ? "included, though not shown: " : "left out: ";
  notes_.push_back(
      note_of(NoteCode::kBodies, fate + counted(count, "hidden node") + " and what is below"));
}

scene::Affine Scene::map_of(uint32_t node) const {
  const NodeDetail* detail = detail_of(node);
  if (detail == nullptr || detail->placing == kNone) return {};
  const NodePlacing& parts = model_.placings[detail->placing];
  const auto copy = [&](uint32_t from, auto& to) {
    if (from == kNone) return;
    for (size_t i = 0; i < to.size(); ++i) to[i] = model_.numbers[from + i];
  };
  scene::Placing placing;
  copy(parts.translation, placing.translation);
  copy(parts.rotation, placing.rotation);
  copy(parts.scale, placing.scale);
  const std::optional<scene::Affine> map = scene::affine_of(placing);
  if (!map) fail(node, "a rotation of length 0", "a unit quaternion");
  if (parts.matrix == kNone) return *map;
  if (!scene::is_identity(*map)) fail(node, "a matrix beside its parts", "one or the other");
  std::array<double, 16> columns{};
  copy(parts.matrix, columns);
  scene::Affine::Rows given{};
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 4; ++c) given[r][c] = columns[4 * c + r];
  }
  if (columns[3] != 0 || columns[7] != 0 || columns[11] != 0 || columns[15] != 1)
    fail(node, "a matrix that is not affine", "0, 0, 0, 1 in its last row");
  return scene::affine_of(given);
}

void Scene::for_each(const std::function<void(const Instance&)>& use) const {
  walk([&](uint32_t node, const scene::Affine& outer, scene::Affine& map) {
    if (is_hidden(node) && !is_all()) return false;
    map = scene::compose(outer, map_of(node));
    const NodeDetail* detail = detail_of(node);
    if (detail == nullptr || detail->mesh == kNone) return true;
    if (detail->mesh >= model_.meshes.size())
      fail(node, "mesh " + std::to_string(detail->mesh) + " is not there", "a mesh that is there");
    use({node, detail, map});
    return true;
  });
}

}  // namespace vkh::gltf
