// The same tests on the model of Vulkan's arithmetic: every operation rounds in a direction of its
// own.
#define VKH_TEST_VULKAN_MODEL

#include "tests/verification/math/lib_parts_test.cpp"
