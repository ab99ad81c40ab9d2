/* The installed header and archive from C: prints the version and the extensions that a device
 * needs. */
#include <stdio.h>
#include <vkhausdorff.h>
#include <vulkan/vulkan.h> /* after ours, which must not have hidden its prototypes */

/* Not evaluated: nothing of the loader is linked. */
enum { kPrototypes = sizeof(&vkCreateInstance) };

int main(void) {
  uint32_t count = 0, i;
  const char* const* names = vkhGetRequiredExtensions(&count);
  puts(VKH_VERSION_STRING);
  for (i = 0; i < count; ++i) puts(names[i]);
  vkhDestroyContext(NULL);
  return count == 2 && vkhGetVersion() == VKH_VERSION ? 0 : 1;
}
