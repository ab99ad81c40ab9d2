#include "host/solve/coverage.h"

namespace vkh {

CoverageCheck check_coverage(std::span<const uint64_t> areas, uint64_t of_face, bool bounded) {
  CoverageCheck out;
  const size_t faces = areas.size() / 2;
  for (size_t i = 0; i < faces; ++i) {
    const uint64_t closed = areas[i], open = areas[faces + i];
    const bool whole = closed <= of_face && open <= of_face && closed + open == of_face;
    const bool waiting = closed == 0 && open == 0;
    ++(whole ? out.whole : waiting ? out.waiting : out.wrong);
    out.closed +=
        static_cast<double>(closed) / static_cast<double>(of_face) / static_cast<double>(faces);
  }
  out.holds = out.wrong == 0 && (out.waiting == 0 || !bounded);
  return out;
}

}  // namespace vkh
