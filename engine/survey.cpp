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
        faces_told(s.faces_told),
        classes(s.classes),
        keys(s.keys),
        parents(s.parents),
        agreements(s.agreements),
        blocks(s.blocks),
        histogram(s.histogram),
        plan(s.plan),
        table(s.table),
        push(what) {}

  Slice<gpu::Cell> cells;
  Slice<gpu::CellBounds> bounds;
  Slice<gpu::Wide> weights;
  Slice<uint32_t> faces_reached, faces_told, classes, keys, parents;
  Slice<gpu::CellAgreement> agreements;
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
  if (weights.buffer != VK_NULL_HANDLE) {
    rec.copy(weights, survey.weights);
  } else {
    rec.fill(survey.weights, 0);
  }
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

void record_survey_sides(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveySides& sides) {
  const auto scope = rec.scope("survey sides");
  struct Given : SurveyGiven<gpu::SurveySidesPush> {
    using SurveyGiven::SurveyGiven;
    Slice<uint32_t> face_kinds;
  };
  Given given(p, survey,
              gpu::SurveySidesPush{.first = sides.first,
                                   .end = sides.first + sides.count,
                                   .face_count = p.face_count,
                                   .triangle_count = p.b.face_count,
                                   .above = sides.above,
                                   .moved = sides.moved,
                                   .is_solid = sides.isSolid,
                                   .front = sides.front});
  given.face_kinds = {sides.kindBuffer, sides.kindOffset,
                      VkDeviceSize{p.b.face_count} * sizeof(uint32_t)};
  rec.run<k::SurveySides>(given, Items{sides.count});
}

void record_survey_normals(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                           const VkhSurveyNormals& normals) {
  const auto scope = rec.scope("survey normals");
  struct Given : SurveyGiven<gpu::SurveyNormalsPush> {
    using SurveyGiven::SurveyGiven;
    Slice<gpu::FaceNormal> normals;
  };
  Given given(p, survey,
              gpu::SurveyNormalsPush{.first = normals.first,
                                     .end = normals.first + normals.count,
                                     .face_count = p.face_count,
                                     .triangle_count = p.b.face_count,
                                     .moved = normals.moved,
                                     .limit_down = normals.limitDown,
                                     .limit_up = normals.limitUp});
  given.normals = {
      normals.normalBuffer, normals.normalOffset,
      (VkDeviceSize{p.face_count} + VkDeviceSize{p.b.face_count}) * sizeof(gpu::FaceNormal)};
  rec.run<k::SurveyNormals>(given, Items{normals.count});
}

// Copies what is told of each face to the caller's buffer. What a face reached before its cells
// were split is kept.
void record_survey_faces(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyFaces& faces) {
  const auto scope = rec.scope("survey faces");
  const VkDeviceSize bytes = VkDeviceSize{p.face_count} * sizeof(uint32_t);
  const auto tell = [&](uint32_t classes, uint32_t reached, VkDeviceSize offset) {
    if (reached != 0 && (classes & gpu::kAllClasses) == gpu::kAllClasses) {
      rec.copy(survey.faces_reached, survey.faces_told);
    } else {
      rec.fill(survey.faces_told, 0);
    }
    const SurveyGiven given(p, survey, gpu::SurveyFacesPush{faces.cells, classes, reached});
    rec.run<k::SurveyFaces>(given, Items{faces.cells});
    rec.copy(first_of(survey.faces_told, p.face_count),
             {faces.buffer, faces.offset + offset, bytes});
  };
  tell(faces.reachedClasses, 1, 0);
  tell(faces.highestClasses, 0, bytes);
}

void record_survey_read(Recorder& rec, const SurveyStreams& survey, const VkhSurveyRead& read) {
  const auto scope = rec.scope("survey read");
  const auto copy = [&]<class T>(const Slice<T>& from, VkBuffer buffer, VkDeviceSize offset) {
    const VkDeviceSize size = read.count * sizeof(T);
    rec.copy(Slice<T>{from.buffer, from.offset + read.first * sizeof(T), size},
             {buffer, offset, size}, Order::kIndependent);
  };
  copy(survey.cells, read.cellBuffer, read.cellOffset);
  copy(survey.bounds, read.boundsBuffer, read.boundsOffset);
  copy(survey.classes, read.classBuffer, read.classOffset);
}

void record_survey_write(Recorder& rec, const SurveyStreams& survey, const VkhSurveyWrite& write) {
  const auto scope = rec.scope("survey write");
  const VkDeviceSize size = write.count * sizeof(gpu::CellBounds);
  rec.copy(
      Slice<gpu::CellBounds>{write.boundsBuffer, write.boundsOffset, size},
      {survey.bounds.buffer, survey.bounds.offset + write.first * sizeof(gpu::CellBounds), size});
}

void record_survey_move(Recorder& rec, const SurveyStreams& from, const SurveyStreams& to,
                        uint32_t cells) {
  const auto scope = rec.scope("survey move");
  rec.copy(from.weights, to.weights);
  rec.copy(from.faces_reached, to.faces_reached, Order::kIndependent);
  rec.copy(first_of(from.cells, cells), to.cells, Order::kIndependent);
  rec.copy(first_of(from.bounds, cells), to.bounds, Order::kIndependent);
  rec.copy(first_of(from.classes, cells), to.classes, Order::kIndependent);
  rec.copy(first_of(from.agreements, cells), to.agreements, Order::kIndependent);
  rec.copy(first_of(from.keys, cells), to.keys, Order::kIndependent);
}

}  // namespace vkh
