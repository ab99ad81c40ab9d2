// Our headers first, then Vulkan's: its prototypes are there, as if ours had not been.
#include <vkhausdorff.h>
#include <vkhausdorff/device.h>
#include <vulkan/vulkan.h>

static_assert(sizeof(::vkCreateInstance(nullptr, nullptr, nullptr)) == sizeof(VkResult));
static_assert(VKH_VERSION >= VKH_MAKE_VERSION(0, 2, 0));
