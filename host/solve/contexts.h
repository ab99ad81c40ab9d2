// The pipelines of a device, in one context for each set of switches that is asked for.
#pragma once

#include <list>
#include <memory>
#include <mutex>

#include "host/gpu/pipeline_cache.h"
#include "host/solve/switches.h"

namespace vkh {

/// The work that is to be recorded with a context.
enum class ContextUse {
  kRun,       ///< all that its switches say
  kHierarchy  ///< BVHs, or searches for closest points
};

/// Destroys the context with it.
using ContextHandle = std::unique_ptr<VkhContext_T, void (*)(VkhContext)>;

/// Threads may share it, and so may all solvers of its device. It outlives what they record.
class Contexts {
 public:
  Contexts(const Device& device, const std::filesystem::path& cache_folder)
      : device_(device), cache_(device, cache_folder) {}

  /// Returns a context that serves; creates one if there is none. Threads that ask meanwhile wait.
  /// Throws DeviceError.
  VkhContext get(uint32_t switches, ContextUse use = ContextUse::kRun);
  size_t count() const;

 private:
  struct Made {
    uint32_t switches;
    ContextHandle context;
  };
  ContextHandle create(uint32_t switches) const;

  const Device& device_;
  mutable std::mutex mutex_;
  PipelineCache cache_;
  std::list<Made> made_;
};

/// Whether a context that was created for `made` may be used for `asked`.
bool serves(uint32_t made, uint32_t asked, ContextUse use);

}  // namespace vkh
