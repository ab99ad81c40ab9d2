// make_mesh for readers of large files: on several threads, and called off in time. And what it
// counts of faces, which is wrong with them without being an error.
#pragma once

#include "host/base/thread_pool.h"
#include "host/mesh/mesh.h"

namespace vkh {

enum class Positions { kAny, kDiffer };  ///< whether two vertices may be at one position

/// As make_mesh of mesh.h, whatever the pool: the same mesh, and of several errors the same.
Mesh make_mesh(std::string name, std::vector<glm::dvec3> vertices, std::vector<glm::uvec3> faces,
               const ThreadPool& pool, Positions positions = Positions::kAny);

/// Whether a triangle is a segment or a point: exact for all finite coordinates.
bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Faces whose three positions are those of an earlier face.
uint64_t count_duplicates(const Mesh& mesh, Positions positions, const ThreadPool& pool);

}  // namespace vkh
