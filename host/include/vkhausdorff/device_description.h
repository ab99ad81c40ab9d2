// A device's name and whether it is usable, for people and programs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

/// The name, among selectors of devices, of the processor alone, which takes no Vulkan.
constexpr std::string_view kNative = "native";

struct DeviceDescription {
  uint32_t index = 0;
  std::string name, driver, type;  ///< type: "discrete", "integrated", "virtual", "cpu", "other";
                                   ///< or kNative
  std::string api_version;
  uint64_t memory_bytes = 0;  ///< largest device-local heap
  bool usable = false;
  std::string reason;  ///< why it is not usable; empty otherwise

  /// Whether the processor does a device's work: a CPU device, or kNative.
  bool is_processor() const { return type == "cpu" || type == kNative; }
};

}  // namespace vkh
