// Draws the finest level, each face coloured by the distance from the chosen one that none of its
// points exceeds, in units of the chosen one's upper bound; the chosen one flat with its edges; or
// plain.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "examples/shaders/frame.glsl"

layout(scalar, binding = 4) readonly buffer Reports { float reports[]; };
layout(scalar, binding = 5) readonly buffer Errors { float errors[]; };
layout(scalar, binding = 1) readonly buffer Levels { Level levels[]; };
layout(scalar, binding = 2) readonly buffer ChoiceBlock { Choice choice; };
layout(scalar, push_constant) uniform Push {
  mat4 view_projection;
  vec3 eye;
  uint mode;
  uint report_words;
};

layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 world;
layout(location = 2) in vec3 edge;
layout(location = 0) out vec4 colour;

// Dark blue, teal, yellow, as in perceptual maps: lightness rises with the value.
vec3 map(float x) {
  vec3 low = vec3(0.24, 0.27, 0.62);
  vec3 middle = vec3(0.10, 0.62, 0.58);
  vec3 high = vec3(0.99, 0.88, 0.18);
  return x < 0.5 ? mix(low, middle, 2.0 * x) : mix(middle, high, 2.0 * x - 1.0);
}

void main() {
  vec3 to_eye = normalize(eye - world);
  vec3 n = mode == kModeEdges ? normalize(cross(dFdx(world), dFdy(world))) : normalize(normal);
  if (dot(n, to_eye) < 0.0) n = -n;
  vec3 light = normalize(vec3(0.4, -0.5, 0.9));
  float shade = 0.12 + 0.18 * (0.5 + 0.5 * n.z) + 0.70 * max(dot(n, light), 0.0);
  float gloss = 0.3 * pow(max(dot(n, normalize(light + to_eye)), 0.0), 40.0);
  vec3 base = vec3(0.78, 0.80, 0.84);
  if (mode == kModeErrors) {
    float error = 0.0;  // of the finest level
    if (choice.level > 0u)
      error = errors[error_at(choice.level, faces_of(levels[0]), gl_PrimitiveID)] /
              reports[(choice.level - 1u) * report_words + 1u];
    base = map(clamp(error, 0.0, 1.0));
  }
  if (mode == kModeEdges) {
    vec3 width = fwidth(edge);
    vec3 drawn = smoothstep(vec3(0.0), 1.2 * width, edge);
    base *= mix(0.35, 1.0, min(drawn.x, min(drawn.y, drawn.z)));
  }
  // The colours are given as they look on a screen, the light adds up linearly.
  colour = vec4(pow(base, vec3(2.2)) * shade + 0.5 * gloss, 1.0);
}
