// The points that the seed queries: A's vertices and, in a warm run, the last run's witness behind
// them, wherever it is now. Include after `vertices`, `faces`, `control` and `push` are declared.
#ifndef VKH_SHADERS_LIB_SEED_GLSL
#define VKH_SHADERS_LIB_SEED_GLSL

#include "shaders/lib/root.glsl"

bool is_old_witness(uint i) { return i == push.vertex_count && push.warm != 0u; }

Two3 seed_point(uint i) {
  if (i < push.vertex_count) return vertex_at(i);
  return place(load_root(control.witness.root), uvec2(control.witness.j, control.witness.k));
}

#endif
