// For --verify: the part of each face of A that has been closed, as an exact 64-bit integer, in
// units of 2^-40 of the face. A part that became a subroot (wave/subroot.glsl) counts as
// closed from then on, and is not counted again. All of this compiles to nothing if kUseCoverage is
// off. The kernel declares `areas`, `control`.
#ifndef VKH_SHADERS_BASE_COVERAGE_GLSL
#define VKH_SHADERS_BASE_COVERAGE_GLSL

#include "shaders/base/switches.glsl"
#include "shaders/math/bary.h"

// The cross product of two edges: 2^40 for a whole root. Children keep their parent's orientation,
// so it is never negative.
Area area_of(Bary3 t) {
  ivec2 u = ivec2(t.b) - ivec2(t.a);
  ivec2 v = ivec2(t.c) - ivec2(t.a);
  int hi0, lo0, hi1, lo1;
  imulExtended(u.x, v.y, hi0, lo0);
  imulExtended(u.y, v.x, hi1, lo1);
  uint borrow = uint(lo0) < uint(lo1) ? 1u : 0u;
  return Area(uint(lo0) - uint(lo1), uint(hi0) - uint(hi1) - borrow);
}

// Adds in two words of 32 bits: every addition that wraps the low one carries, so their order does
// not matter.
void add_area(uint at, Bary3 t) {
  Area area = area_of(t);
  uint before = atomicAdd(areas[at].lo, area.lo);
  uint carried = area.hi + (before + area.lo < before ? 1u : 0u);
  if (carried > 0u) atomicAdd(areas[at].hi, carried);
}

void close_area(bool closed, uint root, Bary3 t) {
  if ((kSwitches & kUseCoverage) != 0u && closed && root < control.face_count) add_area(root, t);
}

#endif
