#include "host/survey/normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace vkh {
namespace {

std::vector<glm::dvec3> scaled_of(const Mesh& mesh, const Frame& frame) {
  bool is_exact = true;
  return scaled(mesh, frame, is_exact);
}

std::vector<Corners3> corners_of_faces(const Mesh& mesh, const std::vector<glm::dvec3>& vertices) {
  std::vector<Corners3> faces;
  faces.reserve(mesh.faces.size());
  for (const UVec3& f : mesh.faces) faces.push_back({vertices[f.x], vertices[f.y], vertices[f.z]});
  return faces;
}

std::vector<uint32_t> numbers_below(size_t count) {
  std::vector<uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

std::vector<UnitNormal> normals_of(const std::vector<Corners3>& faces) {
  std::vector<UnitNormal> normals(faces.size());
  for (size_t i = 0; i < faces.size(); ++i) normals[i] = unit_normal(faces[i]);
  return normals;
}

}  // namespace

// The product is off by E = 16 kRound |e| |f| (statistics.cpp), and by what underflows. With n the
// exact one and m the computed one, n / |n| and m / |m| differ by E / |m| twice: by the vector, and
// by its length. Quotients and the length round by 4 kRound more.
UnitNormal unit_normal(const Corners3& face) {
  constexpr double kLeast = 1e-140;
  const glm::dvec3 e = face[1] - face[0], f = face[2] - face[0];
  const glm::dvec3 product = glm::cross(e, f);
  const double length = glm::length(product);
  const double error = 1.01 * 16 * kRound * glm::length(e) * glm::length(f) + kUnderflow;
  if (!(length > std::max(4 * error, kLeast))) return {};
  return {product / length, 1.01 * 2 * error / length + 4 * kRound};
}

// The sum of three products of numbers of at most 1 rounds by less than 8 kRound.
Enclosure cosine_of(const UnitNormal& x, const UnitNormal& y) {
  if (x.off >= 1 || y.off >= 1) return {0, 1};
  const double cosine = std::abs(glm::dot(x.along, y.along));
  const double off = 1.01 * (x.off + y.off + 8 * kRound);
  return {std::clamp(cosine - off, 0.0, 1.0), std::clamp(cosine + off, 0.0, 1.0)};
}

// pi and the product round by 3 kRound of less than 1.6, the cosine by an ulp: 2^-50 is more.
// Normals of any angle agree to 90 degrees, and to 0 only equal ones may.
Enclosure cosine_of_degrees(double degrees) {
  if (degrees >= 90) return {0, 0};
  const double cosine = std::cos(degrees * (std::numbers::pi / 180));
  return {std::max(cosine - 0x1p-50, 0.0), std::min(cosine + 0x1p-50, 1.0)};
}

namespace {

// The signs of (p - from).along at all corners p of a cell, less the errors: whether each is
// positive. Differences are off by kRound of themselves and p by `off`; products and their sum by
// 3 kRound more.
bool is_ahead(const PlacedCell& at, const glm::dvec3& from, const glm::dvec3& along) {
  return std::all_of(at.corners.begin(), at.corners.end(), [&](const glm::dvec3& p) {
    const glm::dvec3 d = p - from;
    const double size = std::abs(d.x * along.x) + std::abs(d.y * along.y) + std::abs(d.z * along.z);
    const double error = 8 * kRound * size + 1.01 * at.off * sum_of_sizes(along) + kUnderflow;
    return glm::dot(d, along) > error;
  });
}

// Whether all corners of a cell lie beyond the edge from s to t, seen from v, in the plane of the
// three. With e = t - s, f = v - s the outward direction is e x (e x f): e x f is off by 16 kRound
// |e| |f|, the second product by 16 kRound |e| |e x f| more, so all of it by 32 kRound |e|^2 |f|,
// and its product with p - s by as much and 8 kRound more. 64 are taken. Lengths are sums of sizes:
// squares of lengths under 1e-160 underflow. |e|^2 may, since all of it is then under kUnderflow.
bool is_beyond(const PlacedCell& at, const glm::dvec3& s, const glm::dvec3& t,
               const glm::dvec3& v) {
  const glm::dvec3 e = t - s, f = v - s;
  const glm::dvec3 outward = glm::cross(e, glm::cross(e, f));
  const double size = glm::dot(e, e) * sum_of_sizes(f);
  return std::all_of(at.corners.begin(), at.corners.end(), [&](const glm::dvec3& p) {
    const glm::dvec3 d = p - s;
    const double error = (64 * kRound * sum_of_sizes(d) + 2 * at.off) * size + kUnderflow;
    return glm::dot(d, outward) > error;
  });
}

}  // namespace

// At a corner: where all points of the triangle lie behind it. On an edge: where a point's foot on
// its line lies within the edge, and the triangle on the other side of the line.
std::array<bool, 3> closest_feature(const PlacedCell& at, const Corners3& triangle) {
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const glm::dvec3 &s = triangle[i], &t = triangle[j], &v = triangle[k];
    if (is_ahead(at, s, s - t) && is_ahead(at, s, s - v)) return {i == 0, i == 1, i == 2};
    if (is_ahead(at, s, t - s) && is_ahead(at, t, s - t) && is_beyond(at, s, t, v))
      return {k != 0, k != 1, k != 2};
  }
  return {};
}

// As distance_below(): with g = q / |q| for any q the triangle's least corner along g is at least
// so far from the cell's farthest. Both products are off by 8 kRound of their lengths, a corner of
// the cell by sqrt(3) `off`, and |g| is at most 1 + 4 kRound.
double separation(const PlacedCell& at, const glm::dvec3& centre, const Corners3& triangle) {
  const FromPoint seen = seen_from(centre, triangle), own = seen_from(centre, at.corners);
  const glm::dvec3 q = nearest_to_origin(seen);
  const double size = std::sqrt(glm::dot(q, q));
  if (!(size > 1e-140)) return 0;
  const glm::dvec3 g = q / size;
  const auto along = [&](const glm::dvec3& p) { return glm::dot(g, p); };
  const double least =
      std::min({along(seen.corners[0]), along(seen.corners[1]), along(seen.corners[2])});
  const double most =
      std::max({along(own.corners[0]), along(own.corners[1]), along(own.corners[2])});
  const double error = 16 * kRound * (seen.reach + own.reach) + 2 * at.off;
  return std::max(least - most - error, 0.0) * (1 - 8 * kRound);
}

Normals::Normals(const SurveyedPair& pair)
    : a_(pair.a),
      b_(pair.b),
      displacement_(pair.displacement),
      vertices_(scaled_of(pair.a, pair.frame)),
      faces_(corners_of_faces(pair.b, scaled_of(pair.b, pair.frame))),
      tree_(faces_, numbers_below(faces_.size())),
      normals_of_a_(normals_of(corners_of_faces(pair.a, vertices_))),
      normals_of_b_(normals_of(faces_)) {}

Corners3 Normals::corners_of_a(uint32_t face) const {
  const UVec3& f = a_.faces[face];
  return {vertices_[f.x], vertices_[f.y], vertices_[f.z]};
}

double Normals::distance_up(const glm::dvec3& p, uint32_t hint) const {
  double best = std::numeric_limits<double>::infinity(), best2 = best;
  const auto see = [&](uint32_t face) {
    best = std::min(best, distance_above(seen_from(p, faces_[face])));
    best2 = best * best;
  };
  if (hint < faces_.size()) see(hint);
  tree_.nearest_first(p, best2, see);
  return best;
}

// Finds all faces that may be closest somewhere on the cell. Returns whether they are few enough to
// look at. No point of the cell is farther from B than `most`, and so from its closest face.
bool Normals::find_near(const gpu::Cell& cell, const gpu::CellBounds& bounds,
                        std::vector<NearFace>& found) const {
  constexpr size_t kMostFaces = 128;
  const PlacedCell at = placed_cell(corners_of_a(cell.face), cell);
  const CellBall ball =
      ball_of(at, [&](const glm::dvec3& p) { return distance_up(p, bounds.face); });
  const double most = (static_cast<double>(bounds.highest) + displacement_) * (1 + 8 * kRound);
  const auto look = [&](uint32_t face) {
    const Corners3& triangle = faces_[face];
    if (!ball.may_hold(triangle) || separation(at, ball.centre, triangle) > most) return true;
    found.push_back({face, cosine_of(normals_of_a_[cell.face], normals_of_b_[face])});
    return found.size() <= kMostFaces;
  };
  return tree_.walk([&](const TriangleBox& box) { return ball.may_hold(box); }, look);
}

// Whether a face of B has all those corners of another one, as they were given: scaling may lay two
// subnormal coordinates on one.
bool Normals::has_corners(uint32_t face, const std::array<bool, 3>& which, uint32_t of) const {
  const auto corner = [&](uint32_t f, int i) { return glm::dvec3(b_.vertices[b_.faces[f][i]]); };
  const Corners3 own{corner(face, 0), corner(face, 1), corner(face, 2)};
  for (int i = 0; i < 3; ++i) {
    const bool is_asked = which[static_cast<size_t>(i)];
    if (is_asked && std::find(own.begin(), own.end(), corner(of, i)) == own.end()) return false;
  }
  return true;
}

// Where a face is closest, so is each face that has the corner or the edge on which its closest
// point lies.
double Normals::excused(const PlacedCell& at, const NearFace& one,
                        const std::vector<NearFace>& all) const {
  double best = one.cosine.lower;
  const std::array<bool, 3> feature = closest_feature(at, faces_[one.face]);
  if (feature == std::array<bool, 3>{}) return best;
  for (const NearFace& other : all) {
    if (other.cosine.lower > best && has_corners(other.face, feature, one.face))
      best = other.cosine.lower;
  }
  return best;
}

Enclosure Normals::of(const gpu::Cell& cell, const gpu::CellBounds& bounds) const {
  constexpr double kNarrow = 1e-3;
  std::vector<NearFace> near;
  if (!find_near(cell, bounds, near) || near.empty()) return {0, 1};
  Enclosure cosine{1, 0};
  for (const NearFace& one : near) cosine.upper = std::max(cosine.upper, one.cosine.upper);
  const PlacedCell at = placed_cell(corners_of_a(cell.face), cell);
  for (const NearFace& one : near) {
    const bool is_far = one.cosine.lower < cosine.upper - kNarrow;
    cosine.lower = std::min(cosine.lower, is_far ? excused(at, one, near) : one.cosine.lower);
  }
  return cosine;
}

double Normals::likely(const gpu::Cell& cell, uint32_t face) const {
  if (face >= normals_of_b_.size()) return 0;
  return std::min(std::abs(glm::dot(normals_of_a_[cell.face].along, normals_of_b_[face].along)),
                  1.0);
}

NormalCells::NormalCells(const SurveyedPair& pair, const SurveyOptions& options, const Areas& areas,
                         GoesOn goes_on)
    : pair_(pair),
      options_(options),
      areas_(areas),
      goes_on_(std::move(goes_on)),
      normals_(pair),
      limit_(cosine_of_degrees(*options.normals_within)) {}

// A cell that is as narrow as it is to be keeps its cosine when it is split; the other half is
// looked at.
bool NormalCells::look_at(const CellStore& cells) {
  known_.resize(cells.count());
  std::vector<size_t> open;
  for (size_t i = 0; i < cells.count(); ++i) {
    const gpu::uvec4 &now = cells.cell(i).corners, &then = known_[i].corners;
    const bool is_same = now.x == then.x && now.y == then.y && now.z == then.z && now.w == then.w;
    if (!known_[i].is_known || !is_same) open.push_back(i);
  }
  return each_while(open.size(), goes_on_, [&](size_t k) {
    const gpu::Cell& cell = cells.cell(open[k]);
    known_[open[k]] = {normals_.of(cell, cells.bounds(open[k])), cell.corners, true};
  });
}

// All of what is within agrees, or nothing of it, or that is not known.
Enclosure NormalCells::agreeing(const CellStore& cells, size_t i, const Threshold& at) const {
  const Enclosure share = share_within(cells, i, at), &cosine = known_[i].cosine;
  return {cosine.lower >= limit_.upper ? share.lower : 0,
          cosine.upper >= limit_.lower ? share.upper : 0};
}

Enclosure NormalCells::mean(const CellStore& cells) const {
  return mean_over(cells, areas_, [&](size_t i) { return known_[i].cosine; });
}

namespace {

double area_of_cell(const CellStore& cells, const Areas& areas, size_t i) {
  return cells.share(i) * areas.of_face[cells.face(i)];
}

double width_of_part(const Enclosure& e) { return e.upper - e.lower; }

}  // namespace

Scores NormalCells::score_shares(const CellStore& cells) {
  if (!look_at(cells)) return {};
  std::vector<Threshold> open;
  double part = 0;
  for (const double band : options_.bands) {
    const Threshold at = threshold_at(pair_.frame, pair_.displacement, band);
    const double width =
        width_of_part(mean_over(cells, areas_, [&](size_t i) { return agreeing(cells, i, at); }));
    if (width <= options_.agreeing_tolerance) continue;
    open.push_back(at);
    part = std::max(part, part_to_split(width, options_.agreeing_tolerance));
  }
  if (open.empty()) return {{}, true};
  Scores scores = scored(cells, [&](size_t i) -> std::optional<double> {
    double width = 0;
    for (const Threshold& at : open) width += width_of_part(agreeing(cells, i, at));
    return width * area_of_cell(cells, areas_, i);
  });
  scores.part = part;
  return scores;
}

Scores NormalCells::score_mean(const CellStore& cells) {
  if (!look_at(cells)) return {};
  const double width = width_of_part(mean(cells));
  if (width <= options_.cosine_tolerance) return {{}, true};
  Scores scores = scored(cells, [&](size_t i) -> std::optional<double> {
    return width_of_part(known_[i].cosine) * area_of_cell(cells, areas_, i);
  });
  scores.part = part_to_split(width, options_.cosine_tolerance);
  return scores;
}

void NormalCells::add_goals(std::vector<Goal>& goals) {
  if (std::isfinite(options_.agreeing_tolerance) && !options_.bands.empty())
    goals.emplace_back([this](const CellStore& cells) { return score_shares(cells); });
  if (std::isfinite(options_.cosine_tolerance))
    goals.emplace_back([this](const CellStore& cells) { return score_mean(cells); });
}

namespace {

void put_estimate(const Enclosure& likely, Enclosure& e) {
  e.estimate = std::clamp((likely.lower + likely.upper) / 2, e.lower, e.upper);
}

// The part of a cell within a distance, by the affine function of its corners' estimates.
double likely_share(const CellEstimate& e, double distance) {
  return share_within(e.corners[0], e.corners[1], e.corners[2], distance);
}

}  // namespace

// An estimate takes the face of B that is closest to the cell's middle for all of it.
void NormalCells::add_figures(const CellStore& cells, const Estimates& estimates,
                              Statistics& statistics) {
  look_at(cells);
  const auto likely = [&](size_t i) {
    const Enclosure& known = known_[i].cosine;
    return std::clamp(normals_.likely(cells.cell(i), cells.bounds(i).face), known.lower,
                      known.upper);
  };
  const auto likely_mean = [&](const auto& value) {
    return mean_over(cells, areas_, [&](size_t i) { return Enclosure{value(i), value(i)}; });
  };
  Enclosure& cosine = statistics.normal_cosine.emplace(mean(cells));
  put_estimate(likely_mean(likely), cosine);
  for (AreaWithin& band : statistics.bands) {
    const Threshold at = threshold_at(pair_.frame, pair_.displacement, band.distance);
    const double distance = pair_.frame.to_frame(band.distance);
    Enclosure& share = band.agreeing.emplace(
        mean_over(cells, areas_, [&](size_t i) { return agreeing(cells, i, at); }));
    put_estimate(likely_mean([&](size_t i) {
                   return likely(i) >= limit_.lower ? likely_share(estimates.of(i), distance) : 0.0;
                 }),
                 share);
  }
}

}  // namespace vkh
