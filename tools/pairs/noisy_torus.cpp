#include "tools/pairs/noisy_torus.h"

#include <array>
#include <utility>

#include "vkhausdorff/error.h"

namespace vkh::pairs {
namespace {

// SplitMix64's finalizer (Steele, Lea, Flood 2014): integers only.
uint64_t mixed(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// A number in [-1, 1), a multiple of 2^-31.
double noise_at(uint64_t seed, uint64_t vertex) {
  const auto bits = static_cast<uint32_t>(mixed(mixed(seed) ^ vertex) >> 32);
  return static_cast<double>(static_cast<int64_t>(bits) - (int64_t{1} << 31)) * 0x1p-31;
}

// Taylor's series, for x^2 <= (pi/4)^2: the remainder is below 2^-53 of the result.
double series(double first, double x2, uint32_t from) {
  constexpr uint32_t kTerms = 9;
  double sum = 0;
  for (uint32_t i = kTerms; i > 0; --i) {
    const uint32_t n = from + 2 * i;
    sum = -(x2 / static_cast<double>(n * (n - 1))) * (1 + sum);
  }
  return first * (1 + sum);
}

uint64_t root_of(uint64_t x) {
  uint64_t root = 0;
  for (uint64_t bit = uint64_t{1} << 31; bit > 0; bit >>= 1) {
    if ((root + bit) * (root + bit) <= x) root += bit;
  }
  return root;
}

}  // namespace

SineCosine sine_cosine(uint32_t turns, uint32_t of) {
  const uint64_t eighths = uint64_t{8} * turns;
  const auto octant = static_cast<uint32_t>(eighths / of % 8);
  uint64_t rest = eighths % of;
  if (octant % 2 == 1) rest = of - rest;  // back from the next multiple of a quarter
  const double angle = static_cast<double>(rest) / static_cast<double>(of) * 0x1.921fb54442d18p-1;
  SineCosine out = {series(angle, angle * angle, 1), series(1, angle * angle, 0)};
  if ((octant + 1) % 4 >= 2) std::swap(out.sine, out.cosine);
  if (octant >= 4) out.sine = -out.sine;
  if (octant >= 2 && octant < 6) out.cosine = -out.cosine;
  return out;
}

NoisyTorus::NoisyTorus(uint64_t faces, uint64_t seed, double noise) : seed_(seed), noise_(noise) {
  constexpr uint64_t kMostFaces = uint64_t{1} << 32;
  if (faces < 18 || faces >= kMostFaces) {
    throw UsageError("--faces " + std::to_string(faces) +
                     ": expected 18 or more and fewer than 2^32");
  }
  around_ = static_cast<uint32_t>(root_of(faces / 4));
  if (around_ < 3) around_ = 3;
  rings_ = static_cast<uint32_t>(faces / 2 / around_);
}

glm::dvec3 NoisyTorus::vertex(uint32_t ring, uint32_t place) const {
  constexpr double kTube = 0.375;
  const SineCosine along = sine_cosine(ring, rings_), across = sine_cosine(place, around_);
  const uint64_t number = uint64_t{ring} * around_ + place;
  const double radius = kTube * (1 + noise_ * noise_at(seed_, number));
  const double from_axis = 1 + radius * across.cosine;
  return {from_axis * along.cosine, from_axis * along.sine, radius * across.sine};
}

void NoisyTorus::write(const std::string& path) const {
  PlyStream out(path, shape());
  for (uint32_t ring = 0; ring < rings_; ++ring) {
    for (uint32_t place = 0; place < around_; ++place) out.add_vertex(vertex(ring, place));
  }
  const auto index = [&](uint32_t ring, uint32_t place) {
    return ring % rings_ * around_ + place % around_;
  };
  for (uint32_t ring = 0; ring < rings_; ++ring) {
    for (uint32_t place = 0; place < around_; ++place) {
      const uint32_t i = index(ring, place), j = index(ring + 1, place);
      const uint32_t k = index(ring + 1, place + 1), l = index(ring, place + 1);
      out.add_face(i, j, k);
      out.add_face(i, k, l);
    }
  }
  out.finish();
}

}  // namespace vkh::pairs
