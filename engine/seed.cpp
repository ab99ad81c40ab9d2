// The seed: one query a vertex of A, the first lower bound and its witness.
#include "engine/stages.h"

namespace vkh {

void record_seed(Recorder& rec, const Problem& p) {
  const auto scope = rec.scope("seed");
  const Workspace& ws = p.ws;
  const gpu::CountPush vertices{p.vertex_count};
  const gpu::CountPush faces{p.face_count};
  const gpu::BeginPush begin{.capacity = ws.capacity,
                             .face_count = p.face_count,
                             .cull_tolerance = p.cull_tolerance,
                             .two_float = p.two_float ? 1u : 0u};
  rec.run<k::SeedBegin>({.control = ws.control}, begin, Groups{1});
  rec.fill(ws.vertex_nearest, gpu::kNone, Order::kIndependent);
  rec.run<k::SeedMark>({.faces = ws.faces, .vertex_nearest = ws.vertex_nearest}, faces,
                       Items{p.face_count});
  rec.run<k::SeedQuery>({.vertices = ws.vertices,
                         .nodes = p.b.nodes,
                         .triangles = p.b.triangles,
                         .vertex_nearest = ws.vertex_nearest,
                         .vertex_distance = ws.vertex_distance,
                         .control = ws.control,
                         .triangle_lows = p.b.triangle_lows},
                        vertices, Items{p.vertex_count});
  rec.run<k::SeedLower>({.vertices = ws.vertices,
                         .nodes = p.b.nodes,
                         .triangles = p.b.triangles,
                         .vertex_nearest = ws.vertex_nearest,
                         .vertex_distance = ws.vertex_distance,
                         .control = ws.control,
                         .triangle_lows = p.b.triangle_lows},
                        vertices, Items{p.vertex_count});
  rec.run<k::SeedWitness>(
      {.faces = ws.faces, .vertex_distance = ws.vertex_distance, .control = ws.control}, faces,
      Items{p.face_count});
  rec.run<k::SeedAdopt>({.vertices = ws.vertices,
                         .faces = ws.faces,
                         .vertex_nearest = ws.vertex_nearest,
                         .control = ws.control},
                        {}, Groups{1});
  rec.stage("seed");
}

}  // namespace vkh
