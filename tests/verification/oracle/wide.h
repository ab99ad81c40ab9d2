// Vectors of 64-bit floats, for error terms of 24 and of 44 bits.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace vkh::test {

using Wide = long double;

struct WideVector {
  Wide x = 0, y = 0, z = 0;
};
inline WideVector operator-(const WideVector& a, const WideVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline WideVector operator+(const WideVector& a, const WideVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline WideVector operator*(Wide s, const WideVector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Wide dot(const WideVector& a, const WideVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Wide size(const WideVector& a) { return std::sqrt(dot(a, a)); }

/// The distance of p from the segment ab.
inline Wide from_edge(const WideVector& p, const WideVector& a, const WideVector& b) {
  const WideVector ab = b - a;
  const Wide length2 = dot(ab, ab);
  const Wide t = length2 > 0 ? std::clamp<Wide>(dot(p - a, ab) / length2, 0, 1) : Wide{0};
  return size(p - a - t * ab);
}
/// The distance of p from a triangle: if its foot in the plane is inside, the plane's; otherwise an
/// edge's.
inline Wide distance(const WideVector& p, const std::array<WideVector, 3>& t) {
  const Wide edges =
      std::min({from_edge(p, t[0], t[1]), from_edge(p, t[1], t[2]), from_edge(p, t[2], t[0])});
  const WideVector ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const Wide bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
  const Wide det = bb * cc - bc * bc;
  if (!(det > 0)) return edges;
  const Wide v = (cc * dot(ap, ab) - bc * dot(ap, ac)) / det;
  const Wide w = (bb * dot(ap, ac) - bc * dot(ap, ab)) / det;
  return v >= 0 && w >= 0 && v + w <= 1 ? std::min(edges, size(ap - v * ab - w * ac)) : edges;
}

}  // namespace vkh::test
