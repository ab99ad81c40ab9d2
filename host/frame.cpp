#include "host/frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vkh {
namespace {

// Largest |coordinate - centre|. With the middle for centre it cannot overflow, and subtraction is
// exact among subnormals.
double reach_of(const Box& box, const glm::dvec3& centre) {
  double reach = 0;
  for (int i = 0; i < 3; ++i) {
    reach = std::max({reach, std::abs(box.lo[i] - centre[i]), std::abs(box.hi[i] - centre[i])});
  }
  return reach;
}

// 2^exponent brings the reach to [1/2, 1).
int exponent_for(double reach) {
  int exponent = 0;
  std::frexp(reach, &exponent);
  return reach == 0 ? 0 : -exponent;
}

// 2^exponent in two steps: one could leave the range of double on the way.
double scaled(double x, int exponent) {
  return std::ldexp(std::ldexp(x, exponent / 2), exponent - exponent / 2);
}

// Stores `given` and returns how far that displaced it, rounded up: what two floats leave exactly,
// the rounding of the subtraction by its bound (2^-53 relative, taken twice over; scaling is exact
// but for underflow, which the last term takes).
double store(double given, double centre, int exponent, float& high, float& low) {
  const double exact = scaled(given - centre, exponent);
  high = static_cast<float>(exact);
  low = static_cast<float>(exact - static_cast<double>(high));
  const double left = std::abs((exact - static_cast<double>(high)) - static_cast<double>(low));
  const double subtraction = centre == 0 ? 0 : std::abs(exact) * 0x1p-52;
  return left + subtraction + (exact == 0 && given == centre ? 0 : 0x1p-1000);
}

// Halved first only where the sum would overflow: a subnormal's half is rounded.
glm::dvec3 middle_of(const Box& box) {
  const glm::dvec3 sum = box.lo + box.hi;
  return std::isfinite(sum.x + sum.y + sum.z) ? sum / 2.0 : box.lo / 2.0 + box.hi / 2.0;
}

Frame frame_around(const Box& box, const glm::dvec3& centre) {
  return {centre, exponent_for(reach_of(box, centre))};
}

// Around the origin the meshes may use only part of [-1, 1]; a quarter of it costs two bits and is
// worth being exact.
bool may_keep_origin(const Box& box) {
  return reach_of(box, glm::dvec3(0)) <= 4 * reach_of(box, middle_of(box));
}

bool is_exact(const StoredMesh& stored) { return !stored.has_low && stored.displacement < 0x1p-61; }

}  // namespace

Box bounding_box(const Mesh& mesh) {
  Box box{mesh.vertices.front(), mesh.vertices.front()};
  for (const glm::dvec3& v : mesh.vertices) box = join(box, {v, v});
  return box;
}

Box join(const Box& x, const Box& y) {
  Box joint;
  for (int i = 0; i < 3; ++i) {
    joint.lo[i] = std::min(x.lo[i], y.lo[i]);
    joint.hi[i] = std::max(x.hi[i], y.hi[i]);
  }
  return joint;
}

double diagonal(const Box& box) {
  const glm::dvec3 extent = box.hi - box.lo;
  return std::hypot(extent.x, extent.y, extent.z);
}

double Frame::to_frame(double length) const { return scaled(length, exponent); }

double Frame::reach(const Box& box) const { return to_frame(reach_of(box, centre)); }

double Frame::length_down(double frame_length) const {
  const double length = scaled(frame_length, -exponent);
  return scaled(length, exponent) > frame_length ? std::nextafter(length, 0.0) : length;
}

double Frame::length_up(double frame_length) const {
  const double length = scaled(frame_length, -exponent);
  return scaled(length, exponent) < frame_length
             ? std::nextafter(length, std::numeric_limits<double>::infinity())
             : length;
}

FileInterval Frame::to_files(const FileInterval& certified, double displacement,
                             double joint_diagonal) const {
  const double infinity = std::numeric_limits<double>::infinity();
  const double moved = std::nextafter(displacement, infinity);
  const double lower = std::max(0.0, std::nextafter(certified.lower - moved, -infinity));
  const double upper = std::nextafter(certified.upper + moved, infinity);
  // The joint diagonal is rounded to nearest: a little more is surely above it.
  const double farthest = std::nextafter(joint_diagonal * (1 + 0x1p-40), infinity) + 0x1p-1070;
  return {length_down(lower), std::min(length_up(upper), farthest)};
}

StoredMesh store_in(const Frame& frame, const Mesh& mesh) {
  StoredMesh stored;
  stored.high.resize(3 * mesh.vertices.size());
  stored.low.resize(3 * mesh.vertices.size());
  double worst = 0;
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    double sum = 0;  // of the three coordinates: no less than their Euclidean norm, and it does not
                     // underflow
    for (int i = 0; i < 3; ++i) {
      const size_t k = 3 * v + static_cast<size_t>(i);
      sum += store(mesh.vertices[v][i], frame.centre[i], frame.exponent, stored.high[k],
                   stored.low[k]);
      stored.has_low = stored.has_low || stored.low[k] != 0;
    }
    worst = std::max(worst, sum);
  }
  stored.displacement = worst * (1 + 0x1p-50);
  return stored;
}

FramedPair frame_pair(const Mesh& a, const Mesh& b) {
  const Box joint = join(bounding_box(a), bounding_box(b));
  const auto framed = [&](const glm::dvec3& centre) {
    const Frame frame = frame_around(joint, centre);
    return FramedPair{frame, store_in(frame, a), store_in(frame, b)};
  };
  if (may_keep_origin(joint)) {
    FramedPair pair = framed(glm::dvec3(0));
    if (is_exact(pair.a) && is_exact(pair.b)) return pair;
  }
  return framed(middle_of(joint));
}

FramedMesh frame_mesh(const Mesh& mesh) {
  const Box box = bounding_box(mesh);
  const auto framed = [&](const glm::dvec3& centre) {
    const Frame frame = frame_around(box, centre);
    return FramedMesh{frame, store_in(frame, mesh)};
  };
  if (may_keep_origin(box)) {
    FramedMesh one = framed(glm::dvec3(0));
    if (is_exact(one.stored)) return one;
  }
  return framed(middle_of(box));
}

}  // namespace vkh
