// Checks whether a certificate proves its claim.
#pragma once

#include <functional>
#include <mutex>

#include "check/certificate.h"
#include "check/exact.h"
#include "check/placing.h"
#include "host/base/parallel.h"
#include "vkhausdorff/mesh.h"

namespace vkh::check {

/// The certificate is well formed, but does not prove its claim.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The inputs for the proof of a direction, from X to Y. All coordinates are integers times
/// 2^unit / scale, where `scale` is the product of both meshes' denominators.
struct Question {
  const std::vector<unsigned char>& file;
  const Direction& claim;
  const PlacedMesh &x, &y;
  int unit;
  const Z& scale;
  size_t threads;
  std::function<void()> face_done;  ///< called by all threads

  std::array<Point, 3> corners_of_x(uint64_t face) const {
    return x.corners(face, unit, y.denominator());
  }
  std::array<Point, 3> corners_of_y(uint64_t face) const {
    return y.corners(face, unit, x.denominator());
  }
};

/// A part of a face. Its corners are multiplied by 2^depth, so that they stay integers.
struct Part {
  std::array<Point, 3> corner;
  unsigned depth;
};

/// Measures the leaves of a block.
class Leaves {
 public:
  Leaves(const Question& question, const Fraction& limit) : q_(question), limit_(limit) {}

  Fraction largest;

  void face(uint64_t face) {
    q_.face_done();
    face_ = face, leaf_ = 0;
    parts_ = {{q_.corners_of_x(face), 0}};
  }

  /// Visits, with m the middle of j and k, first the part of i, j, m and then that of i, m, k.
  void halve(size_t i) {
    const Part whole = std::move(parts_.back());
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    Part second{{}, whole.depth + 1};
    for (size_t c = 0; c < 3; ++c) second.corner[c] = whole.corner[c] << 1;
    Part first = second;
    first.corner[k] = second.corner[j] = sum(1, whole.corner[j], 1, whole.corner[k]);
    parts_.back() = std::move(second);
    parts_.push_back(std::move(first));
  }

  void leaf(uint32_t s) {
    for (const Point& corner : parts_.back().corner) check(corner, parts_.back().depth, s);
    done();
  }

  /// p and q are multiplied by 2^bits more.
  void cut(uint32_t s, uint32_t r, const Cut& cut) {
    const auto& [corner, depth] = parts_.back();
    const Point &o = corner[cut.o], &j = corner[(cut.o + 1) % 3], &k = corner[(cut.o + 2) % 3];
    const unsigned whole = 1U << cut.bits;
    const Point p = sum(whole - cut.s, o, cut.s, j), q = sum(whole - cut.t, o, cut.t, k);
    check(o, depth, s);
    for (const uint32_t each : {s, r}) {
      check(p, depth + cut.bits, each);
      check(q, depth + cut.bits, each);
    }
    check(j, depth, r);
    check(k, depth, r);
    done();
  }

 private:
  void check(const Point& point, unsigned depth, uint32_t number) {
    if (number != number_) triangle_ = Triangle(q_.corners_of_y(number));
    number_ = number;
    Fraction square = triangle_.squared_distance(point, depth);
    if (!(largest < square)) return;
    if (limit_ < square)
      throw Refused("face " + std::to_string(face_) + ", leaf " + std::to_string(leaf_) +
                    ": farther than upper from triangle " + std::to_string(number));
    largest = std::move(square);
  }

  void done() {
    parts_.pop_back();
    ++leaf_;
  }

  const Question& q_;
  const Fraction& limit_;
  std::vector<Part> parts_;  ///< the last is the current one
  uint64_t face_ = 0, leaf_ = 0, number_ = UINT64_MAX;
  Triangle triangle_;  ///< with this number
};

/// Whether the triangle is beyond a plane across an axis that is `reach` away from the point: then
/// all of it is so far away.
inline bool is_beyond(const std::array<Point, 3>& triangle, const Point& point, const Z& reach) {
  for (const auto axis : {&Point::x, &Point::y, &Point::z}) {
    const auto [low, high] = std::minmax({triangle[0].*axis, triangle[1].*axis, triangle[2].*axis});
    if (low - point.*axis >= reach || point.*axis - high >= reach) return true;
  }
  return false;
}

/// claim + side * (delta of A + delta of B), which has to be at least 0, squared, in
/// 4^unit / scale^2.
inline Fraction squared_claim(double claim, int side, const std::array<double, 2>& delta,
                              const Question& question) {
  const int e = std::min({exponent_of(claim), exponent_of(delta[0]), exponent_of(delta[1]), 0});
  const Z sum = integer(claim, e) + side * (integer(delta[0], e) + integer(delta[1], e));
  if (sum < 0) throw Refused("upper is less than both deltas");
  return scaled({sum * sum * question.scale * question.scale, 1}, e - question.unit);
}

/// Throws Refused if a corner of a leaf is farther from its triangle than `limit`. Returns the
/// largest of their distances; both are squares, in 4^unit / scale^2.
inline Fraction largest_of_leaves(const Question& question, const Fraction& limit) {
  const std::vector<Direction::Block>& blocks = question.claim.blocks;
  std::mutex one_at_a_time;
  Fraction largest;
  const auto one_block = [&](size_t i) {
    Leaves leaves(question, limit);
    walk(Bytes(question.file, blocks[i].begin, blocks[i].end), blocks[i], question.y.faces(),
         question.claim.cut_bits, leaves);
    const std::lock_guard lock(one_at_a_time);
    largest = std::max(largest, leaves.largest);
  };
  for_each_index(blocks.size(), one_block, question.threads);
  return largest;
}

/// The witness's distance from Y, also squared, and the nearest triangle.
inline Fraction distance_of_witness(const Question& question, uint64_t& nearest) {
  const Direction& claim = question.claim;
  const std::array<Point, 3> face = question.corners_of_x(claim.witness);
  const Z i = integer((uint64_t{1} << claim.e) - claim.j - claim.k), j = integer(claim.j),
          k = integer(claim.k);
  const auto weighted = [&](Z Point::*axis) {
    return Z(i * face[0].*axis + j * face[1].*axis + k * face[2].*axis);
  };
  const Point witness{weighted(&Point::x), weighted(&Point::y), weighted(&Point::z)};  // times 2^e
  // The point is rounded, and the reach rounded up: a triangle that is not measured must be as far
  // as one that was.
  const Point about{witness.x >> claim.e, witness.y >> claim.e, witness.z >> claim.e};
  Fraction least;
  Z reach;
  for (uint64_t f = 0; f < question.y.faces(); ++f) {
    const std::array<Point, 3> triangle = question.corners_of_y(f);
    if (f > 0 && is_beyond(triangle, about, reach)) continue;
    Fraction square = Triangle(triangle).squared_distance(witness, claim.e);
    if (f > 0 && !(square < least)) continue;
    least = std::move(square);
    nearest = f;
    reach = sqrt(Z(least.numerator / least.denominator)) + 2;
  }
  return least;
}

}  // namespace vkh::check
