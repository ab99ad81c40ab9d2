// What is wrong with a face without being an error.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "host/mesh/make_mesh.h"

namespace vkh {

/// Whether a triangle is a segment or a point: exact for all finite coordinates.
bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Faces whose three positions are those of an earlier face.
uint64_t count_duplicates(const Mesh& mesh, Positions positions, const Crew& crew);

}  // namespace vkh
