#include "host/survey/proof_tree.h"

#include "host/survey/certificate_bytes.h"

namespace vkh {

/// Writes bytes, and numbers as differences from the one before.
class NumberWriter {
 public:
  std::string bytes;

  void byte(uint32_t x) { append_unsigned(bytes, x, 1); }
  void pair(uint32_t x) { append_unsigned(bytes, x, 2); }
  void number(uint32_t x) {
    const int64_t step = static_cast<int64_t>(x) - last_;
    last_ = x;
    append_count(
        bytes, step >= 0 ? 2 * static_cast<uint64_t>(step) : 2 * static_cast<uint64_t>(-step) - 1);
  }

 private:
  int64_t last_ = 0;
};

uint32_t ProofTree::halve(uint32_t node, uint8_t opposite) {
  const auto first = static_cast<uint32_t>(nodes_.size());
  nodes_[node].opposite = opposite;
  nodes_[node].halves = first;
  nodes_.resize(nodes_.size() + 2);
  return first;
}

void ProofTree::write_face(uint32_t face, NumberWriter& out) const {
  std::vector<uint32_t> open = {face};
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (node.halves != 0) {
      out.byte(node.opposite);
      open.insert(open.end(), {node.halves + 1, node.halves});
      continue;
    }
    const Leaf& leaf = node.leaf;
    if (leaf.alone == Leaf::kUncut) {
      out.byte(3);
      out.number(leaf.first);
      continue;
    }
    out.byte(4u + leaf.alone);
    out.number(leaf.first);
    out.number(leaf.second);
    out.pair(leaf.cut_next);
    out.pair(leaf.cut_last);
  }
}

std::string ProofTree::written() const {
  constexpr size_t kBlockBytes = size_t{1} << 16;  // a reader's thread has one at a time
  std::string all;
  for (uint32_t face = 0; face < face_count_;) {
    NumberWriter block;
    const uint32_t first = face;
    while (face < face_count_ && block.bytes.size() < kBlockBytes) write_face(face++, block);
    append_unsigned(all, face - first, 4);
    append_unsigned(all, block.bytes.size(), 4);
    all += block.bytes;
  }
  return all;
}

}  // namespace vkh
