#include "host/solve/coverage.h"

#include <cmath>

namespace vkh {

CoverageCheck check_coverage(std::span<const uint64_t> areas, bool bounded) {
  constexpr uint64_t kWhole = uint64_t{1} << 40;
  CoverageCheck out;
  const size_t faces = areas.size() / 2;
  for (size_t i = 0; i < faces; ++i) {
    const uint64_t closed = areas[i], open = areas[faces + i];
    const bool whole = closed <= kWhole && open <= kWhole && closed + open == kWhole;
    const bool waiting = closed == 0 && open == 0;
    ++(whole ? out.whole : waiting ? out.waiting : out.wrong);
    out.closed += std::ldexp(static_cast<double>(closed), -40) / static_cast<double>(faces);
  }
  out.holds = out.wrong == 0 && (out.waiting == 0 || !bounded);
  return out;
}

}  // namespace vkh
