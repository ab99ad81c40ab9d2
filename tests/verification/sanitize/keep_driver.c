/* Linked into every program of the sanitizer tree. Opens the drivers that VK_DRIVER_FILES (or
 * VK_ICD_FILENAMES) names before anything else does, and for good. The Vulkan loader unloads a
 * driver with the last instance, before leaks are counted; what the driver allocated once for the
 * life of the process is then a leak of an unknown module, which
 * tests/verification/sanitize/lsan.supp cannot name. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The text between the quotes that follow "key":, cut off where it does not fit. */
static int value_of(const char* json, const char* key, char* out, size_t size) {
  const char* at = strstr(json, key);
  const char* colon = at != NULL ? strchr(at, ':') : NULL;
  const char* open = colon != NULL ? strchr(colon, '"') : NULL;
  const char* close = open != NULL ? strchr(open + 1, '"') : NULL;
  if (close == NULL || (size_t)(close - open) > size) return 0;
  memcpy(out, open + 1, (size_t)(close - open - 1));
  out[close - open - 1] = '\0';
  return 1;
}

static void keep(const char* manifest) {
  char json[8192], library[4096];
  FILE* file = fopen(manifest, "rb");
  if (file == NULL) return;
  json[fread(json, 1, sizeof json - 1, file)] = '\0';
  fclose(file);
  if (!value_of(json, "\"library_path\"", library, sizeof library)) return;
  if (dlopen(library, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE) == NULL)
    fprintf(stderr, "keep_driver: %s: %s\n", manifest, dlerror());
}

__attribute__((constructor)) static void keep_drivers(void) {
  const char* files = getenv("VK_DRIVER_FILES");
  if (files == NULL) files = getenv("VK_ICD_FILENAMES");
  char* list = files != NULL ? strdup(files) : NULL;
  if (list == NULL) return;
  char* rest = NULL;
  for (char* one = strtok_r(list, ":", &rest); one != NULL; one = strtok_r(NULL, ":", &rest))
    keep(one);
  free(list);
}
