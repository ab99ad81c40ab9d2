// One wave: every refined candidate becomes four, or sixteen, every new point is queried, every
// child bounded, most of them closed; then the next one is planned.
#include "engine/stages.h"

namespace vkh {
namespace {

void record_subdivide(Recorder& rec, const Problem& p) {
  const Workspace& ws = p.ws;
  rec.run_indirect<k::WaveSubdivide>({.control = ws.control,
                                      .frontier = ws.frontier,
                                      .vertices = ws.vertices,
                                      .faces = ws.faces,
                                      .nodes = as<gpu::uvec4>(p.b.nodes),
                                      .triangles = as<gpu::uvec4>(p.b.triangles),
                                      .splits = ws.splits,
                                      .points = ws.points,
                                      .triangle_lows = p.b.triangle_lows,
                                      .areas = areas_of(p),
                                      .order = ws.sort.values[0],
                                      .centroid_nearest = ws.centroid_nearest},
                                     {}, ws.dispatch(gpu::kDispatchSubdivide));
  rec.stage("subdivide");
}

void record_query(Recorder& rec, const Problem& p, const Slice<gpu::Point>& points, uint32_t asked,
                  uint32_t dispatch) {
  rec.run_indirect<k::Query>(query_args(p, points), query_push(p, asked), p.ws.dispatch(dispatch));
  rec.stage("query");
}

// The new points, where the base has moved the witness in their place, and where the wave is fused
// the splits before them. Packets, unless the wave has few and a workgroup walks for each; the plan
// knows.
void record_query_points(Recorder& rec, const Problem& p) {
  if ((p.switches & gpu::kUsePacket) != 0) {
    rec.run_indirect<k::WavePacket>({.control = p.ws.control,
                                     .nodes = as<gpu::uvec4>(p.b.nodes),
                                     .triangles = as<gpu::uvec4>(p.b.triangles),
                                     .points = p.ws.points,
                                     .triangle_lows = p.b.triangle_lows},
                                    {}, p.ws.dispatch(gpu::kDispatchPacket));
    rec.stage("query");
  }
  record_query(rec, p, p.ws.points, gpu::kAskPoints, gpu::kDispatchQueryPoints);
}

void record_filter(Recorder& rec, const Problem& p) {
  const Workspace& ws = p.ws;
  rec.run_indirect<k::WaveFilter>({.control = ws.control,
                                   .frontier = ws.frontier,
                                   .vertices = ws.vertices,
                                   .faces = ws.faces,
                                   .triangles = as<gpu::uvec4>(p.b.triangles),
                                   .vertex_nearest = ws.vertex_nearest,
                                   .splits = ws.splits,
                                   .points = ws.points,
                                   .survivors = ws.survivors,
                                   .centroids = ws.centroids,
                                   .triangle_lows = p.b.triangle_lows,
                                   .areas = areas_of(p),
                                   .face_shared = ws.face_shared,
                                   .centroid_nearest = ws.centroid_nearest},
                                  {}, ws.dispatch(gpu::kDispatchFilter));
  rec.run<k::WaveSurvivors>({.control = ws.control, .dispatches = ws.dispatches}, {}, Groups{1});
  rec.stage("filter");
}

void record_bisect(Recorder& rec, const Problem& p) {
  const Workspace& ws = p.ws;
  rec.run_indirect<k::WaveBisect>({.control = ws.control,
                                   .frontier = ws.frontier,
                                   .vertices = ws.vertices,
                                   .faces = ws.faces,
                                   .triangles = as<gpu::uvec4>(p.b.triangles),
                                   .vertex_nearest = ws.vertex_nearest,
                                   .splits = ws.splits,
                                   .points = ws.points,
                                   .survivors = ws.survivors,
                                   .triangle_lows = p.b.triangle_lows,
                                   .u3_bounds = ws.u3_bounds},
                                  {}, ws.dispatch(gpu::kDispatchBisect));
}

void record_bound(Recorder& rec, const Problem& p) {
  const Workspace& ws = p.ws;
  if ((p.switches & gpu::kUsePaperU3) != 0) record_bisect(rec, p);
  rec.run_indirect<k::WaveBound>({.control = ws.control,
                                  .frontier = ws.frontier,
                                  .vertices = ws.vertices,
                                  .faces = ws.faces,
                                  .triangles = as<gpu::uvec4>(p.b.triangles),
                                  .vertex_nearest = ws.vertex_nearest,
                                  .splits = ws.splits,
                                  .points = ws.points,
                                  .survivors = ws.survivors,
                                  .centroids = ws.centroids,
                                  .triangle_lows = p.b.triangle_lows,
                                  .areas = areas_of(p),
                                  .face_shared = ws.face_shared,
                                  .u3_bounds = ws.u3_bounds,
                                  .centroid_nearest = ws.centroid_nearest,
                                  .dispatches = ws.dispatches},
                                 {}, ws.dispatch(gpu::kDispatchBound));
  rec.stage("bound");
}

void record_plan(Recorder& rec, const Problem& p) {
  const Workspace& ws = p.ws;
  rec.run<k::WavePlan>({.control = ws.control,
                        .dispatches = ws.dispatches,
                        .frontier = ws.frontier,
                        .vertices = ws.vertices,
                        .faces = ws.faces},
                       {}, Groups{1});
  rec.stage("plan");
}

void record_bounds(Recorder& rec, const Problem& p) {
  // Without a filter, wave_bound has the whole cascade.
  if ((p.switches & gpu::kUseFilter) != 0) record_filter(rec, p);
  if ((p.switches & gpu::kUseCentroid) != 0)
    record_query(rec, p, p.ws.centroids, gpu::kAskCentroids, gpu::kDispatchQueryCentroids);
  record_bound(rec, p);
  if (!is_fused(p.switches)) record_plan(rec, p);
}

}  // namespace

void record_first_wave(Recorder& rec, const Problem& p) {
  const auto scope = rec.scope("wave");
  record_bounds(rec, p);
}

void record_wave(Recorder& rec, const Problem& p) {
  const auto scope = rec.scope("wave");
  if ((p.switches & gpu::kUseSort) != 0) record_wave_sort(rec, p);
  if (!is_fused(p.switches)) record_subdivide(rec, p);
  record_query_points(rec, p);
  record_bounds(rec, p);
}

}  // namespace vkh
