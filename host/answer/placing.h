// The units of both meshes, by their files and the question.
#pragma once

#include <string>

#include "vkhausdorff/mesh.h"
#include "vkhausdorff/question.h"

namespace vkh {

/// The units of A and B; empty: unknown.
struct Units {
  std::string a, b;
  bool differ() const { return !a.empty() && !b.empty() && a != b; }
};

/// Throws UsageError for a unit that contradicts a file's own, or that no file lacks.
Units units_of(const Question& question, const Mesh& a, const Mesh& b);

}  // namespace vkh
