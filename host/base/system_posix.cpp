#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>

#include "host/base/system.h"

namespace vkh {
namespace {

namespace fs = std::filesystem;

// A signal handler can reach nothing but a global.
volatile std::sig_atomic_t g_interrupted = 0;

extern "C" void on_interrupt(int signal) {
  g_interrupted = 1;
  std::signal(signal, SIG_DFL);
}

#ifdef __APPLE__
constexpr const char* kLoaders[] = {"libvulkan.1.dylib", "/usr/local/lib/libvulkan.1.dylib",
                                    "/opt/homebrew/lib/libvulkan.1.dylib", "libMoltenVK.dylib"};
#else
constexpr const char* kLoaders[] = {"libvulkan.so.1", "libvulkan.so"};
#endif

void* vulkan_loader() {
  for (const char* name : kLoaders) {
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
  }
  return nullptr;
}

}  // namespace

#ifdef __APPLE__
const char* const kVulkanLoader =
    "libvulkan.1.dylib or libMoltenVK.dylib: install the Vulkan SDK, or molten-vk and "
    "vulkan-loader from Homebrew";
const bool kAsksForPortability = true;
#else
const bool kAsksForPortability = false;
const char* const kVulkanLoader = "libvulkan.so.1: install your driver's or the package libvulkan1";
#endif

std::vector<std::string> command_line(int argc, const char* const* argv) {
  return {argv + (argc > 0 ? 1 : 0), argv + argc};
}

Console::Console() = default;
Console::~Console() = default;

bool is_error_terminal() { return isatty(STDERR_FILENO) == 1; }

void note_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}
bool is_interrupted() { return g_interrupted != 0; }

fs::path user_cache_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && cache[0] == '/') return fs::path(cache) / "vkhausdorff";
  const char* home = std::getenv("HOME");
  return home != nullptr && home[0] == '/' ? fs::path(home) / ".cache" / "vkhausdorff" : fs::path();
}

unsigned long process_id() { return static_cast<unsigned long>(getpid()); }

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

void end_process(int code) { std::_Exit(code); }

AnyFunction vulkan_loader_function(const char* name) {
  void* library = vulkan_loader();
  return library == nullptr ? nullptr : reinterpret_cast<AnyFunction>(dlsym(library, name));
}

}  // namespace vkh
