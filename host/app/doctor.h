// Reports a machine's devices, and whether their answers can be trusted.
#pragma once

#include <iosfwd>
#include <string>

#include "host/answer/json_object.h"

namespace vkh {

/// Lists every Vulkan device, prints which one `selector` chooses and with which driver and loader,
/// probes the arithmetic that the certificate rests on, and solves a pair whose distance is known
/// on it: false if a promise is broken, or if the interval misses the distance or stays open.
/// Throws DeviceError if no device is usable. Unless `json` is null, fills it as far as it got
/// (docs/platforms.md), and also solves the demo's pair twice.
bool examine_devices(std::ostream& out, const std::string& selector, Json* json);

}  // namespace vkh
