// The boxes over a workgroup's run of kRun neighbours of one level of the pyramid: over 4, 16, 64
// and 256 neighbours. If one run holds the whole level over 256, the last workgroup to end also
// computes the boxes above that level. The workgroup has kRun invocations. The kernel declares
// `boxes`, coherent, and `groups_done`.
#ifndef VKH_SHADERS_BVH_RUN_BOXES_GLSL
#define VKH_SHADERS_BVH_RUN_BOXES_GLSL

#include "shaders/bvh/box.glsl"
#include "shaders/base/invocation.glsl"
#include "shaders/base/last_group.glsl"

// The boxes of 1 item, then of 4, 16 and 64, each at its level's start.
shared Box run_boxes[kRun + kRun / 4u + kRun / 16u + kRun / 64u];

uint fours(uint count) { return (count + 3u) / 4u; }

// Called by every invocation of the workgroup. `own`: the box of item run * kRun + lane, empty past
// the end; `count`: the number of all items; `quads`, `sixteens`: the starts of the levels above
// them in boxes (PyramidPush). One item has no levels above it.
void write_run(uint run, Box own, uint count, uint quads, uint sixteens) {
  uint lane = gl_LocalInvocationID.x;
  uint below = 0u;
  uint width = kRun;
  run_boxes[lane] = own;
  for (uint level = 0u; level < 4u; ++level) {
    if ((level & 1u) == 0u && count <= 1u) return;
    barrier();
    uint above = below + width;
    width /= 4u;
    count = fours(count);
    uint i = run * width + lane;
    if (lane < width) {
      uint k = below + 4u * lane;
      Box b = joined(joined(run_boxes[k], run_boxes[k + 1u]),
                     joined(run_boxes[k + 2u], run_boxes[k + 3u]));
      if (level < 3u) run_boxes[above + lane] = b;
      if (i < count) boxes[quads + i] = b;
    }
    // The next level is of the other kind; each level starts behind the last one of its kind.
    uint other = sixteens;
    sixteens = quads + count;
    quads = other;
    below = above;
  }
}

// The run of this workgroup, with room for one more run.
void write_levels(Box own, uint count, uint quads, uint sixteens) {
  write_run(workgroup_index(), own, count, quads, sixteens);
  if (count <= kRun || count > kRun * kRun || !is_last_group()) return;
  uint over_16 = fours(fours(count));
  uint over_256 = fours(fours(over_16));
  uint lane = gl_LocalInvocationID.x;
  Box above = empty_box();
  if (lane < over_256) above = boxes[sixteens + over_16 + lane];
  write_run(0u, above, over_256, quads + fours(count) + fours(over_16),
            sixteens + over_16 + over_256);
}

#endif
