// The seed: one query a vertex of A, the first lower bound and its witness, the first wave's plan.
#include "engine/stages.h"

namespace vkh {

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
  const uint32_t items = p.vertex_count + begin.warm;
  // As `query` has it: all of a workgroup for an item where they are few.
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
  const k::Query::Args args = query_args(p, p.ws.points);
  const auto ask = [&](uint32_t asked) { return query_push(p, asked, p.vertex_count, p.warm); };
  rec.run<k::Query>(args, ask(gpu::kAskVertices),
                    Items{in_groups ? items * gpu::kQueryGroup : items});
  rec.run<k::Query>(args, ask(gpu::kAskVerticesAgain), Items{items});
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
