// The shapes in the model parts of a 3MF package.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "host/read/threemf_package.h"
#include "host/read/threemf_volumes.h"
#include "host/read/transform.h"

namespace vkh::threemf {

constexpr uint32_t kNone = UINT32_MAX;

/// An object at a place: a component of another, or an item of the build.
struct Use {
  uint32_t part = 0, id = 0;  ///< of the object that is used
  uint32_t transform = kNone;
  size_t line = 0;
  bool is_printed = true;  ///< for an item of the build
};

struct Range {
  size_t begin = 0, end = 0;
};

struct Object {
  uint32_t part = 0, id = 0;
  Range vertices, faces;  ///< ranges of its mesh
  Range components;
  Role role = Role::kBody;
  bool has_shape = false;       ///< a mesh, or components
  bool lacks_shape = false;     ///< it has none, or one of its components has none
  std::string foreign;          ///< the last element in it from outside the core
  uint64_t face_count = 0;      ///< with its components'; at most 2^40
  uint64_t measured_count = 0;  ///< the part of them that is read if it is a body
  uint32_t others = kNone;      ///< number of the counts of its shapes that are no bodies
};

/// All parts of one package; objects stand behind the ones that they refer to.
struct Model {
  std::vector<std::string> parts;  ///< the root first
  std::string unit = "mm";
  std::deque<glm::dvec3> vertices;
  std::deque<glm::uvec3> faces;  ///< indices into an object's own vertices
  std::deque<std::array<double, 12>> transforms;
  std::deque<Use> components;
  std::deque<Object> objects;
  std::vector<Use> items;
  std::vector<uint32_t> by_id;  ///< the objects, by part and id

  /// Finds what `user` uses, an object or, if kNone, the build. Rejects a missing object, and one
  /// that stands behind its user in a part: no object is part of itself.
  uint32_t find(const MeshSource& source, const Use& use, uint32_t user) const;
};

/// Reads the root part and the parts that it names. Rejects extensions that are required and not
/// known here, and shapes that no triangle has: beam lattices.
Model read_model(const MeshSource& source, Package& package);

scene::Affine map_of(const Model& model, const Use& use);

}  // namespace vkh::threemf
