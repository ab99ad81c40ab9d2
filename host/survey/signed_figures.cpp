#include "host/survey/signed_figures.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "host/base/parallel.h"
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
  uint32_t face = UINT32_MAX;  // one that has the point at `lower`

  void add(const gpu::CellBounds& bounds, bool has_side, uint32_t of_face) {
    if (has_side && bounds.reached > lower) {
      lower = bounds.reached;
      face = of_face;
    }
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
    if (side != SurfaceSide::kUnder)
      over.add(cells.bounds(i), side == SurfaceSide::kOver, cells.face(i));
    if (side != SurfaceSide::kOver)
      under.add(cells.bounds(i), side == SurfaceSide::kUnder, cells.face(i));
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

// The shares at which the distribution of signed distances is told: both of its ends matter.
constexpr std::array kSignedShares = {0.01, 0.05, 0.5, 0.95, 0.99};

void add_statistics(const SurveyedPair& pair, const SurveyedArea& surface,
                    const std::vector<CellSide>& sides, SignedFigures& figures) {
  const auto& [store, areas, known] = surface;
  figures.mean = signed_in_files(pair, signed_mean(store, sides, areas));
  const double resolution = 0x1p-17 * static_cast<double>(store.reached());
  const std::vector<Enclosure> at =
      signed_percentiles(store, sides, areas, {kSignedShares, resolution});
  for (size_t i = 0; i < at.size(); ++i)
    figures.percentiles.push_back({kSignedShares[i], signed_in_files(pair, at[i])});
}

}  // namespace

SidedCells::SidedCells(const SurveyedPair& pair) : pair_(pair), ms_(-now_ms()), sides_(pair) {
  ms_ += now_ms();
}

// Looks at cells that reach above that, in the frame, and were not looked at as they are. Halves of
// a cell with a side have it, too, and are only looked at again if they are new.
void SidedCells::look_at(const CellStore& cells, double above) {
  const double start = now_ms();
  known_.resize(cells.count());
  constexpr size_t kCellsOfRange = 1024;
  for_each_range_of(kCellsOfRange, cells.count(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      Known& known = known_[i];
      if (static_cast<double>(cells.bounds(i).highest) <= above) continue;
      const gpu::uvec4& now = cells.cell(i).corners;
      const bool is_same = known.corners.x == now.x && known.corners.y == now.y &&
                           known.corners.z == now.z && known.corners.w == now.w;
      if (known.is_known && (is_same || known.side.side != SurfaceSide::kUnsigned)) continue;
      known = {sides_.of(cells.cell(i), cells.bounds(i)), now, true};
    }
  });
  ms_ += now_ms() - start;
}

Scores SidedCells::score_limits(const CellStore& cells, const SidedLimits& limits) {
  const LimitInFrame over = in_frame(pair_, limits.over), under = in_frame(pair_, limits.under);
  const double least = std::min(over.within, under.within);
  const double most = std::max(over.beyond, under.beyond);
  look_at(cells, least);
  Scores scores{{}, true};
  for (size_t i = 0; i < cells.count(); ++i) {
    const gpu::CellBounds& b = cells.bounds(i);
    const double highest = static_cast<double>(b.highest);
    const double reached = static_cast<double>(b.reached);
    if (reached > most) return {{}, true};
    if (highest <= least) continue;
    const SurfaceSide side = known_[i].side.side;
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

// Splits help cells that meet B or are over an edge; segments and points of B, faces on each other
// and too many faces stay in the way however small a cell is. Cells that are no farther than a
// hundredth of the largest distance have signed distances that are known as well without a side.
Scores SidedCells::score_unsigned(const CellStore& cells, const Areas& areas) {
  constexpr double kEnough = 0.05, kNear = 0.01;
  look_at(cells, -1);
  Scores scores{{}, true};
  const double near = kNear * static_cast<double>(cells.reached());
  double open = 0;
  for (size_t i = 0; i < cells.count(); ++i) {
    const CellSide& side = known_[i].side;
    if (side.doubt != Doubt::kMeets && side.doubt != Doubt::kEdge) continue;
    if (static_cast<double>(cells.bounds(i).highest) <= near) continue;
    const double area = cells.share(i) * areas.of_face[cells.face(i)];
    open += area;
    if (area > 0 && cells.can_split(i)) scores.cells.push_back({area, i});
  }
  scores.is_met = open <= kEnough * areas.whole;
  return scores;
}

SignedFigures SidedCells::figures(const SurveyedArea& surface, const SurveyOptions& options) const {
  const double start = now_ms();
  const CellStore& cells = surface.store;
  std::vector<CellSide> sides = sides_.of(cells);
  for (size_t i = 0; i < known_.size(); ++i) {
    if (sides[i].side == SurfaceSide::kUnsigned && known_[i].side.side != SurfaceSide::kUnsigned)
      sides[i] = known_[i].side;  // a half has the side of the cell that it is of
  }
  SignedFigures figures;
  figures.inside = sides_.is_shared() ? Inside::kProven : sides_.shells().inside();
  if (!sides_.is_shared() && figures.inside == Inside::kProven) figures.inside = Inside::kUndecided;
  figures.edges = sides_.shells().edges();
  BothSides all;
  for (size_t i = 0; i < cells.count(); ++i) all.add(cells, i, sides[i].side);
  figures.over = all.over.in_files_of(pair_);
  figures.under = all.under.in_files_of(pair_);
  const auto file_face = [&](const Reach& reach) -> std::optional<uint64_t> {
    if (reach.face == UINT32_MAX) return {};
    return pair_.a.file_faces.of(reach.face);
  };
  figures.over_face = file_face(all.over);
  figures.under_face = file_face(all.under);
  if (options.faces) add_faces(pair_, cells, sides, figures);
  if (surface.areas.is_positive()) {
    const auto shares = shares_of_sides(cells, sides, surface.areas);
    figures.areas.emplace();
    std::copy_n(shares.begin(), kDoubts, figures.areas->doubts.begin());
    figures.areas->over = shares[kDoubts];
    figures.areas->under = shares[kDoubts + 1];
    if (options.statistics) add_statistics(pair_, surface, sides, figures);
  }
  figures.ms = ms_ + now_ms() - start;
  return figures;
}

}  // namespace vkh
