// Makes meshes for readers of large files, on several threads; the caller may cancel. Also counts
// degenerate and duplicate faces, which are no errors.
#pragma once

#include "host/base/thread_pool.h"
#include "vkhausdorff/mesh.h"

namespace vkh {

enum class Positions { kAny, kDiffer };  ///< whether two vertices may be at one position

/// Does the same as make_mesh of mesh.h, with any pool: it returns the same mesh, and throws the
/// same one of several errors.
Mesh make_mesh(std::string name, std::vector<glm::dvec3> vertices, std::vector<glm::uvec3> faces,
               const ThreadPool& pool, Positions positions = Positions::kAny);

/// Does the same as make_points of mesh.h, with any pool.
Mesh make_points(std::string name, std::vector<glm::dvec3> points, const ThreadPool& pool);

/// Whether a triangle is a segment or a point: exact for all finite coordinates.
bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Counts faces whose three positions are those of an earlier face.
uint64_t count_duplicates(const Mesh& mesh, Positions positions, const ThreadPool& pool);

}  // namespace vkh
