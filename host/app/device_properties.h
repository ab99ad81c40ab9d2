// Properties of a device as Vulkan reports them, as JSON.
#pragma once

#include <string>

#include "host/answer/json_object.h"
#include "vkhausdorff/device.h"

namespace vkh {

/// Versions, limits, features, extensions, queue families and memory, by Vulkan's own names.
Json properties_json(const Device& device);
/// The loader's version, as 1.3.230. Throws DeviceError if there is none.
std::string loader_version();
/// The system that this program was built for, and its processor: "Linux x86-64".
const char* system_name();

}  // namespace vkh
