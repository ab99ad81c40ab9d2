// Builds the topology of B's BVH over the sorted Morton keys, every inner node at once (Karras
// 2012, "Maximizing Parallelism in the Construction of BVHs, Octrees, and k-d Trees"). Ties are
// broken by position, so that keys are distinct and a path from the root shares a prefix that grows
// by a bit a level (kStackDepth). In: keys[count], sorted. Out: branches[max(count - 1, 1)].
// A child of at most kLeafTriangles triangles is referenced as a leaf; its own inner nodes
// stay behind, unreachable.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Keys { uint keys[]; };
layout(scalar, binding = 1) writeonly buffer Branches { Branch branches[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

// Length of the common prefix of keys i and j; -1 where j is out of range.
int prefix(int i, int j) {
  if (j < 0 || j >= int(push.count)) return -1;
  uint difference = keys[i] ^ keys[j];
  if (difference != 0u) return 31 - findMSB(difference);
  return 32 + 31 - findMSB(uint(i ^ j));
}

// Searches probe several places at a time, whose loads do not wait for each other: for a small mesh
// the longest chain of one invocation decides the time.
const int kProbes = 3;

// The largest s under `span` with prefix(i, i + s * direction) > least, where that holds for 0, not
// for `span`, and up to some s only.
int farthest(int i, int direction, int least, int span) {
  int s = 0;
  while (span > 1) {
    span = (span + kProbes) / (kProbes + 1);
    int beyond = 0;
    for (int k = 1; k <= kProbes; ++k)
      beyond += prefix(i, i + (s + k * span) * direction) > least ? span : 0;
    s += beyond;
  }
  return s;
}

// The other end of the range that node i covers, which grows in this direction.
int range_end(int i, int direction) {
  int least = prefix(i, i - direction);
  int reach = 2;
  int longer = kProbes;
  while (longer == kProbes) {
    longer = 0;
    for (int k = 0; k < kProbes; ++k)
      longer += prefix(i, i + (reach << k) * direction) > least ? 1 : 0;
    reach <<= longer;
  }
  return i + farthest(i, direction, least, reach) * direction;
}

// The last triangle of the first child of a node over [first, last].
int split_of(int first, int last) {
  return first + farthest(first, 1, prefix(first, last), last - first);
}

// Reference to the child over [first, last] whose inner node would be `inner`.
uint child_over(int first, int last, uint inner) {
  uint triangle_count = uint(last - first + 1);
  if (triangle_count <= kLeafTriangles)
    return kLeafFlag | ((triangle_count - 1u) << 28) | uint(first);
  return inner;
}

void main() {
  int i = int(item_index());
  if (i >= max(int(push.count) - 1, 1)) return;
  if (push.count == 1u) {  // one leaf, which both children refer to
    branches[0] = Branch(kLeafFlag, kLeafFlag, 0u, 0u);
    return;
  }
  int direction = prefix(i, i + 1) > prefix(i, i - 1) ? 1 : -1;
  int end = range_end(i, direction);
  int first = min(i, end);
  int last = max(i, end);
  int split = split_of(first, last);
  branches[i] = Branch(child_over(first, split, uint(split)),
                       child_over(split + 1, last, uint(split + 1)), uint(first), uint(last));
}
