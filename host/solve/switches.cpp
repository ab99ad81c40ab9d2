#include "host/solve/switches.h"

#include <algorithm>

#include "engine/vkhausdorff_experimental.h"
#include "shaders/gpu_types.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

struct NamedSwitch {
  const char* name;
  uint32_t bit;
};

constexpr NamedSwitch kSwitches[] = {
#define VKH_NAMED(constant, bit, api, name) {#name, gpu::constant},
    VKH_SWITCHES(VKH_NAMED)
#undef VKH_NAMED
        {"wide", kSwitchWide},
    {"multiwave", kSwitchMultiwave}};

// The paper's baseline (docs/method.md, section 10): its cascade without what the paper adds to it.
// Its bounds are certified, too, and a point of A is queried once, where the paper queries
// the three corners of each child: up to four times as many queries as ours.
constexpr uint32_t kBaseline = VKH_SWITCH_U3_PAPER | VKH_SWITCH_U4;
// The paper's method. Traversals start from what the candidate knows, since its worklist holds the
// closest triangles, and its packet traversal updates minima (docs/method.md, section 6).
constexpr uint32_t kPaper = kBaseline | VKH_SWITCH_SORT | VKH_SWITCH_PACKET | VKH_SWITCH_THIN |
                            VKH_SWITCH_DEFER | VKH_SWITCH_WARM_START;

uint32_t switch_bit(const std::string& name) {
  for (const auto& [known, bit] : kSwitches) {
    if (name == known) return bit;
  }
  throw UsageError("no switch is called '" + name + "'");
}

uint32_t preset_bits(const std::string& preset, const Device& device) {
  if (preset.empty() || preset == "default") return default_switches(device) | kSwitchMultiwave;
  if (preset == "paper") return kPaper;
  if (preset == "baseline-gpu") return kBaseline;
  throw UsageError("no preset is called '" + preset + "'");
}

}  // namespace

uint32_t default_switches(const Device& device) {
  const bool is_cpu = device.description().type == "cpu";
  if (is_cpu) return VKH_SWITCH_DEFAULT_NARROW;
  return VKH_SWITCH_DEFAULT_WIDE | kSwitchWide;
}

std::vector<std::string> switch_names() {
  std::vector<std::string> names;
  for (const NamedSwitch& s : kSwitches) names.emplace_back(s.name);
  return names;
}

std::vector<std::string> preset_names() { return {"default", "paper", "baseline-gpu"}; }

uint32_t switches_of(const EngineOptions& options, const Device& device) {
  uint32_t on = preset_bits(options.preset, device);
  for (const std::string& name : options.enabled) on |= switch_bit(name);
  for (const std::string& name : options.disabled) on &= ~switch_bit(name);
  if (options.coverage) on |= VKH_CONTEXT_COVERAGE;
  if (options.cells) on |= VKH_CONTEXT_CELLS;
  if (options.closest) on |= VKH_CONTEXT_CLOSEST;
  if (options.fine) on |= VKH_CONTEXT_FINE;
  return options.certified ? on : on | VKH_SWITCH_UNCERTIFIED;
}

uint32_t switches_for(const SolveOptions& options, double diagonal_a, const Device& device) {
  const double coarse =
      options.tolerance_is_absolute ? kFineTolerance * diagonal_a : kFineTolerance;
  const bool is_fine = options.tolerance < coarse;
  return switches_of(options.engine, device) | (is_fine ? uint32_t{VKH_CONTEXT_FINE} : 0);
}

SwitchStates switch_states(uint32_t switches) {
  SwitchStates states;
  for (const NamedSwitch& s : kSwitches)
    ((switches & s.bit) != 0 ? states.on : states.off).emplace_back(s.name);
  return states;
}

}  // namespace vkh
