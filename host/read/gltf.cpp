// glTF 2.0 and GLB: a scene's triangles, each where its nodes put it.
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "host/base/reject.h"
#include "host/read/gltf_data.h"
#include "host/read/gltf_scene.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace gltf {
namespace {

/// The mode of a primitive; points and lines stand before these.
enum Mode : uint8_t { kTriangles = 4, kStrip = 5, kFan = 6 };

class Reader {
 public:
  Reader(const MeshSource& source, const Model& model, std::string_view chunk)
      : source_(source),
        model_(model),
        scene_(source, model),
        data_(source, model, chunk),
        builder_(source),
        noted_(model.meshes.size()) {}

  ReadMesh read() {
    scene_.for_each([&](const Instance& instance) { count(instance); });
    if (faces_ >= UINT32_MAX) {
      reject(source_.name, "byte 0", std::to_string(faces_) + " faces, each mesh at each node",
             "fewer than 2^32 - 1");
    }
    builder_.reserve(0, faces_);
    slots_.resize(most_positions_);
    scene_.for_each([&](const Instance& instance) { add(instance); });
    add_notes();
    ReadMesh mesh = std::move(builder_).finish("byte " + std::to_string(source_.bytes.size()));
    mesh.delta = delta_;
    mesh.unit = "m";
    return mesh;
  }

  /// The files that read() opens, by name, or tries to open before it refuses the document.
  std::vector<FileBeneath> files() {
    std::set<uint32_t> buffers;
    std::vector<bool> is_known(model_.meshes.size());
    scene_.for_each([&](const Instance& instance) {
      if (is_known[instance.detail->mesh]) return;
      is_known[instance.detail->mesh] = true;
      for_primitives(instance, [&](uint32_t number) {
        const Primitive& primitive = model_.primitives[number];
        data_.add_buffers(primitive.position, buffers);
        data_.add_buffers(primitive.indices, buffers);
        check_going(source_.name, source_.limits);
      });
    });
    std::map<std::string, std::filesystem::path> by_name;
    for (const uint32_t number : buffers) {
      const std::string_view uri = model_.buffers[number].uri;
      if (uri.empty() || is_data(uri)) continue;
      const NamedFile file = data_.file_of(number);
      if (!file.name.empty()) by_name.emplace(file.name, file.path);
    }
    std::vector<FileBeneath> files;
    files.reserve(by_name.size());
    for (const auto& [name, path] : by_name) files.push_back({name, path});
    return files;
  }

 private:
  /// The place where a position went: the vertex, for the column that is being read.
  struct Slot {
    uint32_t column = 0, vertex = 0;
  };

  [[noreturn]] void fail(const char* list, size_t number, const std::string& what,
                         const std::string& expected) const {
    reject(source_.name, place_of(list, number), what, expected);
  }

  void check_kind(const Instance& instance, const Primitive& primitive) {
    if (primitive.mode > kFan)
      fail("meshes", instance.detail->mesh, "a primitive of an unknown mode", "0 to 6");
    const bool is_there = primitive.position != kNone && data_.has_data(primitive.position) &&
                          (primitive.indices == kNone || data_.has_data(primitive.indices));
    if (primitive.is_draco && !is_there) {
      fail("meshes", instance.detail->mesh, "KHR_draco_mesh_compression, which is not read",
           "a file without it, such as one that was decoded");
    }
  }

  void note_rest(const Instance& instance) {
    if (noted_[instance.detail->mesh]) return;
    noted_[instance.detail->mesh] = true;
    const MeshEntry& mesh = model_.meshes[instance.detail->mesh];
    lines_ += mesh.line_count;
    without_positions_ += mesh.placeless_count;
  }

  uint64_t faces_of(const Instance& instance, const Primitive& primitive, uint64_t corners) const {
    const bool is_whole = primitive.mode == kTriangles ? corners % 3 == 0 : corners >= 3;
    if (!is_whole) {
      fail("meshes", instance.detail->mesh, counted(corners, "corner") + " are no whole triangles",
           primitive.mode == kTriangles ? "a multiple of three" : "three or more");
    }
    return primitive.mode == kTriangles ? corners / 3 : corners - 2;
  }

  void check_pose(const Instance& instance, const MeshEntry& mesh, const Primitive& primitive) {
    if (!primitive.has_targets) return;
    const NodeDetail& node = *instance.detail;
    if (node.has_weights ? node.has_morph_weight : mesh.has_morph_weight) {
      fail("nodes", instance.node, "morph targets at weights other than 0",
           "a mesh whose pose was applied");
    }
    has_targets_ = true;
  }

  template <class Use>
  void for_primitives(const Instance& instance, const Use& use) {
    const Range range = model_.meshes[instance.detail->mesh].primitives;
    for (uint32_t i = range.begin; i < range.begin + range.count; ++i) use(i);
  }

  // Counts an instance before it is added, and so before anything is allocated for it.
  void count(const Instance& instance) {
    if (instance.detail->skin != kNone) {
      fail("nodes", instance.node, "a skin, whose pose decides the shape",
           "a mesh whose pose was applied");
    }
    if (instance.detail->instances) {
      fail("nodes", instance.node, "EXT_mesh_gpu_instancing, which is not read",
           "a node for each instance");
    }
    note_rest(instance);
    for_primitives(instance, [&](uint32_t number) {
      const Primitive& primitive = model_.primitives[number];
      check_kind(instance, primitive);
      check_pose(instance, model_.meshes[instance.detail->mesh], primitive);
      const Column positions = data_.positions(primitive.position);
      const uint32_t corners =
          primitive.indices == kNone ? positions.count : data_.indices(primitive.indices).count;
      faces_ += faces_of(instance, primitive, corners);
      most_positions_ = std::max(most_positions_, positions.count);
      check_going(source_.name, source_.limits);
    });
  }

  void add(const Instance& instance) {
    uint32_t last = kNone;
    is_mirrored_ = instance.map.sign < 0;
    for_primitives(instance, [&](uint32_t number) {
      const Primitive& primitive = model_.primitives[number];
      // Primitives that follow each other share the positions that they have in common.
      if (primitive.position != last) start_column();
      last = primitive.position;
      const Column positions = data_.positions(primitive.position);
      std::optional<Column> indices;
      if (primitive.indices != kNone) indices = data_.indices(primitive.indices);
      const scene::Mover mover(instance.map, positions.relative_off());
      const auto vertex = [&](uint64_t corner) {
        const uint64_t index = indices ? indices->index(corner) : corner;
        return vertex_of(positions, index, mover);
      };
      add_faces(primitive.mode, indices ? indices->count : positions.count, vertex);
    });
  }

  void start_column() {
    if (++column_ != 0) return;
    std::fill(slots_.begin(), slots_.end(), Slot{});
    column_ = 1;
  }

  uint32_t vertex_of(const Column& positions, uint64_t index, const scene::Mover& mover) {
    if (index >= positions.count) {
      reject(source_.name, positions.place,
             "index " + std::to_string(index) + " of " + counted(positions.count, "position"),
             "indices below that count");
    }
    Slot& slot = slots_[index];
    if (slot.column != column_) {
      slot = {column_, static_cast<uint32_t>(builder_.vertices().size())};
      builder_.add_vertex(mover(positions.position(index), delta_));
    }
    return slot.vertex;
  }

  template <class Vertex>
  void add_faces(uint8_t mode, uint64_t corners, const Vertex& vertex) {
    if (mode == kTriangles) {
      for (uint64_t i = 0; i < corners; i += 3) {
        const uint32_t j = vertex(i), k = vertex(i + 1);  // vertices in the order of corners
        add_face(j, k, vertex(i + 2));
      }
      return;
    }
    const uint32_t first = vertex(0);
    for (uint64_t i = 2; i < corners; ++i) {
      const uint32_t before = vertex(i - 1), here = vertex(i);
      if (mode == kFan) {
        add_face(first, before, here);
      } else {  // every other face of a strip is turned round
        const uint32_t oldest = vertex(i - 2);
        i % 2 == 0 ? add_face(oldest, before, here) : add_face(before, oldest, here);
      }
    }
  }

  // A mirror turns faces round (specification 2.0, 3.7.4).
  void add_face(uint32_t i, uint32_t j, uint32_t k) {
    builder_.add_triangle(is_mirrored_ ? glm::uvec3(i, k, j) : glm::uvec3(i, j, k));
  }

  void add_notes() {
    builder_.notes = scene_.notes();
    const auto note = [&](bool holds, NoteCode code, const std::string& text) {
      if (holds) builder_.notes.push_back(note_of(code, text));
    };
    note(lines_ > 0, NoteCode::kElements,
         counted(lines_, "primitive") + " of points or lines ignored");
    note(without_positions_ > 0, NoteCode::kPositions,
         counted(without_positions_, "primitive") + " without positions ignored");
    note(has_targets_, NoteCode::kMorph, "morph targets at weight 0: the base shape");
    note(model_.has_animations, NoteCode::kAnimations,
         "animations ignored: nodes as the file places them");
  }

  const MeshSource& source_;
  const Model& model_;
  const Scene scene_;
  Data data_;
  FileMeshBuilder builder_;
  uint64_t faces_ = 0, lines_ = 0, without_positions_ = 0;
  uint32_t most_positions_ = 0, column_ = 0;
  bool has_targets_ = false, is_mirrored_ = false;
  std::vector<bool> noted_;  // meshes whose points and lines were counted
  std::vector<Slot> slots_;
  double delta_ = 0;
};

constexpr std::string_view kMagic = "glTF";

/// The two chunks of a GLB.
struct Chunks {
  std::string_view json, binary;
  uint64_t bytes_behind = 0;  ///< bytes that its header does not count
};

Chunks chunks_of(const MeshSource& source) {
  constexpr size_t kHeader = 12, kChunkHeader = 8;
  constexpr uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
  const std::string_view file = source.bytes;
  const auto fail = [&](size_t at, const std::string& what, const std::string& expected) {
    reject(source.name, "byte " + std::to_string(at), what, expected);
  };
  if (file.size() < kHeader + kChunkHeader) fail(file.size(), "the file ends here", "a GLB");
  const uint32_t version = load<uint32_t>(&file[4]), length = load<uint32_t>(&file[8]);
  if (version != 2) fail(4, "GLB version " + std::to_string(version), "version 2");
  if (length > file.size()) {
    fail(8, "a GLB of " + counted(length, "byte") + " in a file of " + std::to_string(file.size()),
         "as many bytes as its header says");
  }
  const std::string_view bytes = file.substr(0, length), behind = file.substr(length);
  if (behind.starts_with(kMagic)) fail(length, "another GLB behind the first", "one GLB a file");
  Chunks chunks{.json = {}, .binary = {}, .bytes_behind = behind.size()};
  size_t at = kHeader;
  while (at < bytes.size()) {
    if (bytes.size() - at < kChunkHeader) fail(at, "half a chunk's header", "whole chunks");
    const uint32_t size = load<uint32_t>(&bytes[at]), type = load<uint32_t>(&bytes[at + 4]);
    const bool is_first = at == kHeader;
    at += kChunkHeader;
    if (size > bytes.size() - at) fail(at, "a chunk of " + counted(size, "byte"), "whole chunks");
    if (is_first && type != kJson) fail(at, "the first chunk is no JSON", "the JSON chunk");
    if (is_first) chunks.json = bytes.substr(at, size);
    if (type == kBinary && chunks.binary.empty()) chunks.binary = bytes.substr(at, size);
    at += size;
  }
  return chunks;
}

// A GLB's binary chunk names no file, and need not be read for it. Empty if the file is no GLB.
std::string json_of_glb(const MeshSource& source) {
  constexpr uint64_t kHeaders = 20;
  const std::string head = head_of(source, kHeaders);
  if (head.size() < kHeaders) return "";
  const uint64_t size = load<uint32_t>(&head[12]);
  if (size > source.size() - kHeaders) return "";
  Windows windows(source);
  return std::string(Windows::Window(windows).read(kHeaders, kHeaders + size));
}

ReadMesh read_whole(const MeshSource& source) {
  const bool is_glb = source.bytes.starts_with(kMagic);
  const Chunks chunks = is_glb ? chunks_of(source) : Chunks{.json = source.bytes, .binary = {}};
  const Model model = read_model(source, chunks.json);
  ReadMesh mesh = Reader(source, model, chunks.binary).read();
  if (chunks.bytes_behind > 0) {
    mesh.notes.push_back(note_of(NoteCode::kUnread, counted(chunks.bytes_behind, "byte") +
                                                        " behind the GLB's own length ignored"));
  }
  return mesh;
}

}  // namespace
}  // namespace gltf

ReadMesh parse_gltf(const MeshSource& source) { return in_memory(source, gltf::read_whole); }

std::vector<FileBeneath> files_of_gltf(const MeshSource& source) {
  const bool is_glb = head_of(source, 4) == gltf::kMagic;
  const std::string json = is_glb ? gltf::json_of_glb(source) : read_all(source);
  MeshSource document = source;
  document.bytes = json;
  document.file = nullptr;
  const gltf::Model model = gltf::read_model(document, document.bytes);
  return gltf::Reader(document, model, {}).files();
}

}  // namespace vkh
