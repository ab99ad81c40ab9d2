// Checks whether the caller's buffers hold a mesh, one corner of a face per item. In: vertex_words,
// index_words, low_words as given to mesh_load. Out: one of fault_words, the least face with an
// index out of range, or with a coordinate that is not finite, is beyond 2^15, or has a low part of
// more than half an ulp; otherwise it stays. Vertices that no face uses are no part of the mesh.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer VertexWords { uint vertex_words[]; };
layout(scalar, binding = 1) readonly buffer IndexWords { uint index_words[]; };
layout(scalar, binding = 2) readonly buffer LowWords { uint low_words[]; };
layout(scalar, binding = 3) buffer FaultWords { uint fault_words[]; };
layout(scalar, push_constant) uniform PushBlock { LoadPush push; };

uint index_at(uint i) {
  if (push.index_is_16bit == 0u) return index_words[(push.index_half >> 1) + i];
  uint half_word = push.index_half + i;
  return (index_words[half_word >> 1] >> (16u * (half_word & 1u))) & 0xffffu;
}

// Compares bits: those of NaN and infinity are above all others, and no operation rounds or
// flushes. Half an ulp of a float of exponent e is 2^(e - 24), as bits e - 24 in the exponent; of a
// number under 2^-102 no more than 2^-127 is asked, which no result depends on.
bool is_coordinate(uint high, uint low) {
  uint magnitude = high & 0x7fffffffu;
  uint exponent = magnitude >> 23;
  uint most_low = exponent > 24u ? (exponent - 24u) << 23 : 0x00400000u;
  return magnitude <= kLargestCoordinate && (low & 0x7fffffffu) <= most_low;
}

bool is_vertex(uint v) {
  if (v >= push.vertex_count) return false;
  uint high = push.vertex_word + v * push.stride_words;
  uint low = push.low_word + v * push.stride_words;
  for (uint i = 0u; i < 3u; ++i) {
    uint low_bits = push.has_low != 0u ? low_words[low + i] : 0u;
    if (!is_coordinate(vertex_words[high + i], low_bits)) return false;
  }
  return true;
}

void main() {
  uint i = item_index();
  if (i >= push.index_count || is_vertex(index_at(i))) return;
  atomicMin(fault_words[push.fault_word], i / 3u);
}
