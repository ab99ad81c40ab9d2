// The tree in which the faces of A are halved, with a proof for each leaf, written in the format of
// docs/certificate-file.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/survey/leaf.h"

namespace vkh {

/// The trees of some faces, in their order: tree i is that of node i.
class ProofTree {
 public:
  explicit ProofTree(size_t face_count) : nodes_(face_count), face_count_(face_count) {}

  void prove(uint32_t node, const Leaf& leaf) { nodes_[node].leaf = leaf; }
  /// Halves the node; the halves are the result and the one after it.
  uint32_t halve(uint32_t node, uint8_t opposite);
  /// All trees, as blocks.
  std::string written() const;

 private:
  struct Node {
    Leaf leaf;
    uint8_t opposite = 0;
    uint32_t halves = 0;  ///< 0: it is a leaf
  };
  void write_face(uint32_t face, class NumberWriter& out) const;

  std::vector<Node> nodes_;
  size_t face_count_;
};

}  // namespace vkh
