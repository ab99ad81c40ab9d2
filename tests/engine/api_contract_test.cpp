// The header's promises about itself, sizes and refusals.
#include <doctest/doctest.h>

#include <cctype>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

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
  VkhWorkspaceRequirements workspace{1, 2, 3};
  const uint32_t most = 1u << 28;
  for (const auto& [vertices, faces] :
       {std::pair{0u, 1u}, {1u, 0u}, {most + 1, 1u}, {1u, most + 1}}) {
    CHECK(vkhGetHierarchyRequirements(bench.context(), vertices, faces, &hierarchy) ==
          VKH_ERROR_TOO_LARGE);
    CHECK(vkhGetWorkspaceRequirements(bench.context(), vertices, faces, &workspace) ==
          VKH_ERROR_TOO_LARGE);
  }
  CHECK(hierarchy.scratchSize == 2);  // left as it was
  CHECK(workspace.maximum == 3);
  for (const uint32_t faces : {1u, 2u, 16u, 17u, 1000u, 100'000u, 1u << 20}) {
    CAPTURE(faces);
    REQUIRE(vkhGetHierarchyRequirements(bench.context(), faces, faces, &hierarchy) == VKH_SUCCESS);
    REQUIRE(vkhGetWorkspaceRequirements(bench.context(), faces, faces, &workspace) == VKH_SUCCESS);
    CHECK(workspace.minimum <= workspace.recommended);
    CHECK(workspace.recommended <= workspace.maximum);
  }
}
