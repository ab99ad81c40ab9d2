// A survey's cells: kernels score, choose, split, bound and add up (shaders/survey), by a plan of
// the host's or by the widths of faces.
#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cstddef>
#include <utility>

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
        face_errors(s.face_errors),
        classes(s.classes),
        keys(s.keys),
        parents(s.parents),
        near_corners(s.near_corners),
        agreements(s.agreements),
        blocks(s.blocks),
        histogram(s.histogram),
        plan(s.plan),
        table(s.table),
        wave(s.wave),
        push(what) {}

  Slice<gpu::Cell> cells;
  Slice<gpu::CellBounds> bounds;
  Slice<gpu::Wide> weights;
  Slice<uint32_t> faces_reached, face_errors, classes, keys, parents;
  Slice<gpu::CornerTriangles> near_corners;
  Slice<gpu::CellAgreement> agreements;
  Slice<gpu::SurveyCounts> blocks;
  Slice<uint32_t> histogram;
  Slice<gpu::SurveyPlan> plan;
  Slice<gpu::SurveyTable> table;
  Slice<gpu::SurveyWave> wave;
  Push push;
};

template <class T>
Slice<T> first_of(const Slice<T>& slice, VkDeviceSize count) {
  return {slice.buffer, slice.offset, count * sizeof(T)};
}

// A kernel that goes over all cells has only as many workgroups as keep a device busy, since each
// adds its own sums to the total.
uint32_t groups_for(uint32_t cells) {
  constexpr uint32_t kCellsOfGroup = 4 * gpu::kGroupSize;
  return std::clamp((cells + kCellsOfGroup - 1) / kCellsOfGroup, 1u, gpu::kSurveyGroups);
}

uint32_t blocks_of(uint32_t cells) { return (cells + gpu::kSurveyBlock - 1) / gpu::kSurveyBlock; }

// A member of a struct on the device. Its offset is the same there: all members have four bytes.
template <class Struct>
Slice<uint32_t> word_of(const Slice<Struct>& slice, size_t offset) {
  return {slice.buffer, slice.offset + offset, sizeof(uint32_t)};
}

// Fills members of a struct that was written before.
template <class Struct, size_t count>
void fill_words(Recorder& rec, const Slice<Struct>& slice,
                const std::array<std::pair<size_t, uint32_t>, count>& words) {
  Order order = Order::kAfterAll;
  for (const auto& [offset, word] : words) {
    rec.fill(word_of(slice, offset), word, order);
    order = Order::kIndependent;
  }
}

void record_split(Recorder& rec, const Problem& p, const SurveyStreams& survey, uint32_t cells,
                  uint32_t parents) {
  const SurveyGiven given(p, survey, NoPush{});
  const Groups blocks{blocks_of(cells)};
  rec.run<k::SurveyCount>(given, blocks);
  rec.run<k::SurveyScan>(given, Groups{1});
  rec.run<k::SurveyList>(given, blocks);
  rec.run<k::SurveySplit>(given, Items{parents});
}

// Bounds the new cells of the wave, at most `count` of them, from the first on.
void record_bound(Recorder& rec, const Problem& p, const SurveyStreams& survey, uint32_t first,
                  uint32_t count) {
  const SurveyGiven given(p, survey,
                          gpu::CellPush{.count = count,
                                        .given = gpu::kSurveyCells,
                                        .first = first,
                                        .face_count = p.face_count,
                                        .triangle_count = p.b.face_count});
  rec.run<k::CellBounds>(given, Items{count});
}

// Scores all cells by the plan that is there.
void record_score(Recorder& rec, const Problem& p, const SurveyStreams& survey, uint32_t first,
                  uint32_t count) {
  const uint32_t groups = groups_for(count);
  const SurveyGiven given(p, survey, gpu::SurveyPush{first, first + count, groups, 0, 0});
  rec.run<k::SurveyScore>(given, Groups{groups});
}

// Writes the plan that replaces one of the host's: each face's error is to be known to a width, or
// on which side of a limit it is.
void record_plan_of_faces(Recorder& rec, const SurveyStreams& survey, const VkhSurvey& asked) {
  using Plan = gpu::SurveyPlan;
  const auto within = std::bit_cast<uint32_t>(asked.faceLimit);
  const float beyond = asked.faceLimit > 0 ? asked.faceLimit : FLT_MAX;
  rec.fill(survey.plan, 0);
  fill_words(rec, survey.plan,
             std::array{std::pair{offsetof(Plan, faces), 1u},
                        std::pair{offsetof(Plan, face_tolerance),
                                  std::bit_cast<uint32_t>(asked.faceWidth)},
                        std::pair{offsetof(Plan, face_beyond), std::bit_cast<uint32_t>(beyond)},
                        std::pair{offsetof(Plan, face_within), within},
                        std::pair{offsetof(Plan, face_within) + 4, within},
                        std::pair{offsetof(Plan, face_within) + 8, within}});
}

enum class Splits { kNo, kYes };

// Scores all cells, and chooses what to split, or only finds the survey's status.
void record_choice(Recorder& rec, const Problem& p, const SurveyStreams& survey, uint32_t capacity,
                   Splits splits) {
  rec.fill(survey.histogram, 0);
  record_score(rec, p, survey, 0, capacity);
  const SurveyGiven given(p, survey,
                          gpu::SurveyChoosePush{.capacity = capacity,
                                                .most = survey_parents(capacity),
                                                .splits = splits == Splits::kYes ? 1u : 0u});
  rec.run<k::SurveyChoose>(given, Groups{1});
}

}  // namespace

void record_survey_cells(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const Slice<gpu::Wide>& weights, float farthest) {
  using Wave = gpu::SurveyWave;
  const auto scope = rec.scope("survey begin");
  if (weights.buffer != VK_NULL_HANDLE) {
    rec.copy(weights, survey.weights);
  } else {
    rec.fill(survey.weights, 0);
  }
  rec.fill(survey.faces_reached, 0, Order::kIndependent);
  rec.fill(survey.wave, 0, Order::kIndependent);
  fill_words(rec, survey.wave,
             std::array{std::pair{offsetof(Wave, cells), p.face_count},
                        std::pair{offsetof(Wave, parts), 1u},
                        std::pair{offsetof(Wave, fresh), p.face_count}});
  const SurveyGiven given(p, survey, gpu::SurveyBeginPush{p.face_count, farthest});
  rec.run<k::SurveyBegin>(given, Items{p.face_count});
}

void record_survey_score(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyScore& score) {
  const auto scope = rec.scope("survey score");
  rec.copy({score.planBuffer, score.planOffset, sizeof(gpu::SurveyPlan)}, survey.plan);
  rec.fill(survey.histogram, 0, Order::kIndependent);
  record_score(rec, p, survey, score.first, score.count);
  rec.copy(survey.histogram, {score.histogramBuffer, score.histogramOffset, survey.histogram.size});
}

void record_survey_split(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveySplit& split) {
  using Wave = gpu::SurveyWave;
  const auto scope = rec.scope("survey split");
  const uint32_t parents = split.above + split.ties;
  fill_words(rec, survey.wave,
             std::array{std::pair{offsetof(Wave, cells), split.cells + (split.parts - 1) * parents},
                        std::pair{offsetof(Wave, live), split.cells},
                        std::pair{offsetof(Wave, key), split.bin},
                        std::pair{offsetof(Wave, ties), split.ties},
                        std::pair{offsetof(Wave, above), split.above},
                        std::pair{offsetof(Wave, parts), split.parts},
                        std::pair{offsetof(Wave, fresh), split.parts * parents}});
  record_split(rec, p, survey, split.cells, parents);
}

void record_survey_bound(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyBound& bound) {
  const auto scope = rec.scope("survey bound");
  record_bound(rec, p, survey, bound.first, bound.count);
  rec.stage("cells");
}

void record_survey_begin(Recorder& rec, const Problem& p, const SurveyStreams& survey) {
  record_survey_cells(rec, p, survey, {}, FLT_MAX);
  record_bound(rec, p, survey, 0, p.face_count);
  rec.stage("cells");
}

void record_survey_waves(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurvey& asked, uint32_t waves) {
  if (waves > 0) record_plan_of_faces(rec, survey, asked);
  for (uint32_t i = 0; i < waves; ++i) {
    const auto scope = rec.scope("survey wave");
    const uint32_t parents = survey_parents(asked.capacity);
    record_choice(rec, p, survey, asked.capacity, Splits::kYes);
    record_split(rec, p, survey, asked.capacity, parents);
    rec.stage("survey plan");
    record_bound(rec, p, survey, 0, 4 * parents);
    rec.stage("cells");
  }
}

void record_survey_report(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                          const VkhSurvey& asked, const Slice<gpu::SurveyWave>& report) {
  const auto scope = rec.scope("survey report");
  record_plan_of_faces(rec, survey, asked);
  record_choice(rec, p, survey, asked.capacity, Splits::kNo);
  rec.copy({survey.wave.buffer, survey.wave.offset, report.size}, report);
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
                                   .near = sides.near,
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

void record_unbuilt_survey_report(Recorder& rec, const Slice<gpu::SurveyWave>& report) {
  rec.fill(report, 0);
  fill_words(rec, report,
             std::array{std::pair{offsetof(gpu::SurveyWave, status), gpu::kStatusInput}});
}

void record_unbuilt_faces(Recorder& rec, const Slice<float>& faces) {
  constexpr uint32_t kNan = 0x7fc00000;
  rec.fill(faces, kNan);
}

// Copies both bounds of each face's error to the caller's buffer. A distance that a face reached
// before its cells were split still counts.
void record_survey_faces(Recorder& rec, const Problem& p, const SurveyStreams& survey,
                         const VkhSurveyFaces& faces) {
  const auto scope = rec.scope("survey faces");
  const VkDeviceSize bytes = VkDeviceSize{p.face_count} * sizeof(uint32_t);
  const auto write_errors = [&](uint32_t classes, uint32_t reached, VkDeviceSize offset) {
    if (reached != 0 && (classes & gpu::kAllClasses) == gpu::kAllClasses) {
      rec.copy(survey.faces_reached, survey.face_errors);
    } else {
      rec.fill(survey.face_errors, 0);
    }
    const SurveyGiven given(p, survey, gpu::SurveyFacesPush{classes, reached});
    rec.run<k::SurveyFaces>(given, Items{faces.cells});
    rec.copy(first_of(survey.face_errors, p.face_count),
             {faces.buffer, faces.offset + offset, bytes});
  };
  write_errors(faces.reachedClasses, 1, 0);
  write_errors(faces.highestClasses, 0, bytes);
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
  rec.copy(from.wave, to.wave, Order::kIndependent);
  rec.copy(from.faces_reached, to.faces_reached, Order::kIndependent);
  rec.copy(first_of(from.cells, cells), to.cells, Order::kIndependent);
  rec.copy(first_of(from.bounds, cells), to.bounds, Order::kIndependent);
  rec.copy(first_of(from.classes, cells), to.classes, Order::kIndependent);
  rec.copy(first_of(from.near_corners, cells), to.near_corners, Order::kIndependent);
  rec.copy(first_of(from.agreements, cells), to.agreements, Order::kIndependent);
  rec.copy(first_of(from.keys, cells), to.keys, Order::kIndependent);
}

}  // namespace vkh
