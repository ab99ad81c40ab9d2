// Compiles every kernel, in both of its forms (bound and by address), and the shaders that draw
// pictures, for cards that are not here: RADV, AMD's driver of Mesa, does so if RADV_FORCE_FAMILY
// names one. The driver returns VK_SUCCESS in any case, so that a kernel fails if the driver writes
// to stderr. Nothing runs on the device.
//   vkh_compile          all families; exits 77 where RADV is not installed
//   vkh_compile --here   on the device that the environment selects, in this process
//   vkh_compile --table  all families: the table of docs/platforms.md, with what the driver says of
//                        each kernel: registers, spills, scratch
// VKH_RADV names the file of another RADV than the system's.
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <set>
#include <string>

#include "engine/kernels.h"
#include "engine/vkhausdorff_experimental.h"
#include "host/app/self_test.h"
#include "tools/kernels/pipeline_statistics.h"
#include "vkhausdorff/device.h"
#include "vkhausdorff/error.h"

namespace {

struct Family {
  const char* name;
  const char* newer = nullptr;  // the name that newer versions of RADV have instead
};
constexpr std::array kFamilies{Family{"bonaire"},          Family{"tonga"},  Family{"polaris10"},
                               Family{"vega10"},           Family{"navi10"}, Family{"navi21"},
                               Family{"gfx1100", "navi31"}};
struct KernelForms {
  const char* name;
  bool has_addresses;  // its words differ in a context that is byAddress
};
constexpr std::array kKernels{
#define VKH_FORMS(K) KernelForms{#K, vkh::k::K::kByAddress != 0},
    VKH_KERNELS(VKH_FORMS)
#undef VKH_FORMS
};

// The switches that bring in the kernels that others leave out; VKH_SWITCH_NONE: the rest is off.
constexpr uint32_t kRest =
    VKH_CONTEXT_COVERAGE | VKH_CONTEXT_CELLS | VKH_CONTEXT_FINE | VKH_CONTEXT_CLOSEST;
constexpr uint32_t kPaper = VKH_SWITCH_U3_PAPER | VKH_SWITCH_U4 | VKH_SWITCH_SORT |
                            VKH_SWITCH_PACKET | VKH_SWITCH_THIN | VKH_SWITCH_DEFER;
constexpr std::array kSwitchSets{uint32_t{VKH_SWITCH_DEFAULT_WIDE},
                                 uint32_t{VKH_SWITCH_DEFAULT_WIDE} | kRest,
                                 uint32_t{VKH_SWITCH_DEFAULT_NARROW} | kRest, kPaper};

using Names = std::set<std::string>;
using Look = std::function<void(const std::string& kernel, VkPipeline pipeline)>;

// Names of the kernels that were compiled; each is shown to `look`.
Names compile(const VkhContextCreateInfo& info, const Look& look) {
  VkhContext context = nullptr;
  if (vkhCreateContext(&info, &context) != VKH_SUCCESS)
    throw vkh::DeviceError("the driver refuses the kernels of switches " +
                           std::to_string(info.switches));
  Names names;
  for (size_t i = 0; i < kKernels.size(); ++i) {
    if (context->kernels[i].pipeline == VK_NULL_HANDLE) continue;
    names.insert(kKernels[i].name);
    look(kKernels[i].name, context->kernels[i].pipeline);
  }
  vkhDestroyContext(context);
  return names;
}

Names compile_all(
    const VkhDeviceInfo& device, VkBool32 by_address,
    const Look& look = [](const std::string&, VkPipeline) {}) {
  Names compiled;
  for (const uint32_t switches : kSwitchSets) {
    for (const VkhDeviceKind kind : {VKH_DEVICE_KIND_WIDE, VKH_DEVICE_KIND_NARROW}) {
      VkhContextCreateInfo info{};
      info.size = sizeof(info);
      info.device = device;
      info.flags = (switches & kRest) | VKH_CONTEXT_CHECK_INPUT;
      if (by_address == VK_TRUE) info.flags |= VKH_CONTEXT_BY_ADDRESS;
      info.deviceKind = kind;
      info.switches = switches & ~kRest;
      compiled.merge(compile(info, look));
    }
  }
  return compiled;
}

// The number of kernels with this form that no switches compiled.
int missing(const Names& compiled, VkBool32 by_address) {
  int count = 0;
  for (const KernelForms& kernel : kKernels) {
    const bool has_form = by_address == VK_FALSE || kernel.has_addresses;
    if (!has_form || compiled.contains(kernel.name)) continue;
    std::cerr << kernel.name << " is not compiled by any switches\n";
    ++count;
  }
  return count;
}

// The device is never destroyed: RADV crashes if it waits for a card that is not there.
int compile_here() {
  const vkh::Device& device = *new vkh::Device;
  int failed = missing(compile_all(device.engine_info(), VK_FALSE), VK_FALSE);
  const bool has_addresses = device.has_addresses();
  if (has_addresses) failed += missing(compile_all(device.engine_info(), VK_TRUE), VK_TRUE);
  vkh::compile_self_test(device);
  std::cout << device.description().name << ": " << kKernels.size() + 1 << " kernels, "
            << (has_addresses ? "also by address" : "none by address") << '\n';
  return failed == 0 ? 0 : 1;
}

// The largest figure of any kernel, and the kernel that has it.
struct Most {
  uint64_t value = 0;
  std::string kernel;
  void take(uint64_t other, const std::string& name) {
    if (other > value) *this = {other, name};
  }
  std::string text() const { return value == 0 ? "0" : std::to_string(value) + " " + kernel; }
};

// By kernel, over all switches and both forms.
struct Registers {
  std::map<std::string, uint64_t> spilled_vgprs, spilled_sgprs;  // of kernels that spill
  Most vgprs, sgprs, scratch, shared;
  size_t pipelines = 0;

  void take(const std::string& kernel, const PipelineStatistics& statistics) {
    const auto figure = [&](const char* name) {
      const auto found = statistics.find(name);
      if (found == statistics.end())
        throw vkh::DeviceError(std::string("the driver says nothing of ") + name);
      return found->second;
    };
    ++pipelines;
    vgprs.take(figure("VGPRs"), kernel);
    sgprs.take(figure("SGPRs"), kernel);
    scratch.take(figure("Scratch size"), kernel);
    shared.take(figure("LDS size"), kernel);
    keep(spilled_vgprs, kernel, figure("Spilled VGPRs"));
    keep(spilled_sgprs, kernel, figure("Spilled SGPRs"));
  }

 private:
  static void keep(std::map<std::string, uint64_t>& spills, const std::string& kernel,
                   uint64_t count) {
    if (count > 0) spills[kernel] = std::max(spills[kernel], count);
  }
};

std::string text_of(const std::map<std::string, uint64_t>& spills) {
  std::string text;
  for (const auto& [kernel, count] : spills)
    text += (text.empty() ? "" : ", ") + kernel + " " + std::to_string(count);
  return text.empty() ? "none" : text;
}

int print_row() {
  const StatisticsDevice& made = *new StatisticsDevice;
  Registers registers;
  const Look look = [&](const std::string& kernel, VkPipeline pipeline) {
    registers.take(kernel, made.of(pipeline));
  };
  compile_all(made.engine_info(), VK_FALSE, look);
  if (made.device().has_addresses()) compile_all(made.engine_info(), VK_TRUE, look);
  const char* family = std::getenv("RADV_FORCE_FAMILY");
  std::cout << "| " << (family == nullptr ? made.device().description().name : family) << " | "
            << registers.pipelines << " | " << registers.vgprs.text() << " | "
            << registers.sgprs.text() << " | " << text_of(registers.spilled_vgprs) << " | "
            << text_of(registers.spilled_sgprs) << " | " << registers.scratch.text() << " | "
            << registers.shared.text() << " |\n";
  return 0;
}

// The file that names RADV to the loader; empty where there is none.
std::string driver_file() {
  if (const char* other = std::getenv("VKH_RADV"); other != nullptr) return other;
  for (const char* file : {"/usr/share/vulkan/icd.d/radeon_icd.x86_64.json",
                           "/usr/share/vulkan/icd.d/radeon_icd.json"}) {
    if (std::filesystem::exists(file)) return file;
  }
  return "";
}

// Returns the child's output on stderr, and its `status` as waitpid has it.
std::string run_for(const char* family, const char* what, int& status) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("pipe");
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    setenv("VK_DRIVER_FILES", driver_file().c_str(), 1);
    setenv("RADV_FORCE_FAMILY", family, 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // cached kernels are not compiled
    execl("/proc/self/exe", "vkh_compile", what, static_cast<char*>(nullptr));
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

// RADV reports on any device but its own cards' that it is not conformant there, and that its bus
// is unknown.
bool is_usual(const std::string& line) {
  return line.empty() || line.find("not a conformant") != std::string::npos ||
         line.find("invalid pci bus info") != std::string::npos;
}

bool is_complaint(const std::string& text) {
  size_t begin = 0;
  while (begin < text.size()) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (!is_usual(line)) return true;
    begin = end + 1;
  }
  return false;
}

// `what`: what each child does; its standard output is ours.
int compile_everywhere(const char* what) {
  if (driver_file().empty()) {
    std::cout << "skipped: RADV is not here (Debian's mesa-vulkan-drivers)\n";
    return 77;
  }
  int failed = 0;
  for (const Family& family : kFamilies) {
    int status = 0;
    std::string text = run_for(family.name, what, status);
    if (family.newer != nullptr && text.find("Unknown family") != std::string::npos)
      text = run_for(family.newer, what, status);
    const bool is_right = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !is_complaint(text);
    if (!is_right) std::cout << family.name << " FAILED:\n" << text;
    failed += is_right ? 0 : 1;
  }
  return failed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string asked = argc == 2 ? argv[1] : "";
  if (asked == "--table") {
    std::cout << "| family | pipelines | most VGPRs | most SGPRs | kernels that spill VGPRs | "
                 "that spill SGPRs | most scratch, bytes | most shared memory, bytes |\n"
                 "|---|---|---|---|---|---|---|---|\n"
              << std::flush;
    return compile_everywhere("--row");
  }
  if (asked != "--here" && asked != "--row") return compile_everywhere("--here");
  const int code = asked == "--row" ? print_row() : compile_here();
  std::cout.flush();
  std::_Exit(code);
} catch (const std::exception& error) {
  std::cerr << "vkh_compile: " << error.what() << '\n';
  return 1;
}
