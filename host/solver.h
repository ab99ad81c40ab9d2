// Two meshes in, a certified interval out; blocking, on a device of our own.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "host/device.h"
#include "host/mesh.h"
#include "host/report.h"

namespace vkh {

/// Handed to the progress callback between submissions.
struct Progress {
  uint32_t wave = 0;
  uint64_t candidates = 0;  ///< undecided now
  double lower = 0,
         upper = 0;  ///< in the files' units; upper is infinite before the first bounds exist
  double gap = 0;    ///< (upper - lower) / diag(A)
};

struct SolveOptions {
  double tolerance = 1e-6;  ///< fraction of diag(A), or in the files' units if absolute
  bool tolerance_is_absolute = false;
  double time_limit_s = std::numeric_limits<double>::infinity();
  uint32_t wave_limit = std::numeric_limits<uint32_t>::max();
  uint64_t memory_bytes = 0;          ///< workspace; 0: chosen from the meshes and the device
  std::vector<std::string> enabled;   ///< switch names; u4 is off otherwise
  std::vector<std::string> disabled;  ///< switch names, see switch_names()
  bool coverage = false;  ///< add up what was closed of each face of A: Report::coverage_check
  std::function<bool(const Progress&)>
      progress;  ///< return false to cancel; the interval so far is returned
};

/// Names that `disabled` takes.
std::vector<std::string> switch_names();

/// Keeps pipelines and buffers of one device between runs. One thread at a time.
class Solver {
 public:
  explicit Solver(Device& device);
  ~Solver();
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  /// Encloses h(a, b). Throws DeviceError if the device is lost or out of memory, UsageError for an
  /// unknown switch or a tolerance that is not positive and finite.
  Report distance(const Mesh& a, const Mesh& b, const SolveOptions& options = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vkh
