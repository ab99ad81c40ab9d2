// 113-bit arithmetic: exact enough to check a certificate of 24 or 48 bits with room to spare. It
// is the compiler's own (libgcc), no library; the exponents hold every product of four doubles.
#pragma once

#include <cfloat>
#include <glm/vec3.hpp>

namespace vkh {

#if LDBL_MANT_DIG == 113
using Float128 = long double;
#elif defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Float128;
#else
#error "no arithmetic of 113 bits here (MSVC, Apple's clang): see docs/platforms.md"
#endif

struct Float128Vector {
  Float128 x = 0, y = 0, z = 0;
};

inline Float128 float128(double x) { return static_cast<Float128>(x); }
inline Float128Vector float128(const glm::dvec3& p) {
  return {float128(p.x), float128(p.y), float128(p.z)};
}

inline Float128Vector operator+(const Float128Vector& a, const Float128Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Float128Vector operator-(const Float128Vector& a, const Float128Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Float128Vector operator*(Float128 s, const Float128Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Float128 dot(const Float128Vector& a, const Float128Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Float128Vector cross(const Float128Vector& a, const Float128Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Float128 magnitude(Float128 x) { return x < 0 ? -x : x; }
inline Float128 magnitude(const Float128Vector& a) {  ///< magnitude of the largest coordinate
  const Float128 x = magnitude(a.x), y = magnitude(a.y), z = magnitude(a.z);
  return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

}  // namespace vkh
