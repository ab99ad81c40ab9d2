// Puts a mesh where a user says, and reads the matrix that says so.
#pragma once

#include <filesystem>
#include <string>

#include "vkhausdorff/mesh.h"

namespace vkh {

/// Reads sixteen numbers, four rows of four, between blanks, commas, semicolons or brackets; a line
/// is ignored from a # on. Throws InputError if there are others, or the last row is not 0 0 0 1.
MatrixRows read_matrix(const std::filesystem::path& path);

/// Four rows of four numbers, with 17 digits each: read_matrix() reads the same doubles.
std::string matrix_text(const MatrixRows& rows);

/// The largest entry of |R^T R - I|, rounded up, for the 3 x 3 part R: 0 for an exact rotation. R
/// changes a length l by at most 1.5 times this times l, up to its square (Gershgorin).
double stretch_of(const MatrixRows& rows);

/// Throws InputError that begins with `name` if an entry is not finite, the matrix mirrors or
/// flattens, or stretches by more than 1e-6 where it may not.
void check_matrix(const std::string& name, const MatrixRows& rows, bool may_stretch);

/// Moves every vertex, rounds it, and adds to the mesh's delta what the rounding moved it at most.
/// `unit` is that of the outcome. With `hash_corners`, PlacedFrom::corners is set. Throws
/// InputError if a coordinate becomes larger than any double.
void place(Mesh& mesh, const MeshTransform& placement, const std::string& unit, bool hash_corners);

}  // namespace vkh
