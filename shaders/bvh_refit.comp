// What: every node's two boxes, each from the few pyramid boxes and triangles that cover its range.
// No node waits for another: a climb from the leaves would need its parents' two children in order,
// and takes as many steps as the tree is deep. In: triangles, boxes (bvh_pyramid), nodes' topology.
// Out: nodes' boxes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/lib/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 1) readonly buffer Boxes { Box boxes[]; };
layout(scalar, binding = 2) buffer Nodes { Node nodes[]; };
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

void main() {
  uint i = item_index();
  if (i >= max(push.count, 2u) - 1u) return;
  Node node = nodes[i];
  bool leaf = (node.child0 & kLeafFlag) != 0u;
  uint last_of_first_leaf = (node.child0 & (kMaxTriangles - 1u)) + ((node.child0 >> 28) & 7u);
  uint split = leaf ? last_of_first_leaf
                    : node.child0;  // an inner first child carries its last triangle's number
  Box b0 = range_box(node.first, split + 1u);
  Box b1 = range_box(split + 1u, node.last + 1u);
  nodes[i].lo0 = b0.lo;
  nodes[i].hi0 = b0.hi;
  nodes[i].lo1 = b1.lo;
  nodes[i].hi1 = b1.hi;
}
