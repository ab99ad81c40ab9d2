// Picks the coarsest level that is off by less than a pixel everywhere, writes its draw command,
// and the caption, with the engine's reports where the engine wrote them. It is one invocation. The
// host takes no part.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "examples/shaders/frame.glsl"

layout(local_size_x = 1) in;
layout(scalar, binding = 0) readonly buffer Reports { float reports[]; };
layout(scalar, binding = 1) readonly buffer Levels { Level levels[]; };
layout(scalar, binding = 2) buffer ChoiceBlock { Choice choice; };
layout(scalar, push_constant) uniform Push {
  uint report_words;  // from one report to the next
  uint frame;
  float camera;  // distance of the camera
  float pixel;   // size of a pixel there
};

uint at;  // place of the next character

void put(uint character) { choice.text[at++] = character; }

// `digits` digits, `decimals` of them after the point.
void put_number(uint value, uint digits, uint decimals) {
  uint divisor = 1u;
  for (uint i = 1u; i < digits; ++i) divisor *= 10u;
  for (uint left = digits; left > 0u; --left, divisor /= 10u) {
    if (left == decimals) put(46u);
    put(48u + value / divisor % 10u);
  }
}

void put_word(uint a, uint b, uint c, uint d) {
  put(a);
  put(b);
  put(c);
  put(d);
}

float lower_of(uint level) { return reports[(level - 1u) * report_words]; }
float upper_of(uint level) { return reports[(level - 1u) * report_words + 1u]; }

// "L1 02304 FACES  H IN 0.00362..0.00371  00.35 PX<", bounds rounded outward, to five decimals.
void write_row(uint level) {
  at = level * kColumns;
  put(76u);
  put(48u + level);
  put(32u);
  put_number(faces_of(levels[level]), 5u, 0u);
  put_word(32u, 70u, 65u, 67u);
  put_word(69u, 83u, 32u, 32u);
  put_word(72u, 32u, 73u, 78u);
  put(32u);
  put_number(uint(max(floor(lower_of(level) * 1e5 * 0.999999), 0.0)), 6u, 5u);
  put(46u);
  put(46u);
  put_number(uint(min(ceil(upper_of(level) * 1e5 * 1.000001), 999999.0)), 6u, 5u);
  put(32u);
  put(32u);
  put_number(uint(min(ceil(100.0 * uintBitsToFloat(choice.pixels[level - 1u])), 9999.0)), 4u, 2u);
  put_word(32u, 80u, 88u, level == choice.level ? 60u : 32u);
}

// "FRAME 012  CAMERA 07.32  PIXEL 0.01045  DRAWN L2"
void write_head() {
  at = 0u;
  put_word(70u, 82u, 65u, 77u);
  put_word(69u, 32u, 48u + frame / 100u % 10u, 48u + frame / 10u % 10u);
  put_word(48u + frame % 10u, 32u, 32u, 67u);
  put_word(65u, 77u, 69u, 82u);
  put(65u);
  put(32u);
  put_number(uint(camera * 100.0), 4u, 2u);
  put_word(32u, 32u, 80u, 73u);
  put_word(88u, 69u, 76u, 32u);
  put_number(uint(pixel * 1e5), 6u, 5u);
  put_word(32u, 32u, 68u, 82u);
  put_word(65u, 87u, 78u, 32u);
  put(76u);
  put(48u + choice.level);
}

void main() {
  for (uint i = 0u; i < kRows * kColumns; ++i) choice.text[i] = 32u;
  choice.level = 0u;
  for (uint level = 1u; level < kLevels; ++level) {
    if (uintBitsToFloat(choice.pixels[level - 1u]) < 1.0) choice.level = level;
  }
  choice.draw = DrawCommand(3u * faces_of(levels[choice.level]), 1u, 0u, 0u);
  write_head();
  for (uint level = 1u; level < kLevels; ++level) write_row(level);
}
