// Decides which boxes of B's hierarchy may hold a triangle that is closest somewhere on a cell.
#ifndef VKH_SHADERS_REPORT_CELL_BOXES_GLSL
#define VKH_SHADERS_REPORT_CELL_BOXES_GLSL

#include "shaders/report/cell.h"

// A box is off by the low parts of what is in it and of the point, an ulp of each, and its distance
// by its own rounding.
float box_doubt(CellFrame t, float distance) {
  return 4.0 * kUlp * (t.reach + t.radius + distance);
}

// Boxes at this distance, squared, or farther hold nothing that is closest anywhere on T, which is
// nowhere farther from B than `highest`.
float cell_reach(float highest, CellFrame t) {
  float far = round_up(highest + t.radius, 4.0);
  far = round_up(far + box_doubt(t, far), 8.0);
  return min(round_up(far * far, 8.0), 3.0e38);
}

#endif
