// What a machine offers, and whether its answers can be trusted.
#pragma once

#include <iosfwd>
#include <string>

namespace vkh {

/// Lists every Vulkan device, says which one `selector` chooses and with which driver and loader,
/// and solves a pair whose distance is known on it: false if the interval misses it or stays open.
/// Throws DeviceError if no device is usable.
bool examine_devices(std::ostream& out, const std::string& selector);

}  // namespace vkh
