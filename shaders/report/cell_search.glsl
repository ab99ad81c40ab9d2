// Goes through the triangles of B in some boxes: the boxes that a ray from a cell meets, or the
// boxes that may be closest somewhere on the cell. The kernel declares `nodes` and look_at().
#ifndef VKH_SHADERS_REPORT_CELL_SEARCH_GLSL
#define VKH_SHADERS_REPORT_CELL_SEARCH_GLSL

#include "shaders/report/cell_boxes.glsl"

const uint kNoAxis = 3u;

struct Search {
  uint axis;  // of the ray
  vec3 least,
      most;  // the ray meets a box that does not end before `least` and does not begin behind
             // `most`
  vec3 centre;
  float reach;  // squared
};

// The vertices of both meshes may be `moved`.
Search search_near(CellFrame t, float highest, float moved) {
  return Search(kNoAxis, vec3(0.0), vec3(0.0), t.origin.hi, cell_reach(highest + 2.0 * moved, t));
}

bool may_hold(Search s, vec3 lo, vec3 hi) {
  if (s.axis != kNoAxis)
    return all(greaterThanEqual(hi, s.least)) && all(lessThanEqual(lo, s.most));
  vec3 d = max(max(lo - s.centre, s.centre - hi), vec3(0.0));
  return dot3(d, d) < s.reach;
}

// Looks at a triangle. Returns whether to go on.
bool look_at(uint triangle, Search s, CellFrame t);

const uint kSearchStack = 3u * kStackDepth / 2u + 1u;
uint waiting[kSearchStack];

const uint kSeenAll = 0u;     // it looked at all triangles,
const uint kSeenEnough = 1u;  // until look_at() ended it;
const uint kSeenSome = 2u;    // or at some triangles, since the driver ended the loop

// Drivers may end a loop early (docs/certificate.md, 'Loops that a driver ends'): the loop's work
// is counted, and not by the variable that ends it, which compilers take as known behind it.
uint look_through(Search s, CellFrame t) {
  bool goes_on = true;
  uint promised = 1u;
  uint done = 0u;
  uint left = 1u;
  waiting[0] = 0u;
  while (left > 0u && goes_on) {
    uint at = waiting[--left];
    ++done;
    if ((at & kLeafFlag) != 0u) {
      uint first = at & (kMaxTriangles - 1u);
      uint last = first + ((at >> 28) & 7u);
      promised += last - first + 1u;
      for (uint i = first; i <= last; ++i) {
        if (goes_on) goes_on = look_at(i, s, t);
        ++done;
      }
      continue;
    }
    for (uint k = 0u; k < 4u; ++k) {
      uvec4 lo = nodes[kNodeWords * at + 2u * k];
      uvec4 hi = nodes[kNodeWords * at + 2u * k + 1u];
      if (!may_hold(s, uintBitsToFloat(lo.xyz), uintBitsToFloat(hi.xyz))) continue;
      waiting[left++] = lo.w;
      ++promised;
    }
  }
  if (!goes_on) return kSeenEnough;
  return done == promised ? kSeenAll : kSeenSome;
}

#endif
