// h(A, B) on the processor alone, in doubles: a second implementation of what a device's run does
// (docs/method.md), with the same bounds. No Vulkan takes part.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "vkhausdorff/limit.h"
#include "vkhausdorff/mesh.h"

namespace vkh::native {

/// The progress of a run. The interval is true, in the files' unit.
struct NativeProgress {
  uint32_t levels = 0;
  uint64_t open = 0;
  double lower = 0, upper = 0;
  double diagonal_a = 0;
};

struct NativeOptions {
  double tolerance = 1e-6;  ///< of the least diagonal of A, or in the files' unit
  bool tolerance_is_absolute = false;
  double known_lower =
      0;             ///< a distance that the answer need not resolve below; in the files' unit
  Limit limit = {};  ///< the run ends once the distance is proven to be within or beyond it
  uint32_t level_limit = std::numeric_limits<uint32_t>::max();
  /// The memory for candidates. If they would take more, a level refines the candidates with the
  /// smallest u and the others wait. If even that is too much, the candidates with the smallest u
  /// are given up.
  uint64_t memory_bytes = uint64_t{3} << 30;
  size_t threads = 1;     ///< 0: one for each core
  bool coverage = false;  ///< fill in NativeReport::areas
  /// Asked on the calling thread, after each level and about every 20 ms. False ends the run.
  std::function<bool(const NativeProgress&)> goes_on = {};
};

/// A face of A, in the units of NativeReport::areas.
inline constexpr uint64_t kWholeArea = uint64_t{1} << 60;

enum class NativeStatus {
  kClosed,     ///< upper - lower <= tolerance
  kPrecision,  ///< what is left cannot be decided in doubles, or need not be
  kLevels,     ///< the level limit ended the run
  kMemory,     ///< candidates were given up
  kStopped,    ///< goes_on() said no, or the limit was decided
};

struct NativeWitness {
  uint32_t face_a = 0, face_b = 0;
  std::array<double, 3> barycentric{};  ///< in A's face: exact, and they sum to 1
};

struct NativeReport {
  NativeStatus status = NativeStatus::kClosed;
  double lower = 0, upper = 0;  ///< lower <= h(A, B) <= upper, in the files' unit
  double diagonal_a = 0;        ///< rounded to nearest
  double tolerance = 0;         ///< in the files' unit
  NativeWitness witness;
  bool has_witness = false;  ///< false: the run was ended before any sample
  uint32_t levels = 0;
  uint64_t candidates = 0, queries = 0, peak_candidates = 0, peak_bytes = 0;
  /// The closed area of each face of A, and then the open area of each, in units of 1 / kWholeArea
  /// of the face: exact, since parts are split at integers. Empty if no coverage was asked for.
  std::vector<uint64_t> areas;
  std::array<uint64_t, 7> closed{};  ///< by exact case, u1, u2, ha, u3, a risen bound, precision
};

/// Returns the same bits for any number of threads, unless goes_on() ends it. Throws InputError for
/// an invalid mesh, and what goes_on() throws.
NativeReport run_pair(const Mesh& a, const Mesh& b, const NativeOptions& options = {});

}  // namespace vkh::native
