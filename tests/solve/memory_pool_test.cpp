// Buffers that share blocks of memory: none reaches into another one, whatever is taken and given
// back; and runs in such buffers give what they give alone.
#include "host/gpu/memory_pool.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "host/base/parallel.h"
#include "host/gpu/memory.h"

using namespace vkh;

namespace {

struct Filled {
  Buffer buffer;
  unsigned char value;
};

Filled filled_buffer(const Device& device, MemoryPool* pool, VkDeviceSize bytes,
                     unsigned char value) {
  Buffer buffer(device, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::kUpload, pool);
  std::memset(buffer.mapped(), value, bytes);
  return {std::move(buffer), value};
}

bool is_intact(const Filled& one) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(one.buffer.mapped());
  return std::all_of(bytes, bytes + one.buffer.size(),
                     [&](unsigned char byte) { return byte == one.value; });
}

}  // namespace

TEST_CASE("buffers of a pool keep their bytes while others come and go") {
  const Device device;
  MemoryPool pool(device);
  std::mt19937 random(3);
  std::vector<Filled> kept;
  for (unsigned step = 0; step < 400; ++step) {
    const bool goes = kept.size() > 40 || (!kept.empty() && random() % 3 == 0);
    if (goes) {
      const size_t which = random() % kept.size();
      CHECK(is_intact(kept[which]));
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(which));
    } else {
      const VkDeviceSize bytes = 1 + random() % (random() % 8 == 0 ? 3'000'000 : 200'000);
      kept.push_back(filled_buffer(device, &pool, bytes, static_cast<unsigned char>(step)));
    }
  }
  CHECK(std::all_of(kept.begin(), kept.end(), is_intact));
}

TEST_CASE("small buffers share a block, and what is given back is used again") {
  const Device device;
  MemoryPool pool(device);
  const auto at = [](const Filled& one) { return one.buffer.mapped(); };
  const Filled first = filled_buffer(device, &pool, 1000, 1);
  Filled second = filled_buffer(device, &pool, 70'000, 2);
  const std::byte* const place = at(second);
  CHECK(place - at(first) == 1 << 16);
  const Filled third = filled_buffer(device, &pool, 1000, 3);
  CHECK(at(third) - place == 2 << 16);
  second.buffer = Buffer();
  const Filled fourth = filled_buffer(device, &pool, 100'000, 4);
  CHECK(at(fourth) == place);
  CHECK(is_intact(first));
  CHECK(is_intact(third));
}

TEST_CASE("a buffer that is large beside a block has memory of its own") {
  const Device device;
  MemoryPool pool(device);
  const VkMemoryRequirements needs{
      .size = device.description().memory_bytes / 2, .alignment = 256, .memoryTypeBits = 1};
  CHECK_FALSE(pool.take(needs, 0));
}

TEST_CASE("threads may share a pool") {
  const Device device;
  MemoryPool pool(device);
  for_each_index(
      8,
      [&](size_t thread) {
        for (unsigned i = 0; i < 20; ++i) {
          const auto value = static_cast<unsigned char>(16 * thread + i);
          const Filled one = filled_buffer(device, &pool, 5000 * (1 + (thread + i) % 7), value);
          if (!is_intact(one)) FAIL("thread " << thread);
        }
      },
      8);
}
