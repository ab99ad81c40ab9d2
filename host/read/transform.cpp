#include "host/read/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/float128.h"
#include "host/mesh/exact_sum.h"

namespace vkh::scene {
namespace {

constexpr double kUlp = 0x1p-53;
// The most that computing a bound itself, a dozen roundings to nearest, may take off it.
constexpr double kOutward = 1 + 0x1p-40;

// Rounds up a number that is not negative, by a little more than needed.
double up(Float128 x) { return x == 0 ? 0 : static_cast<double>(x) * kOutward + 0x1p-1060; }

struct Entry {
  double value = 0, off = 0;
};

// `off` bounds the error that the Float128 has already.
Entry rounded(Float128 value, Float128 off) {
  const auto near = static_cast<double>(value);
  if (!std::isfinite(near)) return {near, std::numeric_limits<double>::infinity()};
  return {near, up(magnitude(value - float128(near)) + off)};
}

// Sums in Float128, and what each sum's rounding took, exactly (Knuth's two-sum).
class Float128Sum {
 public:
  void add(Float128 term) {
    const Float128 sum = sum_ + term;
    const Float128 of_term = sum - sum_;
    lost_ += magnitude((sum_ - (sum - of_term)) + (term - of_term));
    sum_ = sum;
  }
  // Terms of finite doubles never reach the ends of Float128's exponents. The losses' own sum, of
  // four at most, is off by less than the factor.
  Entry entry(Float128 off) const { return rounded(sum_, off + lost_ * (1 + float128(0x1p-100))); }

 private:
  Float128 sum_ = 0, lost_ = 0;
};

bool is_finite(const Affine& map) {
  for (const auto& row : map.m) {
    if (!std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); }))
      return false;
  }
  return true;
}

Affine nowhere() {
  Affine map;
  for (auto& row : map.m) row.fill(std::numeric_limits<double>::quiet_NaN());
  return map;
}

using Float128Rows = std::array<std::array<Float128, 3>, 3>;

// Products of two doubles are exact. Each of up to four sums is off by 2^-113 of at most 4 |q|^2,
// and the quotient is off by as much; on the diagonal, the difference from 1 adds at most 2^-113.
// An entry, which is at most 1, is therefore off by less than 2^-105.
Float128Rows rotation_of(const std::array<double, 4>& q) {
  const Float128 x = float128(q[0]), y = float128(q[1]), z = float128(q[2]), w = float128(q[3]);
  const Float128 n = x * x + y * y + z * z + w * w;
  const auto over = [&](Float128 sum) { return 2 * sum / n; };
  return {{{1 - over(y * y + z * z), over(x * y - z * w), over(x * z + y * w)},
           {over(x * y + z * w), 1 - over(x * x + z * z), over(y * z - x * w)},
           {over(x * z - y * w), over(y * z + x * w), 1 - over(x * x + y * y)}}};
}

int sign_of(double x) { return x < 0 ? -1 : x > 0 ? 1 : 0; }

// If an entry is not finite, no point is placed, and the sign does not matter.
int sign_of_determinant(const Affine::Rows& rows) {
  ExactVolume sum;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum.add_product(rows[0][i], rows[1][j], rows[2][k], false);
    sum.add_product(rows[0][i], rows[1][k], rows[2][j], true);
  }
  return sum.sign();
}

bool is_power_of_two(double x) {
  int exponent = 0;
  return std::abs(std::frexp(x, &exponent)) == 0.5;
}

// The row is one coordinate, times a power of two that does not underflow, and nothing else.
bool is_exact(const std::array<double, 4>& row, const std::array<double, 4>& off) {
  if (row[3] != 0 || off != std::array<double, 4>{}) return false;
  int terms = 0;
  for (int k = 0; k < 3; ++k) {
    const double x = row[static_cast<size_t>(k)];
    if (x == 0) continue;
    ++terms;
    if (!is_power_of_two(x) || std::abs(x) < 1) return false;
  }
  return terms <= 1;
}

}  // namespace

bool is_identity(const Affine& map) { return map.m == Affine{}.m && map.off == Affine{}.off; }

Affine affine_of(const Affine::Rows& rows) {
  Affine map{.m = rows};
  if (is_finite(map)) map.sign = sign_of_determinant(rows);
  return map;
}

double squared_length(const std::array<double, 4>& q) {
  return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
}

std::optional<Affine> affine_of(const Placing& placing) {
  const auto& q = placing.rotation;
  const bool is_turned = q[0] != 0 || q[1] != 0 || q[2] != 0;
  if (!is_turned && q[3] == 0) return std::nullopt;
  Float128Rows rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (is_turned) rotation = rotation_of(q);
  Affine map;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      const Float128 scale = float128(placing.scale[j]);
      const Float128 off = is_turned ? magnitude(scale) * float128(0x1p-104) : float128(0);
      const Entry entry = rounded(rotation[i][j] * scale, off);
      map.m[i][j] = entry.value;
      map.off[i][j] = entry.off;
    }
    map.m[i][3] = placing.translation[i];
    map.sign *= sign_of(placing.scale[i]);  // a rotation's is 1
  }
  return map;
}

// A quotient of integers of 53 bits is off by 2^-113 of itself in Float128.
Affine scaling(double numerator, double denominator) {
  const Float128 quotient = float128(numerator) / float128(denominator);
  const bool is_exact = quotient * float128(denominator) == float128(numerator) &&
                        float128(static_cast<double>(quotient)) == quotient;
  const Entry entry = rounded(quotient, is_exact ? float128(0) : quotient * float128(0x1p-112));
  Affine map;
  for (size_t i = 0; i < 3; ++i) {
    map.m[i][i] = entry.value;
    map.off[i][i] = entry.off;
  }
  return map;
}

// exact = (o + do) (i + di): off by |do| |i| + (|o| + |do|) |di|, and by what rounding took.
Affine compose(const Affine& outer, const Affine& inner) {
  if (is_identity(outer)) return inner;
  if (is_identity(inner)) return outer;
  if (!is_finite(outer) || !is_finite(inner)) return nowhere();
  Affine map{.sign = outer.sign * inner.sign};
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 4; ++c) {
      Float128Sum sum;
      Float128 off = 0;
      for (size_t k = 0; k < 3; ++k) {
        const Float128 o = float128(outer.m[r][k]), i = float128(inner.m[k][c]);
        const Float128 o_off = float128(outer.off[r][k]), i_off = float128(inner.off[k][c]);
        sum.add(o * i);
        off += o_off * magnitude(i) + (magnitude(o) + o_off) * i_off;
      }
      if (c == 3) {
        sum.add(float128(outer.m[r][3]));
        off += float128(outer.off[r][3]);
      }
      const Entry entry = sum.entry(off);
      map.m[r][c] = entry.value;
      map.off[r][c] = entry.off;
    }
  }
  return map;
}

// Three products and three sums round each term at most four times, in any order: 4 kUlp of the sum
// of the terms' sizes, taken as 5.
Mover::Mover(const Affine& map, double relative) : map_(map) {
  for (size_t r = 0; r < 3; ++r)
    relative_[r] = (is_exact(map.m[r], map.off[r]) ? 0 : 5 * kUlp) + 2 * relative;
  is_still_ = is_identity(map) && relative == 0;
}

glm::dvec3 Mover::operator()(const glm::dvec3& p, double& delta) const {
  if (is_still_) return p;
  glm::dvec3 moved;
  double off = 0;  // over the three coordinates: no less than the distance
  for (size_t r = 0; r < 3; ++r) {
    const auto& [x, y, z, t] = map_.m[r];
    moved[static_cast<int>(r)] = x * p.x + y * p.y + z * p.z + t;
    const glm::dvec3 size = {std::abs(p.x), std::abs(p.y), std::abs(p.z)};
    const auto& [x_off, y_off, z_off, t_off] = map_.off[r];
    off += x_off * size.x + y_off * size.y + z_off * size.z + t_off;
    if (relative_[r] == 0) continue;
    const double terms =
        std::abs(x) * size.x + std::abs(y) * size.y + std::abs(z) * size.z + std::abs(t);
    off += relative_[r] * terms + 0x1p-1060;  // an underflow loses less than that
  }
  delta = std::max(delta, off * kOutward);
  return moved;
}

}  // namespace vkh::scene
