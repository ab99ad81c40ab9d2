/* Stands in for a driver that allocates once for the life of the process, as Mesa does on
 * processors of one make: 128 bytes, which nothing points to once the library is unloaded. */
#include <stdlib.h>

void leaky_driver_start(void);
static void* volatile kept;

__attribute__((visibility("default"), noinline)) void leaky_driver_start(void) {
  kept = malloc(128);
  kept = NULL;
}
