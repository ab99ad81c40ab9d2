// A part of A's faces, which is a mesh of its own: h(A,B) is the largest h of A's parts, exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "vkhausdorff/mesh.h"
#include "vkhausdorff/report.h"
#include "vkhausdorff/solve_options.h"

namespace vkh {

/// The faces of a mesh from `begin` on, before `end`.
struct FaceRange {
  size_t begin = 0, end = 0;
};
using FaceRanges = std::vector<FaceRange>;

/// Part `index` of `count` parts, at most as many as there are faces, in the order of the faces'
/// numbers; the first parts have a face more if they cannot be alike.
FaceRanges part_in_order(size_t faces, size_t index, size_t count);
/// Deals out blocks of faces one after the other, so that every part has some of the faces that lie
/// near each other.
FaceRanges part_by_turns(size_t faces, size_t index, size_t count);

/// Copies those faces and their vertices, both in A's order. Nothing is counted again: degenerate
/// and duplicate faces are reported for the whole.
Mesh part_of(const Mesh& a, const FaceRanges& ranges);

/// The number in A of a part's face.
uint64_t face_of_whole(const FaceRanges& ranges, uint64_t face);

/// A function that encloses h(a, b).
using Distance = std::function<Report(const Mesh& a, const Mesh& b, const SolveOptions&)>;

/// Encloses h(part, b). A relative tolerance is a fraction of A's diagonal, and so is the report's
/// gap; its counts and the number of its witness's face are A's.
Report distance_of_part(const Distance& distance, const Mesh& a, const FaceRanges& ranges,
                        const Mesh& b, const SolveOptions& options);

}  // namespace vkh
