// A survey's cells: the host plans, and the kernels score, split, bound and add up
// (shaders/survey).
#include <algorithm>

#include "engine/record.h"

namespace vkh {
namespace {

// All buffers that the kernels of a survey bind, by the kernels' names.
template <class Push>
struct SurveyGiven : RunBuffers {
  SurveyGiven(const Problem& p, const SurveyStreams& s, const Push& what)
      : RunBuffers(p),
        cells(s.cells),
        bounds(s.bounds),
        weights(s.weights),
        faces_reached(s.faces_reached),
        faces_highest(s.faces_highest),
        keys(s.keys),
        parents(s.parents),
        blocks(s.blocks),
        histogram(s.histogram),
        plan(s.plan),
        table(s.table),
        push(what) {}

  Slice<gpu::Cell> cells;
  Slice<gpu::CellBounds> bounds;
  Slice<gpu::Wide> weights;
  Slice<uint32_t> faces_reached, faces_highest, keys, parents;
  Slice<gpu::SurveyCounts> blocks;
  Slice<uint32_t> histogram;
  Slice<gpu::SurveyPlan> plan;
  Slice<gpu::SurveyTable> table;
  Push push;
};

template <class T>
Slice<T> first_of(const Slice<T>& slice, VkDeviceSize count) {
  return {slice.buffer, slice.offset, count * sizeof(T)};
}

// A kernel that goes over all cells has no more workgroups than keep a device busy, since each has
// sums of its own to add.
uint32_t groups_for(uint32_t cells) {
  constexpr uint32_t kCellsOfGroup = 4 * gpu::kGroupSize;
  return std::clamp((cells + kCellsOfGroup - 1) / kCellsOfGroup, 1u, gpu::kSurveyGroups);
}

uint32_t blocks_of(uint32_t cells) { return (cells + gpu::kSurveyBlock - 1) / gpu::kSurveyBlock; }

}  // namespace

void record_survey_begin(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const Slice<gpu::Wide>& weights, float farthest) {
  const auto scope = rec.scope("survey begin");
  rec.copy(weights, survey.weights);
  rec.fill(survey.faces_reached, 0, Order::kIndependent);
  const SurveyGiven given(p, survey, gpu::SurveyBeginPush{p.face_count, farthest});
  rec.run<k::SurveyBegin>(given, Items{p.face_count});
}

void record_survey_score(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyScore& score) {
  const auto scope = rec.scope("survey score");
  const uint32_t groups = groups_for(score.count);
  rec.copy({score.planBuffer, score.planOffset, sizeof(gpu::SurveyPlan)}, survey.plan);
  rec.fill(survey.histogram, 0, Order::kIndependent);
  const SurveyGiven given(p, survey,
                          gpu::SurveyPush{score.first, score.first + score.count, groups, 0, 0});
  rec.run<k::SurveyScore>(given, Groups{groups});
  rec.copy(survey.histogram, {score.histogramBuffer, score.histogramOffset, survey.histogram.size});
}

void record_survey_split(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveySplit& split) {
  const auto scope = rec.scope("survey split");
  const SurveyGiven given(
      p, survey,
      gpu::SurveySplitPush{split.cells, split.bin, split.ties, split.above, split.parts});
  const Groups blocks{blocks_of(split.cells)};
  rec.run<k::SurveyCount>(given, blocks);
  rec.run<k::SurveyScan>(given, Groups{1});
  rec.run<k::SurveyList>(given, blocks);
  rec.run<k::SurveySplit>(given, Items{split.above + split.ties});
}

void record_survey_bound(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyBound& bound) {
  const auto scope = rec.scope("survey bound");
  const SurveyGiven given(p, survey,
                          gpu::CellPush{.count = bound.count,
                                        .given = gpu::kSurveyCells,
                                        .first = bound.first,
                                        .face_count = p.face_count,
                                        .triangle_count = p.b.face_count,
                                        .parts = bound.parts,
                                        .live = bound.live});
  rec.run<k::CellBounds>(given, Items{bound.count});
  rec.stage("cells");
}

void record_survey_tally(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyTally& tally) {
  const auto scope = rec.scope("survey tally");
  const uint32_t groups = groups_for(tally.count);
  const int square_unit = 2 * tally.unit - 127;
  rec.copy({tally.planBuffer, tally.planOffset, sizeof(gpu::SurveyPlan)}, survey.plan);
  rec.fill(survey.table, 0, Order::kIndependent);
  const SurveyGiven given(
      p, survey,
      gpu::SurveyPush{tally.first, tally.first + tally.count, groups, tally.unit, square_unit});
  rec.run<k::SurveyTally>(given, Groups{groups});
  rec.copy(survey.table, {tally.tableBuffer, tally.tableOffset, sizeof(gpu::SurveyTable)});
}

void record_survey_read(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                        const VkhSurveyRead& read) {
  const auto scope = rec.scope("survey read");
  if (read.faceBuffer != VK_NULL_HANDLE) {
    const VkDeviceSize bytes = VkDeviceSize{p.face_count} * sizeof(uint32_t);
    rec.fill(survey.faces_highest, 0);
    const SurveyGiven given(p, survey, gpu::CountPush{read.cells});
    rec.run<k::SurveyFaces>(given, Items{read.cells});
    rec.copy(first_of(survey.faces_reached, p.face_count),
             {read.faceBuffer, read.faceOffset, bytes});
    rec.copy(first_of(survey.faces_highest, p.face_count),
             {read.faceBuffer, read.faceOffset + bytes, bytes}, Order::kIndependent);
  }
  if (read.cellBuffer == VK_NULL_HANDLE) return;
  const Slice<gpu::Cell> cells = first_of(survey.cells, read.cells);
  const Slice<gpu::CellBounds> bounds = first_of(survey.bounds, read.cells);
  rec.copy(cells, {read.cellBuffer, read.cellOffset, cells.size});
  rec.copy(bounds, {read.boundsBuffer, read.boundsOffset, bounds.size}, Order::kIndependent);
}

void record_survey_move(Recorder& rec, const SurveyStreams& from, const SurveyStreams& to,
                        uint32_t cells) {
  const auto scope = rec.scope("survey move");
  rec.copy(from.weights, to.weights);
  rec.copy(from.faces_reached, to.faces_reached, Order::kIndependent);
  rec.copy(first_of(from.cells, cells), to.cells, Order::kIndependent);
  rec.copy(first_of(from.bounds, cells), to.bounds, Order::kIndependent);
  rec.copy(first_of(from.keys, cells), to.keys, Order::kIndependent);
}

}  // namespace vkh
