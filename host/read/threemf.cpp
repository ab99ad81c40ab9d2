// 3MF: the objects that its build puts on the plate. libzip unpacks, expat parses; lib3mf 1.8,
// which Debian 12 and Ubuntu 24.04 have, rounds every coordinate to float.
#include "host/base/reject.h"
#include "host/read/readers.h"
#include "vkhausdorff/note.h"

#ifdef VKH_HAS_3MF
#include <algorithm>
#include <array>
#include <deque>

#include "host/read/threemf_model.h"

namespace vkh {
namespace threemf {
namespace {

constexpr const char* kOrAll = "--bodies all, which measures everything as it lies";
constexpr size_t kMostLevels = 256;
// A count larger than any mesh can have, but small enough that a sum of two does not wrap.
constexpr uint64_t kManyFaces = uint64_t{1} << 40;

class Builder {
 public:
  Builder(const MeshSource& source, Model& model, const Volumes& volumes)
      : source_(source), model_(model), volumes_(volumes), builder_(source) {}

  ReadMesh build() {
    count_faces();
    if (build_.face_count >= UINT32_MAX) {
      reject(source_.name, "byte 0",
             std::to_string(build_.face_count) + " faces, each object at each place",
             "fewer than 2^32 - 1");
    }
    builder_.reserve(0, build_.measured_count);
    size_t most = 0;
    for (const Object& object : model_.objects)
      most = std::max(most, object.vertices.end - object.vertices.begin);
    slots_.resize(most);
    for (const Use& item : model_.items) add_item(item);
    add_note();
    const std::string unit = model_.unit;
    slots_ = {};
    model_ = {};  // before the mesh is made of the built shapes
    ReadMesh mesh = std::move(builder_).finish("byte " + std::to_string(source_.bytes.size()));
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

  /// Shapes that are no bodies, and their faces.
  struct Count {
    uint64_t shapes = 0, faces = 0;
  };
  using Counts = std::array<Count, kRoleCount>;

  /// The place where a position of an object went, for the use that is being added.
  struct Slot {
    uint64_t use = 0;
    uint32_t vertex = 0;
  };

  bool is_all() const { return source_.limits.bodies == Bodies::kAll; }

  // Objects of other parts come first: the root uses them.
  void count_faces() {
    for (const bool is_root : {false, true}) {
      for (uint32_t i = 0; i < model_.objects.size(); ++i) {
        if ((model_.objects[i].part == 0) == is_root) count_object(i);
      }
    }
    for (const Use& item : model_.items) {
      const Object& object = model_.objects[model_.find(source_, item, kNone)];
      add_use(build_, role_of(item, kNone, object), object);
    }
  }

  // Leaves out components that give no face: an object may be used often, and then all of its
  // components that are visited have faces.
  void count_object(uint32_t number) {
    Object& object = model_.objects[number];
    object.face_count = object.measured_count = object.faces.end - object.faces.begin;
    object.lacks_shape = !object.has_shape;
    count_volumes(object);
    size_t kept = object.components.begin;
    for (size_t c = object.components.begin; c < object.components.end; ++c) {
      const Use& use = model_.components[c];
      const Object& other = model_.objects[model_.find(source_, use, number)];
      if (other.lacks_shape) {
        object.lacks_shape = true;
        object.foreign = other.foreign;
      }
      if (add_use(object, role_of(use, number, other), other)) model_.components[kept++] = use;
    }
    object.components.end = kept;
  }

  static void add(uint64_t& sum, uint64_t faces) { sum = std::min(kManyFaces, sum + faces); }

  // Returns whether it gives faces, or ends in a refusal.
  bool is_looked_at(const Object& object) const {
    return object.measured_count > 0 ||
           (object.others != kNone &&
            others_[object.others][static_cast<size_t>(Role::kNegative)].shapes > 0);
  }

  // Adds the faces that an object gives, in some role, to its user, and returns whether they are
  // read.
  bool add_use(Object& user, Role role, const Object& object) {
    if (object.face_count == 0) return false;
    add(user.face_count, object.face_count);
    if (role != Role::kBody) {
      count_other(user, role, object.face_count);
      if (is_all()) add(user.measured_count, object.face_count);
      return is_all() || role == Role::kNegative;
    }
    if (object.others != kNone) {
      for (size_t r = 0; r < kRoleCount; ++r)
        count_other(user, static_cast<Role>(r), others_[object.others][r]);
    }
    add(user.measured_count, object.measured_count);
    return is_looked_at(object);
  }

  void count_other(Object& user, Role role, const Count& count) {
    if (count.shapes == 0) return;
    if (user.others == kNone) {
      user.others = static_cast<uint32_t>(others_.size());
      others_.emplace_back();
    }
    Count& sum = others_[user.others][static_cast<size_t>(role)];
    add(sum.shapes, count.shapes);
    add(sum.faces, count.faces);
  }
  void count_other(Object& user, Role role, uint64_t faces) {
    count_other(user, role, Count{.shapes = 1, .faces = faces});
  }

  // A slicer makes one mesh of an object's volumes: calls use(range, end) for each that is no body.
  template <class Use>
  void for_others(const Object& object, const Use& use) const {
    const auto found = volumes_.ranges.find(object.id);
    if (object.part != 0 || found == volumes_.ranges.end()) return;
    const size_t count = object.faces.end - object.faces.begin;
    for (const Volumes::Range& range : found->second) {
      if (range.first >= count) break;
      if (range.role != Role::kBody) use(range, std::min<uint64_t>(range.last + 1ull, count));
    }
  }

  void count_volumes(Object& object) {
    for_others(object, [&](const Volumes::Range& range, uint64_t end) {
      count_other(object, range.role, end - range.first);
      if (!is_all()) object.measured_count -= end - range.first;
    });
  }

  void enter(const Use& use, uint32_t user, const scene::Affine& outer) {
    const uint32_t number = model_.find(source_, use, user);
    const Object& object = model_.objects[number];
    const Role role = role_of(use, user, object);
    if (role != Role::kBody && !is_all()) {
      if (role == Role::kNegative) refuse_negative("line " + std::to_string(use.line), use.id);
      return;
    }
    if (object.lacks_shape) refuse_shape(use, object);
    if (!is_looked_at(object)) return;
    if (levels_.size() == kMostLevels) {
      reject(source_.name, "line " + std::to_string(use.line),
             "components lie " + std::to_string(kMostLevels) + " levels deep", "fewer levels");
    }
    levels_.push_back(
        {number, object.components.begin, scene::compose(outer, map_of(model_, use))});
    if (object.faces.begin != object.faces.end) add_mesh(object, levels_.back().map);
  }

  void add_item(const Use& item) {
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

  // A slicer's entry for a component stands with the object of the root that has it.
  Role role_of(const Use& use, uint32_t user, const Object& object) const {
    if (!use.is_printed) return Role::kUnprinted;
    if (user != kNone && model_.objects[user].part == 0) {
      const auto found = volumes_.components.find({model_.objects[user].id, use.id});
      if (found != volumes_.components.end() && found->second != Role::kBody) return found->second;
    }
    return object.role;
  }

  [[noreturn]] void refuse_negative(const std::string& place, uint32_t id) const {
    reject(source_.name, place,
           "object " + std::to_string(id) + " has a negative volume, which a slicer subtracts",
           std::string("bodies alone: subtract it there, and export again; or ") + kOrAll);
  }

  [[noreturn]] void refuse_shape(const Use& use, const Object& object) const {
    reject(source_.name, "line " + std::to_string(use.line),
           "object " + std::to_string(use.id) + " has a shape that is not read" +
               (object.foreign.empty() ? "" : ", " + vkh::quoted(object.foreign)),
           "objects of triangles alone");
  }

  std::vector<Volumes::Range> left_out_of(const Object& object) const {
    std::vector<Volumes::Range> left;
    if (is_all()) return left;
    for_others(object, [&](const Volumes::Range& range, uint64_t /*end*/) {
      if (range.role == Role::kNegative) refuse_negative("byte 0", object.id);
      left.push_back(range);
    });
    return left;
  }

  // A mirror turns faces round (core specification 1.4, 4.1).
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
      if (map.sign < 0) std::swap(face.y, face.z);
      builder_.add_triangle(face);
    }
  }

  // Adds a note such as "bodies: left out: 1 modifier (12 faces), 2 support blockers (24 faces)".
  void add_note() {
    if (build_.others == kNone) return;
    std::string list;
    for (size_t r = 0; r < kRoleCount; ++r) {
      const Count& count = others_[build_.others][r];
      if (count.shapes == 0) continue;
      list += (list.empty() ? "" : ", ") + counted(count.shapes, name_of(static_cast<Role>(r))) +
              " (" + counted(count.faces, "face") + ")";
    }
    if (builder_.face_count() == 0)
      reject(source_.name, "byte 0", "it has no bodies, only " + list,
             std::string("a body, or ") + kOrAll);
    const char* fate = is_all() ? "included, though not printed as body: " : "left out: ";
    builder_.notes.push_back(note_of(NoteCode::kBodies, fate + list));
  }

  const MeshSource& source_;
  Model& model_;
  const Volumes& volumes_;
  FileMeshBuilder builder_;
  std::vector<Level> levels_;
  std::vector<Slot> slots_;
  uint64_t use_ = 0;
  Object build_;               // the build, which uses the items
  std::deque<Counts> others_;  // by role, for objects that have shapes which are no bodies
  double delta_ = 0;
};

ReadMesh read_whole(const MeshSource& source) {
  Package package(source);
  Model model = read_model(source, package);
  const Volumes volumes = read_volumes(source, package);
  return Builder(source, model, volumes).build();
}

}  // namespace
}  // namespace threemf

ReadMesh parse_3mf(const MeshSource& source) { return in_memory(source, threemf::read_whole); }

}  // namespace vkh
#else
vkh::ReadMesh vkh::parse_3mf(const MeshSource& source) {
  reject(source.name, "byte 0", "a 3MF file, and this program was built without what reads it",
         "a build with libzip-dev and libexpat1-dev");
}
#endif
