// Names an input by the hashes of all files that it is read from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vkhausdorff/read_limits.h"
#include "vkhausdorff/sha256.h"

namespace vkh {

/// Hashes the files beneath a mesh file (files_beneath), which is parsed for their names as far as
/// its format needs. A hash is empty where the file is missing. Throws Interrupted if
/// limits.keep_going ends it, since a list that is cut short would pass for the whole one.
std::vector<FileHash> hashes_beneath(const std::string& file, const ReadLimits& limits);

struct InputHashes {
  std::string sha256;           ///< the mesh file's; empty: not known
  std::vector<FileHash> files;  ///< the hashes of the files beneath it
  uint64_t bytes = 0;           ///< the size of all of them
};

/// Hashes a mesh file and the files beneath it. Throws Interrupted the same way.
InputHashes hashes_of_input(const std::string& file, const ReadLimits& limits);

}  // namespace vkh
