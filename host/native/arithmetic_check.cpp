#include "host/native/arithmetic_check.h"

#include <cmath>
#include <limits>

namespace vkh::native {
namespace {

/// Hides a number from the compiler, which would compute with it by itself.
double hidden(double x) {
  const volatile double seen = x;
  return seen;
}

// Ties go to the even neighbour: up to 1 + 2^-51 from above 1, and from -1 to -1.
bool rounds_to_nearest() {
  const double one = hidden(1), half_ulp = hidden(0x1p-53);
  const bool ties = one + half_ulp == one && -one - half_ulp == -one;
  return ties && one + 3 * half_ulp == 1 + 0x1p-51;
}

// The square of 1 + 2^-27 ends in 2^-54, which a sum with a product of its own would keep.
bool contracts() {
  const double x = hidden(1 + 0x1p-27), minus = hidden(-(1 + 0x1p-26));
  return x * x + minus != 0;
}

bool flushes() {
  const double least = hidden(std::numeric_limits<double>::min()), two = hidden(2);
  const double half = least / two;
  return !(half > 0) || half * two != least || half + half != least;
}

bool divides_and_roots() {
  return hidden(1) / hidden(3) == 0x1.5555555555555p-2 &&
         std::sqrt(hidden(2)) == 0x1.6a09e667f3bcdp+0 &&
         std::fma(hidden(1 + 0x1p-27), hidden(1 + 0x1p-27), hidden(-(1 + 0x1p-26))) == 0x1p-54;
}

}  // namespace

std::string arithmetic_fault() {
  if (!rounds_to_nearest()) return "sums are not rounded to the nearest double";
  if (contracts()) return "a product and a sum are rounded together";
  if (flushes()) return "numbers under 2^-1022 are flushed to zero";
  if (!divides_and_roots()) return "a quotient, a root or fma is not rounded to the nearest double";
  return "";
}

}  // namespace vkh::native
