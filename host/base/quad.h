// 113-bit arithmetic: exact enough to check a certificate of 24 or 48 bits with room to spare. The
// compiler's own (libgcc), no library; the exponents hold every product of four doubles.
#pragma once

#include <cfloat>
#include <glm/vec3.hpp>

namespace vkh {

#if LDBL_MANT_DIG == 113
using Quad = long double;
#elif defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Quad;
#else
#error "no arithmetic of 113 bits here (MSVC, Apple's clang): see docs/platforms.md"
#endif

struct QuadVector {
  Quad x = 0, y = 0, z = 0;
};

inline Quad quad(double x) { return static_cast<Quad>(x); }
inline QuadVector quad(const glm::dvec3& p) { return {quad(p.x), quad(p.y), quad(p.z)}; }

inline QuadVector operator+(const QuadVector& a, const QuadVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline QuadVector operator-(const QuadVector& a, const QuadVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline QuadVector operator*(Quad s, const QuadVector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Quad dot(const QuadVector& a, const QuadVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline QuadVector cross(const QuadVector& a, const QuadVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Quad magnitude(Quad x) { return x < 0 ? -x : x; }
inline Quad magnitude(const QuadVector& a) {  ///< of the largest coordinate
  const Quad x = magnitude(a.x), y = magnitude(a.y), z = magnitude(a.z);
  return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

}  // namespace vkh
