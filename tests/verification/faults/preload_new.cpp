// Loaded before the program (LD_PRELOAD): VKH_FAIL_NEW=n fails its n-th allocation, "n+" all from
// there on; VKH_COUNT_NEW=file gets their number at the end.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "tests/verification/faults/failing_new.h"

namespace {

using Main = int (*)(int, char**, char**);
Main g_main = nullptr;

// No code can catch a failed allocation of static objects before main.
int armed_main(int argc, char** argv, char** environment) {
  const char* text = std::getenv("VKH_FAIL_NEW");
  char* end = nullptr;
  const uint64_t n = text == nullptr ? 0 : std::strtoull(text, &end, 10);
  vkh::test::failing_new().arm(n, end != nullptr && *end == '+');
  return g_main(argc, argv, environment);
}

}  // namespace

// The function by which the C library starts every program; seven parameters are its own.
// NOLINTNEXTLINE(readability-function-size)
extern "C" __attribute__((visibility("default"))) int __libc_start_main(Main main, int argc,
                                                                        char** argv, void (*init)(),
                                                                        void (*fini)(),
                                                                        void (*loader_fini)(),
                                                                        void* stack_end) {
  g_main = main;
  const auto next =
      reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return next(armed_main, argc, argv, init, fini, loader_fini, stack_end);
}

// The program ends with this call, which runs no exit handlers.
extern "C" __attribute__((visibility("default"), noreturn)) void _Exit(int code) {
  const uint64_t count = vkh::test::failing_new().disarm();
  const char* path = std::getenv("VKH_COUNT_NEW");
  if (std::FILE* file = path == nullptr ? nullptr : std::fopen(path, "w")) {
    std::fprintf(file, "%llu\n", static_cast<unsigned long long>(count));
    std::fclose(file);
  }
  _exit(code);
}
