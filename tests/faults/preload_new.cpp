// Loaded before the program (LD_PRELOAD): VKH_FAIL_NEW=n fails its n-th allocation, "n+" all from
// there on; VKH_COUNT_NEW=file gets their number at the end.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "tests/faults/failing_new.h"

namespace {

struct Armed {
  Armed() {
    const char* text = std::getenv("VKH_FAIL_NEW");
    char* end = nullptr;
    const uint64_t n = text == nullptr ? 0 : std::strtoull(text, &end, 10);
    vkh::test::failing_new().arm(n, end != nullptr && *end == '+');
  }
};
const Armed g_armed;

}  // namespace

// The program ends by it, and runs no exit handlers.
extern "C" __attribute__((visibility("default"), noreturn)) void _Exit(int code) {
  const uint64_t count = vkh::test::failing_new().disarm();
  const char* path = std::getenv("VKH_COUNT_NEW");
  if (std::FILE* file = path == nullptr ? nullptr : std::fopen(path, "w")) {
    std::fprintf(file, "%llu\n", static_cast<unsigned long long>(count));
    std::fclose(file);
  }
  _exit(code);
}
