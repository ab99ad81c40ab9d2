// Reduces the faces of a mesh at nearly the same shape.
#pragma once

#include <cstddef>

#include "host/mesh/mesh.h"

namespace vkh {

/// Collapses edges, cheapest quadric error first (Garland and Heckbert 1997), until at most
/// `target_faces` are left or no edge can go without folding the surface or changing its topology.
/// Borders stay as they are. Coordinates are rounded to float32, as a file would hold them. The
/// result is the same to the last bit on every machine: it uses + - * / and sqrt alone, and ties
/// are broken by index.
Mesh simplify(const Mesh& mesh, size_t target_faces);

}  // namespace vkh
