// How the faces of A are halved, and what proves each leaf: written as docs/certificate-file.md
// says.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/survey/leaf.h"

namespace vkh {

/// Trees of some faces, in their order: tree i is that of node i.
class ProofTree {
 public:
  explicit ProofTree(size_t face_count) : nodes_(face_count), face_count_(face_count) {}

  void prove(uint32_t node, const Leaf& leaf) { nodes_[node].leaf = leaf; }
  /// Halves it; the halves are the result and the one after it.
  uint32_t halve(uint32_t node, uint8_t opposite);
  /// Blocks of all of it.
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
