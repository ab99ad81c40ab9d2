// host/mesh/frame.cpp against exact rationals: no vertex is displaced by more than the frame
// states, and lengths come back rounded outward, subnormal and huge coordinates included.
#include "vkhausdorff/frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "host/mesh/mesh_pair.h"
#include "host/mesh/round_to_float.h"
#include "tests/shapes/adversarial.h"
#include "tests/support/tally.h"
#include "tests/verification/model/arithmetic.h"
#include "tests/verification/oracle/exact.h"

using namespace vkh;
using namespace vkh::test;

namespace {

Rational power(int exponent) {
  const auto n = static_cast<unsigned long>(std::abs(exponent));
  return exponent >= 0 ? Rational(Rational(1) << n) : Rational(Rational(1) >> n);
}

/// Coordinates with every bit set or few, far from the origin or near, of one scale or of many.
MeshPair hard_pair_of_points(Random& random) {
  const int scale = random.below(4) == 0 ? static_cast<int>(random.below(2000)) - 1060
                                         : static_cast<int>(random.below(40)) - 20;
  const double far = random.below(3) == 0 ? 0.0 : log_uniform(random, -10, 30);
  const glm::dvec3 by = far * random.direction();
  const bool one_axis = random.below(2) == 0;
  const auto mesh = [&] {
    std::vector<glm::dvec3> points(1 + random.below(4));
    for (glm::dvec3& p : points) {
      p = random.in_cube(1.0) + by;
      if (random.below(4) == 0) p = glm::dvec3(stored(p).value());
      if (one_axis) p.y = p.z = 0.0;
      for (int i = 0; i < 3; ++i) p[i] = std::ldexp(p[i], scale);
    }
    std::vector<glm::uvec3> faces;
    for (uint32_t i = 0; i < points.size(); ++i) faces.emplace_back(i, i, i);
    return make_mesh("points", std::move(points), std::move(faces));
  };
  Mesh a = mesh();
  Mesh b = mesh();
  if (random.below(8) != 0) return {std::move(a), std::move(b)};
  // A B so much larger than A that A's coordinates underflow in the frame; and floats, so that the
  // frame's centre is 0 and displaces nothing by itself.
  for (glm::dvec3& p : b.vertices) p = round_to_float(random.in_cube(1.0));
  return {scaled(a, -60), scaled(b, 1000)};
}

Rational squared_displacement(const Frame& frame, const glm::dvec3& given, const float* high,
                              const float* low) {
  Rational sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Rational exact = (Rational(given[i]) - Rational(frame.centre[i])) * power(frame.exponent);
    const Rational off =
        exact - Rational(static_cast<double>(high[i])) - Rational(static_cast<double>(low[i]));
    sum += off * off;
  }
  return sum;
}

/// The coordinates as they are uploaded.
struct Written {
  std::vector<float> high, low;
  Written(const StoragePlan& stored, const Mesh& mesh)
      : high(3 * mesh.vertices.size()), low(3 * mesh.vertices.size()) {
    write_vertices(stored, mesh, high.data(), low.data());
  }
};

/// A single point is stored as a vertex at its place is, with its own displacement.
void check_point(const Frame& frame, const glm::dvec3& given, double most, Tally& tally) {
  const StoredPoint point = store_point(frame, given);
  const Rational squared = squared_displacement(frame, given, point.high.data(), point.low.data());
  const auto describe = [&] { return hex(given) + " displacement " + hex(point.displacement); };
  tally.require(is_upper_bound(point.displacement, squared), "a point's displacement", describe);
  tally.require(point.displacement <= most, "a point's displacement is not above the mesh's",
                describe);
}

void check_stored(const Frame& frame, const Mesh& mesh, const StoragePlan& stored_mesh,
                  Tally& tally) {
  const double displacement = stored_mesh.displacement;
  const Written written(stored_mesh, mesh);
  bool exact = true;
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const float* high = &written.high[3 * v];
    const float* low = &written.low[3 * v];
    const Rational squared = squared_displacement(frame, mesh.vertices[v], high, low);
    const auto describe = [&] {
      return hex(mesh.vertices[v]) + " centre " + hex(frame.centre) + " 2^" +
             std::to_string(frame.exponent) + " displacement " + hex(displacement);
    };
    tally.require(is_upper_bound(displacement, squared), "displaced by at most the displacement",
                  describe);
    check_point(frame, mesh.vertices[v], displacement, tally);
    exact = exact && squared == 0;
    float largest = 0;
    for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(high[i]) + std::abs(low[i]));
    tally.require(largest <= 1.0f, "coordinates are at most 1", describe);
    if (displacement > 0x1p-200)
      tally.measure("displaced / displacement", sqrt_near(squared) / displacement, describe);
  }
  // A coordinate that would underflow in the frame may be exact, and is not distinguished.
  const bool claimed = !exact || displacement == 0.0 || displacement <= 0x1p-990;
  tally.require(claimed, "exactly stored is not displaced", [&] { return hex(displacement); });
  tally.count("exact with a centre", displacement == 0.0 && frame.centre != glm::dvec3(0));
}

void check_lengths(const Frame& frame, Random& random, Tally& tally) {
  const double length = random.below(8) == 0 ? 0.0 : log_uniform(random, -60, 2);
  const double down = frame.length_down(length), up = frame.length_up(length);
  const auto describe = [&] {
    return hex(length) + " 2^" + std::to_string(-frame.exponent) + " down " + hex(down) + " up " +
           hex(up);
  };
  const Rational exact = Rational(length) * power(-frame.exponent);
  tally.require(std::isfinite(down) && Rational(down) <= exact, "length_down", describe);
  tally.require(std::isinf(up) || Rational(up) >= exact, "length_up", describe);
  const double infinity = std::numeric_limits<double>::infinity();
  tally.require(up <= std::nextafter(std::nextafter(down, infinity), infinity),
                "the two are at most neighbours' neighbours", describe);
}

/// The device's floats stand for the stored meshes; the given ones are displaced from those.
void check_interval(const Frame& frame, double displacement, Random& random, Tally& tally) {
  const int exponent = -static_cast<int>(random.below(60));
  const float lower =
      random.below(4) == 0 ? 0.0f : std::abs(hard_float(random, exponent, exponent));
  const float upper = std::nextafter(lower, 1e30f);
  const FileInterval got = frame.to_files(static_cast<double>(lower), static_cast<double>(upper),
                                          displacement, std::numeric_limits<double>::infinity());
  const Rational unit = power(-frame.exponent), moved(displacement);
  const auto describe = [&] {
    return hex(static_cast<double>(lower)) + " displaced by " + hex(displacement) + " got " +
           hex(got.lower) + ", " + hex(got.upper);
  };
  const Rational below = (Rational(static_cast<double>(lower)) - moved) * unit;
  const Rational above = (Rational(static_cast<double>(upper)) + moved) * unit;
  tally.require(got.lower == 0.0 || Rational(got.lower) <= below, "lower, displaced", describe);
  tally.require(std::isinf(got.upper) || Rational(got.upper) >= above, "upper, displaced",
                describe);
}

/// The diagonal of the joint box bounds the distance of any two points in it.
void check_farthest(const MeshPair& pair, const Frame& frame, double displacement, Tally& tally) {
  const Box a = vkh::bounding_box(pair.a), b = vkh::bounding_box(pair.b);
  const Box joint = {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
  Rational squared = 0;
  for (int i = 0; i < 3; ++i) {
    const Rational extent = Rational(joint.hi[i]) - Rational(joint.lo[i]);
    squared += extent * extent;
  }
  const FileInterval got = frame.to_files(0.0, 3e38, displacement, farthest_in(joint, 0));
  tally.require(is_upper_bound(got.upper, squared), "the diagonal bounds any distance",
                [&] { return hex(got.upper); });
  const double delta = 0x1.8p-3 * got.upper, farther = farthest_in(joint, delta);
  tally.require(std::isinf(farther) || Rational(farther) >= Rational(got.upper) + Rational(delta),
                "and a delta is added to it", [&] { return hex(farther); });
}

}  // namespace

TEST_CASE("the frame's displacement covers every vertex; its lengths are rounded outward") {
  const uint64_t count = case_count() / 4;
  Random random(20240801);
  Tally tally("frame");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const MeshPair pair = hard_pair_of_points(random);
    const FramedPair framed = frame_pair(pair.a, pair.b);
    const Frame& frame = framed.frame;
    const double displacement = framed.a.displacement + framed.b.displacement;
    check_stored(frame, pair.a, framed.a, tally);
    check_stored(frame, pair.b, framed.b, tally);
    check_lengths(frame, random, tally);
    check_interval(frame, displacement, random, tally);
    check_farthest(pair, frame, displacement, tally);
    tally.count("with a centre", frame.centre != glm::dvec3(0));
    tally.count("displaced", displacement > 0x1p-500);
  }
  tally.conclude(4 * count);
  CHECK(tally.counted("with a centre") > count / 10);
  CHECK(tally.counted("displaced") > count / 10);
  CHECK(tally.counted("exact with a centre") > count / 100);
}

// Bits tell of such meshes that they are stored as they are, without a sum of each vertex.
TEST_CASE("floats around the origin, and one coordinate with a bit more or near 2^-126") {
  Random random(20240804);
  Tally tally("floats");
  const uint64_t count = case_count() / 40;
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    std::vector<DVec3> points(1 + random.below(9));
    for (DVec3& p : points) p = round_to_float(random.in_cube(1.0));
    points[0].y = 1;  // with it the origin is nearly always the frame's centre
    double& one = points[random.below(static_cast<uint32_t>(points.size()))].x;
    const uint32_t kind = random.below(3);
    if (kind == 1)
      one = std::bit_cast<double>(std::bit_cast<uint64_t>(one) | uint64_t{1} << random.below(29));
    if (kind == 2) one = std::ldexp(one, -120 - static_cast<int>(random.below(10)));
    const int scale = random.below(2) == 0 ? 0 : static_cast<int>(random.below(1900)) - 900;
    for (DVec3& p : points) {
      for (int axis = 0; axis < 3; ++axis) p[axis] = std::ldexp(p[axis], scale);
    }
    std::vector<UVec3> faces(points.size());
    for (uint32_t v = 0; v < faces.size(); ++v) faces[v] = UVec3(v);
    const Mesh mesh = make_mesh("floats", std::move(points), std::move(faces));
    const FramedMesh framed = frame_mesh(mesh);
    check_stored(framed.frame, mesh, framed.stored, tally);
    const auto describe = [&] { return hex(framed.stored.displacement); };
    const bool around_origin = glm::dvec3(framed.frame.centre) == glm::dvec3(0);
    if (kind == 0 && around_origin)
      tally.require(!framed.stored.has_low && framed.stored.displacement == 0, "floats", describe);
    tally.count("around the origin", around_origin);
    tally.count("one has more", framed.stored.has_low || framed.stored.displacement > 0);
  }
  tally.conclude(count);
  CHECK(tally.counted("around the origin") > count / 2);
  CHECK(tally.counted("one has more") > count / 4);
}

TEST_CASE("a delta is part of the displacement, exactly or more, and moves nothing") {
  Random random(20240803);
  Tally tally("delta");
  for (uint64_t i = 0; i < case_count() / 40 && !tally.hopeless(); ++i) {
    MeshPair pair = hard_pair_of_points(random);
    const FramedPair before = frame_pair(pair.a, pair.b);
    pair.a.delta = log_uniform(random, -1070, 900);
    const FramedPair after = frame_pair(pair.a, pair.b);
    const StoragePlan alone = store_in(before.frame, pair.a);
    const auto describe = [&] { return hex(pair.a.delta) + " " + hex(after.a.displacement); };
    const Rational least =
        Rational(before.a.displacement) + Rational(pair.a.delta) * power(before.frame.exponent);
    for (const double displacement : {after.a.displacement, alone.displacement}) {
      tally.require(std::isinf(displacement) || Rational(displacement) >= least,
                    "displaced by the delta, too", describe);
    }
    const Written moved(after.a, pair.a), still(before.a, pair.a);
    tally.require(moved.high == still.high && moved.low == still.low, "nothing is moved", describe);
    tally.require(after.b.displacement == before.b.displacement, "nor is the other", describe);
  }
  tally.conclude(case_count() / 40);
}

TEST_CASE("a number that is rounded to float stays so beside another") {
  Random random(20240802);
  const auto lost = [](const glm::dvec2& p) {
    return glm::dvec2{p.x - round_to_float(p.x), p.y - round_to_float(p.y)};
  };
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec2 p{1 + random.below(1u << 10) + 0x1p-40, 2 + random.below(1u << 10) + 0x1p-40};
    CHECK(lost(p) == glm::dvec2(0x1p-40));
  }
}

TEST_CASE("the tests' meshes in float32 have no low part") {
  const Mesh sphere = icosphere(1, 1);
  CHECK(store_in(Frame{}, sphere).has_low);
  CHECK_FALSE(store_in(Frame{}, in_float32(sphere)).has_low);
}

TEST_CASE("nothing that a device may flush is stored: it is displaced by so much") {
  for (const double low : {0x1p-140, 0x1p-127, 0x1.8p-126}) {
    const auto mesh = [](double z) {
      return make_mesh("m", {{1, 0, z}, {0, 1, z}, {-1, -1, z}}, {{0, 1, 2}});
    };
    const Mesh a = mesh(0x1p-100 + low), b = mesh(low);
    const FramedPair pair = frame_pair(a, b);
    for (const Written& written : {Written(pair.a, a), Written(pair.b, b)}) {
      for (const std::vector<float>* part : {&written.high, &written.low})
        for (const float x : *part) CHECK((x == 0 || std::abs(x) >= 0x1p-126f));
    }
    const double scale = std::ldexp(1.0, pair.frame.exponent);
    CHECK((low * scale >= 0x1p-126 || pair.b.displacement >= low * scale));
  }
}
