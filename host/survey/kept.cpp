#include "host/survey/kept.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/survey/lengths.h"
#include "vkhausdorff/length.h"

namespace vkh {
namespace {

constexpr double kDown = 1 - 0x1p-50, kUp = 1 + 0x1p-50;  // a quotient or root and more

// Divides a figure of all of A by the share that is kept. No kept distance exceeds `most`.
Enclosure over(const Enclosure& figure, const Enclosure& kept, double most) {
  Enclosure e{kept.upper > 0 ? figure.lower / kept.upper * kDown : 0, most};
  if (kept.lower > 0) e.upper = std::min(most, figure.upper / kept.lower * kUp);
  e.lower = std::min(e.lower, e.upper);
  return e;
}

Enclosure root_of(const Enclosure& e) {
  return {std::sqrt(e.lower) * kDown, std::sqrt(e.upper) * kUp};
}

Enclosure square_of(const Enclosure& e) {
  return {e.lower * e.lower * kDown, e.upper * e.upper * kUp};
}

void keep(const Enclosure& kept, double most, std::vector<AreaWithin>& shares) {
  for (AreaWithin& one : shares) {
    one.share = one.distance >= most ? Enclosure{1, 1} : over(one.share, kept, 1);
    one.jump = false;
  }
}

// The share p of K is first reached where p times the share of K is, of A.
std::vector<Percentile> kept_percentiles(const KeptPart& part, AreaDistances& distances,
                                         double most) {
  const std::vector<double>& asked = part.asked.options.percentiles;
  std::vector<double> shares;
  for (const double p : asked) {
    shares.push_back(p * part.share.lower * kDown);
    shares.push_back(std::min(p * part.share.upper * kUp, 1.0));
  }
  const std::vector<Enclosure> at =
      distances.percentiles({shares, part.asked.resolution(distances.reached())});
  std::vector<Percentile> found;
  for (size_t i = 0; i < asked.size(); ++i) {
    const Enclosure e = in_files(part.pair, {at[2 * i].lower, at[2 * i + 1].upper});
    found.push_back({asked[i], {std::min(e.lower, most), std::min(e.upper, most)}, false});
  }
  return found;
}

}  // namespace

void keep_within(const KeptPart& part, AreaDistances& distances, Statistics& s) {
  const Enclosure& kept = part.share;
  const double most = part.asked.options.max_distance->beyond;
  s.kept = kept;
  s.max_distance = typed_length(*part.asked.options.max_distance);
  const double cap = std::max(part.asked.most().up, 0.0);
  const Enclosure mean = over(part.moments.mean, kept, cap);
  const Enclosure rms = root_of(over(square_of(part.moments.rms), kept, cap * cap * kUp));
  for (const auto& [figure, to] : {std::pair{mean, &s.mean}, {rms, &s.rms}}) {
    *to = in_files(part.pair, figure);
    *to = {std::min(to->lower, most), std::min(to->upper, most)};
  }
  keep(kept, most, s.bands);
  keep(kept, most, s.curve);
  s.percentiles = kept_percentiles(part, distances, most);
}

}  // namespace vkh
