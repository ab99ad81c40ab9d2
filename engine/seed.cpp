// The seed: one query a vertex of A, the first lower bound and its witness, the first wave's plan.
#include "engine/stages.h"

namespace vkh {

k::SeedQuery::Args seed_args(const Problem& p) {
  return {.vertices = p.ws.vertices,
          .nodes = as<gpu::uvec4>(p.b.nodes),
          .triangles = as<gpu::uvec4>(p.b.triangles),
          .vertex_nearest = p.ws.vertex_nearest,
          .vertex_distance = as<uint32_t>(p.ws.vertex_distance),
          .control = p.ws.control,
          .triangle_lows = p.b.triangle_lows,
          .faces = p.ws.faces,
          .boxes = p.b.pyramid};
}

void record_seed(Recorder& rec, const Problem& p) {
  const auto scope = rec.scope("seed");
  const Workspace& ws = p.ws;
  const gpu::CountPush faces{p.face_count};
  const gpu::BeginPush begin{.capacity = ws.capacity,
                             .face_count = p.face_count,
                             .cull_tolerance = p.cull_tolerance,
                             .known_lower = p.known_lower,
                             .two_float = p.two_float ? 1u : 0u,
                             .warm = p.warm ? 1u : 0u,
                             .sort_from = p.sort_from != 0 ? p.sort_from : gpu::kSortFrom};
  gpu::SeedPush seed{.vertex_count = p.vertex_count,
                     .triangle_count = p.b.face_count,
                     .warm = p.warm ? 1u : 0u,
                     .again = 0};
  const uint32_t items = p.vertex_count + seed.warm;
  // As seed_query has it: all of a workgroup for an item where they are few.
  const bool in_groups =
      (p.switches & gpu::kUseGroupWalk) != 0 && p.vertex_count <= gpu::kGroupWalkVertices;
  // Independent of record_load, which writes A's vertices and faces.
  rec.run<k::SeedBegin>(
      {.control = ws.control, .lower_bits = ws.lower_bits, .groups_done = ws.groups_done}, begin,
      Groups{1}, Order::kIndependent);
  rec.fill(ws.vertex_distance, 0, Order::kIndependent);
  rec.run<k::SeedFaces>({.faces = ws.faces,
                         .vertex_state = as<uint32_t>(ws.vertex_distance),
                         .control = ws.control,
                         .vertices = ws.vertices,
                         .triangles = as<gpu::uvec4>(p.b.triangles),
                         .triangle_lows = p.b.triangle_lows,
                         .codes = p.b.codes,
                         .box = p.b.box,
                         .face_shared = ws.face_shared},
                        {.face_count = p.face_count, .triangle_count = p.b.face_count},
                        Items{p.face_count});
  rec.run<k::SeedQuery>(seed_args(p), seed, Items{in_groups ? items * gpu::kQueryGroup : items});
  seed.again = 1;
  rec.run<k::SeedQuery>(seed_args(p), seed, Items{items});
  rec.run<k::SeedWitness>({.faces = ws.faces,
                           .vertex_distance = ws.vertex_distance,
                           .control = ws.control,
                           .vertices = ws.vertices,
                           .vertex_nearest = ws.vertex_nearest,
                           .dispatches = ws.dispatches,
                           .groups_done = ws.groups_done},
                          faces, Items{p.face_count});
  rec.stage("seed");
}

}  // namespace vkh
