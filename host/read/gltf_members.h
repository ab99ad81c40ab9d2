// The members of a glTF document's objects that matter for shape, and where each goes.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "host/read/gltf_model.h"

namespace vkh::gltf {

/// The kinds of objects of the document.
enum class Is : uint8_t {
  kRoot,
  kAsset,
  kAnimation,
  kScene,
  kNode,
  kNodeExtensions,
  kInstancing,
  kVisibility,
  kMesh,
  kPrimitive,
  kAttributes,
  kTarget,
  kPrimitiveExtensions,
  kDraco,
  kAccessor,
  kSparse,
  kSparseIndices,
  kSparseValues,
  kView,
  kViewExtensions,
  kMeshopt,
  kBuffer
};

/// The kinds of values of a member. An index is below 2^32 - 1.
enum class Holds : uint8_t {
  kObject,
  kIndex,
  kSize,
  kBool,
  kString,
  kObjects,  ///< from here on arrays
  kNumbers,
  kStrings
};

/// The kinds of arrays of numbers.
enum class Numbers : uint8_t {
  kOther,
  kRoots,
  kChildren,
  kTranslation,
  kRotation,
  kScale,
  kMatrix,
  kNodeWeights,
  kMeshWeights
};

struct Member {
  Is of;
  std::string_view key;
  Holds holds;
  Is object = Is::kRoot;                ///< for kObject and kObjects
  void (*take)(Model&, uint64_t) = {};  ///< for kIndex, kSize, kBool
  Numbers numbers = Numbers::kOther;
};

inline NodeDetail& detail_of_last(Model& m) {
  if (m.nodes.back() == kNone) {
    m.nodes.back() = static_cast<uint32_t>(m.details.size());
    m.details.emplace_back();
  }
  return m.details.back();
}
inline NodePlacing& placing_of_last(Model& m) {
  NodeDetail& detail = detail_of_last(m);
  if (detail.placing == kNone) {
    detail.placing = static_cast<uint32_t>(m.placings.size());
    m.placings.emplace_back();
  }
  return m.placings.back();
}

constexpr Member object(Is of, std::string_view key, Is object) {
  return {of, key, Holds::kObject, object};
}
constexpr Member objects(Is of, std::string_view key, Is object) {
  return {of, key, Holds::kObjects, object};
}
constexpr Member index(Is of, std::string_view key, void (*take)(Model&, uint64_t)) {
  return {of, key, Holds::kIndex, Is::kRoot, take};
}
constexpr Member size(Is of, std::string_view key, void (*take)(Model&, uint64_t)) {
  return {of, key, Holds::kSize, Is::kRoot, take};
}
constexpr Member numbers(Is of, std::string_view key, Numbers what) {
  return {of, key, Holds::kNumbers, Is::kRoot, nullptr, what};
}
constexpr Member text(Is of, std::string_view key) { return {of, key, Holds::kString}; }

constexpr uint32_t narrow(uint64_t x) { return static_cast<uint32_t>(x); }
/// A component type's number, or 0 if it is none.
constexpr uint16_t component(uint64_t x) {
  return x > 0xffff ? uint16_t{0} : static_cast<uint16_t>(x);
}

inline constexpr Member kMembers[] = {
    object(Is::kRoot, "asset", Is::kAsset),
    index(Is::kRoot, "scene", [](Model& m, uint64_t x) { m.scene = narrow(x); }),
    objects(Is::kRoot, "scenes", Is::kScene),
    objects(Is::kRoot, "nodes", Is::kNode),
    objects(Is::kRoot, "meshes", Is::kMesh),
    objects(Is::kRoot, "accessors", Is::kAccessor),
    objects(Is::kRoot, "bufferViews", Is::kView),
    objects(Is::kRoot, "buffers", Is::kBuffer),
    objects(Is::kRoot, "animations", Is::kAnimation),
    {Is::kRoot, "extensionsRequired", Holds::kStrings},
    text(Is::kAsset, "version"),
    text(Is::kAsset, "minVersion"),
    numbers(Is::kScene, "nodes", Numbers::kRoots),
    index(Is::kNode, "mesh", [](Model& m, uint64_t x) { detail_of_last(m).mesh = narrow(x); }),
    index(Is::kNode, "skin", [](Model& m, uint64_t x) { detail_of_last(m).skin = narrow(x); }),
    numbers(Is::kNode, "children", Numbers::kChildren),
    numbers(Is::kNode, "translation", Numbers::kTranslation),
    numbers(Is::kNode, "rotation", Numbers::kRotation),
    numbers(Is::kNode, "scale", Numbers::kScale),
    numbers(Is::kNode, "matrix", Numbers::kMatrix),
    numbers(Is::kNode, "weights", Numbers::kNodeWeights),
    object(Is::kNode, "extensions", Is::kNodeExtensions),
    object(Is::kNodeExtensions, "EXT_mesh_gpu_instancing", Is::kInstancing),
    object(Is::kNodeExtensions, "KHR_node_visibility", Is::kVisibility),
    {Is::kVisibility, "visible", Holds::kBool, Is::kRoot,
     [](Model& m, uint64_t x) { detail_of_last(m).is_hidden = x == 0; }},
    objects(Is::kMesh, "primitives", Is::kPrimitive),
    numbers(Is::kMesh, "weights", Numbers::kMeshWeights),
    object(Is::kPrimitive, "attributes", Is::kAttributes),
    index(Is::kPrimitive, "indices",
          [](Model& m, uint64_t x) { m.primitives.back().indices = narrow(x); }),
    index(Is::kPrimitive, "mode",
          [](Model& m, uint64_t x) {
            m.primitives.back().mode = static_cast<uint8_t>(std::min<uint64_t>(x, 255));
          }),
    objects(Is::kPrimitive, "targets", Is::kTarget),
    object(Is::kPrimitive, "extensions", Is::kPrimitiveExtensions),
    object(Is::kPrimitiveExtensions, "KHR_draco_mesh_compression", Is::kDraco),
    index(Is::kAttributes, "POSITION",
          [](Model& m, uint64_t x) { m.primitives.back().position = narrow(x); }),
    index(Is::kAccessor, "bufferView",
          [](Model& m, uint64_t x) { m.accessors.back().view = narrow(x); }),
    size(Is::kAccessor, "byteOffset", [](Model& m, uint64_t x) { m.accessors.back().offset = x; }),
    size(Is::kAccessor, "componentType",
         [](Model& m, uint64_t x) { m.accessors.back().component = component(x); }),
    index(Is::kAccessor, "count",
          [](Model& m, uint64_t x) { m.accessors.back().count = narrow(x); }),
    text(Is::kAccessor, "type"),
    {Is::kAccessor, "normalized", Holds::kBool, Is::kRoot,
     [](Model& m, uint64_t x) { m.accessors.back().is_normalized = x != 0; }},
    object(Is::kAccessor, "sparse", Is::kSparse),
    index(Is::kSparse, "count", [](Model& m, uint64_t x) { m.sparses.back().count = narrow(x); }),
    object(Is::kSparse, "indices", Is::kSparseIndices),
    object(Is::kSparse, "values", Is::kSparseValues),
    index(Is::kSparseIndices, "bufferView",
          [](Model& m, uint64_t x) { m.sparses.back().indices.view = narrow(x); }),
    size(Is::kSparseIndices, "byteOffset",
         [](Model& m, uint64_t x) { m.sparses.back().indices.offset = x; }),
    size(Is::kSparseIndices, "componentType",
         [](Model& m, uint64_t x) { m.sparses.back().indices.component = component(x); }),
    index(Is::kSparseValues, "bufferView",
          [](Model& m, uint64_t x) { m.sparses.back().values.view = narrow(x); }),
    size(Is::kSparseValues, "byteOffset",
         [](Model& m, uint64_t x) { m.sparses.back().values.offset = x; }),
    index(Is::kView, "buffer", [](Model& m, uint64_t x) { m.views.back().buffer = narrow(x); }),
    size(Is::kView, "byteOffset", [](Model& m, uint64_t x) { m.views.back().offset = x; }),
    size(Is::kView, "byteLength", [](Model& m, uint64_t x) { m.views.back().length = x; }),
    index(Is::kView, "byteStride", [](Model& m, uint64_t x) { m.views.back().stride = narrow(x); }),
    object(Is::kView, "extensions", Is::kViewExtensions),
    object(Is::kViewExtensions, "EXT_meshopt_compression", Is::kMeshopt),
    object(Is::kViewExtensions, "KHR_meshopt_compression", Is::kMeshopt),
    index(Is::kMeshopt, "buffer", [](Model& m, uint64_t x) { m.packed.back().buffer = narrow(x); }),
    size(Is::kMeshopt, "byteOffset", [](Model& m, uint64_t x) { m.packed.back().offset = x; }),
    size(Is::kMeshopt, "byteLength", [](Model& m, uint64_t x) { m.packed.back().length = x; }),
    index(Is::kMeshopt, "byteStride",
          [](Model& m, uint64_t x) { m.packed.back().stride = narrow(x); }),
    index(Is::kMeshopt, "count", [](Model& m, uint64_t x) { m.packed.back().count = narrow(x); }),
    text(Is::kMeshopt, "mode"),
    text(Is::kMeshopt, "filter"),
    text(Is::kBuffer, "uri"),
    size(Is::kBuffer, "byteLength", [](Model& m, uint64_t x) { m.buffers.back().length = x; }),
};
inline constexpr size_t kMemberCount = std::size(kMembers);

/// The member, or null if it does not matter.
inline const Member* member_of(Is is, std::string_view key) {
  const auto* const found =
      std::find_if(std::begin(kMembers), std::end(kMembers),
                   [&](const Member& member) { return member.of == is && member.key == key; });
  return found == std::end(kMembers) ? nullptr : found;
}

}  // namespace vkh::gltf
