// A driver's own statistics of compiled pipelines: registers, spills, scratch.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "vkhausdorff/device.h"

/// By the names that the driver gives them, as "VGPRs".
using PipelineStatistics = std::map<std::string, uint64_t>;

/// The first device that the environment selects, created with
/// VK_KHR_pipeline_executable_properties. It is never destroyed: RADV crashes if it waits for a
/// card that is not there.
class StatisticsDevice {
 public:
  /// Throws DeviceError if there is no device, or its driver has no statistics.
  StatisticsDevice();
  const vkh::Device& device() const { return *device_; }
  /// For the engine: pipelines that are made through these functions keep their statistics.
  VkhDeviceInfo engine_info() const;
  PipelineStatistics of(VkPipeline pipeline) const;

 private:
  vkh::AdoptedDevice made_;
  const vkh::Device* device_ = nullptr;
  PFN_vkGetPipelineExecutableStatisticsKHR get_ = nullptr;
};
