#include "tests/support/bus_error.h"

#ifdef __linux__
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <string_view>

namespace vkh::test {
namespace {

// Nothing here allocates: the heap may be broken.
void say(std::string_view text) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
}

void say_number(uintptr_t number) {
  std::array<char, 20> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, 16).ptr;
  say("0x");
  say({digits.data(), static_cast<size_t>(end - digits.data())});
}

// Whether a line of /proc/self/maps, which begins as "55d0c000-55d0d000 ", is of the address.
bool is_of(std::string_view line, uintptr_t address) {
  uintptr_t begin = 0, end = 0;
  const char* last = line.data() + line.size();
  const char* dash = std::from_chars(line.data(), last, begin, 16).ptr;
  if (dash == last) return false;
  std::from_chars(dash + 1, last, end, 16);
  return begin <= address && address < end;
}

void say_mapping(uintptr_t address) {
  const int maps = open("/proc/self/maps", O_RDONLY | O_CLOEXEC);
  std::array<char, 512> line{};
  size_t length = 0;
  while (maps >= 0 && length < line.size() && read(maps, &line[length], 1) == 1) {
    if (line[length++] != '\n') continue;
    if (is_of({line.data(), length}, address)) say({line.data(), length});
    length = 0;
  }
  if (maps >= 0) close(maps);
}

void explain(int signal, siginfo_t* info, void*) {
  const auto address = reinterpret_cast<uintptr_t>(info->si_addr);
  say(info->si_code == BUS_ADRERR ? "bus error: a mapped file has no room, or was cut, at "
                                  : "bus error: no memory has the address that was used; at ");
  say_number(address);
  say("\n");
  say_mapping(address);
  std::array<void*, 32> callers{};
  backtrace_symbols_fd(callers.data(), backtrace(callers.data(), 32), STDERR_FILENO);
  raise(signal);  // by default now: it ends the program
}

}  // namespace

void explain_bus_errors() {
  std::array<void*, 1> first{};
  backtrace(first.data(), 1);  // loads what it needs
  struct sigaction action {};
  action.sa_sigaction = explain;
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_RESETHAND);
  sigaction(SIGBUS, &action, nullptr);
}

}  // namespace vkh::test

// Replaces the C library's, so that no library blocks the signals of faults.
extern "C" __attribute__((visibility("default"))) int pthread_sigmask(int how, const sigset_t* set,
                                                                      sigset_t* old) noexcept {
  static const auto next =
      reinterpret_cast<decltype(&pthread_sigmask)>(dlsym(RTLD_NEXT, "pthread_sigmask"));
  if (set == nullptr || how == SIG_UNBLOCK) return next(how, set, old);
  sigset_t without = *set;
  for (const int fault : {SIGBUS, SIGSEGV, SIGILL, SIGFPE}) sigdelset(&without, fault);
  return next(how, &without, old);
}
#else
void vkh::test::explain_bus_errors() {}
#endif
