// A triangle of B at its place in Morton order. The kernel declares `vertices`, `faces`,
// `triangles` (Triangle), `triangle_lows`, `push` (with a count).
#ifndef VKH_SHADERS_BVH_STORE_TRIANGLE_GLSL
#define VKH_SHADERS_BVH_STORE_TRIANGLE_GLSL

#include "shaders/bvh/box.glsl"

// Returns its box. The number is clamped: even if the sort went wrong, the triangle is one of B,
// and upper bounds from it are true.
Box store_triangle(uint i, uint face) {
  face = min(face, push.count - 1u);
  uvec3 f = faces[face];
  Vertex a = vertices[f.x];
  Vertex b = vertices[f.y];
  Vertex c = vertices[f.z];
  triangles[i].a = a.hi;
  triangles[i].b = b.hi;
  triangles[i].c = c.hi;
  triangles[i].face = face;
  triangle_lows[i] = TriangleLow(a.lo, b.lo, c.lo);
  return triangle_box(a.hi, b.hi, c.hi);
}

#endif
