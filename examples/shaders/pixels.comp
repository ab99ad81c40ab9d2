// Finds by how many pixels each level is off where it is off by most: a face's error over the size
// of a pixel at the nearest of its points. An invocation for each face of the finest level and each
// level. One barrier stands between the engine's errors of faces and this.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "examples/shaders/frame.glsl"
#include "examples/shaders/vertex.glsl"

layout(local_size_x = 64) in;
layout(scalar, binding = 0) readonly buffer Vertices { SceneVertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Levels { Level levels[]; };
layout(scalar, binding = 2) buffer ChoiceBlock { Choice choice; };
layout(scalar, binding = 3) readonly buffer Indices { uint indices[]; };
layout(scalar, binding = 4) readonly buffer Errors { float errors[]; };
layout(scalar, push_constant) uniform Push {
  vec3 to_eye;  // from the origin, which the camera looks at, of length 1
  float camera;
  float pixel;  // the size of a pixel at distance 1
};

void main() {
  uint face = gl_GlobalInvocationID.x;
  uint level = gl_GlobalInvocationID.y + 1u;
  Level finest = levels[0];
  uint faces = faces_of(finest);
  if (face >= faces) return;
  float depth = camera;
  for (uint k = 0u; k < 3u; ++k) {
    uint corner = indices[finest.first_index + 3u * face + k];
    depth = min(depth, camera - dot(vertices[finest.first_vertex + corner].position, to_eye));
  }
  float off = errors[error_at(level, faces, face)] / (pixel * depth);
  atomicMax(choice.pixels[level - 1u], floatBitsToUint(off));
}
