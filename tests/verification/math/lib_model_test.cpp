// The tests of the shared headers again, on the model of Vulkan's arithmetic: every operation
// rounds in a direction of its own, quotients and roots are off by what the specification allows.
#define VKH_TEST_VULKAN_MODEL

#include "tests/verification/math/lib_bary_test.cpp"
#include "tests/verification/math/lib_certified_test.cpp"
#include "tests/verification/math/lib_lower_test.cpp"
#include "tests/verification/math/lib_triangle_test.cpp"
#include "tests/verification/math/lib_two_float_test.cpp"
