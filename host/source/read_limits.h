// What reading a file may cost.
#pragma once

#include <cstdint>
#include <functional>

namespace vkh {

/// What a file may cost, and who may call its reading off.
struct ReadLimits {
  /// Bytes that a file may have, and that its mesh may take (mesh_bytes). A file that breaks it is
  /// refused before the work. Reading takes at most six times the larger of both, and so at most
  /// six times this (read_cost_test), besides a megabyte.
  uint64_t max_input_bytes = UINT64_MAX;
  /// Asked now and then while a file is read, perhaps on another thread: false ends it with an
  /// Interrupted.
  std::function<bool()> keep_going = {};
};

/// Of a mesh as a file gives it, with vertices that no face uses: 24 bytes a vertex, 12 a face.
uint64_t mesh_bytes(uint64_t vertex_count, uint64_t face_count);

}  // namespace vkh
