#include "host/solve/closest_search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <utility>

#include "host/base/decimal.h"
#include "host/base/parallel.h"
#include "host/base/reject.h"
#include "host/base/rounding.h"
#include "host/mesh/face_point.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// The points of the first batch, few enough not to keep a CPU busy for seconds; the most points of
// a batch, 24 MB; and the time at which batches aim.
constexpr size_t kFirstPoints = size_t{1} << 12;
constexpr size_t kMostPoints = size_t{1} << 20;
constexpr double kBatchMs = 100;

// A frame serves points whose largest coordinate in it is from 2^-6 up to 2^14: the error analysis
// of the device holds for coordinates up to 2^15 (vkhausdorff.h), and kTiny, 2^-60, is small beside
// a distance from 2^-6 up. The next frame, for points farther out, is 2^20 as large.
constexpr int kLeastExponent = -6;
constexpr int kFrameDoublings = 20;
// The number of the frame around the origin, for points whose distance from B's middle no double
// holds.
constexpr int kWholeRange = std::numeric_limits<int>::max();

int floor_divide(int x, int y) { return (x >= 0 ? x : x - y + 1) / y; }

// Finds the number of the frame that serves a point: 0 is B's own. B fills that one, unless B is a
// single point, which has no size to choose a frame by.
int frame_number(const LaidB& b, bool has_size, const DVec3& point) {
  const glm::dvec3 offset = glm::dvec3(point) - b.frame.centre;
  const double extent = std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
  if (!std::isfinite(extent)) return kWholeRange;
  if (extent == 0) return 0;
  const int exponent = std::ilogb(extent) + b.frame.exponent;
  const int number = floor_divide(exponent - kLeastExponent, kFrameDoublings);
  return has_size ? std::max(number, 0) : number;
}

Frame frame_of(const LaidB& b, int number) {
  if (number == kWholeRange) return {glm::dvec3(0), -std::numeric_limits<double>::max_exponent};
  return {b.frame.centre, b.frame.exponent - kFrameDoublings * number};
}

// The Morton code of a point, ten bits an axis; what lies outside of the frame is clamped to it.
uint32_t morton_code(const StoredPoint& point) {
  uint32_t code = 0;
  for (int bit = 9; bit >= 0; --bit) {
    for (const float high : point.high) {
      const float place = std::clamp(512.0f * (1.0f + high), 0.0f, 1023.0f);
      code = 2 * code + ((static_cast<uint32_t>(place) >> bit) & 1u);
    }
  }
  return code;
}

// Sorts the points along a Morton curve through the frame: invocations that run together then take
// the same way through B's BVH.
void sort_along_curve(const Frame& frame, std::span<const DVec3> points,
                      std::vector<size_t>& numbers) {
  std::vector<std::pair<uint32_t, size_t>> keys(numbers.size());
  for_each_block(numbers.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      keys[i] = {morton_code(store_point(frame, points[numbers[i]])), numbers[i]};
  });
  std::sort(keys.begin(), keys.end());
  std::transform(keys.begin(), keys.end(), numbers.begin(),
                 [](const auto& key) { return key.second; });
}

class ClosestSearch {
 public:
  ClosestSearch(const Mesh& mesh, const ClosestQuestion& question)
      : mesh_(mesh), question_(question) {
    const size_t count = question.points.size();
    result_ = {std::vector<double>(count), std::vector<double>(count), std::vector<DVec3>(count),
               std::vector<uint32_t>(count)};
  }

  /// Finds the closest points for the points with these numbers, which B's frame serves.
  void find(const LaidB& b, std::vector<size_t> all) {
    sort_along_curve(b.frame, question_.points, all);
    std::span<const size_t> numbers = all;
    while (!numbers.empty()) {
      if (done_ > 0 && question_.goes_on && !question_.goes_on(done_))
        throw Interrupted("the search for closest points was called off");
      const size_t count = std::min(batch_points_, numbers.size());
      find_batch(b, numbers.first(count));
      numbers = numbers.subspan(count);
      done_ += count;
    }
  }

  ClosestPoints take() { return std::move(result_); }

 private:
  void find_batch(const LaidB& b, std::span<const size_t> numbers);
  void settle(const LaidB& b, size_t number, const gpu::ClosestFace& found);
  FacePoint on_face(size_t number, uint32_t face) const;
  void keep(size_t number, uint32_t face, double lower, const FacePoint& at);
  void measure_all(size_t number);
  void adapt(size_t count, double ms);

  const Mesh& mesh_;
  const ClosestQuestion& question_;
  ClosestPoints result_;
  std::vector<gpu::Vertex> stored_;
  std::vector<gpu::ClosestFace> found_;
  size_t batch_points_ = kFirstPoints;
  size_t done_ = 0;
};

void ClosestSearch::find_batch(const LaidB& b, std::span<const size_t> numbers) {
  stored_.resize(numbers.size());
  found_.resize(numbers.size());
  for_each_block(numbers.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const StoredPoint s = store_point(b.frame, question_.points[numbers[i]]);
      stored_[i] = {{s.high[0], s.high[1], s.high[2]}, {s.low[0], s.low[1], s.low[2]}};
      result_.lower[numbers[i]] = s.displacement;  // until its distance is known
    }
  });
  const auto start = std::chrono::steady_clock::now();
  b.find({stored_, found_});
  adapt(
      numbers.size(),
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  for_each_block(numbers.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) settle(b, numbers[i], found_[i]);
  });
}

FacePoint ClosestSearch::on_face(size_t number, uint32_t face) const {
  const UVec3& corner = mesh_.faces[face];
  return closest_on_face(
      question_.points[number],
      {mesh_.vertices[corner.x], mesh_.vertices[corner.y], mesh_.vertices[corner.z]});
}

// `lower` may be of the stored mesh, which its delta has moved already.
void ClosestSearch::keep(size_t number, uint32_t face, double lower, const FacePoint& at) {
  result_.lower[number] = std::min(lower, at.lower);
  result_.upper[number] = add_up(at.upper, mesh_.delta);
  result_.points[number] = at.point;
  result_.faces[number] = face;
}

// Says whether a distance is enclosed more widely than by a search that went to its end, which
// leaves 1e-6 of the distance and of a face (vkhausdorff.h); a face is at most 4 wide in the frame.
// The device bounds faces by their boxes where more are equally near than it examines.
bool is_wide(const Frame& frame, double lower, double upper) {
  const double width = upper - lower;
  return width > 0x1p-10 * upper && width > frame.length_down(0x1p-16);
}

// The device's lower end is of the stored point and mesh. The upper end is measured here, for the
// coordinates as given: the device has only named the face.
void ClosestSearch::settle(const LaidB& b, size_t number, const gpu::ClosestFace& found) {
  if (found.face >= mesh_.faces.size())
    throw DeviceError("the device names face " + std::to_string(found.face) + " of " +
                      std::to_string(mesh_.faces.size()));
  if (found.lower_above == gpu::kSearchEnded) return measure_all(number);
  const double moved = add_up(b.displacement, result_.lower[number]);
  const double lower =
      add_down(static_cast<double>(found.base), static_cast<double>(found.lower_above));
  const double down = b.frame.length_down(std::max(0.0, add_down(lower, -moved)));
  const FacePoint at = on_face(number, found.face);
  if (is_wide(b.frame, b.frame.length_down(std::max(0.0, lower) + moved), at.upper))
    return measure_all(number);
  keep(number, found.face, down, at);
}

// Measures every face here, where the device's search did not: a driver ended it early, as lavapipe
// does, or too many faces are about equally near.
void ClosestSearch::measure_all(size_t number) {
  const glm::dvec3 p = question_.points[number];
  FacePoint best{.point = {}, .lower = 0, .upper = std::numeric_limits<double>::infinity()};
  uint32_t closest = 0;
  double lower = std::numeric_limits<double>::max();
  for (uint32_t face = 0; face < mesh_.faces.size(); ++face) {
    const UVec3& f = mesh_.faces[face];
    const FacePoint at = on_face(number, face);
    lower = std::min(
        lower,
        face_distance_down(p, {mesh_.vertices[f.x], mesh_.vertices[f.y], mesh_.vertices[f.z]}, at));
    if (face > 0 && at.upper >= best.upper) continue;
    best = at;
    closest = face;
  }
  keep(number, closest, std::max(0.0, add_down(lower, -mesh_.delta)), best);
}

// The next batch takes about kBatchMs, and is at most four times as large.
void ClosestSearch::adapt(size_t count, double ms) {
  const double wanted = static_cast<double>(count) * kBatchMs / std::max(ms, 1e-3);
  const double most = 4 * static_cast<double>(batch_points_);
  batch_points_ =
      std::clamp(static_cast<size_t>(std::min(wanted, most)), kFirstPoints / 16, kMostPoints);
}

// The numbers of the points that each frame serves.
std::map<int, std::vector<size_t>> by_frame(const LaidB& b, std::span<const DVec3> points) {
  const Box box = bounding_box(b.mesh);
  const bool has_size = box.lo != box.hi;
  std::map<int, std::vector<size_t>> groups;
  for (size_t i = 0; i < points.size(); ++i)
    groups[frame_number(b, has_size, points[i])].push_back(i);
  return groups;
}

}  // namespace

void check_points(std::span<const DVec3> points) {
  for (size_t i = 0; i < points.size(); ++i) {
    const DVec3& p = points[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    reject("points", "row " + std::to_string(i),
           "(" + coordinates_text(p.x, p.y, p.z) + ") is not finite", "finite coordinates");
  }
}

ClosestPoints find_closest_points(const LaidB& b, const LayB& lay,
                                  const ClosestQuestion& question) {
  check_points(question.points);
  ClosestSearch search(b.mesh, question);
  std::map<int, std::vector<size_t>> groups = by_frame(b, question.points);
  for (auto& [number, numbers] : groups)
    search.find(number == 0 ? b : lay(frame_of(b, number)), std::move(numbers));
  return search.take();
}

ClosestPoints find_closest_points(Runner& runner, const FramedB& b,
                                  const ClosestQuestion& question) {
  const auto laid = [&runner, &mesh = b.mesh](const StoragePlan& stored, const ResidentMesh& on) {
    const auto find = [&runner, &mesh, &on, has_low = stored.has_low](PointBatch batch) {
      batch.has_low = has_low;
      runner.find_closest(mesh, on, batch);
    };
    return LaidB{mesh, stored.frame, stored.displacement, find};
  };
  std::deque<ResidentMesh> others;
  const auto lay = [&](const Frame& frame) {
    const StoragePlan stored = store_in(frame, b.mesh);
    return laid(stored, others.emplace_back(runner.build({&b.mesh, &stored})));
  };
  const StoragePlan own{.frame = b.frame, .has_low = b.has_low, .displacement = b.displacement};
  return find_closest_points(laid(own, b.resident), lay, question);
}

}  // namespace vkh
