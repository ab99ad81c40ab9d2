// The parts of the method that can be switched, by name; presets of them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/vkhausdorff.h"
#include "vkhausdorff/device.h"
#include "vkhausdorff/solve_options.h"

namespace vkh {

/// Runs several waves per submission. host/solve/run.cpp does this, and not the engine, so its bit
/// is not one of VkhSwitchBits.
constexpr uint32_t kSwitchMultiwave = 1u << 31;
/// The device is of VKH_DEVICE_KIND_WIDE, otherwise NARROW.
constexpr uint32_t kSwitchWide = 1u << 29;
/// VKH_CONTEXT_BY_ADDRESS: for meshes that the device cannot bind.
constexpr uint32_t kSwitchByAddress = VKH_CONTEXT_BY_ADDRESS;
/// The bits that are flags of a context.
constexpr uint32_t kContextFlags = VKH_CONTEXT_COVERAGE | VKH_CONTEXT_CELLS | VKH_CONTEXT_FINE |
                                   VKH_CONTEXT_CLOSEST | VKH_CONTEXT_BY_ADDRESS;

/// The switches that are on by default; what pays depends on the kind of device.
uint32_t default_switches(const Device& device);

/// The VkhSwitchBits and VkhContextFlagBits that are on, kSwitchWide and kSwitchMultiwave. Throws
/// UsageError for an unknown name.
uint32_t switches_of(const EngineOptions& options, const Device& device);

/// A fraction of A's diagonal. A sample is within 2^-20 of a face's edge of the farthest point:
/// half of that.
constexpr double kFineTolerance = 5e-7;
/// The same, with VKH_CONTEXT_FINE where 20 bits of barycentrics are too few for the tolerance.
uint32_t switches_for(const SolveOptions& options, double diagonal_a, const Device& device);

struct SwitchStates {
  std::vector<std::string> on, off;
};
SwitchStates switch_states(uint32_t switches);

}  // namespace vkh
