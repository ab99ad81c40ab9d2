// A pair of meshes in its frame, and the question to the device about it.
#pragma once

#include "host/solve/pair_buffers.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/report.h"
#include "vkhausdorff/solve_options.h"
#include "vkhausdorff/solver.h"

namespace vkh {

namespace native {
class PlacedMesh;  // host/native/closest.h
}

/// A prepared B, in its own frame: on the device, or for the processor alone, where distances make
/// their own copy of it.
struct KeptMesh {
  Mesh mesh;
  Box box;
  Frame frame;
  double displacement = 0;
  bool has_low = false;
  ResidentMesh resident;
  std::shared_ptr<const native::PlacedMesh> placed;  ///< natively
};

/// Whether the frame of a mesh B with that box serves an A with this one: PreparedMesh::serves().
bool serves(const Frame& frame_of_b, const Box& box_b, const Box& box_a);

/// A run's meshes as they are stored in one frame, and the question about them. Proof that any
/// frame will do: in every frame the device encloses the stored meshes' h in the frame's units, for
/// coordinates up to 2^15 (vkhausdorff.h); a stored vertex is within the displacement, which
/// store_in() bounded for this very frame, of its exact place; h moves by no more than both
/// displacements together.
struct Pair {
  const Mesh& a;
  const Mesh& b;
  const Frame& frame;
  const StoragePlan& stored_a;
  const StoragePlan* stored_b;  // null: resident
  const ResidentMesh* resident;
  double displacement;  // both meshes' together
  bool has_low;         // of either mesh
  Box box_a, joint;
  SolveOptions options = {};
  std::function<double()> known_since = {};  ///< distance_since()
  size_t number = 0;                         // Progress::pair
  KeptPair kept = {};                        // set if later calls may be of this pair
};

/// Converts the device's certified bounds of the pair to the files' units.
FileInterval to_files(const VkhReport& report, const Pair& pair);

/// `tolerance` is in the files' units. The result has neither time budgets nor callbacks.
RunInput input_for(const Pair& pair, uint32_t switches, double tolerance);

/// The pair's tolerance, in the files' units.
double tolerance_of(const Pair& pair);

/// Narrows a report by another search of the same pair: both intervals are true. The work of both
/// is added up, and everything else stays as it was.
void narrow(Report& r, const Report& other);

/// The pair with the tolerance that is tried first. If it has a limit and its tolerance is finer
/// than plain floats allow, plain floats are tried first: they decide nearly every limit, and
/// sooner.
Pair coarser(const Pair& pair);
/// Gives the report of `first`, which coarser() returned, the tolerance and the status that it has
/// for `pair`; returns whether a finer run may decide what this one has not.
bool asks_for_more(Report& r, const Pair& first, const Pair& pair);

}  // namespace vkh
