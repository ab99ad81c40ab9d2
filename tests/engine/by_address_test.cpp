// Kernels by address compute the address of an element in 64 bits, with every carry.
#include "engine/by_address.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/kernels.h"

namespace {

using namespace vkh;

// Opcodes of SPIR-V.
constexpr uint32_t kTypePointer = 32, kVariable = 59, kMemberDecorate = 72, kConstant = 43,
                   kLoad = 61, kDecorate = 71, kConstruct = 80, kExtract = 81, kBitcast = 124,
                   kIAdd = 128, kIAddCarry = 149, kUMulExtended = 151;
constexpr uint32_t kBinding = 33, kPhysical = 5349, kArrayStride = 6, kHeaderWords = 5,
                   kBoundAt = 3;

using Pair = std::array<uint32_t, 2>;

/// A module by address: its added instructions, and its strides.
struct Module {
  struct Instruction {
    uint32_t op;
    std::span<const uint32_t> args;  // behind its type and its result
  };
  std::map<uint32_t, Instruction> added;  // by their results
  std::map<uint32_t, uint32_t> constants;
  std::vector<uint32_t> addresses;  // used as a pointer
  std::set<uint64_t> strides;

  Module(const std::vector<uint32_t>& words, uint32_t bound_before) {
    std::set<uint32_t> pointers;
    for (size_t at = kHeaderWords; at < words.size(); at += words[at] >> 16) {
      const uint32_t op = words[at] & 0xffff;
      const std::span args(words.data() + at + 1, (words[at] >> 16) - 1);
      if (op == kTypePointer && args[1] == kPhysical) pointers.insert(args[0]);
      if (op == kConstant) constants[args[1]] = args[2];
      if (op == kDecorate && args[1] == kArrayStride) strides.insert(args[2]);
      if (op == kBitcast && pointers.contains(args[0])) addresses.push_back(args[2]);
      for (const uint32_t known : {kLoad, kConstruct, kExtract, kIAdd, kIAddCarry, kUMulExtended}) {
        if (op == known && args[1] >= bound_before) added[args[1]] = {op, args.subspan(2)};
      }
    }
  }
  // Whether the summand of the address is a constant 0 times the stride.
  bool asks_for_first(uint32_t id) const {
    const Instruction& i = added.at(id);
    if (i.op == kLoad) return false;
    if (i.op == kUMulExtended) {
      const auto number = constants.find(added.at(i.args[0]).args[0]);  // index + 0
      return number != constants.end() && number->second == 0;
    }
    return std::any_of(i.args.begin(), i.args.end(),
                       [&](uint32_t arg) { return added.contains(arg) && asks_for_first(arg); });
  }
};

/// Runs the added instructions, with `start` as the loaded address and `index` as the shader's
/// index.
struct Reckoner {
  const Module& module;
  uint64_t start;
  uint32_t index;

  static Pair halves(uint64_t x) {
    return {static_cast<uint32_t>(x), static_cast<uint32_t>(x >> 32)};
  }
  Pair pair(uint32_t id) const {
    const auto& [op, args] = module.added.at(id);
    if (op == kConstruct) return {word(args[0]), word(args[1])};
    if (op == kIAddCarry) return halves(uint64_t{word(args[0])} + word(args[1]));
    if (op == kUMulExtended) return halves(uint64_t{word(args[0])} * word(args[1]));
    REQUIRE(op == kLoad);
    return halves(start);
  }
  uint32_t word(uint32_t id) const {
    if (const auto constant = module.constants.find(id); constant != module.constants.end())
      return constant->second;
    if (!module.added.contains(id)) return index;
    const auto& [op, args] = module.added.at(id);
    REQUIRE((op == kExtract || op == kIAdd));
    return op == kExtract ? pair(args[0])[args[1]] : word(args[0]) + word(args[1]);
  }
  uint64_t address(uint32_t id) const { return uint64_t{pair(id)[1]} << 32 | pair(id)[0]; }
};

/// The decorations, besides the offset, of the member of each block that is reached as `wanted`
/// selects.
template <class Wanted>
std::multiset<std::set<uint32_t>> said_of_blocks(std::span<const uint32_t> words, Wanted&& wanted) {
  std::map<uint32_t, std::set<uint32_t>> said;
  std::map<uint32_t, uint32_t> bindings, pointees;  // of variables; of pointers
  std::multiset<std::set<uint32_t>> found;
  for (size_t at = kHeaderWords; at < words.size(); at += words[at] >> 16) {
    const uint32_t op = words[at] & 0xffff;
    const std::span args(words.data() + at + 1, (words[at] >> 16) - 1);
    if (op == kMemberDecorate && args.size() == 3) said[args[0]].insert(args[2]);
    if (op == kDecorate && args[1] == kBinding) bindings[args[0]] = args[2];
    if (op == kTypePointer) pointees[args[0]] = args[2];
    if (op == kVariable && bindings.contains(args[1]) && wanted(bindings[args[1]]))
      found.insert(said[pointees[args[0]]]);
  }
  return found;
}

/// The decorations of the added blocks that pointers lead to.
std::multiset<std::set<uint32_t>> said_of_added(std::span<const uint32_t> words, uint32_t bound) {
  std::map<uint32_t, std::set<uint32_t>> said;
  std::multiset<std::set<uint32_t>> found;
  for (size_t at = kHeaderWords; at < words.size(); at += words[at] >> 16) {
    const uint32_t op = words[at] & 0xffff;
    const std::span args(words.data() + at + 1, (words[at] >> 16) - 1);
    if (op == kMemberDecorate && args.size() == 3) said[args[0]].insert(args[2]);
    if (op == kTypePointer && args[1] == kPhysical && args[2] >= bound) found.insert(said[args[2]]);
  }
  return found;
}

/// The number of computed addresses.
size_t check_kernel(std::span<const uint32_t> words, std::span<const uint32_t> edits,
                    uint32_t given) {
  CHECK(edits.empty() == (given == 0));
  if (given == 0) return 0;
  const std::vector<uint32_t> rewritten = edited(words, edits);
  const Module module(rewritten, words[kBoundAt]);
  // Coherent, NonWritable and the like stay with the buffers by address.
  CHECK(said_of_added(rewritten, words[kBoundAt]) ==
        said_of_blocks(words, [&](uint32_t binding) { return (given >> binding & 1) != 0; }));
  size_t wrong = 0;
  constexpr uint64_t kBelowCarry = (uint64_t{7} << 32) - 256;
  for (const uint64_t start : {uint64_t{4096}, kBelowCarry, uint64_t{0x7f3412345600}}) {
    for (const uint32_t index : {1u, 1000003u, 400000009u, 2147483659u, 4294967291u}) {
      for (const uint32_t id : module.addresses) {
        const uint64_t offset = Reckoner{module, start, index}.address(id) - start;
        const bool is_element = offset % index == 0 && module.strides.contains(offset / index);
        const bool is_first = offset == 0 && module.asks_for_first(id);
        wrong += is_first || is_element ? 0 : 1;
      }
    }
  }
  CHECK(wrong == 0);
  return module.addresses.size();
}

}  // namespace

TEST_CASE("an element by address lies its number times the stride behind the start") {
  size_t places = 0;
#define VKH_CHECK(K)                                                                        \
  {                                                                                         \
    const std::string kernel = k::K::kName;                                                 \
    CAPTURE(kernel);                                                                        \
    places += check_kernel(k::K::words(), k::K::edits(), k::K::kByAddress);                 \
    places += check_kernel(k::K::words_for_cpu(), k::K::edits_for_cpu(), k::K::kByAddress); \
  }
  VKH_KERNELS(VKH_CHECK)
#undef VKH_CHECK
  CHECK(places > 500);
}
