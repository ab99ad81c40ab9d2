// What a certificate has to prove, and whether it does.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>

#include "check/certificate.h"
#include "check/exact.h"
#include "host/base/parallel.h"
#include "host/mesh/mesh.h"

namespace vkh::check {

/// Well formed, but it does not prove what it claims.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a direction, from X to Y, is proven with. All coordinates are integers times 2^unit.
struct Question {
  const std::vector<unsigned char>& file;
  const Direction& claim;
  const Mesh &x, &y;
  int unit;
  size_t threads;
  std::function<void()> face_done;  ///< called by all threads
};

inline void set(Point (&out)[3], const Mesh& mesh, uint64_t face, int unit) {
  for (int i = 0; i < 3; ++i) set(out[i], mesh.vertices[mesh.faces[face][i]], unit);
}

/// A part of a face. Its corners are multiplied by 2^depth, so that they stay integers.
struct Part {
  Point corner[3];
  unsigned depth;
};

/// Measures the leaves of blocks, one block after the other.
class Leaves {
 public:
  Leaves(const Question& question, const Fraction& limit)
      : q_(question), limit_(limit), parts_(kDeepest + 1) {}

  Fraction largest;

  void face(uint64_t face) {
    q_.face_done();
    face_ = face, leaf_ = 0, count_ = 1;
    parts_[0].depth = 0;
    set(parts_[0].corner, q_.x, face, q_.unit);
  }

  /// With m, the middle of j and k: first the part of i, j, m and then that of i, m, k.
  void halve(size_t i) {
    Part &second = parts_[count_ - 1], &first = parts_[count_];
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    first.depth = ++second.depth;
    for (size_t x = 0; x < 3; ++x) {
      mpz_add(first.corner[k][x], second.corner[j][x], second.corner[k][x]);
      mpz_mul_2exp(first.corner[i][x], second.corner[i][x], 1);
      mpz_mul_2exp(first.corner[j][x], second.corner[j][x], 1);
      mpz_set(second.corner[i][x], first.corner[i][x]);
      mpz_set(second.corner[j][x], first.corner[k][x]);
      mpz_mul_2exp(second.corner[k][x], second.corner[k][x], 1);
    }
    ++count_;
  }

  void leaf(uint32_t s) {
    const Part& part = parts_[--count_];
    for (const Point& corner : part.corner) check(corner, part.depth, s);
    ++leaf_;
  }

  /// p and q are multiplied by 256 more.
  void cut(uint32_t s, uint32_t r, const Cut& cut) {
    const Part& part = parts_[--count_];
    const Point &o = part.corner[cut.o], &j = part.corner[(cut.o + 1) % 3],
                &k = part.corner[(cut.o + 2) % 3];
    for (size_t x = 0; x < 3; ++x) {
      mpz_mul_ui(b_[x], o[x], 256 - cut.s);
      mpz_addmul_ui(b_[x], j[x], cut.s);
      mpz_mul_ui(c_[x], o[x], 256 - cut.t);
      mpz_addmul_ui(c_[x], k[x], cut.t);
    }
    check(o, part.depth, s);
    for (const Point* point : {&b_, &c_}) check(*point, part.depth + 8, s);
    for (const Point* point : {&b_, &c_}) check(*point, part.depth + 8, r);
    check(j, part.depth, r);
    check(k, part.depth, r);
    ++leaf_;
  }

 private:
  void check(const Point& point, unsigned depth, uint32_t number) {
    if (number != number_) {
      set(triangle_.corner, q_.y, number, q_.unit);
      triangle_.prepare();
      number_ = number;
    }
    triangle_.measure(square_, point, depth);
    if (compare(square_, largest) <= 0) return;
    if (compare(square_, limit_) > 0)
      throw Refused("face " + std::to_string(face_) + ", leaf " + std::to_string(leaf_) +
                    ": farther than upper from triangle " + std::to_string(number));
    swap(largest, square_);
  }

  const Question& q_;
  const Fraction& limit_;
  std::vector<Part> parts_;  ///< the first count_ of them, the one that is spoken of last
  uint64_t face_ = 0, leaf_ = 0, number_ = UINT64_MAX;
  size_t count_ = 0;
  Point b_, c_;
  Triangle triangle_;  ///< with this number, ready
  Fraction square_;
};

/// Whether the triangle's box is so far from point / 2^shift that their distance, squared and times
/// 4^shift, is at least `reach`: then the triangle is, too.
inline bool is_box_as_far(const Triangle& triangle, const Point& point, unsigned shift,
                          const Z& reach) {
  thread_local Z sum, gap;
  mpz_set_ui(sum, 0);
  for (size_t x = 0; x < 3; ++x) {
    mpz_srcptr least = triangle.corner[0][x], most = least;
    for (size_t i = 1; i < 3; ++i) {
      mpz_srcptr value = triangle.corner[i][x];
      if (mpz_cmp(value, least) < 0) least = value;
      if (mpz_cmp(value, most) > 0) most = value;
    }
    mpz_mul_2exp(gap, least, shift);
    mpz_sub(gap, gap, point[x]);
    if (sign(gap) < 0) {
      mpz_mul_2exp(gap, most, shift);
      mpz_sub(gap, point[x], gap);
    }
    if (sign(gap) > 0) mpz_addmul(sum, gap, gap);
  }
  return mpz_cmp(sum, reach) >= 0;
}

/// The largest e such that all coordinates of both are integers times 2^e.
inline int common_exponent(const Mesh& a, const Mesh& b) {
  int out = INT_MAX;
  for (const Mesh* mesh : {&a, &b}) {
    for (const glm::dvec3& v : mesh->vertices)
      out = std::min({out, exponent_of(v.x), exponent_of(v.y), exponent_of(v.z)});
  }
  return out == INT_MAX ? 0 : out;
}

/// claim + sign * (delta of A + delta of B), which has to be at least 0, squared, in 4^unit.
inline Fraction squared_claim(double claim, int side, const std::array<double, 2>& delta,
                              int unit) {
  const int e = std::min({exponent_of(claim), exponent_of(delta[0]), exponent_of(delta[1]), 0});
  Fraction out;
  Z part;
  set(out.numerator, claim, e);
  for (const double d : delta) {
    set(part, d, e);
    side > 0 ? mpz_add(out.numerator, out.numerator, part)
             : mpz_sub(out.numerator, out.numerator, part);
  }
  if (sign(out.numerator) < 0) throw Refused("upper is less than both deltas");
  mpz_mul(out.numerator, out.numerator, out.numerator);
  scale(out, e - unit);
  return out;
}

/// Throws Refused where a corner of a leaf is farther from its triangle than `limit`. Returns the
/// largest of their distances; both are squares, in 4^unit.
inline Fraction largest_of_leaves(const Question& question, const Fraction& limit) {
  const std::vector<Direction::Block>& blocks = question.claim.blocks;
  std::atomic<size_t> next = 0, refused_at = SIZE_MAX;
  std::mutex one_at_a_time;
  std::string why;
  Fraction largest;
  for_each_index(
      question.threads,
      [&](size_t) {
        Leaves leaves(question, limit);
        for (size_t i = next++; i < blocks.size() && i < refused_at; i = next++) {
          try {
            walk(Bytes(question.file, blocks[i].begin, blocks[i].end), blocks[i],
                 question.y.faces.size(), leaves);
          } catch (const Refused& refused) {  // the first block's word is the answer
            const std::lock_guard lock(one_at_a_time);
            if (i < refused_at) refused_at = i, why = refused.what();
          }
        }
        const std::lock_guard lock(one_at_a_time);
        if (compare(leaves.largest, largest) > 0) swap(leaves.largest, largest);
      },
      question.threads);
  if (refused_at != SIZE_MAX) throw Refused(why);
  return largest;
}

/// The witness's distance from Y, likewise, and which triangle is nearest.
inline Fraction distance_of_witness(const Question& question, uint64_t& nearest) {
  const Direction& claim = question.claim;
  const uint64_t weights[] = {(uint64_t{1} << claim.e) - claim.j - claim.k, claim.j, claim.k};
  Triangle triangle;
  set(triangle.corner, question.x, claim.witness, question.unit);
  Point witness;  // times 2^e
  Z weight, reach;
  for (size_t i = 0; i < 3; ++i) {
    set(weight, weights[i]);
    for (size_t x = 0; x < 3; ++x) mpz_addmul(witness[x], triangle.corner[i][x], weight);
  }
  Fraction least, square;
  for (uint64_t f = 0; f < question.y.faces.size(); ++f) {
    set(triangle.corner, question.y, f, question.unit);
    if (f > 0 && is_box_as_far(triangle, witness, claim.e, reach)) continue;
    triangle.prepare();
    triangle.measure(square, witness, claim.e);
    if (f > 0 && compare(square, least) >= 0) continue;
    swap(square, least);
    nearest = f;
    mpz_mul_2exp(reach, least.numerator, 2 * claim.e);
    mpz_cdiv_q(reach, reach, least.denominator);
  }
  return least;
}

}  // namespace vkh::check
