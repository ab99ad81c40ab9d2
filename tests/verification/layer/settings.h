// The test layer's settings from the environment.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace vkh::layer {

/// Fails the `n`-th call of `function` ("*": of all functions that may return `result`), and all
/// after it if `onwards`.
struct Fault {
  std::string function;
  uint64_t n = 1;
  bool onwards = false;
  VkResult result = VK_SUCCESS;
};

struct Settings {
  std::map<std::string, uint64_t> limits;  ///< VKH_LAYER_LIMITS
  std::set<std::string> hidden;            ///< VKH_LAYER_HIDE: extensions and features
  std::vector<Fault> faults;               ///< VKH_LAYER_FAIL
  uint64_t dropped_barrier = 0;            ///< VKH_LAYER_DROP_BARRIER: of synchronization2; 0: none
  uint64_t dropped_plain_barrier = 0;      ///< VKH_LAYER_DROP_PLAIN_BARRIER: vkCmdPipelineBarrier
  bool finds_hazards = false;              ///< VKH_LAYER_HAZARDS
  std::string log, count;                  ///< VKH_LAYER_LOG, VKH_LAYER_COUNT: files
  bool keeps_going = false;                ///< VKH_LAYER_KEEP_GOING: violations do not abort
  bool regroups = false;                   ///< VKH_LAYER_REGROUP: sums of shaders

  std::optional<uint64_t> limit(const std::string& name) const {
    const auto found = limits.find(name);
    return found == limits.end() ? std::nullopt : std::optional(found->second);
  }
};

/// The settings, read once, at the first call. Text that makes no sense ends the program: a
/// misspelt limit must not pass for one that is kept.
Settings& settings();

/// Returns false if the text makes no sense.
bool parse_faults(const std::string& text, std::vector<Fault>& faults);

/// The result by its name; VK_SUCCESS if there is none.
VkResult result_named(const std::string& name);
const char* name_of(VkResult result);
/// Error's bits of a function by name; 0: none, or not a function of ours.
unsigned errors_of(const std::string& function);
/// The bit of Error; 0 for a result that is none.
unsigned bit_of(VkResult result);

}  // namespace vkh::layer
