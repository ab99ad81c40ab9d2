#include <pthread.h>
#include <sys/utsname.h>
#include <unistd.h>
#ifdef __APPLE__
#include <sys/sysctl.h>
#endif

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <fstream>

#include "host/base/begin_now.h"
#include "host/base/system.h"

namespace vkh {
namespace {

namespace fs = std::filesystem;

// Global, since a signal handler can reach nothing else; atomic, since other threads read it.
std::atomic<bool> g_interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// `static`, since a function of C in a namespace without a name is visible to all of the program.
extern "C" {
static void on_interrupt(int) { g_interrupted = true; }
}

// The second signal does what it does by default: it ends the process.
void note_signal(int signal) {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(signal, &action, nullptr);
}

constexpr const char* kUnknownProcessor = "unknown processor";

std::string machine_name() {
  utsname names{};
  return uname(&names) == 0 ? names.machine : kUnknownProcessor;
}

}  // namespace

std::vector<std::string> command_line(int argc, const char* const* argv) {
  return {argv + (argc > 0 ? 1 : 0), argv + argc};
}

Console::Console() = default;
Console::~Console() = default;

bool is_error_terminal() { return isatty(STDERR_FILENO) == 1; }

void note_interrupts() {
  note_signal(SIGINT);
  note_signal(SIGTERM);
}
bool is_interrupted() { return g_interrupted; }

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

#ifdef __APPLE__
std::string processor_name() {
  std::array<char, 256> name{};
  size_t size = name.size() - 1;
  const bool is_known =
      sysctlbyname("machdep.cpu.brand_string", name.data(), &size, nullptr, 0) == 0;
  return is_known && name[0] != '\0' ? name.data() : machine_name();
}
#else
// Linux names no processor on ARM; then only the machine's kind is known.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t at = line.find(": ");
    if (line.starts_with("model name") && at != std::string::npos) return line.substr(at + 2);
  }
  return machine_name();
}
#endif

void call_in_forks(void (*renew)()) { pthread_atfork(nullptr, nullptr, renew); }

void end_process(int code) { std::_Exit(code); }

// Linux shows the name: such threads can be told from those that must end.
void leave_thread(std::thread thread) {
#ifdef __linux__
  pthread_setname_np(thread.native_handle(), "vkh-left");
#endif
  thread.detach();
}

}  // namespace vkh
