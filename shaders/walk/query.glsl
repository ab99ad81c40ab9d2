// Queries of a stream of points. The kernel declares `points`, and what walk/walk.glsl needs.
#ifndef VKH_SHADERS_WALK_QUERY_GLSL
#define VKH_SHADERS_WALK_QUERY_GLSL

#include "shaders/walk/walk.glsl"

// What an invocation knows of its item, and whether a walk is to find more.
struct Item {
  bool exists;  // it is to be answered
  bool asked;
  uint nearest;    // where a walk starts; then what it found
  float distance;  // above the base
  Query query;
};

Query query_at(uint i) {
  return Query(Two3(points[i].position, points[i].position_lo), control.base, control.tight != 0u);
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
