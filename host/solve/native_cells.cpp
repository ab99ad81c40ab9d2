#include "host/solve/native_cells.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <new>
#include <optional>

#include "host/base/parallel.h"
#include "host/solve/cell_corners.h"
#include "shaders/survey/score.h"

namespace vkh {
namespace {

constexpr size_t kBoundedOfPiece = 64, kCellsOfPiece = size_t{1} << 14;

/// Calls work(begin, end) for pieces of some items.
template <class Work>
void in_pieces(const CellRange& some, size_t size, size_t threads, const Work& work) {
  const size_t first = some.first, end = first + some.count;
  for_each_index((some.count + size - 1) / size,
                 [&](size_t i) { work(first + i * size, std::min(first + (i + 1) * size, end)); },
                 threads);
}
template <class Work>
void in_pieces(size_t count, size_t size, size_t threads, const Work& work) {
  in_pieces({0, static_cast<uint32_t>(count)}, size, threads, work);
}

gpu::Wide wide_of(uint64_t x) {
  return {.low = static_cast<uint32_t>(x), .high = static_cast<uint32_t>(x >> 32)};
}
uint64_t whole_of(const glm::uvec2& x) { return uint64_t{x.y} << 32 | x.x; }

// The same as in survey_score.comp and survey_tally.comp.
lib::TallyBounds bounds_of(const gpu::CellBounds& bounds, uint32_t of_class,
                           const gpu::CellAgreement& found, const gpu::SurveyPlan& plan) {
  const lib::TallyBounds b = lib::tally_bounds(bounds);
  return plan.of_normals != 0 ? lib::with_normals(b, found, of_class) : b;
}

// The same as in survey_score.comp.
float score_of(const gpu::CellBounds& bounds, uint32_t of_class, const gpu::CellAgreement& found,
               const gpu::SurveyPlan& plan) {
  if (!(plan.mean > 0 || plan.square > 0 || plan.open_count > 0)) return 0;
  const lib::TallyBounds b = bounds_of(bounds, of_class, found, plan);
  const lib::TallyBounds kept = lib::within_most(b, plan.most);
  float score = 0;
  if (plan.mean > 0 && lib::is_among(of_class, plan.mean_classes)) {
    const bool is_either = lib::is_among(of_class, plan.either_side);
    score += plan.mean * (is_either ? lib::either_width(kept) : lib::mean_width(kept));
  }
  if (plan.square > 0) score += plan.square * lib::square_width(kept);
  for (uint32_t i = 0; i < plan.open_count; ++i) {
    if (lib::is_among(of_class, plan.open_classes[i]))
      score += plan.shares[i] * lib::undecided_share(b, plan.open[i]);
  }
  return score;
}

/// The sums of a tally: what cells add does not depend on their order.
class Sums {
 public:
  Sums(const gpu::SurveyPlan& plan, int unit)
      : plan_(plan), edges_(plan.edges, plan.edge_count), unit_(unit) {}

  struct Told {
    const gpu::CellBounds& bounds;
    uint32_t of_class;
    const gpu::CellAgreement& found;
  };

  void add(uint32_t place, const gpu::Cell& cell, const gpu::Wide& of_face, const Told& told) {
    const lib::CellWeight w =
        lib::cell_weight({of_face.low, of_face.high}, lib::halvings_of(corners_of(cell)));
    const gpu::CellBounds& bounds = told.bounds;
    Bounded b{told, plan_};
    if (plan_.moments != 0) add_moments(lib::within_most(b.all(), plan_.most), w);
    const float to = b.is_whole() ? bounds.highest : lib::counts_to(b.all());
    const float from = b.is_whole() ? lib::lowest_of(bounds) : lib::counts_from(b.all());
    highest_ = std::max(highest_, lib::bits_of(to));
    not_lowest_ = std::max(not_lowest_, ~lib::bits_of(from));
    reached_ = std::max(reached_, lib::bits_of(bounds.reached));
    if (bounds.reached >= plan_.far) not_far_ = std::max(not_far_, ~place);
    add_surely_within(b, w);
    add_perhaps_within(b, w);
  }

  void add(const Sums& others) {
    for (size_t i = 0; i < sums_.size(); ++i) sums_[i] += others.sums_[i];
    highest_ = std::max(highest_, others.highest_);
    not_lowest_ = std::max(not_lowest_, others.not_lowest_);
    reached_ = std::max(reached_, others.reached_);
    not_far_ = std::max(not_far_, others.not_far_);
  }

  void put(gpu::SurveyTable& table) const {
    for (size_t i = 0; i < sums_.size(); ++i) table.sums[i] = wide_of(sums_[i]);
    table.highest = highest_;
    table.not_lowest = not_lowest_;
    table.reached = reached_;
    table.not_far = not_far_;
  }

 private:
  /// Makes a cell's bounds for the tally where they are needed first: an edge may cut no cell.
  struct Bounded {
    const Told& told;
    const gpu::SurveyPlan& plan;
    std::optional<lib::TallyBounds> made = {};

    const lib::TallyBounds& all() {
      if (!made) made = bounds_of(told.bounds, told.of_class, told.found, plan);
      return *made;
    }
    // Whether all of the cell counts, which it does unless normals are compared.
    bool is_whole() const { return plan.of_normals == 0; }
  };

  void add(size_t at, const glm::uvec2& x) { sums_[at] += whole_of(x); }

  // Visits the edges that cut the cell, and the first edge within which it lies entirely.
  void add_surely_within(Bounded& b, const lib::CellWeight& w) {
    const gpu::CellBounds& c = b.told.bounds;
    const float least = std::min({c.upper_a, c.upper_b, c.upper_c});
    for (size_t k = first_edge(&gpu::SurveyEdge::down, least); k < edges_.size(); ++k) {
      const float down = edges_[k].down;
      if (down >= c.highest)
        return add(gpu::kSurelyWhole + k,
                   b.is_whole() ? w.down : lib::part_down(w, lib::surely_within(b.all(), down)));
      add(gpu::kSurelyPart + k, lib::part_down(w, lib::surely_within(b.all(), down)));
    }
  }

  void add_perhaps_within(Bounded& b, const lib::CellWeight& w) {
    const gpu::CellBounds& c = b.told.bounds;
    const float least = std::min({c.lower_a, c.lower_b, c.lower_c});
    const float most = std::max({c.lower_a, c.lower_b, c.lower_c});
    for (size_t k = first_edge(&gpu::SurveyEdge::up, least); k < edges_.size(); ++k) {
      const float up = edges_[k].up;
      if (up >= most)
        return add(gpu::kPerhapsWhole + k,
                   b.is_whole() ? w.up : lib::part_up(w, lib::perhaps_within(b.all(), up)));
      add(gpu::kPerhapsPart + k, lib::part_up(w, lib::perhaps_within(b.all(), up)));
    }
  }

  // The first one that is not below a distance.
  size_t first_edge(float gpu::SurveyEdge::*end, float distance) const {
    const auto is_below = [&](const gpu::SurveyEdge& e) { return e.*end < distance; };
    return static_cast<size_t>(std::partition_point(edges_.begin(), edges_.end(), is_below) -
                               edges_.begin());
  }

  void add_moments(const lib::TallyBounds& b, const lib::CellWeight& w) {
    const int square_unit = 2 * unit_ - 127;
    add(gpu::kMeanLower, lib::weighed_down(w, lib::mean_over_down(b.lower), unit_));
    add(gpu::kMeanUpper, lib::weighed_up(w, b.mean_upper, unit_));
    add(gpu::kSquareLower, lib::weighed_down(w, lib::square_over_down(b.lower), square_unit));
    add(gpu::kSquareUpper, lib::weighed_up(w, b.square_upper, square_unit));
  }

  const gpu::SurveyPlan& plan_;
  const std::span<const gpu::SurveyEdge> edges_;
  const int unit_;
  std::array<uint64_t, gpu::kSurveySums> sums_{};
  uint32_t highest_ = 0, not_lowest_ = 0, reached_ = 0, not_far_ = 0;
};

}  // namespace

NativeCells::NativeCells(const native::PlacedPair& pair, const Mesh& a, size_t threads, size_t most)
    : pair_(pair), a_(a), threads_(threads), most_(most), table_{} {}

void NativeCells::begin(std::span<const uint64_t> weights, float farthest) {
  const size_t faces = a_.faces.size();
  if (faces > most_) throw std::bad_alloc();
  weights_.resize(faces);
  std::transform(weights.begin(), weights.end(), weights_.begin(), wide_of);
  reached_.assign(faces, 0.0f);
  bounds_.assign(faces, unknown_bounds(farthest));
  near_.assign(faces, {});
  classes_.assign(faces, gpu::kClassUnseen);
  agreements_.resize(faces);
  gpu::Cell whole{};
  set_corners(whole, lib::whole_root());
  whole.start = gpu::kNone;
  cells_.assign(faces, whole);
  parents_.resize(faces);
  for (uint32_t f = 0; f < faces; ++f) cells_[f].face = parents_[f] = f;
  parts_ = 1;
}

lib::Root NativeCells::root_of(uint32_t face) const {
  const auto vertex = [this](uint32_t number) {
    const gpu::Vertex v = pair_.vertex_of_a(number);
    return lib::Two3{{v.hi.x, v.hi.y, v.hi.z}, {v.lo.x, v.lo.y, v.lo.z}};
  };
  const glm::uvec3& f = a_.faces[face];
  return lib::make_root(vertex(f.x), vertex(f.y), vertex(f.z));
}

// Returns the bin, 0 for none: as survey_score.comp does.
uint32_t NativeCells::score_one(const gpu::SurveyPlan& plan, uint32_t place, bool& is_stuck) const {
  const gpu::Cell& cell = cells_[place];
  const gpu::CellBounds& b = bounds_[place];
  const float of_face =
      plan.faces == 0
          ? 0
          : lib::face_score(b.highest, reached_[cell.face], plan.face_tolerance,
                            plan.face_within[lib::side_index(classes_[place])], plan.face_beyond);
  is_stuck = of_face > 0;
  const bool is_known = b.highest - lib::lowest_of(b) <= lib::kScoreFloor;
  if (is_known && plan.of_normals == 0) return 0;
  float score = score_of(b, classes_[place], agreements_[place], plan);
  const float of_map = lib::map_score(b, plan.map_step, plan.map_most);
  if (!(score > 0) && !(of_map > 0) && !(of_face > 0)) return 0;
  const lib::Bary3 at = corners_of(cell);
  if (!lib::has_quarters(at)) return 0;
  is_stuck = false;
  const float area = lib::share_of_area(weights_[cell.face], plan.of_whole, at);
  const auto is_seen = [&] {
    return area > plan.map_area ||
           lib::is_longer(lib::plain_corners(root_of(cell.face), at), plan.map_length);
  };
  if (of_map > 0 && is_seen()) score += of_map;
  return lib::score_bin(score * area + of_face);
}

std::span<const uint32_t> NativeCells::score(const gpu::SurveyPlan& plan, const CellRange& some) {
  keys_.resize(count());
  counts_.assign(gpu::kScoreBins, 0);
  std::mutex adding;
  in_pieces(some, kCellsOfPiece, threads_, [&](size_t begin, size_t end) {
    std::vector<uint32_t> counts(gpu::kScoreBins, 0);
    for (size_t i = begin; i < end; ++i) {
      bool is_stuck = false;
      keys_[i] = score_one(plan, static_cast<uint32_t>(i), is_stuck);
      counts[keys_[i]] += keys_[i] > 0 || is_stuck ? 1 : 0;
    }
    const std::lock_guard lock(adding);
    for (size_t bin = 0; bin < counts.size(); ++bin) counts_[bin] += counts[bin];
  });
  return counts_;
}

// Lists the cells above the bin in their order, and then those in it.
void NativeCells::list_chosen(const SurveyChoice& choice) {
  parents_.clear();
  for (uint32_t i = 0; i < keys_.size(); ++i) {
    if (keys_[i] > choice.bin) parents_.push_back(i);
  }
  for (uint32_t i = 0; parents_.size() < choice.count(); ++i) {
    if (keys_[i] == choice.bin) parents_.push_back(i);
  }
}

bool NativeCells::split(const SurveyChoice& choice) {
  const size_t before = count(), after = before + (choice.parts - 1) * size_t{choice.count()};
  if (after > most_) return false;
  try {
    list_chosen(choice);
    bounds_.resize(after);
    near_.resize(after);
    classes_.resize(after);
    agreements_.resize(after);
    cells_.resize(after);
  } catch (const std::bad_alloc&) {
    bounds_.resize(before);
    near_.resize(before);
    classes_.resize(before);
    agreements_.resize(before);
    return false;
  }
  parts_ = choice.parts;
  live_ = static_cast<uint32_t>(before);
  in_pieces(parents_.size(), kCellsOfPiece, threads_, [&](size_t begin, size_t end) {
    for (size_t rank = begin; rank < end; ++rank) split_one(static_cast<uint32_t>(rank));
  });
  return true;
}

// The place of a new cell: the first part of a parent is where that was, and the others follow the
// cells that there were.
uint32_t NativeCells::place_of(size_t item) const {
  const size_t rank = item / parts_, part = item % parts_;
  if (part == 0) return parents_[rank];
  return live_ + static_cast<uint32_t>((parts_ - 1) * rank + part - 1);
}

void NativeCells::split_one(uint32_t rank) {
  gpu::Cell cell = cells_[parents_[rank]];
  const lib::Bary3 at = corners_of(cell);
  const uint32_t code = pair_.split(cell, bounds_[parents_[rank]], near_[parents_[rank]]);
  const lib::Bary6 points = lib::split_points(at, code);
  const gpu::CellBounds known = lib::bounds_of_parts(bounds_[parents_[rank]]);
  const native::Nearby near = near_[parents_[rank]];
  const uint32_t of_class = lib::class_of_parts(classes_[parents_[rank]]);
  for (uint32_t k = 0; k < parts_; ++k) {
    const glm::uvec3 part = parts_ == 2 ? lib::half_points(code, k) : lib::child_points(code, k);
    const uint32_t to = place_of(size_t{rank} * parts_ + k);
    set_corners(cell, lib::child_of(points, part));
    cells_[to] = cell;
    bounds_[to] = known;
    near_[to] = near;
    classes_[to] = of_class;
  }
}

// Keeps the cell's highest, which is stored before: no distance over a part of the cell is above
// it.
void NativeCells::bound_one(uint32_t place) {
  gpu::CellBounds b = pair_.bounds(cells_[place], near_[place]);
  b.highest = std::min(b.highest, bounds_[place].highest);
  b.mean_upper = std::min(b.mean_upper, b.highest);
  cells_[place].start = b.triangle;
  bounds_[place] = b;
}

void NativeCells::bound(size_t first, size_t count, bool) {
  in_pieces(count, kBoundedOfPiece, threads_, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) bound_one(place_of(first + i));
  });
  for (size_t i = 0; i < count; ++i) {
    const uint32_t place = place_of(first + i);
    float& of_face = reached_[cells_[place].face];
    of_face = std::max(of_face, bounds_[place].reached);
  }
}

void NativeCells::bound(const CellBatch& batch) const {
  in_pieces(batch.bounds.size(), kBoundedOfPiece, threads_, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      gpu::Cell cell{};
      set_corners(cell, lib::whole_root());
      cell.face = batch.first + static_cast<uint32_t>(i);
      cell.start = gpu::kNone;
      native::Nearby near;
      batch.bounds[i] = pair_.bounds(batch.cells.empty() ? cell : batch.cells[i], near);
    }
  });
}

const gpu::SurveyTable& NativeCells::tally(const gpu::SurveyPlan& plan, int unit,
                                           const CellRange& some_cells) {
  Sums all(plan, unit);
  std::mutex adding;
  in_pieces(some_cells, kCellsOfPiece, threads_, [&](size_t begin, size_t end) {
    Sums some(plan, unit);
    for (size_t i = begin; i < end; ++i) {
      if (lib::is_among(classes_[i], plan.classes))
        some.add(static_cast<uint32_t>(i), cells_[i], weights_[cells_[i].face],
                 {bounds_[i], classes_[i], agreements_[i]});
    }
    const std::lock_guard lock(adding);
    all.add(some);
  });
  all.put(table_);
  return table_;
}

void NativeCells::find_sides(const SideSearch& search, float above, const CellRange& some) {
  const gpu::SurveySidesPush asked{.first = some.first,
                                   .end = some.first + some.count,
                                   .face_count = 0,
                                   .triangle_count = 0,
                                   .above = above,
                                   .near = search.near,
                                   .moved = search.moved,
                                   .is_solid = search.is_solid ? 1u : 0u,
                                   .front = search.front};
  in_pieces(some, kBoundedOfPiece, threads_, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (classes_[i] != gpu::kClassUnseen || !(bounds_[i].highest > above)) continue;
      classes_[i] = pair_.side_class(cells_[i], bounds_[i], asked, search.face_kinds);
    }
  });
}

void NativeCells::find_normals(const CellRange& some) {
  const native::NormalsGiven given{normals_.normals,
                                   {.first = some.first,
                                    .end = some.first + some.count,
                                    .face_count = static_cast<uint32_t>(a_.faces.size()),
                                    .triangle_count = 0,
                                    .moved = normals_.moved,
                                    .limit_down = normals_.limit_down,
                                    .limit_up = normals_.limit_up}};
  in_pieces(some, kBoundedOfPiece, threads_, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (classes_[i] == gpu::kClassCompared) continue;
      agreements_[i] = pair_.agreement(cells_[i], bounds_[i], given);
      classes_[i] = gpu::kClassCompared;
    }
  });
}

std::vector<float> NativeCells::faces(uint32_t reached_classes, uint32_t highest_classes) {
  const size_t count_of_faces = reached_.size();
  std::vector<float> faces(2 * count_of_faces, 0.0f);
  if (reached_classes == gpu::kAllClasses)
    std::copy(reached_.begin(), reached_.end(), faces.begin());
  for (size_t i = 0; i < count(); ++i) {
    float& reached = faces[cells_[i].face];
    float& highest = faces[count_of_faces + cells_[i].face];
    if (lib::is_among(classes_[i], reached_classes))
      reached = std::max(reached, bounds_[i].reached);
    if (lib::is_among(classes_[i], highest_classes))
      highest = std::max(highest, bounds_[i].highest);
  }
  return faces;
}

void NativeCells::write(const CellRange& some, std::span<const gpu::CellBounds> bounds) {
  std::copy(bounds.begin(), bounds.end(), bounds_.begin() + some.first);
  for (uint32_t i = some.first; i < some.first + some.count; ++i) {
    float& of_face = reached_[cells_[i].face];
    of_face = std::max(of_face, bounds_[i].reached);
  }
}

CellsRead NativeCells::read(const CellRange& some) {
  const auto part = [&](const auto& of) { return std::span(of).subspan(some.first, some.count); };
  return {part(cells_), part(bounds_), part(classes_)};
}

}  // namespace vkh
