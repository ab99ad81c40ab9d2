// A device's name and whether it is usable, for people and programs.
#pragma once

#include <cstdint>
#include <string>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

struct DeviceDescription {
  uint32_t index = 0;
  std::string name, driver, type;  ///< type: "discrete", "integrated", "virtual", "cpu", "other"
  std::string api_version;
  uint64_t memory_bytes = 0;  ///< largest device-local heap
  bool usable = false;
  std::string reason;  ///< why it is not usable; empty otherwise
};

}  // namespace vkh
