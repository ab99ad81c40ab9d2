// Queries of a stream of points. Include after `points` is declared and lib/bvh.glsl is included.
#ifndef VKH_SHADERS_LIB_QUERY_GLSL
#define VKH_SHADERS_LIB_QUERY_GLSL

Query query_at(uint i) {
  return Query(Two3(points[i].position, points[i].position_lo), control.base, control.tight != 0u);
}

float answer(uint i, Nearest found) {
  // Not kMaxLower: others raise it at the same time.
  float d = max(measured(query_at(i), found, control.witness.distance).above, 0.0);
  points[i].nearest = found.triangle;
  points[i].distance = d;
  return d;
}

#endif
