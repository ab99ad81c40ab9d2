// The shape in a glTF 2.0 document, and nothing else. An entry takes no more than five times the
// bytes that the least text of it has, so that no document is larger in memory than six times
// itself.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "host/read/readers.h"

namespace vkh::gltf {

constexpr uint32_t kNone = UINT32_MAX;

/// A range of a pool's entries, which follow each other.
struct Range {
  uint32_t begin = 0, count = 0;
};

/// Details of a node; one without any has none: {} is legal and takes three bytes.
struct NodeDetail {
  uint32_t mesh = kNone, skin = kNone;
  Range children;  ///< range in Model::indices
  uint32_t placing = kNone;
  bool is_hidden = false;         ///< KHR_node_visibility: hidden with all below it
  bool instances = false;         ///< EXT_mesh_gpu_instancing
  bool has_weights = false;       ///< weights that override the mesh's
  bool has_morph_weight = false;  ///< a weight that is not 0
};

/// The places in Model::numbers where each part begins, or kNone.
struct NodePlacing {
  uint32_t translation = kNone, rotation = kNone, scale = kNone, matrix = kNone;
};

/// Keeps only primitives with faces: a mesh may stand at many nodes, and every primitive that is
/// looked at there gives some.
struct MeshEntry {
  Range primitives;
  uint32_t line_count = 0, placeless_count = 0;  ///< points and lines; primitives without positions
  bool has_morph_weight = false;
};

struct Primitive {
  uint32_t position = kNone, indices = kNone;
  uint8_t mode = 4;
  bool has_targets = false, is_draco = false;
};

struct SparsePart {
  uint32_t view = kNone;
  uint64_t offset = 0;
  uint16_t component = 0;
};

struct Sparse {
  uint32_t count = 0;
  SparsePart indices, values;
};

struct Accessor {
  uint64_t offset = 0;
  uint32_t count = 0, view = kNone, sparse = kNone;
  uint16_t component = 0;  ///< 5120 to 5126
  uint8_t width = 0;       ///< 1 SCALAR, 3 VEC3; 255 others
  bool is_normalized = false;
};

enum class Filter : uint8_t { kPlain, kOctahedral, kQuaternion, kExponential, kUnknown };
enum class Packing : uint8_t { kAttributes, kTriangles, kIndices, kUnknown };

/// EXT_meshopt_compression for a view, or KHR_meshopt_compression, which has more codecs.
struct Packed {
  uint64_t offset = 0, length = 0;
  uint32_t buffer = kNone, count = 0, stride = 0;
  Packing packing = Packing::kUnknown;
  Filter filter = Filter::kPlain;
};

struct View {
  uint64_t offset = 0, length = 0;
  uint32_t buffer = kNone, stride = 0, packed = kNone;
};

struct BufferEntry {
  uint64_t length = 0;
  std::string_view uri;  ///< in the file's own bytes, as JSON writes it; no data: empty
};

struct Model {
  uint32_t scene = kNone;
  bool has_animations = false;
  std::deque<uint32_t> scenes;  ///< kNone, or a number in `roots`
  std::deque<Range> roots;      ///< ranges of `indices`
  std::deque<uint32_t> nodes;   ///< kNone, or a number in `details`
  std::deque<NodeDetail> details;
  std::deque<NodePlacing> placings;
  std::deque<uint32_t> indices;
  std::deque<double> numbers;
  std::deque<MeshEntry> meshes;
  std::deque<Primitive> primitives;
  std::deque<Accessor> accessors;
  std::deque<Sparse> sparses;
  std::deque<View> views;
  std::deque<Packed> packed;
  std::deque<BufferEntry> buffers;
};

/// Reads the JSON of a document; `json` lies in source.bytes. Rejects a document that is no glTF 2,
/// that has a thing twice, or that asks for an extension that is not known here.
Model read_model(const MeshSource& source, std::string_view json);

/// Whether a document may require that extension: it is read, or leaves its triangles alone.
bool is_read(std::string_view extension);

/// Returns "accessors[3]": the place that an error names.
std::string place_of(const char* list, size_t index);

}  // namespace vkh::gltf
