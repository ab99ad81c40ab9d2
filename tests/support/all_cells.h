// Cells of all of A, refined everywhere, with their sides.
#pragma once

#include <algorithm>
#include <iterator>

#include "host/survey/area_table.h"
#include "host/survey/wave_survey.h"

namespace vkh::test {

/// Splits all cells that splits may help, and bounds their parts; returns whether there were some.
inline bool split_all(SurveyCells& cells) {
  constexpr float kAny = 3e38f;
  gpu::SurveyPlan plan{};
  plan.faces = 1;
  plan.face_beyond = kAny;
  plan.face_tolerance = -kAny;
  std::fill(std::begin(plan.face_within), std::end(plan.face_within), -kAny);
  const CellRange all{0, static_cast<uint32_t>(cells.count())};
  const SurveyChoice choice = choose_cells(cells.score(plan, all), 1, cells.count());
  if (choice.count() == 0 || !cells.split(choice)) return false;
  cells.bound(0, choice.parts * choice.count(), true);
  return true;
}

/// Makes cells of A's faces, and splits them until there are `at_least`; returns all of them.
inline CellRange make_cells(const SurveyedPair& pair, size_t at_least) {
  SurveyCells& cells = *pair.cells;
  const double farthest = pair.frame.to_frame(pair.farthest) + pair.displacement;
  cells.begin(weights_of(areas_of(pair.a)).of_face, static_cast<float>(1.001 * farthest));
  cells.bound(0, cells.count(), true);
  while (cells.count() < at_least && split_all(cells)) {
  }
  return {0, static_cast<uint32_t>(cells.count())};
}

/// Makes such cells, and finds their sides.
inline CellsRead sided_cells(const SurveyedPair& pair, const SideSearch& search, size_t at_least) {
  const CellRange all = make_cells(pair, at_least);
  pair.cells->find_sides(search, -1, all);
  return pair.cells->read(all);
}

/// Makes such cells, and finds how their normals agree.
inline CellsRead cells_with_normals(const SurveyedPair& pair, const NormalSearch& search,
                                    size_t at_least) {
  const CellRange all = make_cells(pair, at_least);
  pair.cells->begin_normals(search);
  pair.cells->find_normals(all);
  return pair.cells->read(all);
}

}  // namespace vkh::test
