// The place of a face in Morton order: by the middle of its box, which does not depend on the order
// of its corners. It only orders: nothing certified rests on it.
#ifndef VKH_SHADERS_BASE_FACE_CODE_GLSL
#define VKH_SHADERS_BASE_FACE_CODE_GLSL

#include "shaders/math/morton.h"

vec3 face_middle(vec3 a, vec3 b, vec3 c) { return 0.5 * (min(a, min(b, c)) + max(a, max(b, c))); }

vec3 box_corner(uint key[3]) {
  return vec3(uintBitsToFloat(from_ordered_bits(key[0])),
              uintBitsToFloat(from_ordered_bits(key[1])),
              uintBitsToFloat(from_ordered_bits(key[2])));
}

// The code of a point in the cube over a box; a point outside counts as if it were on its side.
uint code_in_box(vec3 p, vec3 lo, vec3 hi) {
  vec3 extent = hi - lo;
  float side = max(extent.x, max(extent.y, extent.z));
  float scale = side > 0.0 ? 1.0 / side : 0.0;  // uncertified: order only
  return morton30((p - lo) * scale);
}

// `count`: the number of B's faces.
uint face_code(vec3 middle, CentroidBox box, uint count) {
  uint code = code_in_box(middle, box_corner(box.lo), -box_corner(box.minus_hi));
  return count <= kFewFaces ? code & (0xffffffffu << kFewFacesFirstBit) : code;
}

#endif
