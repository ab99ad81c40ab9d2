// Changes of a file that know its format: most keep the header's counts true, so that a body is
// read to its end.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vkh::test {

using MutateFile = size_t (*)(uint8_t* data, size_t size, size_t max_size, unsigned seed);

/// Lines and words are copied, dropped and exchanged; numbers become edge cases.
size_t mutate_text(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Changes it as text, and makes the counts of the second line fit the rows.
size_t mutate_off(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Changes only the header or the body, and then makes the counts fit.
size_t mutate_ply(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Changes bytes, and sets the count at byte 80 to that of the bytes behind it.
size_t mutate_stl(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Changes bytes, and sets the counts of a LAS header to that of the records behind it.
size_t mutate_las(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Numbers become edge cases, members change places; JSON stays JSON, mostly.
size_t mutate_gltf(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Changes only the JSON or the binary chunk, and then makes the lengths fit.
size_t mutate_glb(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Numbers become edge cases, elements change places; most of it stays XML.
size_t mutate_xml(uint8_t* data, size_t size, size_t max_size, unsigned seed);
/// Chooses by the appearance of the content.
size_t mutate_any(uint8_t* data, size_t size, size_t max_size, unsigned seed);

}  // namespace vkh::test
