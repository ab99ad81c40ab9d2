#include "tests/verification/layer/spirv.h"

#include <cstring>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace vkh::layer {
namespace {

// Numbers of the SPIR-V specification.
enum Op : uint32_t {
  kExecutionMode = 16,
  kTypeBool = 20,
  kTypeInt = 21,
  kTypeFloat = 22,
  kTypeVector = 23,
  kTypeMatrix = 24,
  kTypeArray = 28,
  kTypeStruct = 30,
  kTypePointer = 32,
  kConstantTrue = 41,
  kConstantFalse = 42,
  kConstant = 43,
  kConstantComposite = 44,
  kSpecConstantTrue = 48,
  kSpecConstantFalse = 49,
  kSpecConstant = 50,
  kSpecConstantComposite = 51,
  kSpecConstantOp = 52,
  kVariable = 59,
  kDecorate = 71,
  kMemberDecorate = 72,
  kExecutionModeId = 331
};
constexpr uint32_t kNonWritable = 24, kBinding = 33, kStorageBuffer = 12;
constexpr uint32_t kSpecId = 1, kBuiltIn = 11, kWorkgroupSize = 25, kLocalSize = 17,
                   kLocalSizeId = 38, kWorkgroup = 4;

struct Unknown : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Module {
 public:
  Module(std::span<const uint32_t> words, const VkSpecializationInfo* info) : info_(info) {
    for (size_t at = 5; at < words.size();) {
      const uint32_t length = words[at] >> 16;
      if (length == 0 || at + length > words.size()) throw Unknown("a broken module");
      read(words[at] & 0xffffu, words.subspan(at + 1, length - 1));
      at += length;
    }
  }

  std::map<uint32_t, bool> writes() {
    std::map<uint32_t, bool> writes;
    for (const auto& [variable, pointer] : buffers_) {
      const uint32_t block = pointee_types_.at(pointer);
      const size_t members = types_.at(block).second.size();
      const bool is_read_only =
          read_only_.contains(variable) || read_only_members_[block].size() == members;
      writes[bindings_.at(variable)] = !is_read_only;
    }
    return writes;
  }

  ShaderNeeds needs() const {
    ShaderNeeds needs;
    needs.local_size = literal_size_;
    const std::vector<uint32_t>* ids = &size_ids_;
    if (workgroup_size_ != 0) ids = &composites_.at(workgroup_size_);
    for (size_t i = 0; i < ids->size() && i < 3; ++i)
      needs.local_size[i] = static_cast<uint32_t>(values_.at((*ids)[i]));
    for (const uint32_t type : shared_) needs.shared_bytes += bytes_of(type);
    return needs;
  }

 private:
  using Words = std::span<const uint32_t>;

  void read(uint32_t op, Words w) {
    if (op == kDecorate && w[1] == kSpecId) spec_ids_[w[0]] = w[2];
    if (op == kDecorate && w[1] == kBuiltIn && w[2] == kWorkgroupSize) workgroup_size_ = w[0];
    if (op == kExecutionMode && w[1] == kLocalSize) literal_size_ = {w[2], w[3], w[4]};
    if (op == kExecutionModeId && w[1] == kLocalSizeId) size_ids_.assign(w.begin() + 2, w.end());
    if (op >= kTypeBool && op <= kTypePointer) read_type(op, w);
    if (op >= kConstantTrue && op <= kSpecConstantOp) read_constant(op, w);
    if (op == kDecorate && w[1] == kBinding) bindings_[w[0]] = w[2];
    if (op == kDecorate && w[1] == kNonWritable) read_only_.insert(w[0]);
    if (op == kMemberDecorate && w[2] == kNonWritable) read_only_members_[w[0]].insert(w[1]);
    if (op == kVariable && w[2] == kStorageBuffer) buffers_[w[1]] = w[0];
    if (op == kVariable && w[2] == kWorkgroup) shared_.push_back(pointee_types_.at(w[0]));
  }

  void read_type(uint32_t op, Words w) {
    if (op == kTypePointer) pointee_types_[w[0]] = w[2];
    types_[w[0]] = {op, {w.begin() + 1, w.end()}};
  }

  void read_constant(uint32_t op, Words w) {
    const uint32_t id = w[1];
    if (op == kConstantTrue || op == kSpecConstantTrue) values_[id] = 1;
    if (op == kConstantFalse || op == kSpecConstantFalse) values_[id] = 0;
    if (op == kConstant || op == kSpecConstant) values_[id] = w[2];
    if (op == kConstantComposite || op == kSpecConstantComposite)
      composites_[id].assign(w.begin() + 2, w.end());
    if (op == kSpecConstantOp) read_operation(id, w[2], w.subspan(3));
    specialise(id);
  }

  void read_operation(uint32_t id, uint32_t op, Words operands) {
    std::vector<uint64_t> v;
    for (const uint32_t operand : operands) {
      const auto known = values_.find(operand);
      if (known == values_.end()) return;  // of vectors: code that needs it will not find it
      v.push_back(known->second);
    }
    if (const auto value = evaluate(op, v)) values_[id] = *value;
  }

  static std::optional<uint64_t> evaluate(uint32_t op, const std::vector<uint64_t>& v) {
    const auto x = static_cast<uint32_t>(v[0]);
    const auto y = static_cast<uint32_t>(v.size() > 1 ? v[1] : 0);
    switch (op) {
      case 128:
        return x + y;
      case 130:
        return x - y;
      case 132:
        return x * y;
      case 134:
        return y == 0 ? std::nullopt : std::optional<uint64_t>(x / y);
      case 137:
        return y == 0 ? std::nullopt : std::optional<uint64_t>(x % y);
      case 164:
      case 170:
        return x == y;
      case 165:
      case 171:
        return x != y;
      case 166:
        return x != 0 || y != 0;
      case 167:
        return x != 0 && y != 0;
      case 168:
        return x == 0;
      case 169:
        return v.size() == 3 ? (x != 0 ? v[1] : v[2]) : std::optional<uint64_t>();
      case 172:
        return x > y;
      case 174:
        return x >= y;
      case 176:
        return x < y;
      case 178:
        return x <= y;
      case 194:
        return x >> y;
      case 196:
        return x << y;
      case 197:
        return x | y;
      case 198:
        return x ^ y;
      case 199:
        return x & y;
      case 200:
        return ~x;
      default:
        return std::nullopt;
    }
  }

  void specialise(uint32_t id) {
    const auto spec = spec_ids_.find(id);
    if (spec == spec_ids_.end() || info_ == nullptr) return;
    for (uint32_t i = 0; i < info_->mapEntryCount; ++i) {
      const VkSpecializationMapEntry& entry = info_->pMapEntries[i];
      if (entry.constantID != spec->second || entry.size != sizeof(uint32_t)) continue;
      uint32_t value = 0;
      std::memcpy(&value, static_cast<const char*>(info_->pData) + entry.offset, sizeof(value));
      values_[id] = value;
    }
  }

  uint64_t bytes_of(uint32_t type) const {
    const auto& [op, w] = types_.at(type);
    if (op == kTypeBool) return 4;
    if (op == kTypeInt || op == kTypeFloat) return w[0] / 8;
    if (op == kTypeVector || op == kTypeMatrix) return bytes_of(w[0]) * w[1];
    if (op == kTypeArray) return bytes_of(w[0]) * values_.at(w[1]);
    if (op != kTypeStruct) throw Unknown("a type");
    uint64_t bytes = 0;
    for (const uint32_t member : w) bytes += bytes_of(member);
    return bytes;
  }

  const VkSpecializationInfo* info_;
  std::array<uint32_t, 3> literal_size_{1, 1, 1};
  std::vector<uint32_t> size_ids_, shared_;
  uint32_t workgroup_size_ = 0;
  std::map<uint32_t, uint32_t> spec_ids_, pointee_types_;
  std::map<uint32_t, uint32_t> bindings_, buffers_;           // of variables; their pointers' types
  std::set<uint32_t> read_only_;                              // variables
  std::map<uint32_t, std::set<uint32_t>> read_only_members_;  // by block
  std::map<uint32_t, uint64_t> values_;
  std::map<uint32_t, std::vector<uint32_t>> composites_;
  std::map<uint32_t, std::pair<uint32_t, std::vector<uint32_t>>> types_;
};

}  // namespace

std::optional<ShaderNeeds> needs_of(std::span<const uint32_t> words,
                                    const VkSpecializationInfo* specialisation) try {
  return Module(words, specialisation).needs();
} catch (const std::exception&) {
  return std::nullopt;
}

std::optional<std::map<uint32_t, bool>> writes_of(std::span<const uint32_t> words) try {
  return Module(words, nullptr).writes();
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace vkh::layer
