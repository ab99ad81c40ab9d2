// Boxes of sorted triangles.
#ifndef VKH_SHADERS_BVH_BOX_GLSL
#define VKH_SHADERS_BVH_BOX_GLSL

Box empty_box() { return Box(vec3(3.0e38), vec3(-3.0e38)); }

Box joined(Box x, Box y) { return Box(min(x.lo, y.lo), max(x.hi, y.hi)); }

Box triangle_box(vec3 a, vec3 b, vec3 c) { return Box(min(a, min(b, c)), max(a, max(b, c))); }

#endif
