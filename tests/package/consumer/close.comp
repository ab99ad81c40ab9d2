// Whether the distance is proven to be under 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "vkhausdorff_report.glsl"
layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer Reports { VkhReport report; };
layout(std430, binding = 1) writeonly buffer Answers { uint is_close; };
void main() { is_close = report.status != VKH_STATUS_INPUT && report.upper < 1.0 ? 1u : 0u; }
