#include "host/survey/sides.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "host/base/float128.h"
#include "host/base/rounding.h"
#include "host/mesh/closest.h"
#include "host/survey/cell_corners.h"
#include "host/survey/sets.h"

namespace vkh {
namespace {

constexpr double kRound = 0x1p-53;  // a double operation's rounding, of its result
// Scaling may underflow by 2^-1074 a coordinate, and products of two such coordinates may by as
// much: beside coordinates of under 2^60 all of that is under this.
constexpr double kUnderflow = 0x1p-900;
// The faces that are looked at for one cell, at most: from the centre of a sphere all are closest.
constexpr int kMostFaces = 4096;

double sum_of_sizes(const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

std::vector<glm::dvec3> scaled(const Mesh& mesh, const Frame& frame, bool& is_exact) {
  std::vector<glm::dvec3> vertices;
  vertices.reserve(mesh.vertices.size());
  Frame back;
  back.exponent = -frame.exponent;
  for (const DVec3& v : mesh.vertices) {
    const glm::dvec3 s(frame.to_frame(v.x), frame.to_frame(v.y), frame.to_frame(v.z));
    is_exact = is_exact && back.to_frame(s.x) == v.x && back.to_frame(s.y) == v.y &&
               back.to_frame(s.z) == v.z;
    vertices.push_back(s);
  }
  return vertices;
}

// Barycentrics of a cell's corner as integers with the sum 2^20.
glm::dvec3 weights_of(const glm::uvec2& corner) {
  return {static_cast<double>(gpu::kBaryOne - corner.x - corner.y), static_cast<double>(corner.x),
          static_cast<double>(corner.y)};
}

double farthest(const Corners3& t) {
  double most = 0;
  for (const glm::dvec3& p : t)
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return most;
}

// Each product and each sum of the three terms rounds by kRound of the largest coordinate at most,
// since the weights add up to 2^20; the division rounds nothing. That is 3; 4 are taken.
glm::dvec3 point_at(const Corners3& face, const glm::dvec3& weights) {
  return (face[0] * weights.x + face[1] * weights.y + face[2] * weights.z) * 0x1p-20;
}
double off_at(const Corners3& face) { return 4 * kRound * farthest(face) + kUnderflow; }

// Above the length of v, whose components may be off by kRound of themselves, each: squares, sums
// and the root round by three more.
double length_up(const glm::dvec3& v) {
  return std::sqrt(glm::dot(v, v)) * (1 + 8 * kRound) + kUnderflow;
}

struct FromPoint {
  Corners3 corners;
  double reach = 0;  // at least the largest distance of a corner, but for a few kRound of itself
};
FromPoint seen_from(const glm::dvec3& p, const Corners3& triangle) {
  FromPoint seen;
  for (size_t i = 0; i < 3; ++i) {
    seen.corners[i] = triangle[i] - p;
    seen.reach = std::max(seen.reach, sum_of_sizes(seen.corners[i]));
  }
  return seen;
}

glm::dvec3 nearest_to_origin(const FromPoint& seen) {
  const auto& [a, b, c] = seen.corners;
  return closest_point(glm::dvec3(0), a, b, c).point;
}

// Above the distance of a triangle: the point that was found is one of it but for the rounding of
// its corners, its weights and its sum, under 32 * 2^-52 of the reach as in leaf.cpp.
double distance_above(const FromPoint& seen) {
  return length_up(nearest_to_origin(seen)) + 64 * kRound * seen.reach;
}

// Below the distance of a triangle: with g = q / |q| for any q, no point of it is nearer than its
// least corner along g. Components of g are off by 4 kRound of themselves, of corners by one, and a
// product of three components by 3: under 8 kRound of the reach, by Cauchy; |g| is at most
// 1 + 4 kRound. 16 are taken.
double distance_below(const FromPoint& seen) {
  const glm::dvec3 q = nearest_to_origin(seen);
  const double size = std::sqrt(glm::dot(q, q));
  if (!(size > 1e-140)) return 0;
  const glm::dvec3 g = q / size;
  const double least = std::min(
      {glm::dot(g, seen.corners[0]), glm::dot(g, seen.corners[1]), glm::dot(g, seen.corners[2])});
  return least - 16 * kRound * seen.reach;
}

struct Wide {
  Float128 x = 0, y = 0, z = 0;
  Float128 operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};

template <class Real>
struct Arithmetic;
template <>
struct Arithmetic<double> {
  static constexpr double kRounding = kRound;
  using Vector = glm::dvec3;
  static Vector point(const Corners3& face, const glm::dvec3& weights) {
    return point_at(face, weights);
  }
  static Vector vector(const glm::dvec3& p) { return p; }
};
template <>
struct Arithmetic<Float128> {
  static constexpr double kRounding = 0x1p-113;
  using Vector = Wide;
  static Vector point(const Corners3& face, const glm::dvec3& weights) {
    const auto sum = [&](int i) {
      return (float128(face[0][i]) * float128(weights.x) +
              float128(face[1][i]) * float128(weights.y) +
              float128(face[2][i]) * float128(weights.z)) *
             float128(0x1p-20);
    };
    return {sum(0), sum(1), sum(2)};
  }
  static Vector vector(const glm::dvec3& p) {
    return {float128(p.x), float128(p.y), float128(p.z)};
  }
};

template <class Real>
Real size_of(Real x) {
  return x < 0 ? -x : x;
}

// The sign of (e x f) . (p - s), where it is more than the error, 0 otherwise. With u the rounding:
// components of e, f and p - s are off by u of themselves, and p by `off`. A product of two is off
// by 3 u of itself, their difference by u more, its product with a component of p - s by 2 u, and
// the sum of three by 2 u: under 9 u of the sum of sizes. 16 u are taken, and `off` times the
// sizes of the products, which are known to within 5 u of themselves.
template <class Real, class Vector>
int sign_of_height(const Vector& s, const Vector& t, const Vector& v, const Vector& p, Real off) {
  const Real u = static_cast<Real>(Arithmetic<Real>::kRounding);
  Real sum = 0, error = static_cast<Real>(kUnderflow);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Real left = (t[j] - s[j]) * (v[k] - s[k]), right = (t[k] - s[k]) * (v[j] - s[j]);
    const Real x = p[i] - s[i];
    sum += (left - right) * x;
    error +=
        (size_of(left) + size_of(right)) * (16 * u * size_of(x) + static_cast<Real>(1.001) * off);
  }
  return size_of(sum) > error ? (sum > 0 ? 1 : -1) : 0;
}

}  // namespace

const char* doubt_name(Doubt doubt) {
  switch (doubt) {
    case Doubt::kNone:
      return "none";
    case Doubt::kMeets:
      return "meets";
    case Doubt::kEdge:
      return "edge";
    case Doubt::kDegenerate:
      return "degenerate";
    case Doubt::kTwoSided:
      return "two-sided";
    case Doubt::kMany:
      return "many";
    case Doubt::kEnded:
      return "ended";
  }
  return "";
}

Sides::Sides(const SurveyedPair& pair, GoesOn goes_on)
    : a_(pair.a),
      b_(pair.b),
      frame_(pair.frame),
      displacement_(pair.displacement),
      goes_on_(std::move(goes_on)),
      vertices_(scaled(pair.a, pair.frame, is_exact_)),
      shells_(scaled(pair.b, pair.frame, is_exact_), pair.b.faces, goes_on_) {}

Sides::Placed Sides::placed(const gpu::Cell& cell) const {
  const UVec3& f = a_.faces[cell.face];
  const Corners3 face = {vertices_[f.x], vertices_[f.y], vertices_[f.z]};
  const lib::Bary3 t = corners_of(cell);
  return {{point_at(face, weights_of(t.a)), point_at(face, weights_of(t.b)),
           point_at(face, weights_of(t.c))},
          off_at(face)};
}

// 1 or -1 if all three corners lie on that side of the plane, by more than the error; 0 otherwise.
template <class Real>
int Sides::side_of_plane(const gpu::Cell& cell, const Corners3& plane) const {
  using Of = Arithmetic<Real>;
  const UVec3& f = a_.faces[cell.face];
  const Corners3 face = {vertices_[f.x], vertices_[f.y], vertices_[f.z]};
  const lib::Bary3 t = corners_of(cell);
  const Real off = static_cast<Real>(4 * Of::kRounding * farthest(face) + kUnderflow);
  const auto side = [&](const glm::uvec2& corner) {
    return sign_of_height<Real>(Of::vector(plane[0]), Of::vector(plane[1]), Of::vector(plane[2]),
                                Of::point(face, weights_of(corner)), off);
  };
  const int first = side(t.a);
  return first != 0 && side(t.b) == first && side(t.c) == first ? first : 0;
}

double Sides::distance_up(const glm::dvec3& p, uint32_t hint) const {
  double best = std::numeric_limits<double>::infinity(), best2 = best;
  const auto see = [&](uint32_t face) {
    best = std::min(best, distance_above(seen_from(p, shells_.corners(face))));
    best2 = best * best;
  };
  if (hint < b_.faces.size()) see(hint);
  shells_.tree().nearest_first(p, best2, see);
  return best;
}

// Any point c serves as the centre, with the largest distance r of the cell's corners from it: a
// face that is closest to some point of the cell is no farther from c than d(c, B) + 2 r.
CellSide Sides::by_faces(const gpu::Cell& cell, uint32_t hint) const {
  const Placed at = placed(cell);
  const glm::dvec3 centre = (at.corners[0] + at.corners[1] + at.corners[2]) * (1.0 / 3);
  double radius = 0;
  for (const glm::dvec3& p : at.corners)
    radius = std::max(radius, length_up(p - centre) + 2 * at.off);
  const double reach = (distance_up(centre, hint) + 2 * radius) * (1 + 8 * kRound);
  const double reach2 = reach * reach * (1 + 16 * kRound) + kUnderflow;
  CellSide found;
  int seen = 0;
  const auto look = [&](uint32_t face) {
    const Corners3& plane = shells_.corners(face);
    if (distance_below(seen_from(centre, plane)) > reach) return true;
    int side = 0;
    if (shells_.is_bare(face)) {
      found.doubt = Doubt::kDegenerate;
    } else if (++seen > kMostFaces) {
      found.doubt = Doubt::kMany;
    } else {
      side = side_of_plane<double>(cell, plane);
      if (side == 0) side = side_of_plane<Float128>(cell, plane);
      const bool is_other =
          found.side != SurfaceSide::kUnsigned && found.side != static_cast<SurfaceSide>(side);
      if (side == 0 || is_other) found.doubt = Doubt::kEdge;
    }
    found.side = static_cast<SurfaceSide>(side);
    if (found.doubt == Doubt::kEdge && shells_.is_two_sided(face)) found.doubt = Doubt::kTwoSided;
    return found.doubt == Doubt::kNone;
  };
  const bool is_sure = shells_.tree().walk(
      [&](const TriangleBox& box) { return distance2(centre, box) <= reach2; }, look);
  if (!is_sure) found.side = SurfaceSide::kUnsigned;
  return found;
}

// A point of the cell is known to within `off` a coordinate: where it is farther from B than a few
// of those, the double that stands for it lies in the same part of what is not B.
bool Sides::is_off(const gpu::Cell& cell, const gpu::CellBounds& bounds) const {
  const UVec3& f = a_.faces[cell.face];
  const double off = off_at({vertices_[f.x], vertices_[f.y], vertices_[f.z]});
  return static_cast<double>(lowest(bounds)) * (1 - 4 * kRound) > displacement_ + 32 * off;
}

// The cell has no point in common with B: any point of it tells the side of all. Weighted sums of
// the corners are off by 4 kRound of the largest coordinate beside their own `off`.
CellSide Sides::by_winding(const gpu::Cell& cell) const {
  const Corners3 t = placed(cell).corners;
  for (const glm::dvec3& w :
       {glm::dvec3(0.3391, 0.3187, 0.3422), glm::dvec3(0.2713, 0.4129, 0.3158),
        glm::dvec3(0.5017, 0.2271, 0.2712)}) {
    const std::optional<SurfaceSide> side = shells_.side_of(t[0] * w.x + t[1] * w.y + t[2] * w.z);
    if (side) return {*side, Doubt::kNone};
  }
  return {};
}

CellSide Sides::of(const gpu::Cell& cell, const gpu::CellBounds& bounds) const {
  const bool off = is_off(cell, bounds);
  if (is_shared() && off) {
    const CellSide found = by_winding(cell);
    if (found.side != SurfaceSide::kUnsigned) return found;
  }
  CellSide found = by_faces(cell, bounds.face);
  if (found.doubt == Doubt::kEdge && !off) found.doubt = Doubt::kMeets;
  return found;
}

namespace {

bool is_same(const gpu::uvec4& x, const gpu::uvec4& y) {
  return x.x == y.x && x.y == y.y && x.z == y.z && x.w == y.w;
}

gpu::Cell whole_face(uint32_t face) {
  gpu::Cell cell{};
  set_corners(cell, lib::whole_root());
  cell.face = face;
  return cell;
}

// The faces that several of the named cells are of, but for those that were tried.
std::vector<uint32_t> faces_of_several(const CellStore& cells, const std::vector<size_t>& which,
                                       const std::vector<uint8_t>& is_tried) {
  std::vector<uint32_t> count(is_tried.size()), faces;
  for (const size_t i : which) {
    const uint32_t f = cells.face(i);
    if (++count[f] == 2 && is_tried[f] == 0) faces.push_back(f);
  }
  return faces;
}

// The first face of each set of faces that are joined at corners: of those that are `pure`.
std::vector<uint32_t> first_of_joined(const Mesh& a, const std::vector<uint8_t>& pure) {
  constexpr uint32_t kNoFace = UINT32_MAX;
  std::vector<uint32_t> at_vertex(a.vertices.size(), kNoFace);
  Sets sets(a.faces.size());
  for (uint32_t f = 0; f < a.faces.size(); ++f) {
    if (pure[f] == 0) continue;
    for (const uint32_t v : {a.faces[f].x, a.faces[f].y, a.faces[f].z}) {
      if (at_vertex[v] == kNoFace) at_vertex[v] = f;
      sets.join(at_vertex[v], f);
    }
  }
  std::vector<uint32_t> first(a.faces.size());
  for (uint32_t f = 0; f < first.size(); ++f) first[f] = sets.of(f);
  return first;
}

}  // namespace

bool KnownSides::has(const gpu::Cell& cell, size_t i) const {
  if (i >= cells_.size() || !cells_[i].is_known) return false;
  return cells_[i].side.side != SurfaceSide::kUnsigned || is_same(cells_[i].corners, cell.corners);
}

CellSide KnownSides::of(const gpu::Cell& cell, size_t i) const {
  return has(cell, i) ? cells_[i].side : CellSide{SurfaceSide::kUnsigned, Doubt::kEnded};
}

std::vector<CellSide> KnownSides::of(const CellStore& cells) const {
  std::vector<CellSide> sides(cells.count());
  for (size_t i = 0; i < sides.size(); ++i) sides[i] = of(cells.cell(i), i);
  return sides;
}

std::vector<CellSide> Sides::of(const CellStore& cells) const {
  KnownSides known;
  find(cells, -1, known);
  return known.of(cells);
}

bool Sides::find(const CellStore& cells, double above, KnownSides& known) const {
  known.cells_.resize(cells.count());
  std::vector<size_t> open;
  for (size_t i = 0; i < cells.count(); ++i) {
    const bool is_far = static_cast<double>(cells.bounds(i).highest) > above;
    if (is_far && !known.has(cells.cell(i), i)) open.push_back(i);
  }
  return is_shared() ? find_shared(cells, open, known) : find_alone(cells, open, known);
}

void Sides::look_at(const CellStore& cells, size_t i, KnownSides& known) const {
  const gpu::Cell& cell = cells.cell(i);
  known.cells_[i] = {of(cell, cells.bounds(i)), cell.corners, true};
}

// A face with all its cells off B is connected, and so are faces that share corners: one point of
// each such set tells the side of all. The cells of other faces are told one by one.
bool Sides::find_shared(const CellStore& cells, const std::vector<size_t>& open,
                        KnownSides& known) const {
  std::vector<uint8_t> pure(a_.faces.size(), 1);
  for (size_t i = 0; i < cells.count(); ++i) {
    if (!is_off(cells.cell(i), cells.bounds(i))) pure[cells.face(i)] = 0;
  }
  const std::vector<uint32_t> first = first_of_joined(a_, pure);
  std::vector<uint32_t> wanted;
  for (const size_t i : open) {
    if (pure[cells.face(i)] != 0) wanted.push_back(first[cells.face(i)]);
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::vector<CellSide> of_set(a_.faces.size());
  const bool are_sets_done = each_while(wanted.size(), goes_on_, [&](size_t k) {
    of_set[wanted[k]] = by_winding(whole_face(wanted[k]));
  });
  return are_sets_done && each_while(open.size(), goes_on_, [&](size_t k) {
           const size_t i = open[k];
           const uint32_t f = cells.face(i);
           const bool is_told = pure[f] != 0 && of_set[first[f]].side != SurfaceSide::kUnsigned;
           if (!is_told) return look_at(cells, i, known);
           known.cells_[i] = {of_set[first[f]], cells.cell(i).corners, true};
         });
}

// A face that has a side as a whole gives it to all its cells: it is looked at where it has several
// cells, once.
bool Sides::look_at_faces(const CellStore& cells, const std::vector<size_t>& open,
                          KnownSides& known) const {
  known.faces_.resize(a_.faces.size());
  known.is_tried_.resize(a_.faces.size());
  const std::vector<uint32_t> faces = faces_of_several(cells, open, known.is_tried_);
  return each_while(faces.size(), goes_on_, [&](size_t k) {
    const uint32_t f = faces[k];
    known.faces_[f] = by_faces(whole_face(f), cells.bounds(f).face);
    known.is_tried_[f] = 1;
  });
}

bool Sides::find_alone(const CellStore& cells, const std::vector<size_t>& open,
                       KnownSides& known) const {
  return look_at_faces(cells, open, known) && each_while(open.size(), goes_on_, [&](size_t k) {
           const size_t i = open[k];
           const CellSide& of_face = known.faces_[cells.face(i)];
           if (of_face.side == SurfaceSide::kUnsigned) return look_at(cells, i, known);
           known.cells_[i] = {of_face, cells.cell(i).corners, true};
         });
}

// No point of a box is nearer than its distance, which is off by 8 kRound of itself at most; below
// it no face in it is.
double Sides::distance_down(const glm::dvec3& p, uint32_t hint) const {
  double best = std::numeric_limits<double>::infinity(), best2 = best;
  const auto see = [&](uint32_t face) {
    best = std::min(best, std::max(distance_below(seen_from(p, shells_.corners(face))), 0.0));
    best2 = best * best;
  };
  if (hint < b_.faces.size()) see(hint);
  shells_.tree().nearest_first(p, best2, see);
  return std::max(best * (1 - 16 * kRound) - kUnderflow, 0.0);
}

// The corner lies within 2 `off` of the double that stands for it, which is more than sqrt(3) off.
// Sides are of the meshes as they are held, and so is this distance: the deltas are taken off.
SidedPoint Sides::farthest_corner(const gpu::Cell& cell, uint32_t hint) const {
  const Placed at = placed(cell);
  const lib::Bary3 weights = corners_of(cell);
  const std::array<glm::dvec3, 3> of_corners = {weights_of(weights.a), weights_of(weights.b),
                                                weights_of(weights.c)};
  Frame back;
  back.exponent = -frame_.exponent;
  const double delta = add_up(a_.delta, b_.delta);
  SidedPoint best;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3& p = at.corners[i];
    const double down = add_down(distance_down(p, hint), -2 * at.off);
    const double lower = std::max(add_down(frame_.length_down(std::max(down, 0.0)), -delta), 0.0);
    if (i > 0 && lower <= best.lower) continue;
    best.lower = lower;
    best.at.set_face(a_, cell.face);
    best.at.barycentric = of_corners[i] * 0x1p-20;
    best.at.point = {back.to_frame(p.x), back.to_frame(p.y), back.to_frame(p.z)};
  }
  return best;
}

}  // namespace vkh
