// The test layer (docs/test_layer.md) in this process: arms faults, and reports their outcomes.
#pragma once

#include <dlfcn.h>
#include <vulkan/vulkan.h>

#include <array>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace vkh::test {

class TestLayer {
 public:
  /// Has the loader put the layer into every instance made from now on; violations do not abort.
  /// Keeps the library loaded, so that its counts stay when the loader releases it.
  TestLayer() {
    setenv("VK_LAYER_PATH", VKH_LAYER_FOLDER ":/usr/share/vulkan/explicit_layer.d", 1);
    setenv("VK_INSTANCE_LAYERS", "VK_LAYER_VKH_test", 1);
    setenv("VKH_LAYER_KEEP_GOING", "1", 1);
    setenv("NODEVICE_SELECT", "1", 1);  // Mesa's own layer, which lists devices once more
    library_ = dlopen(VKH_LAYER_FOLDER "/libVkLayer_vkh_test.so", RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) throw std::runtime_error("no test layer in " VKH_LAYER_FOLDER);
    find("vkhLayerArm", arm_);
    find("vkhLayerLog", log_);
    find("vkhLayerCount", count_);
    find("vkhLayerInjected", injected_);
    find("vkhLayerViolations", violations_);
    find("vkhLayerLive", live_);
    find("vkhLayerErrorsOf", errors_of_);
  }

  /// Takes text like VKH_LAYER_FAIL; resets counts, logs, violations and losses. Call it between
  /// two runs.
  void arm(const std::string& faults) const {
    if (!arm_(faults.c_str())) throw std::runtime_error("the test layer cannot '" + faults + "'");
  }
  /// The calls since then that may fail, in order, and violations.
  std::vector<std::string> calls() const {
    std::string text(log_(nullptr, 0) + 1, '\0');
    log_(text.data(), text.size());
    text.pop_back();
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  /// The number of calls of a function since then; robust_devices: the number of robust devices
  /// made.
  uint64_t count(const std::string& function) const { return count_(function.c_str()); }
  uint32_t injected() const { return injected_(); }
  uint32_t violations() const { return violations_(); }
  /// Objects that live, instances among them.
  uint32_t live() const { return live_(); }
  std::vector<const char*> errors_of(const std::string& function) const {
    std::array<const char*, 32> names{};
    const uint32_t count = errors_of_(function.c_str(), names.data(), names.size());
    return {names.begin(), names.begin() + count};
  }

 private:
  template <class F>
  void find(const char* name, F& function) {
    function = reinterpret_cast<F>(dlsym(library_, name));
    if (function == nullptr) throw std::runtime_error(std::string("the test layer has no ") + name);
  }

  void* library_ = nullptr;
  bool (*arm_)(const char*) = nullptr;
  size_t (*log_)(char*, size_t) = nullptr;
  uint64_t (*count_)(const char*) = nullptr;
  uint32_t (*injected_)() = nullptr;
  uint32_t (*violations_)() = nullptr;
  uint32_t (*live_)() = nullptr;
  uint32_t (*errors_of_)(const char*, const char**, uint32_t) = nullptr;
};

}  // namespace vkh::test
