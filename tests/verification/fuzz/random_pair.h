// Small pairs of meshes, and the actions on them, from a fuzzer's bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vkhausdorff/mesh.h"

namespace vkh::test {

/// The reader returns zeros after the end, so that every input means something.
class FuzzBytes {
 public:
  FuzzBytes(const uint8_t* data, size_t size) : at_(data), end_(data + size) {}

  uint8_t byte() { return at_ == end_ ? 0 : *at_++; }
  uint32_t below(uint32_t count) { return byte() % count; }
  bool flip() { return byte() % 2 == 1; }
  size_t left() const { return static_cast<size_t>(end_ - at_); }

 private:
  const uint8_t* at_;
  const uint8_t* end_;
};

/// Coordinates as the C API takes them: the exact sum of two floats.
struct FuzzMesh {
  std::vector<float> high, low;  ///< three a vertex
  std::vector<uint32_t> corners;
  bool has_low = false;
  uint32_t vertex_offset = 0, low_offset = 0, index_offset = 0, stride = 12;
  bool is_16bit = false;

  uint32_t vertex_count() const { return static_cast<uint32_t>(high.size() / 3); }
  uint32_t face_count() const { return static_cast<uint32_t>(corners.size() / 3); }
  /// The measured mesh: with the low parts or without.
  Mesh measured(bool with_low) const;
};

struct FuzzPair {
  FuzzMesh a, b;
  FuzzMesh later_a, later_b;  ///< the same faces, moved
  bool later = false;         ///< another frame: refit, perhaps warm
  bool warm = false, two_float = false;
  double diagonal = 0;  ///< of both
  double largest = 0;   ///< of all coordinates, as a magnitude
  float tolerance = 0, known_lower = 0;
  uint32_t workspace_percent = 100;  ///< 0: the minimum; 100: the recommended size
  uint32_t first_waves = 0, more_waves = 0;
  uint32_t sort_from = 0;
  bool is_promised = true;  ///< coordinates for which the interval is certified
  bool has_end = true;      ///< a tolerance that coordinates of this size can be resolved to
};

FuzzPair make_pair(FuzzBytes& bytes);

}  // namespace vkh::test
