// Closest points: what `query` works on and what it is asked, of the seed and of every wave.
#include "engine/stages.h"

namespace vkh {

// Kernels do not touch it unless kUseCoverage is on, but a binding must be something.
Slice<gpu::Area> areas_of(const Problem& p) {
  return p.areas.buffer != VK_NULL_HANDLE ? p.areas : as<gpu::Area>(p.ws.unused);
}

k::Query::Args query_args(const Problem& p, const Slice<gpu::Point>& points) {
  return {.control = p.ws.control,
          .nodes = as<gpu::uvec4>(p.b.nodes),
          .triangles = as<gpu::uvec4>(p.b.triangles),
          .triangle_lows = p.b.triangle_lows,
          .boxes = p.b.pyramid,
          .points = points,
          .vertices = p.ws.vertices,
          .faces = p.ws.faces,
          .vertex_nearest = p.ws.vertex_nearest,
          .vertex_distance = as<uint32_t>(p.ws.vertex_distance),
          .frontier = p.ws.frontier,
          .splits = p.ws.splits,
          .areas = areas_of(p),
          .order = p.ws.sort.values[0],
          .centroid_nearest = p.ws.centroid_nearest};
}

gpu::QueryPush query_push(const Problem& p, uint32_t asked, uint32_t vertex_count, bool warm) {
  return {.asked = asked,
          .triangle_count = p.b.face_count,
          .vertex_count = vertex_count,
          .warm = warm ? 1u : 0u};
}

}  // namespace vkh
