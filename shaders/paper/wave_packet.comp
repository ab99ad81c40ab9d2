// Finds the closest triangles of B to the three new points of each refined candidate, one
// invocation per candidate (docs/method.md, section 6): the points are close to each other, so that
// they share most nodes and triangles of the traversal. In: points, each with a triangle to start
// from; a negative distance means skip. Out: nearest, distance; control.maximum[kMaxLower]. It
// replaces query.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/gpu_types.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 2) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 3) buffer Points { Point points[]; };
layout(scalar, binding = 4) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };

#include "shaders/traversal/traversal.glsl"
#include "shaders/paper/packet.glsl"
#include "shaders/traversal/query.glsl"
#include "shaders/base/stream.glsl"

float answer(uint i, Query q, Nearest found) {
  found = measured(q, found, control.witness.distance);
  float distance = max(found.above, 0.0);
  answer_point(i, found.triangle, distance);
  return distance;
}

float ask(uint parent) {
  Packet p;
  uint mask = 0u;
  for (uint k = 0u; k < kPacket; ++k) {
    uint i = 3u * parent + k;
    p.query[k] = query_at(i);
    p.best[k] = nothing_near();
    if (points[i].distance < 0.0) continue;
    mask |= 1u << k;
    if (points[i].nearest != kNone) try_at_once(p.query[k], points[i].nearest, p.best[k]);
  }
  if (mask == 0u) return 0.0;
  traverse_packet(mask, p);
  float d = 0.0;
  for (uint k = 0u; k < kPacket; ++k) {
    if ((mask & (1u << k)) != 0u) d = max(d, answer(3u * parent + k, p.query[k], p.best[k]));
  }
  return d;
}

void main() {
  uint parent = item_index();
  float d = 0.0;
  if (parent < control.parents) d = ask(parent);
  raise(kMaxLower, d);
}
