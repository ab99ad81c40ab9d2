// Compiled pipelines kept in a file between processes, for drivers that keep none themselves.
#pragma once

#include <filesystem>
#include <vector>

#include "vkhausdorff/device.h"

namespace vkh {

/// The content of the file of this device, driver and build, if it is whole. It never makes a run
/// fail: a file that cannot be read or written counts as missing.
class PipelineCache {
 public:
  /// No folder: nothing is kept, and the handle is null.
  PipelineCache(const Device& device, const std::filesystem::path& folder);
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  VkPipelineCache handle() const { return cache_; }
  /// Writes the file if pipelines were added. Readers see the old file or the new one, whole.
  void save();

 private:
  const Device& device_;
  std::filesystem::path file_;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  size_t saved_bytes_ = 0;
};

/// Returns the file's data as write_checked() left them; nothing if the file is cut short, changed
/// or not ours.
std::vector<char> read_checked(const std::filesystem::path& file);
/// Makes the folder too. A concurrent reader finds the old file or the new one.
void write_checked(const std::filesystem::path& file, const std::vector<char>& data);

}  // namespace vkh
