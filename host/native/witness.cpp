#include "host/native/witness.h"

#include <vector>

#include "host/base/parallel.h"
#include "host/native/separate.h"

namespace vkh::native {
namespace {

constexpr size_t kFacesOfPiece = 1 << 14;

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
