// Extensions that a document may require: the ones that, by the text of Khronos' registry, leave
// every triangle where it is, and the ones that are read.
#include <algorithm>
#include <array>

#include "host/read/gltf_model.h"

namespace vkh::gltf {
namespace {

// Every extension of these kinds so far is about looks, light, sound, touch or notes, except for
// drafts that move vertices along a texture.
constexpr std::array<std::string_view, 24> kKinds = {
    "KHR_materials_", "EXT_materials_", "ADOBE_materials_", "BENTLEY_materials_", "FB_material",
    "MOZ_lightmap",   "NV_materials_",  "VRMC_materials_",  "KHR_texture_",       "EXT_texture_",
    "MSFT_texture_",  "MSFT_packing_",  "KHR_image_",       "EXT_image_",         "KHR_lights_",
    "EXT_lights_",    "INTEL_lights_",  "KHR_audio",        "MSFT_audio_",        "MPEG_audio_",
    "MPEG_haptic",    "KHR_xmp",        "KHR_XMP",          "KHR_environment_map"};
constexpr std::string_view kDisplaced = "displacement";

// The others by name. Nothing is animated or simulated: a mesh is read as the document places it.
// Missing here, since they change the document's triangles: compression that is not read (Draco,
// splats), indices that restart a strip, polygons, voxels, instances, places on the globe,
// articulated and external parts, billboards, numbers of 64 bits.
constexpr std::array<std::string_view, 28> kNames = {
    // read
    "KHR_mesh_quantization", "EXT_meshopt_compression", "KHR_meshopt_compression",
    "KHR_node_visibility",
    // properties of features and notes
    "EXT_structural_metadata", "EXT_feature_metadata", "EXT_mesh_features", "EXT_instance_features",
    "AGI_stk_metadata", "CVTOOLS_unity_metadata", "FB_geometry_metadata", "GODOT_single_root",
    "GRIFFEL_bim_data",
    // other descriptions of the same triangles: edges, solids, n-gons, levels of detail
    "CESIUM_primitive_outline", "CESIUM_tile_edges", "EXT_mesh_primitive_edge_visibility",
    "EXT_mesh_manifold", "FB_ngon_encoding", "MSFT_lod", "EXT_pbr_attributes",
    // motion, by whom and when; and how it is drawn
    "KHR_animation_pointer", "KHR_interactivity", "KHR_node_selectability", "KHR_node_hoverability",
    "KHR_physics_rigid_bodies", "KHR_implicit_shapes", "KHR_collision_shapes",
    "ADOBE_render_order"};

}  // namespace

bool is_read(std::string_view extension) {
  if (std::find(kNames.begin(), kNames.end(), extension) != kNames.end()) return true;
  return extension.find(kDisplaced) == std::string_view::npos &&
         std::any_of(kKinds.begin(), kKinds.end(),
                     [&](std::string_view kind) { return extension.starts_with(kind); });
}

}  // namespace vkh::gltf
