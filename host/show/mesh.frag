// One sample of a face: its colour, hatched where it is undecided, darker along its edges.
#version 450

layout(location = 0) flat in vec4 face_colour;
layout(location = 1) noperspective in vec3 barycentric;
layout(location = 2) flat in uint face_hatched;

layout(push_constant) uniform Samples {
  float half_edge;     // half of an edge's width, in samples
  float hatch_period;  // period along a row, in samples
};

layout(location = 0) out vec4 colour;

const float kStripe = 0.42;  // share of a period
const vec3 kStripeColour = vec3(0.29, 0.25, 0.20);

float nearest_edge() {
  const vec3 across =
      sqrt(dFdx(barycentric) * dFdx(barycentric) + dFdy(barycentric) * dFdy(barycentric));
  const vec3 samples = barycentric / max(across, vec3(1e-20));
  return min(min(samples.x, samples.y), samples.z);
}

void main() {
  const float edge = nearest_edge();
  vec3 shown = face_colour.rgb;
  if (face_hatched != 0 && fract((gl_FragCoord.x + gl_FragCoord.y) / hatch_period) < kStripe)
    shown = kStripeColour;
  if (edge < half_edge) shown *= 1 - face_colour.a;
  colour = vec4(shown, 1);
}
