// The reading of files of which many are read at once.
#pragma once

#include <cstdint>
#include <string>

#include "vkhausdorff/mesh_io.h"

namespace vkh {

/// The memory per byte of a file, while it is read and as a mesh, about.
constexpr uint64_t kBytesOfAByte = 3;

/// Reads a smaller file on this thread alone: it gains little from more, and others read beside it.
ReadMesh read_one_of_many(const std::string& file, ReadLimits limits);

}  // namespace vkh
