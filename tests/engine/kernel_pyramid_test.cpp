// The pyramid of boxes over B's sorted triangles, level by level, against plain loops.
#include <doctest/doctest.h>

#include <algorithm>

#include "tests/shapes/shapes.h"
#include "tests/support/kernel_bench.h"
#include "tests/verification/model/vec3.h"

namespace {

using namespace vkh;
using namespace vkh::test;

// Counts around the sizes at which a level, a workgroup or a dispatch more is needed.
constexpr uint32_t kSizes[] = {1,    2,    3,    4,    5,      15,     16,     17,     63,   64,
                               65,   255,  256,  257,  271,    272,    273,    1023,   1024, 1025,
                               4095, 4096, 4097, 4113, 65'535, 65'536, 65'537, 100'003};

gpu::Box box_of(const std::vector<gpu::Triangle>& triangles, size_t first, size_t end) {
  gpu::Box box{{3e38f, 3e38f, 3e38f}, {-3e38f, -3e38f, -3e38f}};
  for (size_t i = first; i < end; ++i) {
    for (const gpu::vec3& p : {triangles[i].a, triangles[i].b, triangles[i].c}) {
      box.lo = min(box.lo, p);
      box.hi = max(box.hi, p);
    }
  }
  return box;
}

/// One level, `span` triangles a box, that starts at `start`. Returns how many boxes it has.
uint32_t check_level(const std::vector<gpu::Triangle>& triangles,
                     const std::vector<gpu::Box>& boxes, uint32_t start, size_t span) {
  const size_t level = (triangles.size() + span - 1) / span;
  REQUIRE(start + level <= boxes.size());
  size_t wrong = 0;
  for (size_t i = 0; i < level; ++i) {
    const gpu::Box box = box_of(triangles, i * span, std::min(i * span + span, triangles.size()));
    const gpu::Box& found = boxes[start + i];
    wrong += !same(found.lo, box.lo) || !same(found.hi, box.hi);
  }
  CAPTURE(span);
  CHECK(wrong == 0);
  return static_cast<uint32_t>(level);
}

/// Boxes of 16, 256, .. triangles, and behind all those the boxes of 4, 64, ..
void check_pyramid(const KernelBench& bench, const Hierarchy& h) {
  CAPTURE(h.face_count);
  const auto triangles = bench.get(h.triangles);
  const auto boxes = bench.get(h.boxes);
  uint32_t sixteens = 0;
  uint32_t quads = pyramid_size(h.face_count);
  size_t span = 1;
  for (uint32_t level = h.face_count; level > 1; span *= gpu::kPyramidFan) {
    quads += check_level(triangles, boxes, quads, 4 * span);
    level = check_level(triangles, boxes, sixteens, gpu::kPyramidFan * span);
    sixteens += level;
  }
  CHECK(sixteens == pyramid_size(h.face_count));
  CHECK(quads == pyramid_size(h.face_count) + quads_size(h.face_count));
}

}  // namespace

TEST_CASE("every box of the pyramid is that of its triangles, after a build and after a refit") {
  for (const uint32_t count : kSizes) {
    KernelBench bench;
    const Mesh mesh = in_float32(soup(count, count));
    const Hierarchy h = build_hierarchy(bench, mesh).hierarchy;
    check_pyramid(bench, h);
    const VkhMesh moved = put_mesh(bench, scaled(mesh, -1));
    const auto before = bench.get(h.triangles);
    bench.run([&](Recorder& rec) { record_refit(rec, moved, h); });
    CHECK(
        !same(bench.get(h.triangles)[0].a, before[0].a));  // else the second check sees nothing new
    check_pyramid(bench, h);
  }
}
