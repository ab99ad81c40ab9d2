// What: every node, one a branch: a branch's grandchildren, or children that are leaves, each with
// its box from the few pyramid boxes and triangles that cover its range. No node waits for another:
// a climb from the leaves would need its parents' children in order, and takes as many steps as the
// tree is deep. In: triangles, boxes (bvh_pyramid), branches. Out: nodes; those of branches at odd
// depth are never read.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/lib/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 1) readonly buffer Boxes { Box boxes[]; };
layout(scalar, binding = 2) readonly buffer Branches { Branch branches[]; };
layout(scalar, binding = 3) writeonly buffer Nodes { Node nodes[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

#include "shaders/lib/box.glsl"

// Box `i` of a level: level 0 is the triangles, later ones start at `start` in boxes.
Box box_at(uint level, uint start, uint i) {
  if (level == 0u) return triangle_box(i);
  return boxes[start + i];
}

// Joins the ends of [first, end) that do not fill a box of the level above, then goes on with that
// level.
Box range_box(uint first, uint end) {
  Box b = empty_box();
  uint start = 0u;
  uint level_count = push.count;
  for (uint level = 0u; first < end; ++level) {
    while (first < end && first % kPyramidFan != 0u) b = joined(b, box_at(level, start, first++));
    while (first < end && end % kPyramidFan != 0u) b = joined(b, box_at(level, start, --end));
    first /= kPyramidFan;  // uncertified: integers
    end /= kPyramidFan;    // uncertified: integers
    if (level > 0u) start += level_count;
    level_count = (level_count + kPyramidFan - 1u) / kPyramidFan;  // uncertified: integers
  }
  return b;
}

struct Range {
  uint first, last;
};

Range range_of(uint child) {
  if ((child & kLeafFlag) == 0u) return Range(branches[child].first, branches[child].last);
  uint first = child & (kMaxTriangles - 1u);
  return Range(first, first + ((child >> 28) & 7u));
}

void write_child(uint node, uint place, uint child) {
  Box b = empty_box();
  if (child != kNone) {
    Range r = range_of(child);
    b = range_box(r.first, r.last + 1u);
  }
  nodes[node].child[place] = Child4(b.lo, child, b.hi, 0u);
}

// A child of the branch: itself, or its own two in its place.
void write_pair(uint node, uint place, uint child) {
  bool leaf = (child & kLeafFlag) != 0u;
  uint second = kNone;
  if (!leaf) {
    second = branches[child].child1;
    child = branches[child].child0;
  }
  write_child(node, place, child);
  write_child(node, place + 1u, second);
}

void main() {
  uint i = item_index();
  if (i >= max(push.count, 2u) - 1u) return;
  // What is within a leaf is never read.
  if (i > 0u && branches[i].last - branches[i].first < kLeafTriangles) return;
  write_pair(i, 0u, branches[i].child0);
  write_pair(i, 2u, push.count == 1u ? kNone : branches[i].child1);
}
