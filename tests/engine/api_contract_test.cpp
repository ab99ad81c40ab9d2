// The header's promises about itself, sizes and refusals.
#include <doctest/doctest.h>

#include <cctype>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>

#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

std::string header() {
  std::ifstream file(VKH_SOURCE_DIR "/engine/vkhausdorff.h");
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), {}};
}

size_t visible(const std::string& text) {
  size_t count = 0;
  for (const char c : text) count += std::isspace(static_cast<unsigned char>(c)) == 0;
  return count;
}

/// The visible characters inside comments.
size_t commented(const std::string& text) {
  size_t count = 0;
  for (size_t at = text.find("/*"); at != std::string::npos; at = text.find("/*", at)) {
    const size_t end = text.find("*/", at) + 2;
    count += visible(text.substr(at, end - at));
    at = end;
  }
  return count;
}

/// Whether a comment ends right above `name`'s declaration.
bool has_contract(const std::string& text, const std::string& name) {
  const size_t at = text.find(name + "(");
  if (at == std::string::npos) return false;
  const size_t line = text.rfind('\n', at);
  return text.compare(line - 2, 2, "*/") == 0;
}

}  // namespace

TEST_CASE("two fifths of the header, and more, are contract") {
  const std::string text = header();
  CHECK(commented(text) * 10 >= visible(text) * 4);
}

TEST_CASE("every function that is not obvious has a contract of its own") {
  const std::string text = header();
  for (const char* name :
       {"vkhGetRequiredExtensions", "vkhQuerySupport", "vkhCreateContext", "vkhDestroyContext",
        "vkhGetRecordingResult", "vkhGetHierarchyRequirements", "vkhGetWorkspaceRequirements",
        "vkhCmdBuildHierarchy", "vkhCmdRefitHierarchy", "vkhCmdBegin", "vkhCmdAdvance",
        "vkhCmdWriteReport"}) {
    CAPTURE(name);
    CHECK(has_contract(text, name));
  }
}

TEST_CASE("the device that the header shows is the one that api_c11 creates") {
  std::istringstream lines(header());
  std::ifstream file(VKH_SOURCE_DIR "/tests/engine/api_c11.c");
  const std::string program{std::istreambuf_iterator<char>(file), {}};
  std::string line;
  while (line.find("A device in C") == std::string::npos) REQUIRE(std::getline(lines, line));
  int shown = 0;
  while (std::getline(lines, line) && line != " */") {
    const size_t start = line.find_first_not_of(" *");
    if (start == std::string::npos) continue;
    CAPTURE(line);
    CHECK(program.find(line.substr(start)) != std::string::npos);
    ++shown;
  }
  CHECK(shown > 10);
}

TEST_CASE("every result has its name") {
  const std::string text = header();
  const std::string results = text.substr(text.find("typedef enum VkhResult {"));
  const std::regex constant(R"((VKH_\w+) = (-?\d+))");
  const auto end = results.begin() + static_cast<std::ptrdiff_t>(results.find('}'));
  int named = 0;
  for (std::sregex_iterator i(results.begin(), end, constant), none; i != none; ++i, ++named)
    CHECK(vkhResultString(static_cast<VkhResult>(std::stoi((*i)[2]))) == (*i)[1].str());
  CHECK(named >= 6);
}

namespace {

// The device, whose function of that name is `ours`; one at a time. `theirs` is the driver's.
struct Replaced {
  static inline PFN_vkGetInstanceProcAddr get_instance = nullptr;
  static inline PFN_vkGetDeviceProcAddr get_device = nullptr;
  static inline const char* name = nullptr;
  static inline PFN_vkVoidFunction ours = nullptr;

  static PFN_vkVoidFunction VKAPI_CALL of_device(VkDevice device, const char* asked) {
    return std::strcmp(asked, name) == 0 ? ours : get_device(device, asked);
  }
  static PFN_vkVoidFunction VKAPI_CALL of_instance(VkInstance instance, const char* asked) {
    if (std::strcmp(asked, name) == 0) return ours;  // functions of VK_EXT_debug_utils
    return std::strcmp(asked, "vkGetDeviceProcAddr") == 0
               ? reinterpret_cast<PFN_vkVoidFunction>(of_device)
               : get_instance(instance, asked);
  }
  static PFN_vkVoidFunction replace(VkhDeviceInfo& device, const char* function,
                                    PFN_vkVoidFunction by) {
    get_instance = device.getInstanceProcAddr;
    get_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(
        get_instance(device.instance, "vkGetDeviceProcAddr"));
    device.getInstanceProcAddr = of_instance;
    name = function;
    ours = by;
    return get_device(device.device, function);
  }
};

// The number of threads that created pipelines, if they are the engine's own.
size_t threads_of_context(uint32_t most) {
  VkhContextCreateInfo info = create_info(0, VKH_DEVICE_KIND_NARROW);
  info.threads = most;
  static std::mutex mutex;
  static std::set<std::thread::id> seen;
  static PFN_vkCreateComputePipelines create = nullptr;
  seen.clear();
  const PFN_vkCreateComputePipelines counting =
      [](VkDevice device, VkPipelineCache cache, uint32_t count,
         const VkComputePipelineCreateInfo* infos, const VkAllocationCallbacks* callbacks,
         VkPipeline* pipelines) {
        {
          const std::lock_guard lock(mutex);
          seen.insert(std::this_thread::get_id());
        }
        return create(device, cache, count, infos, callbacks, pipelines);
      };
  create = reinterpret_cast<PFN_vkCreateComputePipelines>(Replaced::replace(
      info.device, "vkCreateComputePipelines", reinterpret_cast<PFN_vkVoidFunction>(counting)));
  VkhContext context = nullptr;
  REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
  vkhDestroyContext(context);
  if (most == 1) CHECK(seen == std::set{std::this_thread::get_id()});
  return seen.size();
}

// The values by which a context specialises its kernels, and the number of these.
struct Specialised {
  std::set<std::string> values;
  size_t kernels = 0;
};
Specialised specialised_by(uint32_t flags) {
  VkhContextCreateInfo info = create_info(flags, VKH_DEVICE_KIND_NARROW);
  info.threads = 1;
  static Specialised seen;
  static PFN_vkCreateComputePipelines create = nullptr;
  seen = {};
  const PFN_vkCreateComputePipelines noting =
      [](VkDevice device, VkPipelineCache cache, uint32_t count,
         const VkComputePipelineCreateInfo* infos, const VkAllocationCallbacks* callbacks,
         VkPipeline* pipelines) {
        const VkSpecializationInfo& with = *infos->stage.pSpecializationInfo;
        seen.values.emplace(static_cast<const char*>(with.pData), with.dataSize);
        ++seen.kernels;
        return create(device, cache, count, infos, callbacks, pipelines);
      };
  create = reinterpret_cast<PFN_vkCreateComputePipelines>(Replaced::replace(
      info.device, "vkCreateComputePipelines", reinterpret_cast<PFN_vkVoidFunction>(noting)));
  VkhContext context = nullptr;
  REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
  vkhDestroyContext(context);
  return seen;
}

// Names by type, which a context gave its objects.
std::map<VkObjectType, std::set<std::string>> names_of_context() {
  VkhContextCreateInfo info = create_info(0, VKH_DEVICE_KIND_NARROW);
  info.threads = 1;
  static std::map<VkObjectType, std::set<std::string>> names;
  names.clear();
  const PFN_vkSetDebugUtilsObjectNameEXT noting = [](VkDevice,
                                                     const VkDebugUtilsObjectNameInfoEXT* named) {
    CHECK(named->objectHandle != 0);
    names[named->objectType].insert(named->pObjectName);
    return VK_SUCCESS;
  };
  Replaced::replace(info.device, "vkSetDebugUtilsObjectNameEXT",
                    reinterpret_cast<PFN_vkVoidFunction>(noting));
  VkhContext context = nullptr;
  REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
  vkhDestroyContext(context);
  return names;
}

// Runs the work backwards on the calling thread, and counts it.
void run_here(void* user, uint32_t count, void (*work)(void*, uint32_t), void* data) {
  for (uint32_t i = count; i-- > 0;) work(data, i);
  *static_cast<uint32_t*>(user) += count;
}

}  // namespace

TEST_CASE("kernels have their names in captures") {
  const auto names = names_of_context();
  for (const VkObjectType type :
       {VK_OBJECT_TYPE_SHADER_MODULE, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT,
        VK_OBJECT_TYPE_PIPELINE_LAYOUT, VK_OBJECT_TYPE_PIPELINE}) {
    REQUIRE(names.contains(type));
    CHECK(names.at(type).contains("wave_bound"));
    CHECK(names.at(type) == names.at(VK_OBJECT_TYPE_PIPELINE));
  }
}

TEST_CASE("threads that create pipelines can be limited, forbidden or given") {
  CHECK(threads_of_context(1) == 1);
  CHECK(threads_of_context(2) <= 2);
  VkhContextCreateInfo info = create_info(0, VKH_DEVICE_KIND_NARROW);
  uint32_t given = 0;
  info.parallelFor = run_here;
  info.parallelUser = &given;
  VkhContext context = nullptr;
  REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
  CHECK(given > 0);
  vkhDestroyContext(context);
}

TEST_CASE("flags that add kernels leave the others as a driver has compiled them") {
  const Specialised plain = specialised_by(0);
  CHECK(plain.values.size() == 1);
  for (const uint32_t flag : {VKH_CONTEXT_CELLS, VKH_CONTEXT_CLOSEST, VKH_CONTEXT_CHECK_INPUT}) {
    CAPTURE(flag);
    const Specialised more = specialised_by(flag);
    CHECK(more.values == plain.values);
    CHECK(more.kernels == plain.kernels + (flag == VKH_CONTEXT_CELLS ? 12 : 1));
  }
  CHECK(specialised_by(VKH_CONTEXT_FINE).values != plain.values);
}

TEST_CASE("extensions are those of the two that the device has") {
  const VkhDeviceInfo info = test_device().engine_info();
  uint32_t count = 0;
  const char* const* names = vkhGetRequiredExtensions(&info, &count);
  CHECK(std::set<std::string>(names, names + count) ==
        std::set<std::string>{"VK_KHR_synchronization2", "VK_KHR_push_descriptor"});
}

TEST_CASE("a supported device has no reasons against it, whatever the room for them") {
  const VkhDeviceInfo info = test_device().engine_info();
  CHECK(vkhQuerySupport(&info, nullptr, 0) == VKH_SUCCESS);
  char one[2] = {'x', 'y'};
  CHECK(vkhQuerySupport(&info, one, 1) == VKH_SUCCESS);
  CHECK(one[0] == '\0');
  CHECK(one[1] == 'y');
}

TEST_CASE("sizes: refused where the header says so") {
  KernelBench bench;
  VkhHierarchyRequirements hierarchy{1, 2, 3, {}};
  VkhWorkspaceRequirements workspace{1, 2, 3, 4};
  const uint32_t most = 1u << 28;
  for (const auto& [vertices, faces] :
       {std::pair{0u, 1u}, {1u, 0u}, {most + 1, 1u}, {1u, most + 1}}) {
    CHECK(vkhGetHierarchyRequirements(bench.context(), vertices, faces, &hierarchy) ==
          VKH_ERROR_TOO_LARGE);
    CHECK(vkhGetWorkspaceRequirements(bench.context(), vertices, faces, &workspace) ==
          VKH_ERROR_TOO_LARGE);
  }
  CHECK(hierarchy.scratchSize == 2);  // left as it was
  CHECK(workspace.maximum == 4);
  for (const uint32_t faces : {1u, 2u, 16u, 17u, 1000u, 100'000u, 1u << 20}) {
    CAPTURE(faces);
    REQUIRE(vkhGetHierarchyRequirements(bench.context(), faces, faces, &hierarchy) == VKH_SUCCESS);
    REQUIRE(vkhGetWorkspaceRequirements(bench.context(), faces, faces, &workspace) == VKH_SUCCESS);
    CHECK(workspace.minimum <= workspace.compact);
    CHECK(workspace.compact <= workspace.recommended);
    CHECK(workspace.recommended <= workspace.maximum);
  }
}
