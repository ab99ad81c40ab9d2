#include "tests/verification/layer/regroup.h"

#include <array>
#include <map>
#include <optional>

namespace vkh::layer {
namespace {

// Numbers of the SPIR-V specification.
constexpr uint32_t kFAdd = 129, kFSub = 131;
constexpr size_t kHeader = 5, kBound = 3;  // words; the word that all ids are less than

class Regrouping {
 public:
  explicit Regrouping(std::span<const uint32_t> words)
      : result_{{words.begin(), words.begin() + kHeader}} {}

  void add(std::span<const uint32_t> instruction) {
    const uint32_t op = instruction[0] & 0xffffu;
    const bool is_sum = (op == kFAdd || op == kFSub) && instruction.size() == 5;
    if (is_sum && op == kFSub) differences_[instruction[2]] = {instruction[3], instruction[4]};
    if (is_sum && op == kFAdd && regroup(instruction)) return;
    result_.words.insert(result_.words.end(), instruction.begin(), instruction.end());
  }

  Regrouped result() { return std::move(result_); }

 private:
  using Pair = std::array<uint32_t, 2>;

  // The instructions before a sum belong to its function or are constants, and so do its operands:
  // they are there.
  bool regroup(std::span<const uint32_t> sum) {
    const auto outer = differences_.find(sum[3]);
    if (outer == differences_.end()) return false;
    const auto inner = differences_.find(outer->second[0]);
    if (inner == differences_.end()) return false;
    const auto [a, b] = inner->second;
    const uint32_t type = sum[1];
    const uint32_t left = put(kFAdd, type, next_id(), {a, sum[4]});
    const uint32_t right = put(kFAdd, type, next_id(), {b, outer->second[1]});
    put(kFSub, type, sum[2], {left, right});
    ++result_.sums;
    return true;
  }

  uint32_t next_id() { return result_.words[kBound]++; }
  uint32_t put(uint32_t op, uint32_t type, uint32_t id, const Pair& operands) {
    result_.words.insert(result_.words.end(), {5u << 16 | op, type, id, operands[0], operands[1]});
    return id;
  }

  Regrouped result_;
  std::map<uint32_t, Pair> differences_;
};

}  // namespace

Regrouped regrouped(std::span<const uint32_t> words) {
  if (words.size() < kHeader) return {{words.begin(), words.end()}};
  Regrouping out(words);
  for (size_t at = kHeader; at < words.size();) {
    const uint32_t length = words[at] >> 16;
    if (length == 0 || at + length > words.size()) return {{words.begin(), words.end()}};
    out.add(words.subspan(at, length));
    at += length;
  }
  return out.result();
}

}  // namespace vkh::layer
