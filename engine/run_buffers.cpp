// The buffers that the kernels of a run bind, and the points for `query`, in the seed and in every
// wave.
#include "engine/record.h"

namespace vkh {

RunBuffers::RunBuffers(const Problem& p)
    : Workspace(p.ws),
      nodes(p.b.nodes),
      triangles(p.b.triangles),
      triangle_lows(p.b.triangle_lows),
      boxes(p.b.boxes),
      codes(p.b.codes),
      box(p.b.box),
      b_vertices(p.b.vertices),
      b_faces(p.b.faces),
      b_fault(p.b.fault),
      // Kernels do not touch it unless kUseCoverage is on, but a binding must not be empty.
      areas(p.areas.buffer != VK_NULL_HANDLE ? p.areas : as<gpu::Area>(p.ws.unused)),
      vertex_state(p.ws.vertex_distance),
      order(p.ws.sort.values[0]) {}

gpu::QueryPush query_push(const Problem& p, uint32_t asked, uint32_t vertex_count, bool warm) {
  return {.asked = asked,
          .triangle_count = p.b.face_count,
          .vertex_count = vertex_count,
          .warm = warm ? 1u : 0u};
}

}  // namespace vkh
