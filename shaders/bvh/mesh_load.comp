// Copies a mesh from the caller's buffers (any stride, 16- or 32-bit indices) into packed
// ones. In: vertex_words, index_words, low_words as given. Out: vertices[vertex_count],
// indices[index_count], each below vertex_count.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer VertexWords { uint vertex_words[]; };
layout(scalar, binding = 1) readonly buffer IndexWords { uint index_words[]; };
layout(scalar, binding = 2) readonly buffer LowWords { uint low_words[]; };
layout(scalar, binding = 3) writeonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 4) writeonly buffer Indices { uint indices[]; };
layout(scalar, push_constant) uniform PushBlock { LoadPush push; };

void main() {
  uint i = item_index();
  if (i < push.vertex_count) {
    uint w = push.vertex_word + i * push.stride_words;
    vertices[i].hi = vec3(uintBitsToFloat(vertex_words[w]), uintBitsToFloat(vertex_words[w + 1u]),
                          uintBitsToFloat(vertex_words[w + 2u]));
    vec3 lo = vec3(0.0);
    if (push.has_low != 0u) {
      uint l = push.low_word + i * push.stride_words;
      lo = vec3(uintBitsToFloat(low_words[l]), uintBitsToFloat(low_words[l + 1u]),
                uintBitsToFloat(low_words[l + 2u]));
    }
    vertices[i].lo = lo;
  }
  if (i < push.index_count) {
    uint half_word = push.index_half + i;
    uint index = push.index_is_16bit != 0u
                     ? (index_words[half_word >> 1] >> (16u * (half_word & 1u))) & 0xffffu
                     : index_words[(push.index_half >> 1) + i];
    indices[i] = min(index, push.vertex_count - 1u);
  }
}
