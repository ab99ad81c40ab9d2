// Draws the caption's text, and behind each level's row a bar: the pixels that it is off, at most,
// of which one is the row's width.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "examples/shaders/frame.glsl"

layout(scalar, binding = 2) readonly buffer ChoiceBlock { Choice choice; };
// Characters 32 .. 95, each five columns from the left, bit 0 at the top, a word each.
layout(scalar, binding = 5) readonly buffer Font { uint font[]; };
layout(scalar, push_constant) uniform Push {
  uvec2 origin;  // of the panel, in pixels
  uint scale;    // pixels of a dot
};

layout(location = 0) out vec4 colour;

bool dot_at(uvec2 p, uint character) {
  if (character < 32u || character > 95u || p.x >= 5u || p.y >= 7u) return false;
  return (font[5u * (character - 32u) + p.x] >> p.y & 1u) != 0u;
}

void main() {
  colour = vec4(0.010, 0.012, 0.017, 1.0);
  uvec2 p = (uvec2(gl_FragCoord.xy) - origin) / scale;
  uint row = p.y / 10u;
  uint column = p.x / 6u;
  if (row >= kRows || column >= kColumns) return;
  if (row > 0u && p.y % 10u < 9u) {
    float fill = uintBitsToFloat(choice.pixels[row - 1u]);
    vec3 bar = fill < 1.0 ? vec3(0.012, 0.13, 0.065) : vec3(0.19, 0.022, 0.022);
    bool inside = float(p.x) < min(fill, 1.0) * float(6u * kColumns);
    colour.rgb = inside ? bar : vec3(0.022, 0.025, 0.034);
  }
  uvec2 within = uvec2(p.x % 6u, p.y % 10u);
  bool text =
      within.y >= 1u && dot_at(within - uvec2(0u, 1u), choice.text[row * kColumns + column]);
  if (text) colour = vec4(1.0);
}
