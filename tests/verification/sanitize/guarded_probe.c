// Writes or reads beyond a block, or only touches its own memory, as its argument selects: for
// guarded_test.sh.
#define _POSIX_C_SOURCE 200112L
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char** argv) {
  const char* way = argc > 1 ? argv[1] : "";
  unsigned char *aligned = NULL, *grown = realloc(malloc(5000), 8192), *zero = calloc(2, 4096);
  if (posix_memalign((void**)&aligned, 256, 100) != 0 || grown == NULL || zero == NULL) return 2;
  volatile unsigned char *a = aligned, *g = grown, *z = zero;
  a[99] = g[8191] = z[8191] = 1;
  if (z[0] != 0) return 2;
  if (strcmp(way, "read") == 0) a[100] = g[8192];
  if (strcmp(way, "write") == 0) z[8192] = 1;
  if (strcmp(way, "slack") == 0) a[100] = 1;  // before where nothing may be touched
  const uintptr_t freed = (uintptr_t)zero;    // a number, which compilers let stand
  free(aligned);
  free(grown);
  free(zero);
  if (strcmp(way, "freed") == 0) *(volatile unsigned char*)freed = 1;
  puts("touched");
  return 0;
}
