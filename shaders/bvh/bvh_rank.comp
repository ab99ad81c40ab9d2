// Chooses, for a large B, the branches that are nodes, and their places. Nodes are the branches at
// even depth that are no leaf: at most half as many as triangles (nodes_of, engine/workspace.cpp).
// In a smaller B every branch has a place. There is one invocation per branch, which goes down to
// its branch from the root. Places are given out in the order in which invocations come, after the
// root's; nothing but their place in memory depends on that order. In: branches; next_rank = 1.
// Out: ranks, kNone where a branch is no node.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "shaders/gpu_types.h"
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Branches { Branch branches[]; };
layout(scalar, binding = 1) writeonly buffer Ranks { uint ranks[]; };
layout(scalar, binding = 2) buffer NextRank { uint next_rank; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

// The last triangle of the branch's first child, which is also the number of that child's branch.
uint split_of(Branch branch) {
  uint child = branch.child0;
  if ((child & kLeafFlag) == 0u) return child;
  return (child & (kMaxTriangles - 1u)) + ((child >> 28) & 7u);
}

// Called for a branch that is no leaf, so that no branch above it is a leaf.
bool is_at_even_depth(uint i, uint last) {
  uint at = 0u;
  uint depth = 0u;
  while (at != i && depth < kStackDepth) {
    uint split = split_of(branches[at]);
    at = last <= split ? split : split + 1u;
    ++depth;
  }
  return (depth & 1u) == 0u;
}

void main() {
  uint i = item_index();
  bool is_node = false;
  if (i > 0u && i < push.count - 1u) {
    Branch branch = branches[i];
    bool is_leaf = branch.last - branch.first < kLeafTriangles;
    is_node = !is_leaf && is_at_even_depth(i, branch.last);
  }
  uvec4 nodes = subgroupBallot(is_node);
  uint base = 0u;
  if (subgroupElect()) base = atomicAdd(next_rank, subgroupBallotBitCount(nodes));
  uint rank = subgroupBroadcastFirst(base) + subgroupBallotExclusiveBitCount(nodes);
  if (i < push.count - 1u) ranks[i] = i == 0u ? 0u : is_node ? rank : kNone;
}
