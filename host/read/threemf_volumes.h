// Reads the data that slicers keep beside a 3MF model: which of its volumes are no bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "host/read/threemf_package.h"

namespace vkh::threemf {

/// The purpose of a shape. Only bodies are printed as they lie; a negative volume is subtracted.
enum class Role {
  kBody,
  kModifier,
  kBlocker,
  kEnforcer,
  kNegative,
  kSupport,
  kSurface,
  kOther,
  kUnprinted
};
constexpr size_t kRoleCount = static_cast<size_t>(Role::kUnprinted) + 1;

/// Returns "modifier", "support blocker".
std::string name_of(Role role);

/// Kinds by PrusaSlicer (Metadata/Slic3r_PE_model.config, and its descendants) and by Bambu Studio
/// (Metadata/model_settings.config, and OrcaSlicer).
struct Volumes {
  /// Triangles `first` to `last` of an object's mesh.
  struct Range {
    uint32_t first = 0, last = 0;
    Role role = Role::kBody;
  };
  std::map<uint32_t, std::vector<Range>> ranges;  ///< by object in the root part, in order
  std::map<std::pair<uint32_t, uint32_t>, Role> components;  ///< by object, and by its component's
};

/// Rejects kinds of volume that are not known here, and volumes of one object that overlap.
Volumes read_volumes(const MeshSource& source, Package& package);

}  // namespace vkh::threemf
