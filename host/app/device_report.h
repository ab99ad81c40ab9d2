// A device as one JSON document that its owner can send to us (docs/device-report.md).
#pragma once

#include <string>
#include <vector>

#include "host/app/self_test.h"
#include "vkhausdorff/device.h"

namespace vkh {

/// The loader and the devices that Vulkan lists: as much of it as was found out before a problem.
struct Machine {
  std::string loader = {};  ///< its version
  std::vector<DeviceDescription> devices = {};
};

/// The doctor's findings about one device.
struct Examination {
  SelfTestResult arithmetic;
  double lower = 0, upper = 0;  ///< the self-check's interval
  double distance = 0;          ///< and the distance that it should have
  bool passed = false;          ///< of the self-check
};

/// The distances of one pair whose faces are split into four, once for each size after the first,
/// which changes neither surface: sizes, intervals and times as rows of JSON. Throws DeviceError.
std::string timed_sizes(Device& device);

/// The document, with its last line's end. `found` is null where no device could be opened, and
/// then `device`, too; `problem` says why. `sizes` is what timed_sizes() returned, or empty.
std::string device_report(const Machine& machine, const Device* device, const Examination* found,
                          const std::string& sizes, const std::string& problem);

}  // namespace vkh
