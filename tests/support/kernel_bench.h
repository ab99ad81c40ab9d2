// Runs single kernels and recording pages on the test device: vectors in, vectors out.
#pragma once

#include <cstring>
#include <functional>
#include <vector>

#include "engine/recorder.h"
#include "host/memory.h"

namespace vkh::test {

/// The device of this test program, made once, with the validation layer if VKH_VALIDATION is set.
/// The program's exit code is not 0 if the layer said anything (tests/support/main.cpp).
Device& test_device();

class KernelBench {
 public:
  explicit KernelBench(uint32_t switches = VKH_SWITCH_ALL);
  ~KernelBench();
  KernelBench(const KernelBench&) = delete;
  KernelBench& operator=(const KernelBench&) = delete;

  /// A buffer of its own that holds `content` (at least one element).
  template <class T>
  Slice<T> put(std::vector<T> content) {
    if (content.empty()) content.resize(1);
    return {reserve(content.data(), content.size() * sizeof(T)), 0, content.size() * sizeof(T)};
  }
  template <class T>
  std::vector<T> get(const Slice<T>& slice) {
    std::vector<T> content(slice.size / sizeof(T));
    std::memcpy(content.data(), read(slice.buffer, slice.offset, slice.size), slice.size);
    return content;
  }
  /// Records with `record`, submits and waits.
  void run(const std::function<void(Recorder&)>& record);
  VkhContext context() const { return context_; }

 private:
  VkBuffer reserve(const void* content, size_t bytes);
  const std::byte* read(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size);

  Submitter submitter_;
  VkhContext context_ = nullptr;
  std::vector<Buffer> buffers_;
};

}  // namespace vkh::test
