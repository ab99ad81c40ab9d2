// The reading of files of which many are read at once.
#pragma once

#include <cstdint>
#include <string>

#include "vkhausdorff/mesh_io.h"

namespace vkh {

/// About the memory per byte of a file, while it is read and as a mesh.
constexpr uint64_t kBytesOfAByte = 3;

/// Reads a small file on this thread alone: it gains little from more threads, and other files are
/// read at the same time.
ReadMesh read_one_of_many(const std::string& file, ReadLimits limits);

}  // namespace vkh
