// The common parts of field files: bounds as floats, and colours.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "host/mesh/round_to_float.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/field_file.h"

namespace vkh {

/// Throws UsageError unless a field has one value for each face.
inline void check_sizes(const FieldFile& file) {
  const size_t faces = file.mesh.faces.size();
  const auto check = [&](const Field& field) {
    if (field.lower.size() == faces && field.upper.size() == faces) return;
    throw UsageError("a field of " + std::to_string(field.upper.size()) + " values for a mesh of " +
                     std::to_string(faces) + " faces: one for each is needed");
  };
  check(file.field);
  if (file.sides == nullptr) return;
  check(file.sides->over_of_faces);
  check(file.sides->under_of_faces);
}

/// The largest upper bound that is finite.
inline double largest_upper(const Field& field) {
  double largest = 0;
  for (const double upper : field.upper)
    if (std::isfinite(upper)) largest = std::max(largest, upper);
  return largest;
}

inline Rgb colour_of(const FieldFile& file, double upper, double largest) {
  return map_colour(file.map, largest > 0 ? std::min(upper / largest, 1.0) : 0.0);
}

}  // namespace vkh
