// The goal of a map, and the map from a survey's cells.
#pragma once

#include <optional>
#include <span>

#include "host/survey/estimate.h"
#include "host/survey/goals.h"
#include "host/survey/stoppable.h"

namespace vkh {

/// A cell scores if it is larger than a pixel, unresolved and not left out. None unless a map is
/// asked for and A has an area; none for points, which no split divides. All arguments must outlive
/// it.
std::optional<Goal> map_goal(const SurveyOptions& options, const SurveyedPair& pair,
                             const Areas& areas);

/// The map of all cells, which `options` ask for. A has an area, or is points.
CellMap map_of(const SurveyedArea& surface, const SurveyedPair& pair, const SurveyOptions& options,
               const Estimates& estimates);
/// Adds the sides of the survey's cells, in their order, to a map of all of them.
void add_sides(std::span<const CellSide> sides, CellMap& map);

/// Whether MapOptions::sides_if_cheap asks for sides of this B: it is small, has no open edge, and
/// neither mesh stands for any triangulation of its polygons.
bool may_have_cheap_sides(const SurveyOptions& options, const SurveyedPair& pair);
/// Adds sides to a map of all cells, where B has an inside that is proven and `goes_on` does not
/// end the search. Cells that are so near that they look like nought have none.
void add_cheap_sides(const SurveyedPair& pair, const CellStore& cells, const GoesOn& goes_on,
                     CellMap& map);

}  // namespace vkh
