#include "host/survey/signed_figures.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "host/base/rounding.h"

namespace vkh {
namespace {

// A width in the frame: what plain floats leave of a cell's bounds. Splits gain nothing below it.
constexpr double kLeastWidth = 2e-6;

double now_ms() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

// A limit in the frame: a distance on the stored meshes of at most `within` is within it, and one
// of more than `beyond` is not.
struct LimitInFrame {
  double within, beyond;
};
LimitInFrame in_frame(const SurveyedPair& pair, const Limit& limit) {
  return {pair.frame.to_frame(limit.within) * (1 - 1e-15) - pair.displacement,
          pair.frame.to_frame(limit.beyond) * (1 + 1e-15) + pair.displacement};
}

// The distances that are known of one side, of a face or of all: in the frame.
struct Reach {
  float lower = 0, upper = 0;
  bool is_none = true;

  void add(const gpu::CellBounds& bounds, bool has_side) {
    if (has_side) lower = std::max(lower, bounds.reached);
    upper = std::max(upper, bounds.highest);
    is_none = false;
  }
  Enclosure in_files_of(const SurveyedPair& pair) const {
    if (is_none) return {0, 0};
    const Enclosure e = in_files(pair, {static_cast<double>(lower), static_cast<double>(upper)});
    return {std::min(e.lower, e.upper), e.upper};
  }
};

struct BothSides {
  Reach over, under;

  void add(const CellStore& cells, size_t i, SurfaceSide side) {
    if (side != SurfaceSide::kUnder) over.add(cells.bounds(i), side == SurfaceSide::kOver);
    if (side != SurfaceSide::kOver) under.add(cells.bounds(i), side == SurfaceSide::kUnder);
  }
};

void add_faces(const SurveyedPair& pair, const CellStore& cells, const std::vector<CellSide>& sides,
               SignedFigures& figures) {
  std::vector<BothSides> of_face(pair.a.faces.size());
  for (size_t i = 0; i < cells.count(); ++i) of_face[cells.face(i)].add(cells, i, sides[i].side);
  const auto add = [&pair](Field& field, const Reach& reach) {
    const Enclosure e = reach.in_files_of(pair);
    field.lower.push_back(e.lower);
    field.upper.push_back(e.upper);
  };
  for (const BothSides& both : of_face) {
    add(figures.over_of_faces, both.over);
    add(figures.under_of_faces, both.under);
  }
}

// A length of either sign in the files' units, not below or above it.
double down_in_files(const SurveyedPair& pair, double length) {
  const double down = add_down(length, -pair.displacement);
  const double in_unit = down < 0 ? -pair.frame.length_up(-down) : pair.frame.length_down(down);
  return std::max(in_unit, -pair.farthest);
}
Enclosure signed_in_files(const SurveyedPair& pair, const Enclosure& lengths) {
  return {down_in_files(pair, lengths.lower), -down_in_files(pair, -lengths.upper)};
}

// Known percentiles are to be so close to what the cells tell.
double resolution_of(const CellStore& cells) {
  return 0x1p-17 * static_cast<double>(cells.reached());
}

void add_statistics(const SurveyedPair& pair, const SurveyedArea& surface,
                    const std::vector<CellSide>& sides, std::span<const Enclosure> known,
                    SignedFigures& figures) {
  const auto& [store, areas] = surface;
  figures.mean = signed_in_files(pair, signed_mean(store, sides, areas));
  const std::vector<Enclosure> at =
      signed_percentiles(store, sides, areas, {kSignedShares, resolution_of(store), known});
  for (size_t i = 0; i < at.size(); ++i)
    figures.percentiles.push_back({kSignedShares[i], signed_in_files(pair, at[i])});
}

double width_of(const Enclosure& e) { return e.upper - e.lower; }

// The size that a figure of either sign has at least.
double least_size(const Enclosure& e) { return std::max({e.lower, -e.upper, 0.0}); }

}  // namespace

SidedCells::SidedCells(const SurveyedPair& pair, GoesOn goes_on)
    : pair_(pair),
      diagonal_(pair.frame.to_frame(diagonal(bounding_box(pair.a)))),
      ms_(-now_ms()),
      sides_(pair, std::move(goes_on)) {
  ms_ += now_ms();
}

// Looks at cells that reach above that, in the frame. Returns whether it was not ended.
bool SidedCells::look_at(const CellStore& cells, double above) {
  const double start = now_ms();
  const bool is_whole = sides_.find(cells, above, known_);
  ms_ += now_ms() - start;
  return is_whole;
}

namespace {

// Splits help cells that meet B or are over an edge; segments and points of B, faces on each other
// and too many faces stay in the way however small a cell is.
bool may_get_side(const CellSide& side) {
  return side.doubt == Doubt::kMeets || side.doubt == Doubt::kEdge;
}

}  // namespace

Scores SidedCells::score_limits(const CellStore& cells, const SidedLimits& limits) {
  const LimitInFrame over = in_frame(pair_, limits.over), under = in_frame(pair_, limits.under);
  const double least = std::min(over.within, under.within);
  const double most = std::max(over.beyond, under.beyond);
  if (!look_at(cells, least)) return {};
  Scores scores{{}, true};
  for (size_t i = 0; i < cells.count(); ++i) {
    const gpu::CellBounds& b = cells.bounds(i);
    const double highest = static_cast<double>(b.highest);
    const double reached = static_cast<double>(b.reached);
    if (reached > most) return {{}, true};
    if (highest <= least) continue;
    const SurfaceSide side = known_.of(cells.cell(i), i).side;
    const LimitInFrame& limit = side == SurfaceSide::kOver ? over : under;
    if (side != SurfaceSide::kUnsigned && reached > limit.beyond) return {{}, true};
    const double above = highest - (side == SurfaceSide::kUnsigned ? least : limit.within);
    if (above <= 0) continue;
    scores.is_met = false;
    const double spread = highest - static_cast<double>(lowest(b));
    const bool may_gain = side == SurfaceSide::kUnsigned || spread > kLeastWidth;
    if (may_gain && cells.can_split(i)) scores.cells.push_back({above, i});
  }
  return scores;
}

// Cells that are no farther than a hundredth of the largest distance have signed distances that are
// known as well without a side.
Scores SidedCells::score_unsigned(const CellStore& cells, const Areas& areas) {
  constexpr double kEnough = 0.05, kNear = 0.01;
  if (!look_at(cells, -1)) return {};
  Scores scores{{}, true};
  const double near = kNear * static_cast<double>(cells.reached());
  double open = 0;
  for (size_t i = 0; i < cells.count(); ++i) {
    if (!may_get_side(known_.of(cells.cell(i), i))) continue;
    if (static_cast<double>(cells.bounds(i).highest) <= near) continue;
    const double area = cells.share(i) * areas.of_face[cells.face(i)];
    open += area;
    if (area > 0 && cells.can_split(i)) scores.cells.push_back({area, i});
  }
  scores.is_met = open <= kEnough * areas.whole;
  return scores;
}

// A signed figure may be 0, of which no share is a width to work towards: the mean distance is the
// scale of what is asked then.
double SidedCells::enough(const Enclosure& figure, const Moments& plain,
                          const SurveyOptions& options) const {
  const double size = std::max(least_size(figure), plain.mean.lower);
  return std::max(
      {options.signed_tolerance * size, options.signed_floor * diagonal_, 2 * pair_.displacement});
}

namespace {

// Returns `width`, the cell's part of a figure's width, or 0 where a split would gain nothing.
double gain_of(const gpu::CellBounds& b, const CellSide& side, double width) {
  const double highest = static_cast<double>(b.highest);
  const bool is_sided = side.side != SurfaceSide::kUnsigned;
  const double spread = is_sided ? highest - static_cast<double>(lowest(b)) : highest;
  const bool may_gain = spread > kLeastWidth && (is_sided || may_get_side(side));
  return may_gain ? width : 0;
}

}  // namespace

Scores SidedCells::score_mean(const CellStore& cells, const Areas& areas,
                              const SurveyOptions& options) {
  if (!look_at(cells, -1)) return {};
  const std::vector<CellSide> sides = known_.of(cells);
  const Enclosure mean = signed_mean(cells, sides, areas);
  if (width_of(mean) <= enough(mean, moments_of(cells, areas), options)) return {{}, true};
  return scored(cells, [&](size_t i) -> std::optional<double> {
    const double up = static_cast<double>(cells.bounds(i).mean_upper);
    const bool is_sided = sides[i].side != SurfaceSide::kUnsigned;
    const double area = cells.share(i) * areas.of_face[cells.face(i)];
    const double of_mean = is_sided ? up - mean_lower(cells.bounds(i)) : 2 * up;
    return gain_of(cells.bounds(i), sides[i], area * of_mean);
  });
}

Scores SidedCells::score_percentiles(const CellStore& cells, const Areas& areas,
                                     const SurveyOptions& options) {
  if (!look_at(cells, -1)) return {};
  const std::vector<CellSide> sides = known_.of(cells);
  const Moments plain = moments_of(cells, areas);
  const double resolution =
      std::max(resolution_of(cells), options.signed_tolerance * plain.mean.lower / 16);
  percentiles_ = signed_percentiles(cells, sides, areas, {kSignedShares, resolution, percentiles_});
  std::vector<Threshold> open;
  for (const Enclosure& p : percentiles_) {
    if (width_of(p) <= enough(p, plain, options)) continue;
    open.push_back({p.lower, p.lower});
    open.push_back({p.upper, p.upper});
  }
  if (open.empty()) return {{}, true};
  return scored(cells, [&](size_t i) -> std::optional<double> {
    double share = 0;
    for (const Threshold& at : open) share += undecided_share(cells, sides, i, at);
    const double area = cells.share(i) * areas.of_face[cells.face(i)];
    return gain_of(cells.bounds(i), sides[i], share * area);
  });
}

void add_signed_goals(SidedCells& sided, const SurveyOptions& options, const Areas& areas,
                      std::vector<Goal>& goals) {
  const auto add =
      [&](Scores (SidedCells::*score)(const CellStore&, const Areas&, const SurveyOptions&)) {
        goals.emplace_back(
            [&, score](const CellStore& cells) { return (sided.*score)(cells, areas, options); });
      };
  if (options.sided)
    goals.insert(goals.begin(),
                 [&](const CellStore& cells) { return sided.score_limits(cells, *options.sided); });
  if (!options.is_signed || !areas.is_positive()) return;
  if (!options.sided)
    goals.emplace_back([&](const CellStore& cells) { return sided.score_unsigned(cells, areas); });
  if (!options.statistics) return;
  add(&SidedCells::score_mean);
  add(&SidedCells::score_percentiles);
}

namespace {

// The cell of a side on which a point is farthest, as far as is known; none: no cell has the side.
std::optional<size_t> farthest_cell(const CellStore& cells, const std::vector<CellSide>& sides,
                                    SurfaceSide side) {
  std::optional<size_t> best;
  for (size_t i = 0; i < cells.count(); ++i) {
    if (sides[i].side != side) continue;
    if (!best || cells.bounds(i).reached > cells.bounds(*best).reached) best = i;
  }
  return best;
}

void raise_to(double& most, double lower) { most = std::max(most, lower); }

}  // namespace

// A witness raises what its face and its whole side reach at least.
void SidedCells::add_witnesses(const CellStore& cells, const std::vector<CellSide>& sides,
                               SignedFigures& figures) const {
  const auto find = [&](SurfaceSide side, Enclosure& whole, Field& of_faces) {
    std::optional<SidedPoint> witness;
    const std::optional<size_t> cell = farthest_cell(cells, sides, side);
    if (!cell) return witness;
    witness = sides_.farthest_corner(cells.cell(*cell), cells.bounds(*cell).face);
    raise_to(whole.lower, witness->lower);
    if (of_faces.face_count() > 0) raise_to(of_faces.lower[witness->at.face], witness->lower);
    return witness;
  };
  figures.over_witness = find(SurfaceSide::kOver, figures.over, figures.over_of_faces);
  figures.under_witness = find(SurfaceSide::kUnder, figures.under, figures.under_of_faces);
}

std::vector<CellSide> SidedCells::of(const CellStore& cells) {
  look_at(cells, -1);
  return known_.of(cells);
}

SignedFigures SidedCells::figures(const SurveyedArea& surface, const SurveyOptions& options) {
  const CellStore& cells = surface.store;
  look_at(cells, -1);
  const double start = now_ms();
  const std::vector<CellSide> sides = known_.of(cells);
  SignedFigures figures;
  figures.inside = sides_.is_shared() ? Inside::kProven : sides_.shells().inside();
  if (!sides_.is_shared() && figures.inside == Inside::kProven) figures.inside = Inside::kUndecided;
  figures.inside_out = sides_.shells().inside_out();
  figures.edges = sides_.shells().edges();
  BothSides all;
  for (size_t i = 0; i < cells.count(); ++i) all.add(cells, i, sides[i].side);
  figures.over = all.over.in_files_of(pair_);
  figures.under = all.under.in_files_of(pair_);
  if (options.faces) add_faces(pair_, cells, sides, figures);
  add_witnesses(cells, sides, figures);
  if (surface.areas.is_positive()) {
    const auto shares = shares_of_sides(cells, sides, surface.areas);
    figures.areas.emplace();
    std::copy_n(shares.begin(), kDoubts, figures.areas->doubts.begin());
    figures.areas->over = shares[kDoubts];
    figures.areas->under = shares[kDoubts + 1];
    if (options.statistics) add_statistics(pair_, surface, sides, percentiles_, figures);
  }
  figures.ms = ms_ + now_ms() - start;
  return figures;
}

}  // namespace vkh
