// The limits of what reading a file may cost.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "vkhausdorff/polygon.h"

namespace vkh {

/// The choices for polygons whose outline crosses itself, encloses no area or is too intricate.
enum class OddPolygons {
  kRefused,  ///< its face is named in an InputError
  kFanned,   ///< the fan of its corners is measured, though it may cover other points, and noted
};

/// The choices of which shapes of a scene are measured.
enum class Bodies {
  kSolid,  ///< shapes that are printed as bodies, or shown; the others are counted in a note
  kAll,    ///< every shape as it lies; a note counts the shapes that are no bodies
};

/// Expected in errors about a file that breaks max_input_bytes.
inline constexpr const char* kLessInput = "a smaller file, or a greater limit (--max-input)";

/// Limits what a file may cost, chooses what of it is read, and lets reading be called off.
struct ReadLimits {
  /// Bytes that a file may have, and that its mesh may take (mesh_bytes). A file that breaks it is
  /// refused before the work. Reading takes at most six times the larger of both, and so at most
  /// six times this (read_cost_test), besides a megabyte.
  uint64_t max_input_bytes = UINT64_MAX;
  OddPolygons odd_polygons = OddPolygons::kRefused;
  /// Adds Polygons::ambiguity to Mesh::delta: the answer is of every triangulation of the outlines.
  bool any_triangulation = false;
  /// Makes triangles of a polygon, in place of triangulate_fan: of the file's face with this
  /// number, whose fan it replaces. Called by several threads; its exception ends the reading.
  std::function<PolygonResult(uint64_t face, std::span<const DVec3> vertices, std::span<UVec3> fan)>
      triangulate = {};
  Bodies bodies = Bodies::kSolid;
  /// Reads points alone, as Mesh::are_points. A file that has faces is refused then, as one without
  /// faces is otherwise: neither is taken for the other.
  bool points = false;
  /// Called now and then while a file is read, by one thread at a time, which need not be the
  /// caller's. False ends the reading with an Interrupted.
  std::function<bool()> keep_going = {};
  /// Counts the bytes that have been parsed, as they are; null: no caller needs it.
  std::atomic<uint64_t>* bytes_read = nullptr;
  /// The number of threads on which a file is read; 0: one a core.
  size_t threads = 0;
  /// The bytes that a thread reads at a time; 0: chosen by the file. For tests: the mesh, or the
  /// error, is the same for any number.
  size_t block_bytes = 0;
};

}  // namespace vkh
