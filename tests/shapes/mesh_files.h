// Mesh files of every format that is read, in memory.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vkh::test {

struct File {
  std::string name, bytes;
};

/// A grid of n by n cells as text of each format, with fans, continued lines, relative indices and
/// vertices that nothing uses.
std::vector<File> good_files(size_t n);

/// The second of every two parts that threads take has the first one's corners in reverse: both
/// threads meet half of them first.
File mirrored_stl(size_t triangles);

/// Text and binary, of both byte orders; triangles, quads and other polygons; with other columns,
/// elements, and litter behind.
std::vector<File> all_good_files();

}  // namespace vkh::test
