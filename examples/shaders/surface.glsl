// The shape that both examples deform: a torus with ripples that run around it.
#ifndef VKH_EXAMPLES_SURFACE_GLSL
#define VKH_EXAMPLES_SURFACE_GLSL

const float kTau = 6.28318530718;

vec3 surface_point(float u, float v, float time) {
  float ripple = 0.16 * sin(5.0 * u + 2.0 * time) * cos(2.0 * v - time) +
                 0.07 * sin(9.0 * u - 3.0 * v + 1.7 * time);
  float tube = 0.42 * (1.0 + ripple);
  float ring = 1.0 + tube * cos(v);
  return vec3(ring * cos(u), ring * sin(u), tube * sin(v) + 0.12 * sin(2.0 * u + time));
}

#endif
