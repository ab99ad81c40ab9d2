// Kernels from a folder (VKH_SHADER_DIR), in the builds that have them.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/shapes/shapes.h"
#include "tests/support/files.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/solver.h"

namespace fs = std::filesystem;
using namespace vkh;
using namespace vkh::test;

namespace {

struct ShaderFolder {
  explicit ShaderFolder(const fs::path& folder) {
    setenv("VKH_SHADER_DIR", folder.c_str(), /*overwrite=*/1);
  }
  ShaderFolder(const ShaderFolder&) = delete;
  ShaderFolder& operator=(const ShaderFolder&) = delete;
  ~ShaderFolder() { unsetenv("VKH_SHADER_DIR"); }
};

Report solved() {
  const char* selector = std::getenv("VKH_TEST_DEVICE");
  Device device(DeviceRequest{.selector = selector != nullptr ? selector : ""});
  return Solver(device).distance(icosphere(1, 0), icosphere(2, 0));
}

fs::path empty_folder() {
  const fs::path made = vkh::test::folder() / "shaders";
  fs::remove_all(made);
  fs::create_directories(made);
  return made;
}

}  // namespace

TEST_CASE("a folder's kernels give the embedded ones' interval") {
  const Report embedded = solved();
  REQUIRE(fs::exists(fs::path(VKH_KERNEL_FOLDER) / "wave_bound.spv"));
  const ShaderFolder use(VKH_KERNEL_FOLDER);
  const Report report = solved();
  CHECK(report.lower == embedded.lower);
  CHECK(report.upper == embedded.upper);
}

TEST_CASE("a folder's kernel is the one that runs, and others are the embedded ones") {
  const fs::path folder = empty_folder();
  const ShaderFolder use(folder);
  CHECK_NOTHROW(solved());
  std::ofstream(folder / "wave_bound.spv") << "no SPIR-V";
  CHECK_THROWS_AS(solved(), DeviceError);
}
