// Compiles every kernel for cards that are not here: RADV, AMD's driver of Mesa, does so where
// RADV_FORCE_FAMILY names one. The driver returns VK_SUCCESS whatever becomes of a kernel, so that
// a kernel fails where the driver writes to stderr. Nothing runs on the device.
//   vkh_compile          all families; exits 77 where RADV is not installed
//   vkh_compile --here   on the device that the environment selects, in this process
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>

#include "engine/kernels.h"
#include "host/base/error.h"
#include "host/check/self_test.h"
#include "host/gpu/device.h"

namespace {

constexpr const char* kDriver = "/usr/share/vulkan/icd.d/radeon_icd.x86_64.json";
constexpr std::array kFamilies{"bonaire", "tonga",  "polaris10", "vega10",
                               "navi10",  "navi21", "gfx1100"};
constexpr std::array kKernelNames{
#define VKH_NAME(K) #K,
    VKH_KERNELS(VKH_NAME)
#undef VKH_NAME
};

// The switches that bring in what others leave out; VKH_SWITCH_NONE: the rest is off.
constexpr uint32_t kRest = VKH_SWITCH_COVERAGE | VKH_SWITCH_FIELD | VKH_SWITCH_SUBROOTS;
constexpr uint32_t kPaper = VKH_SWITCH_U3_PAPER | VKH_SWITCH_U4 | VKH_SWITCH_SORT |
                            VKH_SWITCH_PACKET | VKH_SWITCH_THIN | VKH_SWITCH_DEFER;
constexpr std::array kSwitchSets{uint32_t{VKH_SWITCH_DEFAULT_WIDE}, VKH_SWITCH_DEFAULT_WIDE | kRest,
                                 uint32_t{VKH_SWITCH_DEFAULT_NARROW} | kRest, kPaper};

// Names of the kernels that were compiled.
std::set<std::string> compile(const VkhContextCreateInfo& info) {
  VkhContext context = nullptr;
  if (vkhCreateContext(&info, &context) != VKH_SUCCESS)
    throw vkh::DeviceError("the driver refuses the kernels of switches " +
                           std::to_string(info.switches));
  std::set<std::string> names;
  for (size_t i = 0; i < kKernelNames.size(); ++i) {
    if (context->kernels[i].pipeline != VK_NULL_HANDLE) names.insert(kKernelNames[i]);
  }
  vkhDestroyContext(context);
  return names;
}

// The device is never destroyed: RADV crashes where it waits for a card that is not there.
int compile_here() {
  const vkh::Device& device = *new vkh::Device;
  std::set<std::string> compiled;
  for (const uint32_t switches : kSwitchSets) {
    for (const VkhDeviceKind kind : {VKH_DEVICE_KIND_WIDE, VKH_DEVICE_KIND_NARROW}) {
      VkhContextCreateInfo info{};
      info.device = device.engine_info();
      info.switches = switches;
      info.deviceKind = kind;
      info.checkInput = VK_TRUE;
      compiled.merge(compile(info));
    }
  }
  vkh::compile_self_test(device);
  std::cout << device.description().name << ": " << compiled.size() + 1 << " kernels\n";
  if (compiled.size() == kKernelNames.size()) return 0;
  for (const char* name : kKernelNames) {
    if (!compiled.contains(name)) std::cerr << name << " is not compiled by any switches\n";
  }
  return 1;
}

// What the child wrote to stderr; `status` as waitpid has it.
std::string run_for(const char* family, int& status) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("pipe");
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    setenv("VK_DRIVER_FILES", kDriver, 1);
    setenv("RADV_FORCE_FAMILY", family, 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // what is cached is not compiled
    execl("/proc/self/exe", "vkh_compile", "--here", static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[1]);
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = read(ends[0], part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<size_t>(n));
  close(ends[0]);
  waitpid(child, &status, 0);
  return text;
}

// RADV says on any device but its own cards' that it is not conformant there.
bool is_complaint(const std::string& text) {
  size_t begin = 0;
  while (begin < text.size()) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (!line.empty() && line.find("not a conformant") == std::string::npos) return true;
    begin = end + 1;
  }
  return false;
}

int compile_everywhere() {
  if (!std::filesystem::exists(kDriver)) {
    std::cout << "skipped: " << kDriver << " is not here (Debian's mesa-vulkan-drivers)\n";
    return 77;
  }
  int failed = 0;
  for (const char* family : kFamilies) {
    int status = 0;
    const std::string text = run_for(family, status);
    const bool is_right = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !is_complaint(text);
    if (!is_right) std::cout << family << " FAILED:\n" << text;
    failed += is_right ? 0 : 1;
  }
  return failed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  const bool here = argc == 2 && std::strcmp(argv[1], "--here") == 0;
  if (!here) return compile_everywhere();
  const int code = compile_here();
  std::cout.flush();
  std::_Exit(code);
} catch (const std::exception& error) {
  std::cerr << "vkh_compile: " << error.what() << '\n';
  return 1;
}
