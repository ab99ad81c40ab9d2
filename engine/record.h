// The recording files, in the order in which they run: they dispatch kernels in order and name
// their buffers.
#pragma once

#include "engine/recorder.h"
#include "engine/workspace.h"

namespace vkh {

// Copies a mesh of the caller's into packed positions and indices; writes zeros if layout_fault is
// not kNone, since the mesh's addresses could then be anywhere.
void record_load(Recorder& rec, const VkhMesh& mesh, const Slice<gpu::Vertex>& vertices,
                 const Slice<gpu::uvec3>& faces);

// Returns kFaultLayout if a VkhMesh cannot describe a mesh, otherwise kNone. The host checks what
// costs nothing: counts, strides, offsets, the type of indices, and that buffers are not null.
uint32_t layout_fault(const VkhMesh& mesh);
// With a context that checks: writes whether the caller's buffers hold a mesh into a word of
// `words`, which holds the faults known so far.
void record_check(Recorder& rec, const VkhMesh& mesh, const Slice<uint32_t>& words, uint32_t word);

// Sorts keys with values by bits first_bit and up, 8 a pass, stable, ascending: from the side that
// sort_side names to side 0.
uint32_t sort_side(uint32_t first_bit);
// A sort of few keys is a chain of dispatches. It needs one less if the kernel that writes the keys
// also counts their first digits into streams.counts, which this function clears. Returns the
// number of keys of a block for these counts; 0: the sort counts itself.
uint32_t record_empty_counts(Recorder& rec, const SortStreams& streams, uint32_t count,
                             uint32_t first_bit, Order order);
enum class Counted { kNo, kYes };
void record_sort(Recorder& rec, const SortStreams& streams, uint32_t count, uint32_t first_bit = 0,
                 Counted counted = Counted::kNo);
// The same if only the device knows the number of keys, streams.count, and the workgroups that they
// take: for blocks of keys, and for digits.
void record_sort(Recorder& rec, const SortStreams& streams, const Slice<gpu::Dispatch>& blocks,
                 const Slice<gpu::Dispatch>& digits);

void record_build(Recorder& rec, const VkhMesh& b, const BuildScratch& scratch,
                  const Hierarchy& hierarchy);

// Records new positions, and boxes over the old order.
void record_refit(Recorder& rec, const VkhMesh& b, const Hierarchy& hierarchy);

// The inputs of a run.
struct Problem {
  uint32_t vertex_count = 0, face_count = 0;  // of A
  VkhRunOptions options = {};                 // as view_problem has checked them
  uint32_t switches = gpu::kUseAll;           // of the context,
  bool wide = true;                           // and the kind of its device
  bool has_a = true;                          // false: no mesh has its counts
  uint32_t input_fault = gpu::kNone;          // of A: layout_fault
  Hierarchy b;
  Workspace ws;
  Slice<gpu::Area> areas =
      {};  // of each face of A, closed; then of each, open. No buffer: not recorded
};

// All buffers that the kernels of a run bind, by the kernels' names.
struct RunBuffers : Workspace {
  explicit RunBuffers(const Problem& p);

  Slice<gpu::Node> nodes;
  Slice<gpu::Triangle> triangles;
  Slice<gpu::TriangleLow> triangle_lows;
  Slice<gpu::Box> boxes;
  Slice<uint32_t> codes;
  Slice<gpu::CentroidBox> box;
  Slice<gpu::Vertex> b_vertices;
  Slice<gpu::uvec3> b_faces;
  Slice<uint32_t> b_fault;
  Slice<gpu::Area> areas;
  // The same memory as vertex_distance. seed_faces leaves each vertex's state there; the first
  // query replaces it by the distance.
  Slice<uint32_t> vertex_state;
  Slice<uint32_t> order;  // of the frontier, where it is sorted
};

// The same with push constants; `points` are the queries.
template <class Push>
struct Given : RunBuffers {
  Given(const RunBuffers& run, const Push& p) : RunBuffers(run), push(p) {}
  Push push;
};
// The points for `query`, kAsk*: A's first `vertex_count` vertices and, if `warm`, the present
// witness. A wave passes no vertices and `warm`: if its plan has moved the base, query.comp
// measures the witness alone, as the item behind zero vertices.
gpu::QueryPush query_push(const Problem& p, uint32_t asked, uint32_t vertex_count = 0,
                          bool warm = true);

void record_seed(Recorder& rec, const Problem& p);
// The first wave refines nothing: it bounds faces of A.
void record_first_wave(Recorder& rec, const Problem& p);
void record_wave(Recorder& rec, const Problem& p);
// Sorts the places of the frontier's candidates into the order in which they are refined, if the
// plan decides that this pays. Only the paper's presets need it.
void record_order(Recorder& rec, const RunBuffers& run);
// Moves the run into another workspace, or lets it go on in its own; pauseWhenFull of `to` holds
// from now on.
void record_move(Recorder& rec, const Problem& from, const Problem& to);
// The cells of A to bound: `count` of `cells`, or, without a buffer, faces from `first` on.
struct AskedCells {
  Slice<gpu::Cell> cells;
  Slice<gpu::CellBounds> bounds;
  uint32_t first = 0, count = 0;
  bool has_run = true;  // false: there are no distances, and bounds are NaN
};
void record_cells(Recorder& rec, const Problem& p, const AskedCells& asked);
// A survey's cells. The host reads and writes through its own buffers; each call waits for the one
// before it.
void record_survey_cells(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const Slice<gpu::Wide>& weights, float farthest);
// Scores all cells by the plan, and counts them by bins into `histogram`.
void record_survey_score(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyScore& score);
void record_survey_split(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveySplit& split);
// Bounds new cells, which may be several submissions' work.
void record_survey_bound(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyBound& bound);
// Makes A's faces cells, and bounds them; then waves that the device plans, for each face's width.
void record_survey_begin(Recorder& rec, const Problem& p, const SurveyStreams& survey);
void record_survey_waves(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurvey& asked, uint32_t waves);
// Writes a VkhSurveyReport: as many bytes of the wave as `report` has.
void record_survey_report(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                          const VkhSurvey& asked, const Slice<gpu::SurveyWave>& report);
// Adds up all cells at the plan's edges into `table`.
void record_survey_tally(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyTally& tally);
// Finds the sides of cells.
void record_survey_sides(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveySides& sides);
// Finds how normals agree on cells.
void record_survey_normals(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                           const VkhSurveyNormals& normals);
// Copies, for each face, a distance that it reaches, and then, for each, one that none of its
// points exceeds.
void record_survey_faces(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyFaces& faces);
// Copies cells, with their bounds and classes.
void record_survey_read(Recorder& rec, const SurveyStreams& survey, const VkhSurveyRead& read);
// Takes over bounds that the host has narrowed.
void record_survey_write(Recorder& rec, const SurveyStreams& survey, const VkhSurveyWrite& write);
// Copies the survey's state into memory with more room.
void record_survey_move(Recorder& rec, const SurveyStreams& from, const SurveyStreams& to,
                        uint32_t cells);
// The points whose closest faces of B are to be found.
struct AskedPoints {
  Slice<gpu::Vertex> asked;
  Slice<gpu::ClosestFace> found;
  uint32_t count = 0;
  bool two_float = false;  // B has low parts
};
void record_closest(Recorder& rec, const Hierarchy& b, const AskedPoints& points);
void record_report(Recorder& rec, const Problem& p, const Slice<gpu::Report>& report);
// Copies the run's counts, as VkhStatistics; `order`: of the first copy.
void record_statistics(Recorder& rec, const Problem& p, const Slice<uint32_t>& to, Order order);
// Reports only that A or B is no mesh, if nothing was built.
void record_unbuilt_report(Recorder& rec, const Problem& p, const Slice<gpu::Report>& report);
void record_unbuilt_survey_report(Recorder& rec, const Slice<gpu::SurveyWave>& report);
void record_unbuilt_faces(Recorder& rec, const Slice<float>& faces);

}  // namespace vkh
