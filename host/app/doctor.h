// Reports a machine's devices, and whether their answers can be trusted.
#pragma once

#include <iosfwd>
#include <string>

namespace vkh {

class OutputFile;

/// Lists every Vulkan device, prints which one `selector` chooses and with which driver and loader,
/// probes the arithmetic that the certificate rests on, and solves a pair whose distance is known
/// on it: false if a promise is broken, or if the interval misses the distance or stays open.
/// Throws DeviceError if no device is usable. Writes `report`, unless it is null, in each of these
/// cases (docs/device-report.md), which takes two more sizes of the demo's pair; throws
/// OutputError.
bool examine_devices(std::ostream& out, const std::string& selector, const OutputFile* report);

}  // namespace vkh
