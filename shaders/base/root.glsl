// Faces of A as roots. The kernel declares `vertices`, `faces`.
#ifndef VKH_SHADERS_BASE_ROOT_GLSL
#define VKH_SHADERS_BASE_ROOT_GLSL

#include "shaders/math/bary.h"

Two3 vertex_at(uint i) { return Two3(vertices[i].hi, vertices[i].lo); }

Root load_root(uint face) {
  uvec3 f = faces[face];
  return make_root(vertex_at(f.x), vertex_at(f.y), vertex_at(f.z));
}

#endif
