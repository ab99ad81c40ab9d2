#include "host/native/face_tree.h"

#include <bit>
#include <limits>

#include "host/base/float_environment.h"

namespace vkh::native {
namespace {

// Six roundings of a square and its sums, and the one of a distance that it is compared with. What
// underflows adds 2^-148 at most.
constexpr float kRoundings = 1 - 0x1p-20f;

// The squared distances of a node's boxes from the point, rounded down, and a bit for each that is
// within reach. Both versions do the same operations.
struct Reached {
  alignas(16) std::array<float, 4> distance2;
  unsigned lanes;
};

#ifdef VKH_SSE
template <class Node>
Reached reached_boxes(const Node& node, const FloatPoint& p, float reach2) {
  __m128 sum = _mm_setzero_ps();
  for (size_t axis = 0; axis < 3; ++axis) {
    const __m128 under = _mm_sub_ps(_mm_load_ps(&node.lo[axis][0]), _mm_set1_ps(p.above[axis]));
    const __m128 over = _mm_sub_ps(_mm_set1_ps(p.below[axis]), _mm_load_ps(&node.hi[axis][0]));
    const __m128 d = _mm_max_ps(_mm_max_ps(under, over), _mm_setzero_ps());
    sum = _mm_add_ps(sum, _mm_mul_ps(d, d));
  }
  Reached r;
  sum = _mm_mul_ps(sum, _mm_set1_ps(kRoundings));
  _mm_store_ps(r.distance2.data(), sum);
  r.lanes = static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(sum, _mm_set1_ps(reach2))));
  return r;
}
#else
template <class Node>
Reached reached_boxes(const Node& node, const FloatPoint& p, float reach2) {
  Reached r{{}, 0};
  for (size_t i = 0; i < 4; ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const float under = node.lo[axis][i] - p.above[axis];
      const float over = p.below[axis] - node.hi[axis][i];
      const float d = std::max(std::max(under, over), 0.0f);
      r.distance2[i] += d * d;
    }
    r.distance2[i] *= kRoundings;
    r.lanes |= (r.distance2[i] <= reach2 ? 1u : 0u) << i;
  }
  return r;
}
#endif

}  // namespace

FaceTree::FaceTree(std::span<const vec3> vertices, std::span<const glm::uvec3> faces) {
  std::vector<Item> items(faces.size());
  for (uint32_t f = 0; f < faces.size(); ++f) {
    const vec3 &a = vertices[faces[f].x], &b = vertices[faces[f].y], &c = vertices[faces[f].z];
    const auto put = [&items, f](size_t axis, double x, double y, double z) {
      const double lo = min(x, min(y, z)), hi = max(x, max(y, z));
      items[f].box.lo[axis] = float_below(lo);
      items[f].box.hi[axis] = float_above(hi);
      items[f].middle[axis] = static_cast<float>(lo + hi);
    };
    put(0, a.x, b.x, c.x);
    put(1, a.y, b.y, c.y);
    put(2, a.z, b.z, c.z);
    items[f].face = f;
  }
  nodes_.reserve(faces.size() / 2 + 1);
  build(items, {0, static_cast<uint32_t>(items.size())});
  order_.reserve(items.size());
  triangles_.reserve(items.size());
  for (const Item& item : items) {
    const glm::uvec3& f = faces[item.face];
    order_.push_back(item.face);
    triangles_.push_back({vertices[f.x], vertices[f.y], vertices[f.z]});
  }
}

namespace {

template <class Item>
size_t widest_axis(std::span<const Item> items) {
  std::array<float, 3> lo = items[0].middle, hi = lo;
  for (const Item& item : items) {
    for (size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], item.middle[i]);
      hi[i] = std::max(hi[i], item.middle[i]);
    }
  }
  const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
  if (x >= y && x >= z) return 0;
  return y >= z ? 1 : 2;
}

// Halves a range along its widest axis: items before the result have the smaller middles.
template <class Item, class Range>
uint32_t halved(std::vector<Item>& items, Range range) {
  const uint32_t middle = range.begin + (range.end - range.begin) / 2;
  if (range.end - range.begin < 2) return middle;
  const size_t axis =
      widest_axis(std::span<const Item>(&items[range.begin], range.end - range.begin));
  std::nth_element(items.begin() + range.begin, items.begin() + middle, items.begin() + range.end,
                   [axis](const Item& p, const Item& q) {
                     if (p.middle[axis] != q.middle[axis]) return p.middle[axis] < q.middle[axis];
                     return p.face < q.face;
                   });
  return middle;
}

}  // namespace

uint32_t FaceTree::build(std::vector<Item>& items, Range range) {
  const auto node = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back();
  const uint32_t middle = halved(items, range);
  const uint32_t left = halved(items, Range{range.begin, middle});
  const uint32_t right = halved(items, Range{middle, range.end});
  set_child(items, node, 0, {range.begin, left});
  set_child(items, node, 1, {left, middle});
  set_child(items, node, 2, {middle, right});
  set_child(items, node, 3, {right, range.end});
  return node;
}

void FaceTree::set_child(std::vector<Item>& items, uint32_t node, uint32_t lane, Range range) {
  constexpr float kFar = std::numeric_limits<float>::max();
  Box box{{kFar, kFar, kFar}, {kFar, kFar, kFar}};  // an empty box is out of reach
  const uint32_t count = range.end - range.begin;
  if (count > 0) box = items[range.begin].box;
  for (uint32_t i = range.begin; i < range.end; ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], items[i].box.lo[axis]);
      box.hi[axis] = std::max(box.hi[axis], items[i].box.hi[axis]);
    }
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    nodes_[node].lo[axis][lane] = box.lo[axis];
    nodes_[node].hi[axis][lane] = box.hi[axis];
  }
  uint32_t child = kNone;
  if (count > kLeaf)
    child = build(items, range);
  else if (count > 0)
    child = kLeafFlag | (count - 1) << kCountShift | range.begin;
  nodes_[node].child[lane] = child;
}

Walk::Walk(const FaceTree& tree, const vec3& p) : tree_(tree), point_(p) {
  waiting_[count_++] = {0, 0};
}

// Pushes a node's children that are in reach onto the stack, the nearest last.
void Walk::open(uint32_t node, float reach2) {
  const FaceTree::Node& n = tree_.nodes_[node];
  const Reached reached = reached_boxes(n, point_, reach2);
  const size_t first = count_;
  for (unsigned left = reached.lanes; left != 0; left &= left - 1) {
    const auto i = static_cast<size_t>(std::countr_zero(left));
    const Waiting next{reached.distance2[i], n.child[i]};
    size_t at = count_++;
    for (; at > first && waiting_[at - 1].distance2 < next.distance2; --at)
      waiting_[at] = waiting_[at - 1];
    waiting_[at] = next;
  }
}

Leaf Walk::next(float reach2) {
  while (count_ > 0) {
    const Waiting top = waiting_[--count_];
    if (!(top.distance2 <= reach2)) continue;
    if ((top.child & FaceTree::kLeafFlag) == 0) {
      open(top.child, reach2);
      continue;
    }
    return FaceTree::leaf_of(top.child);
  }
  return {};
}

float Walk::least_left(float reach2) const {
  float least = reach2;
  for (size_t i = 0; i < count_; ++i) least = std::min(least, waiting_[i].distance2);
  return least;
}

Nearest FaceTree::nearest(const vec3& p, Nearest best) const {
  Walk walk(*this, p);
  for (;;) {
    const Leaf leaf = walk.next(float_above(best.distance2));
    if (leaf.is_none()) return best;
    for (uint32_t i = leaf.begin; i < leaf.end; ++i) try_triangle(p, i, best);
    if (best.distance2 == 0) return best;  // which holds for half of the vertices of a coarser copy
  }
}

}  // namespace vkh::native
