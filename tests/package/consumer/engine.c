/* The installed header and archive from C: prints the version. */
#include <stdio.h>
#include <vkhausdorff.h>
#include <vulkan/vulkan.h> /* after ours, which must not have hidden its prototypes */

/* Not evaluated: nothing of the loader is linked. */
enum { kPrototypes = sizeof(&vkCreateInstance) };

int main(void) {
  puts(VKH_VERSION_STRING);
  vkhDestroyContext(NULL);
  return vkhGetVersion() == VKH_VERSION ? 0 : 1;
}
