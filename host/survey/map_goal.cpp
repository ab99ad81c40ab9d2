#include "host/survey/map_goal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/parallel.h"
#include "host/base/thread_pool.h"
#include "host/solve/cell_corners.h"
#include "host/survey/sides.h"
#include "shaders/survey/score.h"
#include "vkhausdorff/length.h"

namespace vkh {
namespace {

// The distance that about 99 % of A's area is within, rounded up by a percent. It is a histogram of
// logarithms, whose areas are integers, so that sums are the same in any order.
class Percentile99 {
 public:
  Percentile99() : area_(kBins) {}

  void add(double distance, double share) {
    area_[bin_of(distance)] += static_cast<uint64_t>(share * 0x1p40);
  }
  void add(const Percentile99& other) {
    for (size_t i = 0; i < kBins; ++i) area_[i] += other.area_[i];
  }
  double value() const {
    uint64_t whole = 0, seen = 0;
    for (const uint64_t area : area_) whole += area;
    for (size_t i = 0; i < kBins; ++i) {
      seen += area_[i];
      if (seen >= whole / 100 * 99)
        return std::exp2((static_cast<double>(i) + 1) / kOfOctave - kOctaves);
    }
    return 1;
  }

 private:
  // From 2^-30 of the frame, which is less than floats resolve, to 2.
  static constexpr double kOfOctave = 64, kOctaves = 30;
  static constexpr size_t kBins = 64 * 31 + 1;
  static size_t bin_of(double distance) {
    const double at = (std::log2(std::max(distance, 0x1p-30)) + kOctaves) * kOfOctave;
    return std::min(static_cast<size_t>(std::max(at, 0.0)), kBins - 1);
  }

  std::vector<uint64_t> area_;
};

// Returns it for the distances drawn at the cells' middles, without the ones farther than `most`.
double percentile_99(std::span<const MapCell> cells, double most) {
  std::vector<Percentile99> blocks(block_count(cells.size()));
  for_each_block(cells.size(), [&](size_t block, size_t begin, size_t end) {
    for (const MapCell& cell : cells.subspan(begin, end - begin)) {
      const auto [a, b, c] = cell.estimate;
      const double at = static_cast<double>(a + b + c) / 3;
      if (at <= most) blocks[block].add(at, static_cast<double>(cell.share));
    }
  });
  Percentile99 all;
  for (const Percentile99& block : blocks) all.add(block);
  return all.value();
}

// The length of a pixel, in the files' units.
double pixel_of(const SurveyedPair& pair, const MapOptions& options) {
  return diagonal(bounding_box(pair.a)) / options.pixels;
}

// The area of an eighth of a pixel, as a share of A's. Hatched cells of half a pixel, at B's
// vertices, are seen as dots.
double least_area(double pixel, const Areas& areas) {
  const double in_unit = areas.unit.to_frame(pixel);
  return in_unit * in_unit / 8 / areas.whole;
}

// How far other triangulations of both meshes' polygons may move a distance, in the files' units.
// The displacement includes it.
double open_of(const SurveyedPair& pair) {
  double open = 0;
  for (const Mesh* mesh : {&pair.a, &pair.b})
    open += mesh->polygons.any_triangulation ? mesh->polygons.ambiguity : 0;
  return open;
}

// The width up to which a cell is resolved, in the frame. Splits do not reduce `open`: if it alone
// is too wide, cells are split as if it were 0.
double step_of(double end, double open, double floor) {
  const double step = CellMap::kUnresolved * end;
  return std::max(open < step ? step - open : step, floor);
}

// The distance beyond which a map leaves cells out, in the frame.
double most_of(const SurveyOptions& options, const SurveyedPair& pair) {
  return options.max_distance ? pair.frame.to_frame(typed_length(*options.max_distance))
                              : std::numeric_limits<double>::infinity();
}

}  // namespace

MapGoals::MapGoals(const SurveyOptions& options, const SurveyedPair& pair, const Areas& areas,
                   double farthest)
    : most_(most_of(options, pair)),
      open_(pair.frame.to_frame(open_of(pair))),
      least_(least_area(pixel_of(pair, *options.map), areas)),
      longest_(kPixels * pair.frame.to_frame(pixel_of(pair, *options.map))),
      floor_(least_width(pair)),
      is_sought_(!options.map->bar && farthest > 0),
      is_known_(!is_sought_),
      bar_(options.map->bar ? pair.frame.to_frame(*options.map->bar) : 0),
      farthest_(farthest),
      from_(least_bar()),
      to_(farthest) {}

// Distances in a geometric sequence, and then the distance beyond which the map leaves cells out.
std::vector<Threshold> MapGoals::thresholds() const {
  std::vector<Threshold> at;
  if (is_known_) return at;
  for (int k = 0; k <= kCuts; ++k) {
    const double d = from_ * std::pow(to_ / from_, static_cast<double>(k) / kCuts);
    at.push_back({d, d});
  }
  at.push_back({std::min(most_, farthest_), std::min(most_, farthest_)});
  return at;
}

// The bar ends behind the last distance within which less than 99 % of the area may be. Taking the
// area that surely is there would make the bar too long while cells are wide, and leave other cells
// too wide. It only steers. Looks again if the bar's end is outside of the distances, or if these
// are far apart.
bool MapGoals::look(const Tallied& tallied) {
  if (is_known_) return false;
  const std::vector<Threshold> at = thresholds();
  const double wanted = 0.99 * tallied.shares.back().upper;
  const auto is_within = [&](size_t k) { return tallied.shares[k].upper >= wanted; };
  size_t next = 0;
  while (next < kCuts && !is_within(next)) ++next;
  const bool is_below = next == 0 && from_ > least_bar();
  const bool is_above = !is_within(next) && to_ < farthest_;
  if (is_below || is_above) {
    from_ = is_below ? least_bar() : from_;
    to_ = is_above ? farthest_ : to_;
    return true;
  }
  bar_ = at[next > 0 ? next - 1 : 0].down;
  const bool is_coarse = to_ > 8 * from_;
  from_ = bar_ / kNarrow;
  to_ = std::min(at[next].down * kNarrow, farthest_);
  is_known_ = is_nearly_met_ && !is_coarse;
  return is_coarse;
}

gpu::SurveyPlan MapGoals::plan(double whole) const {
  gpu::SurveyPlan plan{};
  plan.of_whole = static_cast<float>(1 / whole);
  const double step = step_of(bar_, open_, floor_);
  plan.map_step = static_cast<float>(is_nearly_met_ ? step : 2 * step);
  plan.map_area = static_cast<float>(is_nearly_met_ ? least_ : 2 * least_);
  plan.map_length = static_cast<float>(is_nearly_met_ ? longest_ : 2 * longest_);
  plan.map_most = static_cast<float>(std::min(most_, 1e38));
  return plan;
}

namespace {

// Reads all cells, some at a time: a driver takes an H200's host a third of a millisecond for each
// MB that it gives out to read them in.
template <class Take>
void read_all(WaveSurvey& waves, const Take& take) {
  constexpr uint32_t kAtOnce = 1u << 17;  // 12 MB
  const auto count = static_cast<uint32_t>(waves.count());
  for (uint32_t first = 0; first < count; first += kAtOnce) {
    const CellsRead some = waves.read({first, std::min(kAtOnce, count - first)});
    for_each_block(some.cells.size(), [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) take(first + i, some, i);
    });
  }
}

}  // namespace

CellMap map_of(WaveSurvey& waves, const Areas& areas, const SurveyedPair& pair,
               const SurveyOptions& options) {
  CellMap map;
  map.unit = pair.frame.length_down(1);
  map.least = least_width(pair);
  // Adds what is open to each cell's width, so that no cell seems better known than it is.
  const double open = pair.frame.to_frame(open_of(pair));
  map.slack = pair.frame.length_up(std::max(pair.displacement - open, 0.0));
  if (options.max_distance) map.max_distance = typed_length(*options.max_distance);
  resize_together(ThreadPool(), map.cells, waves.count());
  read_all(waves, [&](size_t number, const CellsRead& some, size_t i) {
    const auto& [c, face, start] = some.cells[i];
    const auto halvings = static_cast<int>(lib::halvings_of(corners_of(some.cells[i])));
    const double area = std::ldexp(areas.of_face[face], -halvings);
    const lib::DrawnCell drawn = lib::drawn_of(some.bounds[i]);
    map.cells[number] = {.corners = {c.x, c.y, c.z, c.w},
                         .face = face,
                         .estimate = {drawn.at.x, drawn.at.y, drawn.at.z},
                         .width = static_cast<float>(static_cast<double>(drawn.off) + open),
                         .share = static_cast<float>(area / areas.whole),
                         .side = side_of_class(some.classes[i]).side};
  });
  map.bar = options.map->bar ? *options.map->bar
                             : map.unit * percentile_99(map.cells, most_of(options, pair));
  return map;
}

void add_sides(WaveSurvey& waves, CellMap& map) {
  map.has_sides = true;
  read_all(waves, [&](size_t number, const CellsRead& some, size_t i) {
    map.cells[number].side = side_of_class(some.classes[i]).side;
  });
}

bool may_have_cheap_sides(const SurveyOptions& options, const SurveyedPair& pair) {
  constexpr size_t kFewFaces = 50'000;
  const bool is_asked = options.map && options.map->sides_if_cheap && !options.is_signed;
  const Mesh& b = pair.b;
  return is_asked && !options.sided && open_of(pair) == 0 && b.faces.size() <= kFewFaces &&
         !b.are_points && Shells::edges_of(b).open == 0;
}

// If all cells are nearer, at least the worst places get sides.
double near_zero(double bar, double reached) {
  constexpr double kOfLargest = 0.5;
  return std::min(CellMap::kUnresolved * bar, kOfLargest * reached);
}

// A width is rounded to a float twice, by a share of 2^-23 at most. The sums, the products and
// `unit` together are rounded by less than ten shares of 2^-53 of the larger end.
Enclosure CellMap::around(double estimate, double width) const {
  const double gap = width * (1 + 0x1p-22);
  const double rounding = (estimate + gap) * unit * 0x1p-49 + slack;
  return {std::max((estimate - gap) * unit - rounding, 0.0), (estimate + gap) * unit + rounding};
}

std::array<glm::dvec3, 3> weights_of(const MapCell& cell) {
  gpu::Cell words{};
  words.corners = {cell.corners[0], cell.corners[1], cell.corners[2], cell.corners[3]};
  const lib::Bary3 t = corners_of(words);
  const auto weights = [](const glm::uvec2& at) {
    const glm::dvec2 w = glm::dvec2(at) / static_cast<double>(gpu::kBaryOne);
    return glm::dvec3(1 - w.x - w.y, w.x, w.y);
  };
  return {weights(t.a), weights(t.b), weights(t.c)};
}

}  // namespace vkh
