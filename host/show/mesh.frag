// One sample of a face: its colour, or that of its share of the bar (palette.h), hatched where it
// is not resolved; of a disc what is in the inscribed circle.
#version 450

layout(location = 0) flat in vec4 face_colour;
layout(location = 1) noperspective in vec3 barycentric;
layout(location = 2) flat in uvec3 face_is_so;
layout(location = 3) noperspective in float bar_share;

const int kOutside = 6, kWithin = 16;

layout(push_constant) uniform Samples {
  float hatch_period;                    // period along a row, in samples
  float from, to;                        // the limits, as shares of the bar
  uint colours[2 * kOutside + kWithin];  // below, within, above; alpha of the first: bands
};

layout(location = 0) out vec4 colour;

const float kStripe = 0.42;  // share of a period
const vec3 kStripeColour = vec3(0.29, 0.25, 0.20);
const float kRim = 0.3;  // the darkness of a disc's rim, which tells it from its neighbours
const vec3 kOver = vec3(214, 32, 140) / 255, kBelow = vec3(91, 15, 128) / 255;  // map_scale.h

vec3 between(int first, int count, float share) {
  const float at = clamp(share, 0.0, 1.0) * float(count - 1);
  const int i = min(int(at), count - 2);
  return mix(unpackUnorm4x8(colours[first + i]).rgb, unpackUnorm4x8(colours[first + i + 1]).rgb,
             at - float(i));
}

vec3 bar_colour(float share) {
  if (share > 1) return kOver;
  if (share < 0) return kBelow;
  const float bands = float(colours[0] >> 24);
  if (bands > 0) share = (min(floor(share * bands), bands - 1) + 0.5) / bands;
  if (share < from) return between(0, kOutside, share / from);
  if (share > to) return between(kOutside + kWithin, kOutside, (share - to) / (1 - to));
  return between(kOutside, kWithin, to > from ? (share - from) / (to - from) : 0);
}

// The square of the distance from a regular triangle's middle: 1 on the inscribed circle.
float from_middle() {
  const vec3 off = barycentric - 1.0 / 3.0;
  return 6 * dot(off, off);
}

void main() {
  vec3 shown = face_is_so.y != 0 ? bar_colour(bar_share) * face_colour.r : face_colour.rgb;
  if (face_is_so.x != 0 && fract((gl_FragCoord.x + gl_FragCoord.y) / hatch_period) < kStripe)
    shown = kStripeColour;
  if (face_is_so.z != 0) {
    const float off = from_middle();
    if (off > 1) discard;
    shown *= 1 - kRim * off * off;
  }
  colour = vec4(shown, 1);
}
