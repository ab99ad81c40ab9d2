#include "host/mesh/triangle_tree.h"

#include <glm/common.hpp>
#include <numeric>

namespace vkh {
namespace {

int longest_axis(const TriangleBox& box) {
  const glm::dvec3 size = box.hi - box.lo;
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

std::vector<uint32_t> numbers_to(size_t count) {
  std::vector<uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

}  // namespace

TriangleBox box_of(const Corners3& t) {
  return {glm::min(glm::min(t[0], t[1]), t[2]), glm::max(glm::max(t[0], t[1]), t[2])};
}

TriangleTree::TriangleTree(std::span<const Corners3> triangles, std::vector<uint32_t> which)
    : order_(std::move(which)) {
  if (!order_.empty()) build(triangles, 0, static_cast<uint32_t>(order_.size()));
}

TriangleTree::TriangleTree(std::span<const Corners3> triangles)
    : TriangleTree(triangles, numbers_to(triangles.size())) {}

void TriangleTree::build(std::span<const Corners3> triangles, uint32_t begin, uint32_t end) {
  TriangleBox box = box_of(triangles[order_[begin]]);
  for (uint32_t i = begin; i < end; ++i) {
    const TriangleBox one = box_of(triangles[order_[i]]);
    box = {glm::min(box.lo, one.lo), glm::max(box.hi, one.hi)};
  }
  const size_t at = nodes_.size();
  nodes_.push_back({box, begin, end - begin});
  if (end - begin <= kLeaf) return;
  const int axis = longest_axis(box);
  const auto place = [&](uint32_t t) {
    return triangles[t][0][axis] / 3 + triangles[t][1][axis] / 3 + triangles[t][2][axis] / 3;
  };
  const uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](uint32_t x, uint32_t y) {
                     const double of_x = place(x), of_y = place(y);
                     return of_x < of_y || (of_x == of_y && x < y);
                   });
  build(triangles, begin, middle);
  nodes_[at].first = static_cast<uint32_t>(nodes_.size());
  nodes_[at].count = 0;
  build(triangles, middle, end);
}

}  // namespace vkh
