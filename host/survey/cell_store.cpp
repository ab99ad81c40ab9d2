#include "host/survey/cell_store.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "host/base/parallel.h"
#include "host/solve/cell_corners.h"
#include "shaders/survey/score.h"

namespace vkh {
namespace {

void raise(float& most, float value) {
  const std::atomic_ref<float> shared(most);
  float seen = shared.load(std::memory_order_relaxed);
  while (seen < value && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
  }
}

template <class F>
void each_of(size_t count, const F& work) {
  for_each_block(count, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) work(i);
  });
}

}  // namespace

uint32_t opposite_longest(const Mesh& a, const gpu::Cell& cell) {
  const glm::uvec3& f = a.faces[cell.face];
  const glm::dvec3 ab = a.vertices[f.y] - a.vertices[f.x];
  const glm::dvec3 ac = a.vertices[f.z] - a.vertices[f.x];
  const lib::Bary3 t = corners_of(cell);
  const auto length = [&](const glm::uvec2& p, const glm::uvec2& q) {
    const glm::dvec2 d = glm::dvec2(q) - glm::dvec2(p);
    return glm::length(d.x * ab + d.y * ac);
  };
  const double la = length(t.b, t.c), lb = length(t.c, t.a), lc = length(t.a, t.b);
  if (la >= lb && la >= lc) return 0;
  return lb >= lc ? 1 : 2;
}

float lowest(const gpu::CellBounds& b) { return lib::lowest_of(b); }

CellStore::CellStore(const Mesh& a, float farthest) : a_(a), reached_(a.faces.size(), 0.0f) {
  gpu::Cell whole{};
  set_corners(whole, lib::whole_root());
  whole.start = gpu::kNone;
  cells_.assign(a.faces.size(), whole);
  for (size_t i = 0; i < cells_.size(); ++i) cells_[i].face = static_cast<uint32_t>(i);
  bounds_.assign(cells_.size(), unknown_bounds(farthest));
  depth_.assign(cells_.size(), 0);
  opposite_.resize(cells_.size());
  each_of(cells_.size(), [&](size_t i) { see_split(i); });
  set_shares();
}

CellStore::CellStore(const Mesh& a, std::vector<gpu::Cell> cells,
                     std::vector<gpu::CellBounds> bounds, std::vector<float> reached)
    : a_(a), cells_(std::move(cells)), bounds_(std::move(bounds)), reached_(std::move(reached)) {
  depth_.resize(cells_.size());
  opposite_.resize(cells_.size());
  each_of(cells_.size(), [&](size_t i) {
    depth_[i] = static_cast<uint8_t>(lib::halvings_of(corners_of(cells_[i])));
    see_split(i);
  });
  set_shares();
}

void CellStore::set_shares() {
  for (unsigned depth = 0; depth <= kMostDepth; ++depth)
    shares_.push_back(std::ldexp(1.0, -static_cast<int>(depth)));
}

// Takes only `highest` from the larger cell, for a face's bounds.
void CellStore::narrow(std::span<const size_t> which, std::span<const gpu::CellBounds> found) {
  each_of(which.size(), [&](size_t k) {
    const size_t i = which[k];
    gpu::CellBounds& b = bounds_[i];
    const float highest = std::min(b.highest, found[k].highest);
    b = found[k];
    b.highest = highest;
    b.mean_upper = std::min(b.mean_upper, highest);
    cells_[i].start = found[k].triangle;
    raise(reached_[cells_[i].face], found[k].reached);
  });
}

void CellStore::see_split(size_t i) {
  const uint32_t opposite = opposite_longest(a_, cells_[i]);
  const bool can =
      depth_[i] < kMostDepth && lib::has_middle_opposite(corners_of(cells_[i]), opposite);
  opposite_[i] = can ? static_cast<uint8_t>(opposite) : kNoSplit;
}

void CellStore::close(std::span<const size_t> which) {
  for (const size_t i : which) opposite_[i] = kNoSplit;
}

void CellStore::split(std::span<const size_t> which) {
  const size_t first = cells_.size();
  cells_.resize(first + which.size());
  bounds_.resize(cells_.size());
  depth_.resize(cells_.size());
  opposite_.resize(cells_.size());
  each_of(which.size(), [&](size_t k) { split(which[k], first + k); });
}

void CellStore::split(size_t i, size_t half) {
  const uint32_t opposite = opposite_[i];
  const lib::Bary3 t = corners_of(cells_[i]);
  const lib::Halves halves = lib::halves_of(t, opposite, lib::middle_opposite(t, opposite));
  // An affine function has other values at a half's corners: the extremes of the larger cell hold.
  gpu::CellBounds& b = bounds_[i];
  b.lower_a = b.lower_b = b.lower_c = lowest(b);
  b.upper_a = b.upper_b = b.upper_c = b.highest;
  b.mean_upper = b.highest;
  b.square_upper = std::numeric_limits<float>::max();
  ++depth_[i];
  cells_[half] = cells_[i];
  bounds_[half] = b;
  depth_[half] = depth_[i];
  set_corners(cells_[i], halves.first);
  set_corners(cells_[half], halves.second);
  see_split(i);
  see_split(half);
}

std::vector<float> CellStore::highest_of_faces() const {
  std::vector<float> highest(reached_.size(), 0.0f);
  for (size_t i = 0; i < cells_.size(); ++i) {
    float& of_face = highest[cells_[i].face];
    of_face = std::max(of_face, bounds_[i].highest);
  }
  return highest;
}

float CellStore::reached() const { return *std::max_element(reached_.begin(), reached_.end()); }

}  // namespace vkh
