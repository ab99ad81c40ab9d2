// The seed: one query a vertex of A, the first lower bound and its witness.
#include "engine/stages.h"

namespace vkh {

constexpr uint32_t kNegative = 0xbf800000u;  // -1.0f

void record_seed(Recorder& rec, const Problem& p) {
  const auto scope = rec.scope("seed");
  const Workspace& ws = p.ws;
  const gpu::CountPush faces{p.face_count};
  const gpu::BeginPush begin{.capacity = ws.capacity,
                             .face_count = p.face_count,
                             .cull_tolerance = p.cull_tolerance,
                             .known_lower = p.known_lower,
                             .two_float = p.two_float ? 1u : 0u,
                             .warm = p.warm ? 1u : 0u};
  const gpu::SeedPush seed{
      .vertex_count = p.vertex_count, .triangle_count = p.b.face_count, .warm = p.warm ? 1u : 0u};
  const Items points{p.vertex_count + seed.warm};
  rec.run<k::SeedBegin>({.control = ws.control}, begin, Groups{1});
  rec.fill(ws.vertex_distance, kNegative, Order::kIndependent);
  rec.run<k::SeedMark>({.faces = ws.faces, .vertex_distance = ws.vertex_distance}, faces,
                       Items{p.face_count});
  rec.run<k::SeedQuery>({.vertices = ws.vertices,
                         .nodes = p.b.nodes,
                         .triangles = p.b.triangles,
                         .vertex_nearest = ws.vertex_nearest,
                         .vertex_distance = ws.vertex_distance,
                         .control = ws.control,
                         .triangle_lows = p.b.triangle_lows,
                         .faces = ws.faces},
                        seed, points);
  rec.run<k::SeedLower>({.vertices = ws.vertices,
                         .nodes = p.b.nodes,
                         .triangles = p.b.triangles,
                         .vertex_nearest = ws.vertex_nearest,
                         .vertex_distance = ws.vertex_distance,
                         .control = ws.control,
                         .triangle_lows = p.b.triangle_lows,
                         .faces = ws.faces},
                        seed, points);
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
