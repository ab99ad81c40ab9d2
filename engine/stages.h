// The recording pages, in the order in which they run: what is dispatched, in which order, on which
// buffers.
#pragma once

#include "engine/recorder.h"
#include "engine/workspace.h"

namespace vkh {

// A mesh of the caller's into packed positions and indices.
void record_load(Recorder& rec, const VkhMesh& mesh, const Slice<gpu::Vertex>& vertices,
                 const Slice<gpu::uvec3>& faces);

// Sorts scratch.keys[0] with scratch.values[0], stable, ascending; the result is on side 0 again.
void record_sort(Recorder& rec, const BuildScratch& scratch, uint32_t count);

void record_build(Recorder& rec, const VkhMesh& b, const BuildScratch& scratch,
                  const Hierarchy& hierarchy);

// New positions, and boxes over the old order.
void record_refit(Recorder& rec, const VkhMesh& b, const Hierarchy& hierarchy);

// What a run works on.
struct Problem {
  uint32_t vertex_count = 0, face_count = 0;  // of A
  float cull_tolerance = 0, known_lower = 0;
  bool two_float = false;
  bool warm = false;  // the workspace holds an earlier run to start from
  // The context's switches: waves have a filter; few queries are workgroups.
  bool asks_centroids = true, walks_in_groups = true;
  Hierarchy b;
  Workspace ws;
  Slice<gpu::Area> areas =
      {};  // of each face of A, closed; then of each, open. No buffer: not recorded
};

void record_seed(Recorder& rec, const Problem& p);
void record_wave(Recorder& rec, const Problem& p);
void record_report(Recorder& rec, const Problem& p, const Slice<gpu::Report>& report);

}  // namespace vkh
