// A part of A's faces, which is a mesh of its own: h(A,B) is the largest h of A's parts, exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "host/mesh/mesh.h"
#include "host/solve/report.h"
#include "host/solve/solve_options.h"

namespace vkh {

/// Of a mesh's faces those from `begin` on, before `end`.
struct FaceRange {
  size_t begin = 0, end = 0;
};
using FaceRanges = std::vector<FaceRange>;

/// Part `index` of `count`, at most as many as there are faces: in the order of their numbers, the
/// first parts a face larger where they cannot be alike.
FaceRanges part_in_order(size_t faces, size_t index, size_t count);
/// Blocks of faces in turn, so that every part has some of what is near each other.
FaceRanges part_by_turns(size_t faces, size_t index, size_t count);

/// Those faces and their vertices, both in A's order. Nothing is counted again: of degenerate and
/// duplicate faces the whole says it.
Mesh part_of(const Mesh& a, const FaceRanges& ranges);

/// The number in A of a part's face.
uint64_t face_of_whole(const FaceRanges& ranges, uint64_t face);

/// What encloses h(a, b).
using Distance = std::function<Report(const Mesh& a, const Mesh& b, const SolveOptions&)>;

/// Encloses h(part, b). A fraction is of A's diagonal, and so is the report's gap; its counts and
/// the number of its witness's face are A's.
Report distance_of_part(const Distance& distance, const Mesh& a, const FaceRanges& ranges,
                        const Mesh& b, const SolveOptions& options);

}  // namespace vkh
