// Emits a level of detail, its vertices pulled from the buffers that the engine reads too.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "examples/shaders/frame.glsl"
#include "examples/shaders/vertex.glsl"

layout(scalar, binding = 0) readonly buffer Vertices { SceneVertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Levels { Level levels[]; };
layout(scalar, binding = 2) readonly buffer ChoiceBlock { Choice choice; };
layout(scalar, binding = 3) readonly buffer Indices { uint indices[]; };
layout(scalar, push_constant) uniform Push {
  mat4 view_projection;
  vec3 eye;
  uint mode;
};

layout(location = 0) out vec3 normal;
layout(location = 1) out vec3 world;
layout(location = 2) out vec3 edge;

void main() {
  Level level = levels[mode == kModeErrors ? 0u : choice.level];
  SceneVertex v = vertices[level.first_vertex + indices[level.first_index + gl_VertexIndex]];
  normal = v.normal;
  world = v.position;
  int corner = gl_VertexIndex % 3;
  edge = vec3(corner == 0, corner == 1, corner == 2);
  gl_Position = view_projection * vec4(v.position, 1.0);
}
