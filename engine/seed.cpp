// The seed: one query per vertex of A, the first lower bound and its witness, the first wave's
// plan.
#include "engine/record.h"

namespace vkh {
namespace {

gpu::BeginPush begin_push(const Problem& p) {
  return {.capacity = p.ws.capacity,
          .face_count = p.face_count,
          .cull_tolerance = p.options.cullTolerance,
          .known_lower = p.options.knownLower,
          .limit = p.options.limit,
          .limit_up = p.options.limitUp,
          .two_float = p.options.twoFloat != VK_FALSE ? 1u : 0u,
          .warm = p.options.warm != VK_FALSE ? 1u : 0u,
          .sort_from = p.options.sortFrom,
          .pauses = p.options.pauseWhenFull != VK_FALSE ? 1u : 0u,
          .input_fault = p.input_fault};
}

// The same choice as in `query`: a whole workgroup per item if they are few.
bool in_groups(const Problem& p) {
  return gpu::traverses_by_group(p.switches, p.wide) &&
         p.vertex_count <= gpu::kGroupTraversalVertices;
}

}  // namespace

void record_seed(Recorder& rec, const Problem& p) {
  const auto scope = rec.scope("seed");
  const RunBuffers run(p);
  const bool warm = p.options.warm != VK_FALSE;
  const uint32_t items = p.vertex_count + (warm ? 1u : 0u);
  const Given begin(run, begin_push(p));
  const Given faces(run, gpu::FacesPush{p.face_count, p.b.face_count});
  const Given once(run, query_push(p, gpu::kAskVertices, p.vertex_count, warm));
  const Given again(run, query_push(p, gpu::kAskVerticesAgain, p.vertex_count, warm));
  const Given corners(run, gpu::CountPush{p.face_count});
  // The fill is independent of record_load, which writes A's vertices and faces.
  rec.run<k::SeedBegin>(begin, Groups{1}, Order::kIndependent);
  rec.fill(run.vertex_state, 0, Order::kIndependent);
  rec.run<k::SeedFaces>(faces, Items{p.face_count});
  rec.run<k::Query>(once, Items{in_groups(p) ? items * gpu::kQueryGroup : items});
  rec.run<k::Query>(again, Items{items});
  rec.run<k::SeedWitness>(corners, Items{p.face_count});
  rec.stage("seed");
}

}  // namespace vkh
