// Inputs on which float32 geometry goes wrong: needles, caps, collapsed triangles, points on them
// and on the borders between their regions, tiny triangles far from the origin, ties.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tests/shapes/shapes.h"

namespace vkh::test {

/// A point as the device holds it: two floats per coordinate, whose sum fits a double exactly.
struct Stored {
  glm::vec3 hi{}, lo{};
  glm::dvec3 value() const { return glm::dvec3(hi) + glm::dvec3(lo); }
};
/// The point rounded to 48 bits per coordinate.
Stored stored(const glm::dvec3& p);
/// The point rounded to float32.
Stored stored_single(const glm::dvec3& p);

struct StoredTriangle {
  std::array<Stored, 3> corner;
  glm::dvec3 at(uint32_t i) const { return corner[i % 3].value(); }
};

enum class Shape {
  kAny,        ///< corners anywhere in the cube
  kSmall,      ///< of any size down to 2^-24, anywhere
  kNeedle,     ///< one short edge
  kCap,        ///< a corner close to the opposite edge, or beyond an end of it
  kGrid,       ///< corners on a coarse grid: right angles, equal edges, ties
  kFewUlps,    ///< corners a few ulps apart
  kLowParts,   ///< high parts equal or an ulp apart; the low parts make the shape
  kCollinear,  ///< exactly, or up to rounding
  kSegment,    ///< two corners coincide
  kPoint,      ///< all three do
  kCount
};

/// A triangle in [-1, 1]^3, of a shape drawn evenly.
StoredTriangle hard_triangle(Random& random);
StoredTriangle hard_triangle(Random& random, Shape shape);
/// A triangle near `about`, within about `size` of it: a neighbour of another triangle.
StoredTriangle hard_triangle_near(Random& random, const glm::dvec3& about, double size);

/// A point in a random position to t: on it, on its border, above these by 2^-1..2^-45, outside a
/// corner or an edge, at a corner, or anywhere in the cube.
glm::dvec3 hard_point(Random& random, const StoredTriangle& t);

/// A base for distances from t: 0, next to p's distance, or anything.
float hard_base(Random& random, const StoredTriangle& t, const glm::dvec3& p);

/// Barycentrics of a point of the closed triangle, often on its border.
glm::dvec3 barycentrics(Random& random);
glm::dvec3 on_triangle(const StoredTriangle& t, const glm::dvec3& weights);

/// A sign, any mantissa (often all ones, a power of two, or a tie of a 12-bit half) and an exponent
/// in [lo, hi].
float hard_float(Random& random, int lo, int hi);
/// 2^x for x uniform in [lo, hi).
double log_uniform(Random& random, double lo, double hi);
/// A low part for x, below an ulp of it; most below half an ulp, often next to it, often 0.
float low_part(Random& random, float x);
/// Three of those, of one scale or of many.
Stored hard_vector(Random& random, int lo, int hi);

/// The smallest float >= x.
float float_up(double x);
/// >= |p|, by a double's rounding at most.
float length_up(const Stored& p);

}  // namespace vkh::test
