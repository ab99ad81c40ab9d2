// The second oracle: CGAL's bounded-error Hausdorff distance. CGAL is GPL and slow to compile; it
// is confined to cgal_oracle.cpp and to the tests.
#pragma once

#include <optional>

#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/mesh.h"

namespace vkh::test {

/// Encloses h(A, B) within error of CGAL's estimate; nothing if CGAL cannot hold a mesh: CGAL needs
/// oriented manifold surfaces, without degenerate faces.
std::optional<Interval> cgal_hausdorff(const Mesh& a, const Mesh& b, double error);

}  // namespace vkh::test
