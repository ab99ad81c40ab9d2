// Loaded before a test program (LD_PRELOAD): every allocation that is aligned, as a CPU driver's
// buffers are, or has 4 kB ends where memory begins that nothing may touch, up to 15 bytes that are
// checked when it is freed. So a kernel that a CPU driver compiled is caught at the instruction
// that reads or writes beyond a buffer, at full speed, with the instructions of the processor. New
// memory has a pattern of its own, and freed memory is not given out again.
#define _GNU_SOURCE
#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* block, size_t size);
extern void __libc_free(void* block);

#define EXPORT __attribute__((visibility("default")))

static const size_t kPage = 4096, kLeast = 4096, kRegion = (size_t)1 << 44;
static const uint64_t kMark = 0x5afe6a4d5afe6a4d;
static const unsigned char kPattern = 0xa5;

// A page before the block's own: [Head][pages of the block][a page that nothing may touch].
struct Head {
  uint64_t mark;
  unsigned char* block;
  size_t size, pages;
};

static char* g_region;  // reserved once, given out from the front
static size_t g_used;

static char* region(void) {
  char* known = __atomic_load_n(&g_region, __ATOMIC_ACQUIRE);
  if (known != NULL) return known;
  char* made = mmap(NULL, kRegion, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (made == MAP_FAILED) abort();
  if (__atomic_compare_exchange_n(&g_region, &known, made, 0, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE))
    return made;
  munmap(made, kRegion);
  return known;
}

static int is_guarded(const void* block) {
  const char* begin = __atomic_load_n(&g_region, __ATOMIC_ACQUIRE);
  return begin != NULL && (const char*)block >= begin && (const char*)block < begin + kRegion;
}

static void* guarded(size_t alignment, size_t size) {
  if (alignment < kPage) alignment = 16;
  const size_t pages = (size + alignment + kPage - 1) / kPage;
  char* at = region() + __atomic_fetch_add(&g_used, (pages + 2) * kPage, __ATOMIC_RELAXED);
  if (mprotect(at, (pages + 1) * kPage, PROT_READ | PROT_WRITE) != 0) {
    errno = ENOMEM;
    return NULL;
  }
  memset(at + kPage, kPattern, pages * kPage);
  const uintptr_t end = (uintptr_t)at + (pages + 1) * kPage;
  struct Head* head = (struct Head*)at;
  *head = (struct Head){kMark, (unsigned char*)((end - size) & ~(alignment - 1)), size, pages};
  return head->block;
}

static struct Head* head_of(void* block) {
  struct Head* head = (struct Head*)((uintptr_t)block & ~(kPage - 1));
  while (head->mark != kMark || head->block != block) head = (struct Head*)((char*)head - kPage);
  return head;
}

static void check(const unsigned char* begin, const unsigned char* end) {
  for (; begin < end; ++begin) {
    if (*begin != kPattern) abort();  // an overrun wrote there
  }
}

static void release(void* block) {
  struct Head* head = head_of(block);
  unsigned char* pages = (unsigned char*)head + kPage;
  check(pages, head->block);
  check(head->block + head->size, pages + head->pages * kPage);
  const size_t bytes = (head->pages + 1) * kPage;
  mmap(head, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED, -1, 0);
}

EXPORT void* malloc(size_t size) { return size < kLeast ? __libc_malloc(size) : guarded(16, size); }

EXPORT void* calloc(size_t count, size_t size) {
  if (size != 0 && count > SIZE_MAX / size) return __libc_calloc(count, size);
  if (count * size < kLeast) return __libc_calloc(count, size);
  void* block = guarded(16, count * size);
  return block == NULL ? NULL : memset(block, 0, count * size);
}

EXPORT void free(void* block) {
  if (is_guarded(block)) {
    release(block);
  } else {
    __libc_free(block);
  }
}

EXPORT void* realloc(void* block, size_t size) {
  if (block == NULL) return malloc(size);
  if (!is_guarded(block)) return __libc_realloc(block, size);
  void* moved = size == 0 ? NULL : malloc(size);
  if (size != 0 && moved == NULL) return NULL;
  const size_t before = head_of(block)->size;
  if (moved != NULL) memcpy(moved, block, before < size ? before : size);
  release(block);
  return moved;
}

EXPORT void* memalign(size_t alignment, size_t size) { return guarded(alignment, size); }
EXPORT void* aligned_alloc(size_t alignment, size_t size) { return guarded(alignment, size); }
EXPORT int posix_memalign(void** block, size_t alignment, size_t size) {
  void* made = guarded(alignment, size);
  if (made == NULL) return ENOMEM;
  *block = made;
  return 0;
}
