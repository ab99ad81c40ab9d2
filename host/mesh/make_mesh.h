// make_mesh for readers of large files: on several threads, and called off in time.
#pragma once

#include "host/base/crew.h"
#include "host/mesh/mesh.h"

namespace vkh {

enum class Positions { kAny, kDiffer };  ///< whether two vertices may be at one position

/// As make_mesh of mesh.h, whatever the crew: the same mesh, and of several errors the same.
Mesh make_mesh(std::string name, std::vector<glm::dvec3> vertices, std::vector<glm::uvec3> faces,
               const Crew& crew, Positions positions = Positions::kAny);

}  // namespace vkh
