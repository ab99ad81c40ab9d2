#include "host/survey/sides.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "host/base/float128.h"
#include "host/base/rounding.h"
#include "host/survey/measured.h"
#include "host/survey/sets.h"

namespace vkh {
namespace {

// The faces that are looked at for one cell, at most: from the centre of a sphere all are closest.
constexpr int kMostFaces = 4096;

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

PlacedCell Sides::placed(const gpu::Cell& cell) const {
  const UVec3& f = a_.faces[cell.face];
  return placed_cell({vertices_[f.x], vertices_[f.y], vertices_[f.z]}, cell);
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
  return distance_above(
      p, shells_.tree(), static_cast<uint32_t>(b_.faces.size()),
      [&](uint32_t face) { return shells_.corners(face); }, hint);
}

CellSide Sides::by_faces(const gpu::Cell& cell, uint32_t hint) const {
  const CellBall ball =
      ball_of(placed(cell), [&](const glm::dvec3& p) { return distance_up(p, hint); });
  CellSide found;
  int seen = 0;
  const auto look = [&](uint32_t face) {
    const Corners3& plane = shells_.corners(face);
    if (!ball.may_hold(plane)) return true;
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
  const bool is_sure =
      shells_.tree().walk([&](const TriangleBox& box) { return ball.may_hold(box); }, look);
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

double Sides::distance_down(const glm::dvec3& p, uint32_t hint) const {
  return distance_below(
      p, shells_.tree(), static_cast<uint32_t>(b_.faces.size()),
      [&](uint32_t face) { return shells_.corners(face); }, hint);
}

// The corner lies within 2 `off` of the double that stands for it, which is more than sqrt(3) off.
// Sides are of the meshes as they are held, and so is this distance: the deltas are taken off.
SidedPoint Sides::farthest_corner(const gpu::Cell& cell, uint32_t hint) const {
  const PlacedCell at = placed(cell);
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
