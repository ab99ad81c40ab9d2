// The radix sort against std::stable_sort, and each of its kernels against plain loops.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "tests/shapes/shapes.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using Words = std::vector<uint32_t>;

constexpr uint32_t kAwkwardSizes[] = {1,   2,   63,   64,   65,   255,  256,  257,
                                      511, 513, 2047, 2048, 2049, 4095, 4097, 10007};

struct Keys {
  const char* name;
  std::function<uint32_t(uint32_t i, uint32_t count, Random&)> at;
};

// Keys with each digit alone, all digits, few distinct ones, and the orders that a stable sort must
// not touch or must turn round.
const Keys kAllKeys[] = {
    {"random", [](uint32_t, uint32_t, Random& r) { return static_cast<uint32_t>(r.bits()); }},
    {"Morton", [](uint32_t, uint32_t, Random& r) { return r.below(1u << 30); }},
    {"all equal", [](uint32_t, uint32_t, Random&) { return 0x12345678u; }},
    {"all zero", [](uint32_t, uint32_t, Random&) { return 0u; }},
    {"all ones", [](uint32_t, uint32_t, Random&) { return 0xffffffffu; }},
    {"sorted", [](uint32_t i, uint32_t, Random&) { return 3 * i; }},
    {"reversed", [](uint32_t i, uint32_t n, Random&) { return 0xffffffffu - 5 * (n - i); }},
    {"two values", [](uint32_t, uint32_t, Random& r) { return r.below(2) * 0xff0000ffu; }},
    {"lowest digit", [](uint32_t, uint32_t, Random& r) { return r.below(256); }},
    {"highest digit", [](uint32_t, uint32_t, Random& r) { return r.below(256) << 24; }},
    {"sawtooth", [](uint32_t i, uint32_t, Random&) { return (i % 7) << 13; }},
    {"runs", [](uint32_t i, uint32_t, Random&) { return (i / 100) * 0x9e3779b9u; }},
};

Words make_keys(const Keys& keys, uint32_t count) {
  Random random(count);
  Words out(count);
  for (uint32_t i = 0; i < count; ++i) out[i] = keys.at(i, count, random);
  return out;
}

struct Sorted {
  Words keys, values;
};

Sorted sort_on_cpu(const Words& keys, const Words& values) {
  Words order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t i, uint32_t j) { return keys[i] < keys[j]; });
  Sorted out;
  for (uint32_t i : order) {
    out.keys.push_back(keys[i]);
    out.values.push_back(values[i]);
  }
  return out;
}

Sorted sort_on_device(KernelBench& bench, const Words& keys, const Words& values) {
  const auto count = static_cast<uint32_t>(keys.size());
  SortStreams scratch;
  scratch.keys[0] = bench.put(keys);
  scratch.values[0] = bench.put(values);
  scratch.keys[1] = bench.garbage<uint32_t>(count);
  scratch.values[1] = bench.garbage<uint32_t>(count);
  scratch.counts = bench.garbage<uint32_t>(sort_rows(count) * gpu::kSortDigits);
  scratch.totals = bench.garbage<uint32_t>(gpu::kSortDigits);
  scratch.count = bench.garbage<uint32_t>(1);
  bench.run([&](Recorder& rec) { record_sort(rec, scratch, count); });
  return {bench.get(scratch.keys[0]), bench.get(scratch.values[0])};
}

void check_sort(KernelBench& bench, const Words& keys) {
  // Values tell equal keys apart, and are not the identity.
  Words values(keys.size());
  for (uint32_t i = 0; i < values.size(); ++i) values[i] = i * 0x9e3779b1u + 7;
  const Sorted expected = sort_on_cpu(keys, values);
  const Sorted found = sort_on_device(bench, keys, values);
  CHECK(std::is_sorted(found.keys.begin(), found.keys.end()));
  CHECK(found.keys == expected.keys);
  CHECK(found.values == expected.values);
}

}  // namespace

TEST_CASE("the sort is std::stable_sort at awkward sizes, whatever the keys") {
  KernelBench bench;
  for (const uint32_t count : kAwkwardSizes) {
    CAPTURE(count);
    for (const Keys& kind : kAllKeys) {
      CAPTURE(kind.name);
      check_sort(bench, make_keys(kind, count));
    }
  }
}

TEST_CASE("the sort is std::stable_sort on many keys") {
  for (const Keys& kind : kAllKeys) {
    KernelBench bench;
    CAPTURE(kind.name);
    check_sort(bench, make_keys(kind, 100'003));
  }
  // Uses more blocks than a workgroup has lanes, so that sort_scan's lanes hold several.
  KernelBench bench;
  check_sort(bench, make_keys(kAllKeys[0], gpu::kSortGroup * gpu::kSortBlock + 12'345));
}

TEST_CASE("the sort is std::stable_sort where blocks grow, and as a CPU device has it") {
  const uint32_t few = gpu::kSortFewBlocks * gpu::kSortGroup;  // keys of few blocks, one per round
  for (const bool wide : {true, false}) {
    KernelBench bench(VKH_SWITCH_DEFAULT_NARROW, wide);
    for (const uint32_t rounds : {2u, 4u, 8u}) {
      for (const uint32_t count : {few * rounds - 1, few * rounds, few * rounds + 1}) {
        CAPTURE(wide);
        CAPTURE(count);
        check_sort(bench, make_keys(kAllKeys[0], count));
      }
    }
  }
}

TEST_CASE("sorting nothing touches nothing") {
  KernelBench bench;
  const Words one(1, 0xdeadbeefu);
  SortStreams s;
  for (int side = 0; side < 2; ++side) s.keys[side] = s.values[side] = bench.put(one);
  s.counts = s.totals = bench.garbage<uint32_t>(gpu::kSortDigits);
  s.count = bench.garbage<uint32_t>(1);
  bench.run([&](Recorder& rec) { record_sort(rec, s, 0); });
  CHECK(bench.get(s.keys[0]) == one);
  CHECK(bench.get(s.values[1]) == one);
}

TEST_CASE("sort_count counts each digit of each block") {
  for (const uint32_t count : kAwkwardSizes) {
    KernelBench bench;
    const Words keys = make_keys(kAllKeys[0], count);
    const auto keys_in = bench.put(keys);
    const auto key_count = bench.put(Words{count});
    for (const uint32_t rounds : {2u, 4u, 8u}) {
      const uint32_t blocks = sort_blocks(count, rounds);
      for (uint32_t shift = 0; shift < 32; shift += 8) {
        Words expected(blocks * gpu::kSortDigits);
        for (uint32_t i = 0; i < count; ++i) {
          const uint32_t block = i / (rounds * gpu::kSortGroup);
          ++expected[block * gpu::kSortDigits + ((keys[i] >> shift) & 255)];
        }
        const auto counts = bench.garbage<uint32_t>(expected.size());
        const gpu::SortPush push{
            .shift = shift, .rounds = rounds, .count = gpu::kNone, .pass = 0, .passes = 1};
        bench.run([&](Recorder& rec) {
          rec.run<k::SortCount>(Direct<k::SortCount>{{keys_in, counts, key_count}, push},
                                Groups{blocks});
        });
        CAPTURE(count);
        CAPTURE(rounds);
        CAPTURE(shift);
        CHECK(bench.get(counts) == expected);
      }
    }
  }
}

TEST_CASE("sort_scan sums each digit's counts exclusively") {
  for (const uint32_t blocks : {1u, 2u, 63u, 64u, 65u, 255u, 256u, 257u, 511u, 513u, 1000u}) {
    KernelBench bench;
    Random random(blocks);
    Words counts(blocks * gpu::kSortDigits);
    for (uint32_t& c : counts) c = random.below(gpu::kSortBlock + 1);
    Words sums, totals(gpu::kSortDigits);
    for (uint32_t i = 0; i < counts.size(); ++i) {
      sums.push_back(totals[i % gpu::kSortDigits]);
      totals[i % gpu::kSortDigits] += counts[i];
    }
    const auto in_out = bench.put(counts);
    const auto totals_out = bench.garbage<uint32_t>(gpu::kSortDigits);
    const auto key_count = bench.put(Words{blocks * gpu::kSortBlock});
    const gpu::SortPush push{
        .shift = 0, .rounds = gpu::kSortRounds, .count = gpu::kNone, .pass = 0, .passes = 1};
    bench.run([&](Recorder& rec) {
      rec.run<k::SortScan>(Direct<k::SortScan>{{in_out, totals_out, key_count}, push},
                           Groups{gpu::kSortDigits});
    });
    CAPTURE(blocks);
    CHECK(bench.get(in_out) == sums);
    CHECK(bench.get(totals_out) == totals);
  }
}
