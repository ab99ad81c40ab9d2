// Hill climbing against a target: inputs and the direction of every single rounding are bent, bit
// by bit, to the point where its bound has the least margin.
#pragma once

#include <bit>

#include "tests/verification/model/attack_targets.h"

namespace vkh::test {

struct Genome {
  std::vector<float> inputs;
  std::array<uint64_t, 8> directions{};
};

inline Genome first(Random& random, size_t inputs) {
  Genome g;
  const int smallest[] = {-1, -12, -30};
  const int lo = smallest[random.below(3)];
  for (size_t i = 0; i < inputs; ++i) g.inputs.push_back(hard_float(random, lo, 0));
  for (uint64_t& word : g.directions) word = random.below(4) == 0 ? 0 : random.bits();
  return g;
}

inline Genome changed(Random& random, Genome g) {
  for (uint32_t i = 1 + random.below(2); i > 0; --i) {
    if (random.below(2) == 0) {
      const uint32_t bit = random.below(512);
      g.directions[bit / 64] ^= uint64_t{1} << (bit % 64) % (random.below(3) == 0 ? 64 : 24);
      continue;
    }
    float& x = g.inputs[random.below(static_cast<uint32_t>(g.inputs.size()))];
    switch (random.below(5)) {
      case 0:
        x = hard_float(random, random.below(2) == 0 ? -2 : -40, 0);
        break;
      case 1:
        x = -x;
        break;
      case 2:
        x = std::nextafter(x, random.below(2) == 0 ? 2.0f : -2.0f);
        break;
      default:
        x = std::bit_cast<float>(std::bit_cast<uint32_t>(x) ^ 1u << random.below(24));
    }
    if (!(std::abs(x) < 2.0f) || std::abs(x) < 0x1p-42f) x = 0.5f;
  }
  return g;
}

inline Wide try_it(const Target& target, const Genome& g) {
  model::whim = {model::Direction::kScript, false, 1, g.directions, 0};
  Inputs in(g.inputs);
  return target.excess(in);
}

inline Wide climb(const Target& target, Random& random, uint64_t steps) {
  Genome at = first(random, target.inputs);
  Wide height = try_it(target, at);
  for (uint64_t i = 0; i < steps; ++i) {
    Genome next = changed(random, at);
    const Wide there = try_it(target, next);
    if (there < height) continue;
    height = there;
    at = std::move(next);
  }
  return height;
}

}  // namespace vkh::test
