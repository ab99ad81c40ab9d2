// Merges corners of triangles, three each, into vertices: corners of equal positions become one
// vertex, numbered in the order in which they come first.
#pragma once

#include <atomic>
#include <utility>
#include <vector>

#include "host/mesh/position_index.h"

namespace vkh {

struct MergedCorners {
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> faces;
};

/// `Corner` is a vector of floats or doubles. There are fewer than 2^32 - 1 of them, three for each
/// face.
template <class Corner>
class CornerMerger {
 public:
  CornerMerger(const ThreadPool& pool, const Array<Corner>& corners)
      : pool_(pool), corners_(corners) {}

  MergedCorners merge() {
    resize_together(pool_, merged_.faces, corners_.size() / 3);
    bring_together();
    find_first();
    number();
    return std::move(merged_);
  }

 private:
  // Sets each corner's number to the number of one corner at the same position.
  void bring_together() {
    const auto position = [this](uint32_t c) { return glm::dvec3(corners_[c]); };
    PositionIndex index(pool_, corners_.size(), position);
    pool_.for_parts(corners_.size(), [&](size_t, size_t begin, size_t end) {
      Array<uint32_t> found(end - begin);
      index.insert(static_cast<uint32_t>(begin), static_cast<uint32_t>(end), found.data());
      for (size_t c = begin; c < end; ++c) number_of(c) = found[c - begin];
    });
  }

  // Sets least_ of that corner to the first corner of its position.
  void find_first() {
    least_ = Array<uint32_t>(corners_.size());
    pool_.for_parts(corners_.size(), [&](size_t, size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) least_[c] = static_cast<uint32_t>(c);
    });
    pool_.for_parts(corners_.size(), [&](size_t, size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) {
        const std::atomic_ref<uint32_t> least(least_[number_of(c)]);
        uint32_t known = least.load(std::memory_order_relaxed);
        while (c < known && !least.compare_exchange_weak(known, static_cast<uint32_t>(c),
                                                         std::memory_order_relaxed)) {
        }
      }
    });
  }

  void number() {
    Array<uint8_t> is_first(corners_.size());
    std::vector<size_t> starts(ThreadPool::parts_of(corners_.size()));
    pool_.for_parts(corners_.size(), [&](size_t part, size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) {
        is_first[c] = least_[number_of(c)] == c ? 1 : 0;
        starts[part] += is_first[c];
      }
    });
    resize_together(pool_, merged_.vertices, starts_of(starts));
    pool_.for_parts(corners_.size(), [&](size_t part, size_t begin, size_t end) {
      auto vertex = static_cast<uint32_t>(starts[part]);
      for (size_t c = begin; c < end; ++c) {
        if (is_first[c] == 0) continue;
        merged_.vertices[vertex] = glm::dvec3(corners_[c]);
        least_[number_of(c)] = vertex++;
      }
    });
    pool_.for_parts(corners_.size(), [&](size_t, size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) number_of(c) = least_[number_of(c)];
    });
  }

  uint32_t& number_of(size_t corner) {
    return merged_.faces[corner / 3][static_cast<int>(corner % 3)];
  }

  const ThreadPool& pool_;
  const Array<Corner>& corners_;
  Array<uint32_t> least_;
  MergedCorners merged_;
};

}  // namespace vkh
