// Queries of a stream of points. The kernel declares `points`, and what traversal/traversal.glsl
// needs.
#ifndef VKH_SHADERS_TRAVERSAL_QUERY_GLSL
#define VKH_SHADERS_TRAVERSAL_QUERY_GLSL

#include "shaders/base/switches.glsl"
#include "shaders/traversal/traversal.glsl"

// An invocation's knowledge of its item, and whether a traversal must find more.
struct Item {
  bool exists;  // it is to be answered
  bool asked;
  uint nearest;    // start of a traversal; then its result
  float distance;  // above the base
  Query query;
};

Query query_at(uint i) {
  return Query(Two3(points[i].position, points[i].position_lo), control.base, control.tight != 0u,
               has_subroots() && control.base == 0.0);
}

Item point_item(uint i, bool mine) {
  bool asked = mine && points[i].distance >= 0.0;
  return Item(asked, asked, points[i].nearest, 0.0, query_at(i));
}

void answer_point(uint i, uint nearest, float distance) {
  points[i].nearest = nearest;
  points[i].distance = distance;
}

#endif
