#include <algorithm>
#include <array>
#include <atomic>

#include "host/mesh/make_mesh.h"
#include "host/mesh/position_index.h"

namespace vkh {
namespace {

// Returns for each vertex one at the same position, the same for all of them; nothing if all
// positions differ.
Array<uint32_t> one_at_position(const std::vector<glm::dvec3>& vertices, const ThreadPool& pool) {
  const auto position = [&vertices](uint32_t v) -> const glm::dvec3& { return vertices[v]; };
  PositionIndex index(pool, vertices.size(), position);
  Array<uint32_t> one(vertices.size());
  const size_t own = pool.sum_parts(vertices.size(), [&](size_t begin, size_t end) {
    return index.insert(static_cast<uint32_t>(begin), static_cast<uint32_t>(end),
                        one.begin() + begin);
  });
  return own == vertices.size() ? Array<uint32_t>() : std::move(one);
}

// Groups faces by their least corner, by counting, and sorts the faces of a corner by the other
// two: neighbours in memory stay neighbours, which a hash would scatter, and no file can make it
// slow.
class FaceGroups {
 public:
  FaceGroups(const Mesh& mesh, Array<uint32_t> one, const ThreadPool& pool)
      : faces_(mesh.faces),
        one_(std::move(one)),
        pool_(pool),
        end_(filled(pool, mesh.vertices.size(), uint32_t{0})) {}

  uint64_t duplicates() {
    count();
    counts_to_begins();
    bring_together();
    return pool_.sum_parts(end_.size(), [&](size_t begin, size_t end) {
      uint64_t sum = 0;
      for (size_t v = begin; v < end; ++v)
        sum += duplicates_among(v == 0 ? 0 : end_[v - 1], end_[v]);
      return sum;
    });
  }

 private:
  std::array<uint32_t, 3> corners_of(const glm::uvec3& f) const {
    std::array<uint32_t, 3> c = {f.x, f.y, f.z};
    if (one_.size() > 0) c = {one_[f.x], one_[f.y], one_[f.z]};
    if (c[0] > c[1]) std::swap(c[0], c[1]);
    if (c[1] > c[2]) std::swap(c[1], c[2]);
    if (c[0] > c[1]) std::swap(c[0], c[1]);
    return c;
  }

  uint32_t add(uint32_t vertex, uint32_t count) {
    return std::atomic_ref<uint32_t>(end_[vertex]).fetch_add(count, std::memory_order_relaxed);
  }

  // Counts in runs: faces that follow each other often share their least corner; a fan's all do,
  // and threads would wait for each other.
  void count() {
    pool_.for_parts(faces_.size(), [&](size_t, size_t begin, size_t end) {
      uint32_t vertex = 0, run = 0;
      for (size_t f = begin; f < end; ++f) {
        const uint32_t least = corners_of(faces_[f])[0];
        if (least != vertex && run > 0) add(vertex, std::exchange(run, 0));
        vertex = least;
        ++run;
      }
      add(vertex, run);
    });
  }

  void counts_to_begins() {
    std::vector<size_t> starts(ThreadPool::parts_of(end_.size()));
    pool_.for_parts(end_.size(), [&](size_t part, size_t begin, size_t end) {
      for (size_t v = begin; v < end; ++v) starts[part] += end_[v];
    });
    starts_of(starts);
    pool_.for_parts(end_.size(), [&](size_t part, size_t begin, size_t end) {
      auto sum = static_cast<uint32_t>(starts[part]);
      for (size_t v = begin; v < end; ++v) sum += std::exchange(end_[v], sum);
    });
  }

  // Stores the other two corners of each vertex's faces; the vertex's begin becomes its end.
  void bring_together() {
    others_ = Array<uint64_t>(faces_.size());
    pool_.for_parts(faces_.size(), [&](size_t, size_t begin, size_t end) {
      std::array<uint64_t, 64> run;
      uint32_t vertex = 0, length = 0;
      const auto put = [&] {
        if (length == 0) return;
        std::copy_n(run.begin(), length, others_.begin() + add(vertex, length));
        length = 0;
      };
      for (size_t f = begin; f < end; ++f) {
        const auto [i, j, k] = corners_of(faces_[f]);
        if (i != vertex || length == run.size()) put();
        vertex = i;
        run[length++] = uint64_t{j} << 32 | k;
      }
      put();
    });
  }

  uint64_t duplicates_among(size_t begin, size_t end) {
    if (end - begin < 2) return 0;
    uint64_t* const first = others_.begin() + begin;
    uint64_t* const stop = others_.begin() + end;
    std::sort(first, stop);
    return static_cast<uint64_t>(stop - std::unique(first, stop));
  }

  const std::vector<glm::uvec3>& faces_;
  const Array<uint32_t> one_;
  const ThreadPool& pool_;
  Array<uint32_t> end_;  // the end of a vertex's faces, where the next one's begin
  Array<uint64_t> others_;
};

}  // namespace

uint64_t count_duplicates(const Mesh& mesh, Positions positions, const ThreadPool& pool) {
  Array<uint32_t> one;
  if (positions == Positions::kAny) one = one_at_position(mesh.vertices, pool);
  return FaceGroups(mesh, std::move(one), pool).duplicates();
}

}  // namespace vkh
