// Triangles of B as surfaces to measure against, low parts included where the meshes have them.
// The kernel declares `triangles`, `triangle_lows`, `control`.
#ifndef VKH_SHADERS_BASE_SURFACE_GLSL
#define VKH_SHADERS_BASE_SURFACE_GLSL

#include "shaders/base/fetch.glsl"

// Triangle i as the run measures it.
struct Exact {
  Two3 a, b, c;
};

Exact load_exact(uint i) {
  TriangleLow low = TriangleLow(vec3(0.0), vec3(0.0), vec3(0.0));
  if (control.two_float != 0u) {
    low.a = triangle_lows[i].a;
    low.b = triangle_lows[i].b;
    low.c = triangle_lows[i].c;
  }
  Corners t = triangle_corners(i);
  return Exact(Two3(t.a, low.a), Two3(t.b, low.b), Two3(t.c, low.c));
}

Surface load_surface(uint i, View from) {
  Exact t = load_exact(i);
  return make_surface(t.a, t.b, t.c, from);
}

// Compares bit by bit, with 0 equal to -0: devices may flush floats that they compare.
bool is_same(vec3 p, vec3 q) {
  uvec3 u = floatBitsToUint(p);
  uvec3 v = floatBitsToUint(q);
  uvec3 zero = uvec3(equal((u | v) << 1, uvec3(0u)));
  return all(bvec3(zero | uvec3(equal(u, v))));
}

bool is_same(Two3 p, Two3 q) { return both(is_same(p.hi, q.hi), is_same(p.lo, q.lo)); }

bool is_corner(Two3 p, Exact t) {
  return either(is_same(p, t.a), either(is_same(p, t.b), is_same(p, t.c)));
}

// Whether each corner of a triangle is one of triangle i: then it lies in triangle i, and its
// distance from B is 0, however distances round.
bool lies_in(Two3 p, Two3 q, Two3 r, uint i) {
  Exact t = load_exact(i);
  return is_corner(p, t) && is_corner(q, t) && is_corner(r, t);
}

// A surface for measuring one point as precisely as possible.
View view_from(Two3 p, float base, bool fine) {
  return View(p, norm_up(p.hi), base, true, false, 0.0, fine);
}

#endif
