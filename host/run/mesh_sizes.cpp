#include "host/run/mesh_sizes.h"

#include <algorithm>
#include <string>

#include "host/base/error.h"

namespace vkh {
namespace {

// The most faces, with as many vertices each as `counts` has, that `takes` accepts.
template <class Takes>
uint32_t most_faces(const MeshSize& counts, Takes&& takes) {
  uint32_t fits = 0, too_many = counts.faces;
  while (too_many - fits > 1) {
    const uint32_t middle = fits + (too_many - fits) / 2;
    const uint64_t vertices = uint64_t{counts.vertices} * middle / counts.faces;
    const MeshSize fewer{std::max(static_cast<uint32_t>(vertices), 1u), middle};
    (takes(fewer) ? fits : too_many) = middle;
  }
  return fits;
}

std::string counted(uint32_t n, const char* what) { return std::to_string(n) + " " + what; }

template <class Takes>
void check_size(const char* name, const MeshSize& counts, Takes&& takes) {
  if (takes(counts)) return;
  const uint32_t most = most_faces(counts, takes);
  throw DeviceError(std::string("mesh ") + name + " is too large for this device: " +
                    counted(counts.faces, "faces and ") + counted(counts.vertices, "vertices, ") +
                    "of which its storage buffers take about " + counted(most, "faces") +
                    "; try a device with larger ones (vkhausdorff doctor), or simplify the mesh");
}

}  // namespace

VkhWorkspaceRequirements workspace_for(VkhContext context, const MeshSize& a) {
  VkhWorkspaceRequirements needed{};
  check_size("A", a, [&](const MeshSize& counts) {
    return vkhGetWorkspaceRequirements(context, counts.vertices, counts.faces, &needed) ==
           VKH_SUCCESS;
  });
  return needed;
}

VkhHierarchyRequirements hierarchy_for(VkhContext context, const MeshSize& b) {
  VkhHierarchyRequirements needed{};
  check_size("B", b, [&](const MeshSize& counts) {
    return vkhGetHierarchyRequirements(context, counts.vertices, counts.faces, &needed) ==
           VKH_SUCCESS;
  });
  return needed;
}

}  // namespace vkh
