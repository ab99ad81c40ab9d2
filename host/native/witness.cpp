#include "host/native/witness.h"

#include <vector>

#include "host/base/parallel.h"

namespace vkh::native {
namespace {

constexpr size_t kFacesOfPiece = 1 << 14;

// Any direction gives a true bound. A corner is separated along the offset, an edge by what is
// orthogonal to it, the inside by the normal; where the closest point lies next to a border,
// rounding may have named the wrong one, so all are tried.
double distance_by_features(const Surface& s, const vec3& offset) {
  const Two3 ab = two(s.at.b - s.at.a), ac = two(s.at.c - s.at.a), bc = two(s.at.c - s.at.b);
  const auto along = [&](const Two3& u, bool both_edges) {
    return coarse_distance_down(s, rounded(orthogonal(offset, u, ac, both_edges)));
  };
  return max(max(along(ab, true), along(ab, false)), max(along(ac, false), along(bc, false)));
}

double nearest_of(const Problem& problem, const Two3& p, size_t begin, size_t end, double enough) {
  const View view = view_around(p);
  double least = 1e30;
  for (size_t f = begin; f < end; ++f) {
    const UVec3& v = problem.b.faces[f];
    const std::vector<vec3>& at = problem.placed_b.at;
    const Surface s = make_surface(two(at[v.x]), two(at[v.y]), two(at[v.z]), view);
    least = min(least, distance_from_origin_down(s, enough));
  }
  return least;
}

}  // namespace

double distance_from_origin_down(const Surface& s, double enough) {
  double best = max(coarse_distance_down(s, -s.at.a), 0.0);
  if (best >= enough) return best;
  const Closest c = closest_point(vec3(0, 0, 0), s.at);
  best = max(best, coarse_distance_down(s, c.offset));
  return best >= enough ? best : max(best, distance_by_features(s, c.offset));
}

// Differences of corners without low parts are exact, and the combination is off by 4 kUlp2 S.
// Coordinates are 1 at most, and the weights sum to 1 at most: S is under sqrt(3) + 2 sqrt(3) = 5.2,
// and 4 * 5.2 kUlp2 are under 32, which are 2^-97.
Two3 exact_position(const Corners& face, const uvec2& at) {
  return two_combination(two(face.a), at.x * kUnit, two_difference(two(face.b), two(face.a)),
                         at.y * kUnit, two_difference(two(face.c), two(face.a)));
}

double witness_distance_down(const Problem& problem, const Sample& sample, size_t threads) {
  const UVec3& v = problem.a.faces[sample.face];
  const std::vector<vec3>& at = problem.placed_a.at;
  const Two3 p = exact_position({at[v.x], at[v.y], at[v.z]}, sample.at);
  const size_t count = problem.b.faces.size();
  std::vector<double> least((count + kFacesOfPiece - 1) / kFacesOfPiece);
  for_each_index(
      least.size(),
      [&](size_t piece) {
        const size_t begin = piece * kFacesOfPiece;
        least[piece] =
            nearest_of(problem, p, begin, std::min(begin + kFacesOfPiece, count), sample.distance);
      },
      threads);
  const double nearest = *std::min_element(least.begin(), least.end());
  return max(lowered(nearest - kPositionError), 0.0);
}

}  // namespace vkh::native
