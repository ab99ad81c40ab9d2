// What: a Morton code for each face of B. In: vertices, faces, box of the centroids. Out: keys[i],
// values[i] = i.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/lib/morton.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) readonly buffer BoxBlock { CentroidBox box; };
layout(scalar, binding = 3) writeonly buffer Keys { uint keys[]; };
layout(scalar, binding = 4) writeonly buffer Values { uint values[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

vec3 corner(uint key[3]) {
  return vec3(uintBitsToFloat(from_ordered_bits(key[0])),
              uintBitsToFloat(from_ordered_bits(key[1])),
              uintBitsToFloat(from_ordered_bits(key[2])));
}

void main() {
  uint i = item_index();
  if (i >= push.count) return;
  uvec3 f = faces[i];
  vec3 centre = (vertices[f.x].hi + vertices[f.y].hi + vertices[f.z].hi) *
                (1.0f / 3.0f);  // uncertified: order only
  vec3 lo = corner(box.lo);
  vec3 extent = corner(box.hi) - lo;
  float side = max(extent.x, max(extent.y, extent.z));
  float scale = side > 0.0 ? 1.0 / side : 0.0;  // uncertified: order only
  keys[i] = morton30((centre - lo) * scale);
  values[i] = i;
}
