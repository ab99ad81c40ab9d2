// The frame in which the device works (coordinates of order 1, float32), and the displacement that
// storing coordinates in it causes.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "vkhausdorff/length.h"
#include "vkhausdorff/mesh.h"

namespace vkh {

struct Box {
  DVec3 lo, hi;
};
Box bounding_box(const Mesh& mesh);
Box join(const Box& x, const Box& y);
/// The length of the box's diagonal, rounded to nearest; the largest double if it is longer.
double diagonal(const Box& box);
/// The diagonal of which lengths in % and diag are shares.
Diagonal diagonal_of(const Mesh& mesh);
/// The farthest that two points of meshes in that box can be apart if the deltas of the meshes, by
/// which vertices are off their exact places, have that sum.
double farthest_in(const Box& joint, double delta);

/// Distances in the files' units, rounded outward.
struct FileInterval {
  double lower, upper;
};

/// frame = (given - centre) * 2^exponent. Any frame is a true one, since the displacement by
/// storing is measured vertex by vertex; a good one keeps it small.
struct Frame {
  DVec3 centre{};
  int exponent = 0;
  bool operator==(const Frame&) const = default;

  double to_frame(double length) const;
  /// The largest |frame coordinate| in a box, to within a rounding.
  double extent(const Box& box) const;
  /// Convert a length of the frame to the files' units, rounded down or up. Exact unless the result
  /// is subnormal.
  double length_down(double frame_length) const;
  double length_up(double frame_length) const;
  /// The interval for the given coordinates from the one certified for the stored coordinates:
  /// widened by the displacement of both meshes. `farthest` bounds any distance, also before the
  /// first bounds exist.
  FileInterval to_files(double lower, double upper, double displacement, double farthest) const;
};

/// Describes how a mesh's vertices will be stored in a frame: each of three coordinates as a sum of
/// two float32, high and low. write_vertices() writes them where they are needed, since a second
/// copy of a large mesh takes time and memory.
struct StoragePlan {
  Frame frame;
  bool has_low = false;  ///< some low part is not 0
  /// The largest distance of a stored vertex from the exact one, in frame units, rounded up: the
  /// displacement by storing plus Mesh::delta. h is 1-Lipschitz in both meshes.
  double displacement = 0;
};
StoragePlan store_in(const Frame& frame, const Mesh& mesh);
/// Writes three floats per vertex and reads none of them. Writes `low` only if has_low.
void write_vertices(const StoragePlan& stored, const Mesh& mesh, float* high, float* low);

/// One point, stored as a mesh's vertices are.
struct StoredPoint {
  std::array<float, 3> high{}, low{};
  double displacement = 0;  ///< in frame units, rounded up
};
StoredPoint store_point(const Frame& frame, const DVec3& point);

struct FramedPair {
  Frame frame;
  StoragePlan a, b;
  Box box_a, box_b;

  /// Returns what frame_pair(b, a) does.
  FramedPair reversed() const { return {frame, b, a, box_b, box_a}; }
};
/// Makes the joint box reach from 1/2 to 1. Prefers centre 0 where that keeps every coordinate in
/// its high part, as for float32 files near the origin; otherwise the middle of the joint box.
FramedPair frame_pair(const Mesh& a, const Mesh& b);

struct FramedMesh {
  Frame frame;
  StoragePlan stored;
};
/// The same for one mesh alone.
FramedMesh frame_mesh(const Mesh& mesh);

}  // namespace vkh
