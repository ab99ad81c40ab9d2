#include "host/solve/mesh_sizes.h"

#include <algorithm>
#include <string>

#include "vkhausdorff/error.h"

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

VkhResult ask(VkhContext context, const MeshSize& a, VkhWorkspaceRequirements& needed) {
  return vkhGetWorkspaceRequirements(context, a.vertices, a.faces, &needed);
}
VkhResult ask(VkhContext context, const MeshSize& b, VkhHierarchyRequirements& needed) {
  return vkhGetHierarchyRequirements(context, b.vertices, b.faces, &needed);
}

template <class Requirements>
Requirements needed_for(const char* name, VkhContext context, const MeshSize& mesh) {
  Requirements needed{};
  check_size(name, mesh,
             [&](const MeshSize& counts) { return ask(context, counts, needed) == VKH_SUCCESS; });
  return needed;
}

template <class Requirements>
bool takes(VkhContext context, const MeshSize& mesh) {
  Requirements needed{};
  return ask(context, mesh, needed) == VKH_SUCCESS;
}

}  // namespace

bool takes_as_a(VkhContext context, const MeshSize& a) {
  return takes<VkhWorkspaceRequirements>(context, a);
}
bool takes_as_b(VkhContext context, const MeshSize& b) {
  return takes<VkhHierarchyRequirements>(context, b);
}

VkhWorkspaceRequirements workspace_for(VkhContext context, const MeshSize& a) {
  return needed_for<VkhWorkspaceRequirements>("A", context, a);
}
VkhHierarchyRequirements hierarchy_for(VkhContext context, const MeshSize& b) {
  return needed_for<VkhHierarchyRequirements>("B", context, b);
}

}  // namespace vkh
