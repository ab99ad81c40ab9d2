#include "host/survey/signed_figures.h"

#include <algorithm>
#include <array>
#include <limits>

#include "host/survey/lengths.h"

namespace vkh {
namespace {

// The distances that are known of one side, of a face or of all; none: there is no cell.
Enclosure reach_in_files(const SurveyedPair& pair, double lower, double upper) {
  const Enclosure e = in_files(pair, {lower, upper});
  return {std::min(e.lower, e.upper), e.upper};
}

// `own`: cells of the side; `not_other`: cells that are not on the other side.
struct SideAsked {
  uint32_t own, not_other;
};
constexpr SideAsked kOver{kOverB, gpu::kAllClasses & ~kUnderB},
    kUnder{kUnderB, gpu::kAllClasses & ~kOverB};

// An upper bound of a cell is never 0, so 0 marks a face without such cells.
Field field_of_side(const SurveyedPair& pair, const SideAsked& side, WaveSurvey& waves) {
  const std::vector<float> distances = waves.faces(side.own, side.not_other);
  const size_t faces = distances.size() / 2;
  Field field;
  for (size_t f = 0; f < faces; ++f) {
    const auto upper = static_cast<double>(distances[faces + f]);
    const Enclosure e = upper > 0 ? reach_in_files(pair, static_cast<double>(distances[f]), upper)
                                  : Enclosure{0, 0};
    field.lower.push_back(e.lower);
    field.upper.push_back(e.upper);
  }
  return field;
}

struct WholeSide {
  Enclosure all;
  std::optional<SidedPoint> witness;
};

// The witness is a corner of the first cell that provably reaches farthest. It raises the side's
// lower bound.
WholeSide whole_side(const SurveyedPair& pair, const SideAsked& side, const Sides& sides,
                     WaveSurvey& waves) {
  WholeSide found{{0, 0}, {}};
  const Tallied may_be = waves.tally_anyway({.at = {}, .classes = side.not_other});
  if (may_be.is_empty) return found;
  const float reached = waves.tally_anyway({.at = {}, .classes = side.own}).reached;
  found.all = reach_in_files(pair, static_cast<double>(reached), may_be.highest);
  const Tallied far = waves.tally_anyway({.at = {}, .classes = side.own, .far = reached});
  if (!far.far) return found;
  const CellsRead cell = waves.read({*far.far, 1});
  found.witness = sides.farthest_corner(cell.cells[0], cell.bounds[0].face);
  found.all.lower = std::max(found.all.lower, found.witness->lower);
  return found;
}

void raise_witness(const std::optional<SidedPoint>& witness, Field& of_faces) {
  if (!witness || of_faces.face_count() == 0) return;
  double& lower = of_faces.lower[witness->at.face];
  lower = std::max(lower, witness->lower);
}

// The share of A's area in some classes; exactly 0 if no cell is in them.
Enclosure share_of_classes(uint32_t classes, WaveSurvey& waves) {
  const std::array<Threshold, 1> all{{{kAnyDistance, kAnyDistance}}};
  return waves.tally_anyway({.at = all, .classes = classes}).shares[0];
}

// As a rule all cells without a side meet B.
SignedFigures::Areas areas_of_sides(WaveSurvey& waves) {
  constexpr uint32_t kMeets = 1u << gpu::kClassMeets;
  SignedFigures::Areas areas;
  areas.over = share_of_classes(kOverB, waves);
  areas.under = share_of_classes(kUnderB, waves);
  const auto put = [&](Doubt doubt, uint32_t of_class) {
    areas.doubts[static_cast<size_t>(doubt)] = share_of_classes(1u << of_class, waves);
  };
  put(Doubt::kMeets, gpu::kClassMeets);
  if (share_of_classes(kWithoutSide & ~kMeets, waves).upper == 0) return areas;
  put(Doubt::kEdge, gpu::kClassEdge);
  put(Doubt::kDegenerate, gpu::kClassDegenerate);
  put(Doubt::kTwoSided, gpu::kClassTwoSided);
  put(Doubt::kMany, gpu::kClassMany);
  put(Doubt::kEnded, gpu::kClassUnseen);
  return areas;
}

void add_statistics(const SurveyedPair& pair, SignedDistances& distances, SignedFigures& figures) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  const Enclosure mean = distances.tally({.at = {}, .moments = Threshold{kAll, kAll}}).moments.mean;
  figures.mean = signed_in_files(pair, mean);
  const std::vector<Enclosure> at =
      distances.percentiles({kSignedShares, 0x1p-17 * distances.reached()});
  for (size_t i = 0; i < at.size(); ++i)
    figures.percentiles.push_back({kSignedShares[i], signed_in_files(pair, at[i])});
}

}  // namespace

SignedFigures signed_figures(const SurveyedPair& pair, const Areas& areas,
                             const SurveyOptions& options, const Sides& sides,
                             SignedDistances& distances) {
  WaveSurvey& waves = distances.cells();
  SignedFigures figures;
  figures.inside = sides.shells().inside();
  if (!sides.is_solid() && figures.inside == Inside::kProven) figures.inside = Inside::kUndecided;
  figures.inside_out = sides.shells().inside_out();
  figures.edges = sides.shells().edges();
  const WholeSide over = whole_side(pair, kOver, sides, waves);
  const WholeSide under = whole_side(pair, kUnder, sides, waves);
  figures.over = over.all;
  figures.under = under.all;
  figures.over_witness = over.witness;
  figures.under_witness = under.witness;
  if (options.faces) {
    figures.over_of_faces = field_of_side(pair, kOver, waves);
    figures.under_of_faces = field_of_side(pair, kUnder, waves);
    raise_witness(over.witness, figures.over_of_faces);
    raise_witness(under.witness, figures.under_of_faces);
  }
  if (areas.is_positive()) {
    figures.areas = areas_of_sides(waves);
    if (options.statistics) add_statistics(pair, distances, figures);
  }
  return figures;
}

}  // namespace vkh
