// Computes every node, one per branch or, in a large B, per branch that bvh_rank chose: a branch's
// grandchildren, or children that are leaves, each with its box from the few pyramid boxes and
// triangles that cover its range. No node waits for another: a climb from the leaves would need its
// parents' children in order, and takes as many steps as the tree is deep. There is one invocation
// per child. In: triangles, boxes (bvh_leaves, bvh_pyramid), branches, ranks. Out: nodes; those of
// branches at odd depth are never read.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 1) readonly buffer Boxes { vec2 boxes[]; };
layout(scalar, binding = 2) readonly buffer Branches { Branch branches[]; };
layout(scalar, binding = 3) writeonly buffer Nodes { Node nodes[]; };
layout(scalar, binding = 4) readonly buffer Ranks { uint ranks[]; };
layout(scalar, push_constant) uniform PushBlock { RefitPush push; };

#include "shaders/bvh/box.glsl"
#include "shaders/base/fetch.glsl"

struct Range {
  uint first, last;
};

// A range of up to 2 kEnd boxes is covered by kEnd boxes from either end. In a larger range, at
// most kEnd boxes are left over at either end of its boxes of four.
const uint kEnd = 3u;

Box box_of_triangle(uint i) {
  Corners t = triangle_corners(i);
  return triangle_box(t.a, t.b, t.c);
}

// Reads a box in three 8-byte loads.
Box box_at(uint i) {
  vec2 x = boxes[3u * i];
  vec2 y = boxes[3u * i + 1u];
  vec2 z = boxes[3u * i + 2u];
  return Box(vec3(x, y.x), vec3(y.y, z));
}

// The ends of a range of triangles, and of boxes of the level that starts at `start`. Joining a box
// twice does no harm, so no load waits for another or for a test.
Box triangle_ends(Range r) {
  Box b = empty_box();
  for (uint k = 0u; k < kEnd; ++k) {
    b = joined(b, box_of_triangle(min(r.first + k, r.last)));
    b = joined(b, box_of_triangle(max(r.last, r.first + k) - k));
  }
  return b;
}

Box box_ends(uint start, Range r) {
  Box b = empty_box();
  for (uint k = 0u; k < kEnd; ++k) {
    b = joined(b, box_at(start + min(r.first + k, r.last)));
    b = joined(b, box_at(start + max(r.last, r.first + k) - k));
  }
  return b;
}

// The boxes of four that lie in a range of more than 2 * kEnd boxes, which has at least one.
Range fours_within(Range r) { return Range((r.first + 3u) / 4u, (r.last + 1u) / 4u - 1u); }

Box range_box(Range r) {
  Box b = triangle_ends(r);
  uint count = push.count;
  uint start = push.quads;
  uint next = 0u;  // start of the level after that: levels over 4, 64, .. stand apart
  while (r.last - r.first >= 2u * kEnd) {
    r = fours_within(r);
    b = joined(b, box_ends(start, r));
    count = (count + 3u) / 4u;
    uint after = start + count;
    start = next;
    next = after;
  }
  return b;
}

Range range_of(uint child) {
  if ((child & kLeafFlag) == 0u) return Range(branches[child].first, branches[child].last);
  uint first = child & (kMaxTriangles - 1u);
  return Range(first, first + ((child >> 28) & 7u));
}

// Place 0 to 3 of a branch's node: each child itself, or its own two in its place.
uint child_at(Branch branch, uint place) {
  uint child = place < 2u ? branch.child0 : branch.child1;
  bool second = (place & 1u) != 0u;
  if ((child & kLeafFlag) != 0u) return second ? kNone : child;
  return second ? branches[child].child1 : branches[child].child0;
}

// The place of a branch's node.
uint place_of(uint i) { return push.ranked != 0u ? ranks[i] : i; }

void main() {
  uint i = item_index() >> 2;
  uint place = item_index() & 3u;
  if (i >= max(push.count, 2u) - 1u) return;
  Branch branch = branches[i];
  // A branch within a leaf is never read.
  if (i > 0u && branch.last - branch.first < kLeafTriangles) return;
  uint at = place_of(i);
  if (at == kNone) return;
  uint child = child_at(branch, place);
  if (push.count == 1u && place > 0u) child = kNone;
  Box b = empty_box();
  if (child != kNone) b = range_box(range_of(child));
  if ((child & kLeafFlag) == 0u) child = place_of(child);
  nodes[at].child[place] = Child4(b.lo, child, b.hi, 0u);
}
