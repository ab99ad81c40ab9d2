/* Loads the driver argv[1] as the Vulkan loader does and unloads it again before leaks are counted.
 * With a second argument it also leaks 64 bytes of its own. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

static __attribute__((noinline)) void leak(void) {
  volatile char* lost = malloc(64);
  lost[0] = 1;
}

int main(int argc, char** argv) {
  void* driver = argc > 1 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : NULL;
  void (*start)(void) = NULL;
  if (driver == NULL) return fprintf(stderr, "leak_probe: %s\n", dlerror()), 2;
  *(void**)&start = dlsym(driver, "leaky_driver_start");
  if (start == NULL) return 2;
  start();
  dlclose(driver);
  if (argc > 2) leak();
  return 0;
}
