// 3MF: what its build puts on the plate. libzip unpacks, expat parses; lib3mf 1.8, which Debian 12
// and Ubuntu 24.04 have, rounds every coordinate to float.
#include "host/base/text_scanner.h"
#include "host/read/readers.h"

#ifdef VKH_HAS_3MF
#include <algorithm>

#include "host/threemf/model.h"

namespace vkh {
namespace threemf {
namespace {

constexpr size_t kMostLevels = 256;
// More than any mesh can have, and no sum of two of them wraps.
constexpr uint64_t kManyFaces = uint64_t{1} << 40;

class Builder {
 public:
  Builder(const MeshSource& source, Model& model)
      : source_(source), model_(model), builder_(source) {}

  Mesh build() {
    count_faces();
    uint64_t faces = 0;
    for (const Use& item : model_.items)
      faces = std::min(kManyFaces, faces + built(item).face_count);
    if (faces >= UINT32_MAX) {
      reject(source_.name, "byte 0", std::to_string(faces) + " faces, each object at each place",
             "fewer than 2^32 - 1");
    }
    builder_.reserve(0, faces);
    size_t most = 0;
    for (const Object& object : model_.objects)
      most = std::max(most, object.vertices.end - object.vertices.begin);
    slots_.resize(most);
    for (const Use& item : model_.items) add(item);
    add_notes();
    const std::string unit = model_.unit;
    slots_ = {};
    model_ = {};  // before the mesh is made of what was built
    Mesh mesh = std::move(builder_).finish("byte " + std::to_string(source_.bytes.size()));
    mesh.delta = delta_;
    mesh.unit = unit;
    return mesh;
  }

 private:
  /// An object that is open, and which of its components comes next.
  struct Level {
    uint32_t object = 0;
    size_t next = 0;
    scene::Affine map;
  };

  /// Where a position of an object went, for the use that is being added.
  struct Slot {
    uint64_t use = 0;
    uint32_t vertex = 0;
  };

  const Object& built(const Use& item) {
    const Object& object = model_.objects[model_.find(source_, item, kNone)];
    if (object.is_other) {
      reject(source_.name, "line " + std::to_string(item.line),
             "object " + std::to_string(item.id) + " is of type other", "one that can be built");
    }
    return object;
  }

  // Those of other parts first: the root uses them. Components without a face are left out: an
  // object may be used often, and each time what is looked at shall give some.
  void count_faces() {
    for (const bool is_root : {false, true}) {
      for (uint32_t i = 0; i < model_.objects.size(); ++i) {
        Object& object = model_.objects[i];
        if ((object.part == 0) != is_root) continue;
        object.face_count = object.faces.end - object.faces.begin;
        size_t kept = object.components.begin;
        for (size_t c = object.components.begin; c < object.components.end; ++c) {
          const Object& other = model_.objects[model_.find(source_, model_.components[c], i)];
          if (other.face_count == 0) continue;
          object.face_count = std::min(kManyFaces, object.face_count + other.face_count);
          model_.components[kept++] = model_.components[c];
        }
        object.components.end = kept;
      }
    }
  }

  void enter(const Use& use, uint32_t user, const scene::Affine& outer) {
    const uint32_t number = model_.find(source_, use, user);
    const Object& object = model_.objects[number];
    if (object.face_count == 0) return;
    if (levels_.size() == kMostLevels) {
      reject(source_.name, "line " + std::to_string(use.line),
             "components lie " + std::to_string(kMostLevels) + " levels deep", "fewer levels");
    }
    levels_.push_back(
        {number, object.components.begin, scene::compose(outer, map_of(model_, use))});
    has_support_ = has_support_ || object.is_support;
    if (object.faces.begin != object.faces.end) add_mesh(object, levels_.back().map);
  }

  void add(const Use& item) {
    enter(item, kNone, {});
    while (!levels_.empty()) {
      Level& level = levels_.back();
      if (level.next == model_.objects[level.object].components.end) {
        levels_.pop_back();
        continue;
      }
      const size_t component = level.next++;
      const scene::Affine outer = level.map;  // the level may move as others are added
      enter(model_.components[component], level.object, outer);
    }
  }

  void add_mesh(const Object& object, const scene::Affine& map) {
    const scene::Mover mover(map, 0);
    ++use_;
    for (size_t f = object.faces.begin; f < object.faces.end; ++f) {
      glm::uvec3 face{};
      for (int c = 0; c < 3; ++c) {
        const uint32_t corner = model_.faces[f][c];
        Slot& slot = slots_[corner];
        if (slot.use != use_) {
          slot = {use_, static_cast<uint32_t>(builder_.vertices().size())};
          builder_.add_vertex(mover(model_.vertices[object.vertices.begin + corner], delta_));
        }
        face[c] = slot.vertex;
      }
      builder_.add_triangle(face);
    }
  }

  void add_notes() {
    if (has_support_) builder_.notes.emplace_back("objects of type support are part of it");
  }

  const MeshSource& source_;
  Model& model_;
  MeshBuilder builder_;
  std::vector<Level> levels_;
  std::vector<Slot> slots_;
  uint64_t use_ = 0;
  bool has_support_ = false;
  double delta_ = 0;
};

Mesh read_whole(const MeshSource& source) {
  Package package(source);
  Model model = read_model(source, package);
  return Builder(source, model).build();
}

}  // namespace
}  // namespace threemf

Mesh parse_3mf(const MeshSource& source) { return in_memory(source, threemf::read_whole); }

}  // namespace vkh
#else
vkh::Mesh vkh::parse_3mf(const MeshSource& source) {
  reject(source.name, "byte 0", "a 3MF file, and this program was built without what reads it",
         "a build with libzip-dev and libexpat1-dev");
}
#endif
