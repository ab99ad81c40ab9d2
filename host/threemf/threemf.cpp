// 3MF: what its build puts on the plate. libzip unpacks, expat parses; lib3mf 1.8, which Debian 12
// and Ubuntu 24.04 have, rounds every coordinate to float.
#include "host/base/note.h"
#include "host/base/text_scanner.h"
#include "host/read/readers.h"

#ifdef VKH_HAS_3MF
#include <algorithm>
#include <map>

#include "host/threemf/model.h"

namespace vkh {
namespace threemf {
namespace {

constexpr size_t kMostLevels = 256;
// More than any mesh can have, and no sum of two of them wraps.
constexpr uint64_t kManyFaces = uint64_t{1} << 40;

class Builder {
 public:
  Builder(const MeshSource& source, Model& model, const Volumes& volumes)
      : source_(source), model_(model), volumes_(volumes), builder_(source) {}

  Mesh build() {
    count_faces();
    uint64_t faces = 0;
    for (const Use& item : model_.items) {
      if (item.is_printed) faces = std::min(kManyFaces, faces + built(item).face_count);
    }
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
    add_note();
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
    if (object.role == Role::kOther) {
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
        object.lacks_shape = !object.has_shape;
        size_t kept = object.components.begin;
        for (size_t c = object.components.begin; c < object.components.end; ++c) {
          const Object& other = model_.objects[model_.find(source_, model_.components[c], i)];
          if (other.lacks_shape) {
            object.lacks_shape = true;
            object.foreign = other.foreign;
          }
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
    if (!use.is_printed) return leave_out("unprinted item", object.face_count);
    const Role role = role_of(use, user, object);
    if (role == Role::kNegative) refuse_negative("line " + std::to_string(use.line), use.id);
    if (role != Role::kBody) return leave_out(name_of(role), object.face_count);
    if (object.lacks_shape) refuse_shape(use, object);
    if (object.face_count == 0) return;
    if (levels_.size() == kMostLevels) {
      reject(source_.name, "line " + std::to_string(use.line),
             "components lie " + std::to_string(kMostLevels) + " levels deep", "fewer levels");
    }
    levels_.push_back(
        {number, object.components.begin, scene::compose(outer, map_of(model_, use))});
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

  // What a slicer says of a component stands with the object of the root that has it.
  Role role_of(const Use& use, uint32_t user, const Object& object) const {
    if (user != kNone && model_.objects[user].part == 0) {
      const auto found = volumes_.components.find({model_.objects[user].id, use.id});
      if (found != volumes_.components.end() && found->second != Role::kBody) return found->second;
    }
    return object.role;
  }

  void leave_out(const std::string& what, uint64_t faces) {
    LeftOut& left = left_out_[what];
    ++left.count;
    left.faces += faces;
  }

  [[noreturn]] void refuse_negative(const std::string& place, uint32_t id) const {
    reject(source_.name, place,
           "object " + std::to_string(id) + " has a negative volume, which a slicer subtracts",
           "bodies alone: subtract it there, and export again");
  }

  [[noreturn]] void refuse_shape(const Use& use, const Object& object) const {
    reject(source_.name, "line " + std::to_string(use.line),
           "object " + std::to_string(use.id) + " has a shape that is not read" +
               (object.foreign.empty() ? "" : ", " + vkh::quoted(object.foreign)),
           "objects of triangles alone");
  }

  // Of the volumes that a slicer made one mesh of, those that are no bodies.
  std::vector<Volumes::Range> left_out_of(const Object& object) {
    std::vector<Volumes::Range> left;
    const auto found = volumes_.ranges.find(object.id);
    if (object.part != 0 || found == volumes_.ranges.end()) return left;
    const size_t count = object.faces.end - object.faces.begin;
    for (const Volumes::Range& range : found->second) {
      if (range.first >= count) break;
      if (range.role == Role::kBody) continue;
      if (range.role == Role::kNegative) refuse_negative("byte 0", object.id);
      leave_out(name_of(range.role), std::min<uint64_t>(range.last + 1ull, count) - range.first);
      left.push_back(range);
    }
    return left;
  }

  void add_mesh(const Object& object, const scene::Affine& map) {
    const scene::Mover mover(map, 0);
    const std::vector<Volumes::Range> left = left_out_of(object);
    auto next = left.begin();
    ++use_;
    for (size_t f = object.faces.begin; f < object.faces.end; ++f) {
      const size_t number = f - object.faces.begin;
      while (next != left.end() && next->last < number) ++next;
      if (next != left.end() && next->first <= number) continue;
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

  // "bodies: left out: 1 modifier (12 faces), 2 support blockers (24 faces)".
  void add_note() {
    if (left_out_.empty()) return;
    std::string all;
    for (const auto& [what, left] : left_out_) {
      all += (all.empty() ? "" : ", ") + counted(left.count, what) + " (" +
             counted(left.faces, "face") + ")";
    }
    if (builder_.face_count() == 0)
      reject(source_.name, "byte 0", "it has no bodies, only " + all, "a body");
    builder_.notes.push_back(note_of(NoteCode::kBodies, "left out: " + all));
  }

  struct LeftOut {
    uint64_t count = 0, faces = 0;
  };

  const MeshSource& source_;
  Model& model_;
  const Volumes& volumes_;
  MeshBuilder builder_;
  std::vector<Level> levels_;
  std::vector<Slot> slots_;
  uint64_t use_ = 0;
  std::map<std::string, LeftOut> left_out_;  // by what they are
  double delta_ = 0;
};

Mesh read_whole(const MeshSource& source) {
  Package package(source);
  Model model = read_model(source, package);
  const Volumes volumes = read_volumes(source, package);
  return Builder(source, model, volumes).build();
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
