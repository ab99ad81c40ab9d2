// Measures how far each vertex of the finest level is from the chosen one, for the colour: the
// smallest distance to a triangle of the 3 x 3 cells around its parameters. It is for the eye; the
// bounds are the engine's.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "examples/shaders/frame.glsl"
#include "examples/shaders/vertex.glsl"

layout(local_size_x = 64) in;
layout(scalar, binding = 0) buffer Vertices { SceneVertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Levels { Level levels[]; };
layout(scalar, binding = 2) readonly buffer ChoiceBlock { Choice choice; };

float segment2(vec3 p, vec3 a, vec3 b) {
  vec3 d = p - mix(a, b, clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0));
  return dot(d, d);
}

float triangle2(vec3 p, vec3 a, vec3 b, vec3 c) {
  vec3 n = cross(b - a, c - a);
  bool inside = dot(cross(n, b - a), p - a) >= 0.0 && dot(cross(n, c - b), p - b) >= 0.0 &&
                dot(cross(n, a - c), p - c) >= 0.0;
  float height = dot(p - a, n);
  if (inside) return height * height / dot(n, n);
  return min(segment2(p, a, b), min(segment2(p, b, c), segment2(p, c, a)));
}

vec3 corner(Level level, uint u, uint v) {
  return vertices[level.first_vertex + v % level.cells_v * level.cells_u + u % level.cells_u]
      .position;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  Level finest = levels[0];
  if (i >= finest.cells_u * finest.cells_v) return;
  Level level = levels[choice.level];
  vec3 p = vertices[finest.first_vertex + i].position;
  uint u = i % finest.cells_u * level.cells_u / finest.cells_u + level.cells_u - 1u;
  uint v = i / finest.cells_u * level.cells_v / finest.cells_v + level.cells_v - 1u;
  float nearest2 = 1e30;
  for (uint k = 0u; k < 9u; ++k) {
    vec3 a = corner(level, u + k % 3u, v + k / 3u);
    vec3 b = corner(level, u + k % 3u + 1u, v + k / 3u);
    vec3 c = corner(level, u + k % 3u + 1u, v + k / 3u + 1u);
    vec3 d = corner(level, u + k % 3u, v + k / 3u + 1u);
    nearest2 = min(nearest2, min(triangle2(p, a, b, c), triangle2(p, a, c, d)));
  }
  vertices[finest.first_vertex + i].distance = sqrt(nearest2);
}
