#include "host/prove/proof_tree.h"

namespace vkh {

namespace {

void append_u32(std::string& out, uint64_t x) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>((x >> shift) & 255);
}

}  // namespace

/// Bytes, and numbers as differences from the one before.
class NumberWriter {
 public:
  std::string bytes;

  void byte(uint32_t x) { bytes += static_cast<char>(x); }
  void pair(uint32_t x) {
    byte(x & 255);
    byte(x >> 8);
  }
  void number(uint32_t x) {
    const int64_t step = static_cast<int64_t>(x) - last_;
    last_ = x;
    uint64_t code =
        step >= 0 ? 2 * static_cast<uint64_t>(step) : 2 * static_cast<uint64_t>(-step) - 1;
    for (; code >= 128; code >>= 7) byte(128 | (code & 127));
    byte(static_cast<uint32_t>(code));
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
    append_u32(all, face - first);
    append_u32(all, block.bytes.size());
    all += block.bytes;
  }
  return all;
}

}  // namespace vkh
