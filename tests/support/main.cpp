// Every test program's main: doctest's, and a failure if the validation layer said anything.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>

#include "tests/support/kernel_bench.h"

int main(int argc, char** argv) {
  const int result = doctest::Context(argc, argv).run();
  const uint32_t messages = vkh::test::validation_messages();
  if (messages > 0) std::fprintf(stderr, "%u messages of the validation layer\n", messages);
  vkh::test::release_kept();
  return result != 0 ? result : (messages > 0 ? 1 : 0);
}
