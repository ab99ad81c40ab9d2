// Open parts of A, and the results of a level.
#pragma once

#include <array>
#include <cstdint>

#include "host/native/problem.h"

namespace vkh::native {

/// A part of a face of A that is not decided yet.
struct Candidate {
  Bary3 at;
  uint32_t face;
  std::array<uint32_t, 3> nearest;  ///< places in the tree of the triangles nearest to its corners
  uint32_t centre;                  ///< the same for its centroid
  double upper;                     ///< u, a bound of d(x, B) over it
};

/// A point of A, and its distance from a triangle of B: the lower bound that steers.
struct Sample {
  double distance = -1;
  uint32_t face = kNone;
  uvec2 at = {0u, 0u};
  uint32_t place = kNone;
};

/// A candidate's split: its code, and the triangles nearest to its three new points.
struct Split {
  uint32_t parent;
  uint32_t code;
  std::array<uint32_t, 3> nearest;
};

/// The bound by which a candidate was closed.
enum Close : uint8_t { kByExact, kByU1, kByU2, kByHa, kByU3, kByRisen, kByPrecision, kCloses };

/// The results of a piece of a level's work; pieces are joined in their order.
struct Gain {
  Sample best = {};
  double largest_closed = 0;
  uint64_t candidates = 0, queries = 0;
  std::array<uint64_t, kCloses> closed{};

  void offer(const Sample& s) {
    if (s.distance > best.distance) best = s;
  }
  void close(double upper, Close by) {
    largest_closed = max(largest_closed, upper);
    ++closed[by];
  }
  void add(const Gain& g) {
    offer(g.best);
    largest_closed = max(largest_closed, g.largest_closed);
    candidates += g.candidates;
    queries += g.queries;
    for (size_t i = 0; i < closed.size(); ++i) closed[i] += g.closed[i];
  }
};

}  // namespace vkh::native
