// h(A, B) on the processor alone, in doubles: a second implementation of what a device's run does
// (docs/method.md), with the same bounds. No Vulkan takes part.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "vkhausdorff/mesh.h"

namespace vkh::native {

struct NativeOptions {
  double tolerance = 1e-6;  ///< of the least diagonal of A, or in the files' unit
  bool tolerance_is_absolute = false;
  uint32_t level_limit = 1000;
  /// A level refines no more candidates than fit: those with the smallest u, and others wait.
  size_t most_candidates = size_t{1} << 26;
  size_t threads = 1;
};

enum class NativeStatus {
  kClosed,     ///< upper - lower <= tolerance
  kPrecision,  ///< what is left cannot be decided in doubles
  kLevels,     ///< the level limit ended the run
};

struct NativeWitness {
  uint32_t face_a = 0, face_b = 0;
  std::array<double, 3> barycentric{};  ///< in A's face: exact, and they sum to 1
};

struct NativeReport {
  NativeStatus status = NativeStatus::kClosed;
  double lower = 0, upper = 0;  ///< lower <= h(A, B) <= upper, in the files' unit
  double tolerance = 0;         ///< in the files' unit
  NativeWitness witness;
  uint32_t levels = 0;
  uint64_t candidates = 0, queries = 0, peak_candidates = 0;
  std::array<uint64_t, 7> closed{};  ///< by exact case, u1, u2, ha, u3, a risen bound, precision
};

/// The same bits for any number of threads. Throws InputError for what is no mesh.
NativeReport run_pair(const Mesh& a, const Mesh& b, const NativeOptions& options = {});

}  // namespace vkh::native
