// The kinds of vkh_sweep: each holds what a device answers on thousands of inputs against something
// independent, prints a line for each violation, with the options that repeat it, and a summary,
// and returns 1 if there was a violation.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vkhausdorff/solver.h"

namespace vkh::bench {

struct SweepOptions {
  uint64_t count = 0;  ///< pairs; pair i depends on the seed and i alone
  uint64_t first = 0, seed = 1;
  std::string device;
  /// Spoils the answers by so much of themselves: shows that the sweep sees it.
  double spoil = 0;

  std::string family;         ///< distances: one alone
  double tolerance = 0;       ///< distances; 0: each family's own
  uint64_t least_closed = 0;  ///< distances: fewer closed pairs are a failure
  uint32_t threads = 1;       ///< distances: of the independent solver
  bool gates = false;         ///< distances: also limits near the distances
  bool closes = false;        ///< distances: what the independent solver closes is to be closed

  size_t cells = 0;                 ///< cells and sides: random cells of each pair
  std::vector<std::string> checks;  ///< proofs: programs that take a certificate and two meshes

  std::string a, b;         ///< sides: mesh files
  size_t effort = 200'000;  ///< sides: of the surveys; the cells checked are half as many
  size_t samples = 0;       ///< sides: of the area, for the figures
  bool head = false;        ///< sides: the columns' names first
};

/// The device that is swept, or this processor alone where it is called native.
class Swept {
 public:
  explicit Swept(const std::string& name) {
    if (name == kNative) {
      solver_.emplace(NativeProcessor{});
    } else {
      device_.emplace(DeviceRequest{.selector = name});
      solver_.emplace(*device_);
    }
  }
  Solver& solver() { return *solver_; }
  bool is_native() const { return !device_; }

 private:
  std::optional<Device> device_;
  std::optional<Solver> solver_;
};

/// Intervals against an independent solver in double precision with a rounding margin of its own,
/// and against the exact distance where that is known.
int sweep_distances(const SweepOptions& options);
/// Bounds of cells and faces against closest points and the same solver.
int sweep_cells(const SweepOptions& options);
/// Certificates: checkers that know nothing of how they came about accept every one. Runs differ
/// in preset, switches, workspace, tolerance, direction and limit, and in the limits that end them
/// and the proof.
int sweep_proofs(const SweepOptions& options);
/// Sides of the cells of one pair of files against exact integers, and signed figures against area
/// samples with exact parity. Points of cells are judged by winding numbers where B has a proven
/// inside, otherwise by the planes of all faces that are exactly closest. A figure is off where it
/// is farther from the samples' than five of their standard errors. Prints a line of
/// tab-separated columns.
int sweep_sides(const SweepOptions& options);

}  // namespace vkh::bench
