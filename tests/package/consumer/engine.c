/* The installed header and archive from C: prints the extensions that a device needs. */
#include <stdio.h>
#include <vkhausdorff.h>

int main(void) {
  uint32_t count = 0, i;
  const char* const* names = vkhGetRequiredExtensions(&count);
  for (i = 0; i < count; ++i) puts(names[i]);
  vkhDestroyContext(NULL);
  return count == 2 ? 0 : 1;
}
