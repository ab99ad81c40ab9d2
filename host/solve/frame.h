// The frame in which the device works: coordinates of order 1, float32, and what storing them so
// displaced.
#pragma once

#include <glm/vec3.hpp>

#include "host/mesh/mesh.h"

namespace vkh {

struct Box {
  glm::dvec3 lo, hi;
};
Box bounding_box(const Mesh& mesh);
Box join(const Box& x, const Box& y);
/// Rounded to nearest; the largest double where it is longer.
double diagonal(const Box& box);
/// No two points of meshes in that box are farther apart, whose vertices are off their exact places
/// by deltas of that sum.
double farthest_in(const Box& joint, double delta);

/// Distances in the files' units, rounded outward.
struct FileInterval {
  double lower, upper;
};

/// frame = (given - centre) * 2^exponent. Any frame is a true one, since what storing displaces is
/// measured vertex by vertex; a good one keeps it small.
struct Frame {
  glm::dvec3 centre{};
  int exponent = 0;

  double to_frame(double length) const;
  /// Largest |frame coordinate| in a box, to within a rounding.
  double extent(const Box& box) const;
  /// A length of the frame in the files' units. Exact unless it underflows; then 0 or the smallest
  /// double.
  double length_down(double frame_length) const;
  double length_up(double frame_length) const;
  /// What the device certifies of the stored coordinates, for those given: widened by the
  /// displacement of both meshes. `farthest` bounds any distance, also before the first bounds
  /// exist.
  FileInterval to_files(double lower, double upper, double displacement, double farthest) const;
};

/// How a mesh's vertices are stored in a frame: as sums of two float32, high and low, three per
/// vertex. write_vertices makes them, where they are wanted: a second copy of a large mesh takes
/// time and memory.
struct StoredMesh {
  Frame frame;
  bool has_low = false;  ///< some low part is not 0
  /// Largest distance of a stored vertex from the exact one, in frame units, rounded up: of what
  /// storing displaced, and Mesh::delta. h is 1-Lipschitz in both meshes.
  double displacement = 0;
};
StoredMesh store_in(const Frame& frame, const Mesh& mesh);
/// Three floats a vertex, none of which is read. `low` is written to only where has_low.
void write_vertices(const StoredMesh& stored, const Mesh& mesh, float* high, float* low);

struct FramedPair {
  Frame frame;
  StoredMesh a, b;
};
/// The joint box reaches from 1/2 to 1. Prefers centre 0 where that keeps every coordinate in its
/// high part: float32 files near the origin; else the middle of the joint box.
FramedPair frame_pair(const Mesh& a, const Mesh& b);

struct FramedMesh {
  Frame frame;
  StoredMesh stored;
};
/// The same for one mesh alone.
FramedMesh frame_mesh(const Mesh& mesh);

}  // namespace vkh
