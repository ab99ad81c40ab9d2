// Raises the bound of each face to the largest of its cells of some classes: a distance that none
// of their points exceeds, or one that some point reaches. In: cells, bounds, classes, wave. Out:
// face_errors, floats as bits.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/survey/score.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Cells { Cell cells[]; };
layout(scalar, binding = 1) readonly buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 2) readonly buffer Classes { uint classes[]; };
layout(scalar, binding = 3) buffer FaceErrors { uint face_errors[]; };
layout(scalar, binding = 4) readonly buffer WaveBlock { SurveyWave wave; };
layout(scalar, push_constant) uniform PushBlock { SurveyFacesPush push; };

void main() {
  uint i = item_index();
  if (i >= wave.cells || !is_among(classes[i], push.classes)) return;
  float told = push.reached != 0u ? bounds[i].reached : bounds[i].highest;
  atomicMax(face_errors[cells[i].face], bits_of(told));
}
