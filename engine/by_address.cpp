#include "engine/by_address.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace vkh {
namespace {

// The few words of the SPIR-V 1.5 specification that this file needs.
enum Op : uint32_t {
  kName = 5,
  kMemoryModel = 14,
  kEntryPoint = 15,
  kCapability = 17,
  kTypeVoid = 19,
  kTypeInt = 21,
  kTypeVector = 23,
  kTypeArray = 28,
  kTypeRuntimeArray = 29,
  kTypeStruct = 30,
  kTypePointer = 32,
  kConstant = 43,
  kFunction = 54,
  kVariable = 59,
  kLoad = 61,
  kStore = 62,
  kAccessChain = 65,
  kInBoundsAccessChain = 66,
  kDecorate = 71,
  kMemberDecorate = 72,
  kCompositeConstruct = 80,
  kCompositeExtract = 81,
  kBitcast = 124,
  kIAdd = 128,
  kIAddCarry = 149,
  kUMulExtended = 151
};
constexpr uint32_t kPushConstant = 9, kPhysical = 5349;            // storage classes
constexpr uint32_t kPhysicalAddresses = 5347, kPhysical64 = 5348;  // capability, addressing
constexpr uint32_t kBlock = 2, kArrayStride = 6, kBinding = 33, kOffset = 35;  // decorations
constexpr uint32_t kAligned = 2;                                               // of a memory access
constexpr uint32_t kHeaderWords = 5, kBoundAt = 3, kNoId = 0;
// The alignment of every buffer that is given by address, and the most that a load can use.
constexpr uint32_t kBaseAlignment = 16, kWordBytes = 4;

struct Instruction {
  uint32_t op;
  std::span<const uint32_t> args;
};

template <class Visit>
void for_each_instruction(std::span<const uint32_t> words, Visit&& visit) {
  for (size_t at = kHeaderWords; at < words.size(); at += words[at] >> 16)
    visit(Instruction{words[at] & 0xffff, words.subspan(at + 1, (words[at] >> 16) - 1)});
}

bool is_chain(uint32_t op) { return op == kAccessChain || op == kInBoundsAccessChain; }

// The module's declarations, as far as they concern the buffers that are given by address.
struct Declarations {
  struct Pointer {
    uint32_t storage, pointee;
  };
  std::map<uint32_t, uint32_t> bindings;  // of their variables
  std::map<uint32_t, uint32_t> blocks;    // of their variables
  std::map<uint32_t, Pointer> pointers;
  struct Moved {
    uint32_t pointee, alignment;  // its type; bytes
  };
  std::map<uint32_t, Moved> moved;  // pointers into them
  uint32_t word_type = kNoId;       // uint
  uint32_t pair_type = kNoId;       // uvec2, if there is one
  uint32_t push = kNoId;            // variable of the push constants
  uint32_t push_member = kNoId;     // type of what they are

  Declarations(std::span<const uint32_t> words, uint32_t wanted) {
    for_each_instruction(words, [&](const Instruction& i) {
      if (i.op == kDecorate && i.args[1] == kBinding && (wanted >> i.args[2] & 1) != 0)
        bindings[i.args[0]] = i.args[2];
      lay_out(i);
      declare(i);
      if (i.op == kVariable && i.args[2] == kPushConstant) {
        push = i.args[1];
        push_member = structs[pointers[i.args[0]].pointee].at(0);
      }
    });
  }

  bool is_given(uint32_t variable) const { return bindings.contains(variable); }

  // The decorations of a block's member besides its offset: that others see writes (Coherent), that
  // nothing is written.
  std::span<const uint32_t> said_of(uint32_t variable) const {
    const auto found = said.find(blocks.at(variable));
    return found == said.end() ? std::span<const uint32_t>() : found->second;
  }

  // The element type of a binding's array, and its stride in bytes.
  struct Array {
    uint32_t element, stride;
  };
  Array array_in(uint32_t variable) const {
    const uint32_t array = structs.at(blocks.at(variable)).at(0);
    return {elements.at(array), strides.at(array)};
  }

 private:
  void declare(const Instruction& i) {
    if (i.op == kTypeInt && i.args[1] == 32 && i.args[2] == 0) word_type = i.args[0];
    if (i.op == kTypeVector && i.args[1] == word_type && i.args[2] == 2) pair_type = i.args[0];
    if (i.op == kTypePointer) pointers[i.args[0]] = {i.args[1], i.args[2]};
    if (i.op == kVariable && is_given(i.args[1])) blocks[i.args[1]] = pointers[i.args[0]].pointee;
    if (is_chain(i.op) && (is_given(i.args[2]) || moved.contains(i.args[2]))) {
      moved[i.args[1]] = {pointers[i.args[0]].pointee, alignment_of(i.args)};
    }
  }

  void lay_out(const Instruction& i) {
    const std::span<const uint32_t> a = i.args;
    if (i.op == kTypeStruct) structs[a[0]].assign(a.begin() + 1, a.end());
    if (i.op == kTypeArray || i.op == kTypeRuntimeArray) elements[a[0]] = a[1];
    if (i.op == kConstant) constants[a[1]] = a[2];
    if (i.op == kDecorate && a[1] == kArrayStride) strides[a[0]] = a[2];
    if (i.op == kMemberDecorate && a[2] == kOffset) offsets[{a[0], a[1]}] = a[3];
    if (i.op == kMemberDecorate && a.size() == 3) said[a[0]].push_back(a[2]);
  }

  // The alignment that a chain of indices reaches: the greatest common divisor of its start and of
  // each step. Drivers load 16 bytes at once only if that alignment is known.
  uint32_t alignment_of(std::span<const uint32_t> chain) const {
    const uint32_t base = chain[2];
    auto [type, alignment] =
        is_given(base) ? Moved{blocks.at(base), kBaseAlignment} : moved.at(base);
    for (const uint32_t index : chain.subspan(3)) {
      if (const auto array = elements.find(type); array != elements.end()) {
        alignment = std::gcd(alignment, strides.at(type));
        type = array->second;
      } else if (const auto members = structs.find(type); members != structs.end()) {
        const uint32_t member = constants.at(index);
        alignment = std::gcd(alignment, offsets.at({type, member}));
        type = members->second.at(member);
      } else {  // a component
        alignment = std::gcd(alignment, kWordBytes);
      }
    }
    return alignment;
  }

  std::map<uint32_t, std::vector<uint32_t>> structs;          // their members' types
  std::map<uint32_t, std::vector<uint32_t>> said;             // of structs of one member
  std::map<uint32_t, uint32_t> elements, strides, constants;  // of arrays, arrays, by their ids
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> offsets;  // of structs' members
};

class Rewriter {
 public:
  Rewriter(std::span<const uint32_t> words, uint32_t bindings)
      : words_(words), d_(words, bindings), bound_(words[kBoundAt]) {
    uint32_t place = 0;
    for (uint32_t binding = 0; binding < kMaxBindings; ++binding) {
      if ((bindings >> binding & 1) != 0) places_[binding] = place++;
    }
  }

  std::vector<uint32_t> rewritten() {
    out_.assign(words_.begin(), words_.begin() + kHeaderWords);
    put(kCapability, {kPhysicalAddresses});
    name_ids();
    bool has_decorations = false, has_types = false;
    for_each_instruction(words_, [&](const Instruction& i) {
      if (i.op >= kTypeVoid && i.op < kConstant && !has_decorations) {
        put_decorations();
        has_decorations = true;
      }
      if (i.op == kFunction && !has_types) {
        put_types();
        has_types = true;
      }
      rewrite(i);
    });
    out_[kBoundAt] = bound_;
    return std::move(out_);
  }

 private:
  using Words = std::vector<uint32_t>;

  uint32_t fresh() { return bound_++; }

  void put(uint32_t op, const Words& args) {
    out_.push_back(static_cast<uint32_t>(args.size() + 1) << 16 | op);
    out_.insert(out_.end(), args.begin(), args.end());
  }

  void name_ids() {
    new_push_ = d_.push == kNoId;
    push_ = new_push_ ? fresh() : d_.push;
    new_pair_ = d_.pair_type == kNoId;
    pair_ = new_pair_ ? fresh() : d_.pair_type;
    for (uint32_t* id : {&push_block_, &push_pointer_, &pair_pointer_, &two_words_, &zero_})
      *id = fresh();
    for (const auto& [pointer, moved] : d_.moved) {
      if (!physical_.contains(moved.pointee)) physical_[moved.pointee] = fresh();
    }
    for (const auto& [variable, binding] : d_.bindings) {
      const uint32_t stride = d_.array_in(variable).stride;
      if (!strides_.contains(stride)) strides_[stride] = fresh();
      members_[variable] = fresh();
      holders_[variable] = {fresh(), fresh()};
    }
  }

  // The types in the block of push constants: the struct that they were, if any, then the
  // addresses.
  uint32_t first_address() const { return new_push_ ? 0 : 1; }

  void put_decorations() {
    for (const auto& [variable, holder] : holders_) {
      put(kDecorate, {holder.block, kBlock});
      put(kMemberDecorate, {holder.block, 0, kOffset, 0});
      for (const uint32_t said : d_.said_of(variable))
        put(kMemberDecorate, {holder.block, 0, said});
    }
    put(kDecorate, {push_block_, kBlock});
    if (!new_push_) put(kMemberDecorate, {push_block_, 0, kOffset, 0});
    uint32_t member = first_address();
    for (const auto& [variable, binding] : d_.bindings)
      put(kMemberDecorate, {push_block_, member++, kOffset, kAddressOffset + 8 * places_[binding]});
  }

  void put_types() {
    for (const auto& [type, pointer] : physical_) put(kTypePointer, {pointer, kPhysical, type});
    for (const auto& [variable, holder] : holders_) {
      put(kTypeStruct, {holder.block, d_.array_in(variable).element});
      put(kTypePointer, {holder.pointer, kPhysical, holder.block});
    }
    if (new_pair_) put(kTypeVector, {pair_, d_.word_type, 2});
    put(kTypePointer, {pair_pointer_, kPushConstant, pair_});
    put(kTypeStruct, {two_words_, d_.word_type, d_.word_type});
    put(kConstant, {d_.word_type, zero_, 0});
    for (const auto& [stride, id] : strides_) put(kConstant, {d_.word_type, id, stride});
    Words block{push_block_};
    if (!new_push_) block.push_back(d_.push_member);
    uint32_t member = first_address();
    for (const auto& [variable, binding] : d_.bindings) {
      block.push_back(pair_);
      put(kConstant, {d_.word_type, members_[variable], member++});
    }
    put(kTypeStruct, block);
    put(kTypePointer, {push_pointer_, kPushConstant, push_block_});
    put(kVariable, {push_pointer_, push_, kPushConstant});
  }

  void rewrite(const Instruction& i) {
    const std::span<const uint32_t> a = i.args;
    if ((i.op == kName || i.op == kDecorate) && d_.is_given(a[0])) return;
    if (i.op == kVariable && (d_.is_given(a[1]) || a[1] == d_.push)) return;
    if (i.op == kMemoryModel) return put(kMemoryModel, {kPhysical64, a[1]});
    if (i.op == kEntryPoint) return put_entry_point(a);
    if (is_chain(i.op) && d_.moved.contains(a[1])) return put_chain(i);
    if (i.op == kLoad && d_.moved.contains(a[2])) return put_access(i, 3);
    if (i.op == kStore && d_.moved.contains(a[0])) return put_access(i, 2);
    put(i.op, Words(a.begin(), a.end()));
  }

  // The entry point's name, in words that end with a zero byte, and then all variables that it
  // uses.
  void put_entry_point(std::span<const uint32_t> a) {
    const auto name_end =
        std::find_if(a.begin() + 2, a.end(), [](uint32_t w) { return w >> 24 == 0; });
    Words kept(a.begin(), name_end + 1);
    std::copy_if(name_end + 1, a.end(), std::back_inserter(kept),
                 [&](uint32_t id) { return !d_.is_given(id); });
    if (new_push_) kept.push_back(push_);
    put(kEntryPoint, kept);
  }

  uint32_t put_value(uint32_t op, uint32_t type, const Words& operands) {
    const uint32_t value = fresh();
    Words args{type, value};
    args.insert(args.end(), operands.begin(), operands.end());
    put(op, args);
    return value;
  }
  uint32_t put_word(uint32_t op, const Words& operands) {
    return put_value(op, d_.word_type, operands);
  }

  // The address of an element, in 64 bits. If the driver adds the offset, an H200's (580.159)
  // reaches something else 4 GiB and more behind an address.
  uint32_t put_address(uint32_t variable, uint32_t index) {
    const uint32_t at = put_value(kAccessChain, pair_pointer_, {push_, members_[variable]});
    const uint32_t start = put_value(kLoad, pair_, {at});
    const uint32_t number = put_word(kIAdd, {index, zero_});  // as uint, if it is an int
    const uint32_t stride = strides_[d_.array_in(variable).stride];
    const uint32_t offset = put_value(kUMulExtended, two_words_, {number, stride});
    const uint32_t sum = put_value(
        kIAddCarry, two_words_,
        {put_word(kCompositeExtract, {start, 0}), put_word(kCompositeExtract, {offset, 0})});
    const uint32_t high = put_word(
        kIAdd, {put_word(kCompositeExtract, {start, 1}), put_word(kCompositeExtract, {offset, 1})});
    const uint32_t carried = put_word(kIAdd, {high, put_word(kCompositeExtract, {sum, 1})});
    return put_value(kCompositeConstruct, pair_, {put_word(kCompositeExtract, {sum, 0}), carried});
  }

  // A chain into a binding names the block's one member, an element, and the part of the element.
  void put_chain(const Instruction& i) {
    Words args(i.args.begin(), i.args.end());
    args[0] = physical_[d_.pointers[args[0]].pointee];
    if (!d_.is_given(args[2])) return put(i.op, args);
    const uint32_t variable = args[2];
    const uint32_t address = put_address(variable, args.at(4));
    args[2] = put_value(kBitcast, holders_[variable].pointer, {address});
    args[3] = zero_;
    args.erase(args.begin() + 4);
    put(i.op, args);
  }

  // An access by address states its alignment: behind `operands` arguments, and before any of a
  // higher bit.
  void put_access(const Instruction& i, size_t operands) {
    Words args(i.args.begin(), i.args.end());
    if (args.size() == operands) args.push_back(0);
    args[operands] |= kAligned;
    const uint32_t alignment = d_.moved.at(i.op == kLoad ? args[2] : args[0]).alignment;
    args.insert(args.begin() + static_cast<std::ptrdiff_t>(operands) + 1, alignment);
    put(i.op, args);
  }

  std::span<const uint32_t> words_;
  Declarations d_;
  uint32_t bound_;
  Words out_;
  std::array<uint32_t, kMaxBindings> places_{};
  bool new_push_ = false, new_pair_ = false;
  uint32_t push_ = kNoId, push_block_ = kNoId, push_pointer_ = kNoId;
  uint32_t pair_ = kNoId, pair_pointer_ = kNoId;  // uvec2, and a pointer to it
  uint32_t two_words_ = kNoId;                    // struct of two uints
  uint32_t zero_ = kNoId;
  // A block of one element, with the decorations of the array, and a pointer to it.
  struct Holder {
    uint32_t block, pointer;
  };
  std::map<uint32_t, Holder> holders_;     // by variable
  std::map<uint32_t, uint32_t> strides_;   // constants
  std::map<uint32_t, uint32_t> physical_;  // pointers by address, by what they point to
  std::map<uint32_t, uint32_t> members_;   // constants: which address, by its variable
};

}  // namespace

std::vector<uint32_t> by_address(std::span<const uint32_t> words, uint32_t bindings) {
  return Rewriter(words, bindings).rewritten();
}

}  // namespace vkh
