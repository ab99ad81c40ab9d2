// A torus with noise, of any number of faces, the same bytes on every machine.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "tools/pairs/ply_stream.h"

namespace vkh::pairs {

/// The torus lies around the z axis: the tube's centre runs at distance 1, its radius is 3/8. Each
/// vertex lies off the tube by up to `noise` of that radius, evenly spread. It uses only sums,
/// products and quotients of doubles, which IEEE 754 fixes, and sine and cosine by polynomials of
/// our own.
class NoisyTorus {
 public:
  /// Makes at most `faces`, and as near to it as whole rings come. Throws UsageError for fewer than
  /// 18.
  NoisyTorus(uint64_t faces, uint64_t seed, double noise);

  PlyShape shape() const { return {uint64_t{rings_} * around_, 2 * uint64_t{rings_} * around_}; }
  glm::dvec3 vertex(uint32_t ring, uint32_t place) const;
  void write(const std::string& path) const;

 private:
  uint32_t rings_, around_;
  uint64_t seed_;
  double noise_;
};

/// Sine and cosine of the angle that is turns/of of a full circle.
struct SineCosine {
  double sine, cosine;
};
SineCosine sine_cosine(uint32_t turns, uint32_t of);

}  // namespace vkh::pairs
