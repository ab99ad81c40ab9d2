#include "vkhausdorff/frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "host/base/hypot3.h"
#include "host/base/parallel.h"
#include "host/base/rounding.h"
#include "host/mesh/round_to_float.h"

namespace vkh {
namespace {

// The largest |coordinate - centre|. With the middle as centre it cannot overflow, and subtraction
// is exact among subnormals.
double extent_of(const Box& box, const glm::dvec3& centre) {
  double extent = 0;
  for (int i = 0; i < 3; ++i) {
    extent = std::max({extent, std::abs(box.lo[i] - centre[i]), std::abs(box.hi[i] - centre[i])});
  }
  return extent;
}

// 2^exponent brings the extent to [1/2, 1).
int exponent_for(double extent) {
  int exponent = 0;
  std::frexp(extent, &exponent);
  return extent == 0 ? 0 : -exponent;
}

// 2^exponent, for an exponent from -1022 to 1023.
double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<uint64_t>(exponent + 1023) << 52);
}

// Multiplies by 2^exponent in two steps: one could leave the range of double on the way. Each is
// exact, or rounded where it underflows, as with std::ldexp, which takes five times as long.
struct Scale {
  double first, second;
  explicit Scale(int exponent)
      : first(power_of_two(exponent / 2)), second(power_of_two(exponent - exponent / 2)) {}
  double operator()(double x) const { return x * first * second; }
};

double scaled(double x, int exponent) { return Scale(exponent)(x); }

// 0 for a float under 2^-126: a device may flush such floats as it reads them, and different ones
// would become equal.
float without_subnormals(float x) {
  return std::abs(x) >= std::numeric_limits<float>::min() ? x : 0.0f;
}
float stored_float(double x) { return without_subnormals(nearest_float(x)); }

struct Halves {
  float high, low;
};

Halves halves_of(double exact) {
  const float high = stored_float(exact);
  return {high, stored_float(exact - static_cast<double>(high))};
}

// Computes how far storing a coordinate displaces it, rounded up, and whether it needs a low part.
// The sum has what two floats leave, exactly, and the rounding of the subtraction by its bound
// (2^-53 relative, taken twice over), unless it was exact. Scaling is exact except for underflow,
// which the last term covers: a normal result has not underflowed.
double displaced(double given, double centre, const Scale& scale, bool& has_low) {
  const double offset = given - centre;
  const double exact = scale(offset);
  const Halves halves = halves_of(exact);
  has_low = has_low || halves.low != 0;
  const double left =
      std::abs((exact - static_cast<double>(halves.high)) - static_cast<double>(halves.low));
  const double subtraction = sum_error(given, -centre) == 0 ? 0 : std::abs(exact) * 0x1p-52;
  const bool scaled_exactly = offset == 0 || std::abs(exact) >= std::numeric_limits<double>::min();
  return left + subtraction + (scaled_exactly ? 0 : 0x1p-1000);
}

// Halves first only where the sum would overflow: a subnormal's half is rounded.
glm::dvec3 middle_of(const Box& box) {
  const glm::dvec3 sum = box.lo + box.hi;
  return std::isfinite(sum.x + sum.y + sum.z) ? sum / 2.0 : box.lo / 2.0 + box.hi / 2.0;
}

Frame frame_around(const Box& box, const glm::dvec3& centre) {
  return {centre, exponent_for(extent_of(box, centre))};
}

// Around the origin the meshes may use only part of [-1, 1]. Using a quarter of it costs two bits,
// which exact coordinates are worth.
bool may_keep_origin(const Box& box) {
  return extent_of(box, glm::dvec3(0)) <= 4 * extent_of(box, middle_of(box));
}

// The share of a range of vertices in a StoragePlan.
struct Stored {
  double worst = 0;
  bool has_low = false;
};

struct VertexRange {
  size_t begin = 0, end = 0;
};

using Meshes = std::span<const Mesh* const>;

// The ranges that threads share, of 70 us where coordinates have low parts.
std::vector<VertexRange> ranges_of(const Mesh& mesh) {
  constexpr size_t kVertices = 1 << 11;
  const size_t count = mesh.vertices.size(), ranges = std::max<size_t>(count / kVertices, 1);
  std::vector<VertexRange> all;
  for (size_t i = 0; i < ranges; ++i) all.push_back({count * i / ranges, count * (i + 1) / ranges});
  return all;
}

size_t threads_of(Meshes meshes) {
  uint64_t bytes = 0;
  for (const Mesh* mesh : meshes) bytes += mesh->vertices.size() * sizeof(mesh->vertices[0]);
  return threads_for(bytes);
}

// Calls work(mesh, range) for all ranges of all meshes, several at once. Returns what it returned,
// with the mesh's number.
template <class Result, class F>
std::vector<std::pair<size_t, Result>> over_ranges(Meshes meshes, const F& work) {
  std::vector<std::pair<size_t, VertexRange>> ranges;
  for (size_t i = 0; i < meshes.size(); ++i) {
    for (const VertexRange range : ranges_of(*meshes[i])) ranges.emplace_back(i, range);
  }
  std::vector<std::pair<size_t, Result>> found(ranges.size());
  const auto take = [&](size_t i) {
    const auto [mesh, range] = ranges[i];
    found[i] = {mesh, work(*meshes[mesh], range)};
  };
  for_each_index(ranges.size(), take, threads_of(meshes));
  return found;
}

// Whether each coordinate is a float, and no subnormal one, once it is scaled: a frame around the
// origin displaces none of them, and needs no low part. There is no branch, so that compilers
// vectorise it. `least` is 0 if every double but 0 is scaled to 2^-126 or more.
bool are_floats(const Frame& frame, const Mesh& mesh, VertexRange range) {
  constexpr uint64_t kPastFloat = (uint64_t{1} << 29) - 1;  // bits of a double that no float has
  constexpr int kLeastOfFloat = std::numeric_limits<float>::min_exponent - 1;
  const double least = std::ldexp(1.0, kLeastOfFloat - frame.exponent);
  uint64_t past = 0, small = 0;
  for (size_t v = range.begin; v < range.end; ++v) {
    const DVec3& given = mesh.vertices[v];
    for (const double x : {given.x, given.y, given.z}) {
      past |= std::bit_cast<uint64_t>(x) & kPastFloat;
      small |= uint64_t{x != 0} & uint64_t{std::abs(x) < least};
    }
  }
  return past == 0 && small == 0;
}

// Stops if `only_high` and a low part is needed.
Stored store_range(const Frame& frame, const Mesh& mesh, VertexRange range, bool only_high) {
  if (glm::dvec3(frame.centre) == glm::dvec3(0) && are_floats(frame, mesh, range)) return {};
  const Scale scale(frame.exponent);
  Stored stored;
  for (size_t v = range.begin; v < range.end && !(only_high && stored.has_low); ++v) {
    double sum = 0;  // over the three coordinates: no less than their Euclidean norm, and it does
                     // not underflow
    for (int i = 0; i < 3; ++i)
      sum += displaced(mesh.vertices[v][i], frame.centre[i], scale, stored.has_low);
    stored.worst = std::max(stored.worst, sum);
  }
  return stored;
}

// Plans each mesh.
std::vector<StoragePlan> store_in(const Frame& frame, Meshes meshes, bool only_high) {
  const auto store = [&](const Mesh& mesh, VertexRange range) {
    return store_range(frame, mesh, range, only_high);
  };
  std::vector<StoragePlan> plans(meshes.size(), StoragePlan{.frame = frame});
  for (const auto& [mesh, stored] : over_ranges<Stored>(meshes, store)) {
    StoragePlan& plan = plans[mesh];
    plan.displacement = std::max(plan.displacement, stored.worst);
    plan.has_low = plan.has_low || stored.has_low;
  }
  for (StoragePlan& plan : plans) plan.displacement *= 1 + 0x1p-50;
  return plans;
}

// Scaling is exact except for underflow, which leaves less than 2^-1000. Delta is not part of the
// check below: a mesh that is off its place is stored as well as any other.
StoragePlan with_delta(StoragePlan stored, const Frame& frame, const Mesh& mesh) {
  if (mesh.delta == 0) return stored;
  const double delta = scaled(mesh.delta, frame.exponent);
  const bool is_normal = delta >= std::numeric_limits<double>::min();
  stored.displacement = add_up(stored.displacement, is_normal ? delta : 0x1p-1000);
  return stored;
}

bool is_exact(const StoragePlan& stored) {
  return !stored.has_low && stored.displacement < 0x1p-61;
}

// Returns each mesh's box.
std::vector<Box> boxes_of(Meshes meshes) {
  const auto box_of = [](const Mesh& mesh, VertexRange range) {
    glm::dvec3 lo = mesh.vertices[range.begin], hi = lo;  // in registers, which a Box would not be
    for (size_t v = range.begin; v < range.end; ++v) {
      const DVec3& p = mesh.vertices[v];
      lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
      hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
    }
    return Box{lo, hi};
  };
  std::vector<std::optional<Box>> boxes(meshes.size());
  for (const auto& [mesh, box] : over_ranges<Box>(meshes, box_of))
    boxes[mesh] = boxes[mesh] ? join(*boxes[mesh], box) : box;
  std::vector<Box> all;
  all.reserve(boxes.size());
  for (const std::optional<Box>& box : boxes) all.push_back(*box);
  return all;
}

// Plans meshes in one frame: around the origin if that stores them exactly, else around their
// middle. `boxes` are theirs.
std::vector<StoragePlan> plans_of(Meshes meshes, const std::vector<Box>& boxes) {
  const Box joint = std::accumulate(boxes.begin(), boxes.end(), boxes.front(), join);
  std::vector<StoragePlan> plans;
  if (may_keep_origin(joint)) plans = store_in(frame_around(joint, glm::dvec3(0)), meshes, true);
  if (plans.empty() || !std::all_of(plans.begin(), plans.end(), is_exact))
    plans = store_in(frame_around(joint, middle_of(joint)), meshes, false);
  for (size_t i = 0; i < meshes.size(); ++i)
    plans[i] = with_delta(plans[i], plans[i].frame, *meshes[i]);
  return plans;
}

}  // namespace

Box bounding_box(const Mesh& mesh) {
  const std::array<const Mesh*, 1> alone = {&mesh};
  return boxes_of(alone)[0];
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
  const double length = hypot3(extent.x, extent.y, extent.z);  // nan for infinite extents
  return std::isfinite(length) ? length : std::numeric_limits<double>::max();
}

Diagonal diagonal_of(const Mesh& mesh) { return {diagonal(bounding_box(mesh)), mesh.delta}; }

double Frame::to_frame(double length) const { return scaled(length, exponent); }

double Frame::extent(const Box& box) const { return to_frame(extent_of(box, centre)); }

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

double farthest_in(const Box& joint, double delta) {
  // The diagonal is rounded to nearest, or the largest double: a little more is surely above it.
  const double longest = diagonal(joint) * (1 + 0x1p-40);
  return add_up(std::nextafter(longest, std::numeric_limits<double>::infinity()) + 0x1p-1070,
                delta);
}

FileInterval Frame::to_files(double lower, double upper, double displacement,
                             double farthest) const {
  const double down = std::max(0.0, add_down(lower, -displacement));
  const double up = add_up(upper, displacement);
  return {length_down(down), std::min(length_up(up), farthest)};
}

StoragePlan store_in(const Frame& frame, const Mesh& mesh) {
  const std::array<const Mesh*, 1> alone = {&mesh};
  return with_delta(store_in(frame, alone, false)[0], frame, mesh);
}

namespace {

void convert(const StoragePlan& stored, const Mesh& mesh, VertexRange range, float* high,
             float* low) {
  const Scale scale(stored.frame.exponent);
  const glm::dvec3 centre = stored.frame.centre;
  const auto scaled = [&](size_t v, int axis) {
    return scale(mesh.vertices[v][axis] - centre[axis]);
  };
  const auto write_high = [&](size_t v) {
    // No double is made of these again, so that the compiler may vectorise the conversion.
    for (int axis = 0; axis < 3; ++axis)
      high[3 * v + static_cast<size_t>(axis)] =
          without_subnormals(static_cast<float>(scaled(v, axis)));
  };
  const auto write_both = [&](size_t v) {
    for (int axis = 0; axis < 3; ++axis) {
      const size_t k = 3 * v + static_cast<size_t>(axis);
      const Halves halves = halves_of(scaled(v, axis));
      high[k] = halves.high;
      low[k] = halves.low;
    }
  };
  if (stored.has_low) {
    for (size_t v = range.begin; v < range.end; ++v) write_both(v);
  } else {
    for (size_t v = range.begin; v < range.end; ++v) write_high(v);
  }
}

}  // namespace

void write_vertices(const StoragePlan& stored, const Mesh& mesh, float* high, float* low) {
  const std::vector<VertexRange> ranges = ranges_of(mesh);
  const std::array<const Mesh*, 1> alone = {&mesh};
  for_each_index(
      ranges.size(), [&](size_t i) { convert(stored, mesh, ranges[i], high, low); },
      threads_of(alone));
}

StoredPoint store_point(const Frame& frame, const glm::dvec3& point) {
  const Scale scale(frame.exponent);
  StoredPoint stored;
  double sum = 0;  // no less than the Euclidean norm, as in store_range
  for (int i = 0; i < 3; ++i) {
    bool has_low = false;
    sum += displaced(point[i], frame.centre[i], scale, has_low);
    const Halves halves = halves_of(scale(point[i] - frame.centre[i]));
    stored.high[static_cast<size_t>(i)] = halves.high;
    stored.low[static_cast<size_t>(i)] = halves.low;
  }
  stored.displacement = sum * (1 + 0x1p-50);
  return stored;
}

FramedPair frame_pair(const Mesh& a, const Mesh& b) {
  const std::array<const Mesh*, 2> meshes = {&a, &b};
  const std::vector<Box> boxes = boxes_of(meshes);
  const std::vector<StoragePlan> plans = plans_of(meshes, boxes);
  return {plans[0].frame, plans[0], plans[1], boxes[0], boxes[1]};
}

FramedMesh frame_mesh(const Mesh& mesh) {
  const std::array<const Mesh*, 1> alone = {&mesh};
  const StoragePlan plan = plans_of(alone, boxes_of(alone))[0];
  return {plan.frame, plan};
}

}  // namespace vkh
