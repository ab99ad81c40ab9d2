// Changes of a file that know its format: most keep what a header announces true, so that a body is
// read to its end.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vkh::test {

using MutateFile = size_t (*)(uint8_t* data, size_t size, size_t max_size, unsigned seed);

/// Lines and words are copied, dropped and exchanged; numbers become edge cases.
size_t mutate_text(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// As text, and the counts of the second line are made to fit the rows.
size_t mutate_off(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// The header or the body alone, and then counts that fit.
size_t mutate_ply(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Then the count at byte 80 is that of the bytes behind it.
size_t mutate_stl(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Numbers become edge cases, members change places; JSON stays JSON, mostly.
size_t mutate_gltf(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// The JSON or the binary chunk alone, and then lengths that fit.
size_t mutate_glb(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Numbers become edge cases, elements change places; most of it stays XML.
size_t mutate_xml(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// By what the content looks like.
size_t mutate_any(uint8_t* data, size_t size, size_t max_size, unsigned seed);

}  // namespace vkh::test
