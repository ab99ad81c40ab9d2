#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

#include "host/mesh/make_mesh.h"
#include "host/mesh/position_index.h"
#include "host/mesh/repeat_filter.h"

namespace vkh {
namespace {

// The hash has no key: for a file that was made to collide, all faces are compared.
constexpr uint64_t kMix = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
uint64_t plain_hash(const std::array<uint64_t, 3>& words) {
  uint64_t hash = 0;
  for (const uint64_t word : words) hash = ((hash ^ hash >> 32) + word) * kMix;
  return hash;
}

uint64_t place_of(const RepeatFilter& filter, const glm::dvec3& p) {
  const uint64_t hash = plain_hash({position_bits(p.x), position_bits(p.y), position_bits(p.z)});
  return multiply(hash, filter.places()).high;
}

// The vertices whose positions may be another one's, too.
Array<uint32_t> repeated_vertices(const std::vector<glm::dvec3>& vertices, const ThreadPool& pool) {
  RepeatFilter filter(pool, vertices.size());
  constexpr size_t kAhead = 16;  // places fetched at once: each is a cache miss
  pool.for_parts(vertices.size(), [&](size_t, size_t begin, size_t end) {
    std::array<uint64_t, kAhead> places;
    for (size_t first = begin; first < end; first += std::min(kAhead, end - first)) {
      const size_t count = std::min(kAhead, end - first);
      for (size_t i = 0; i < count; ++i) {
        places[i] = place_of(filter, vertices[first + i]);
        filter.fetch(places[i]);
      }
      for (size_t i = 0; i < count; ++i) filter.mark(places[i]);
    }
  });
  return chosen_of(pool, vertices.size(),
                   [&](uint32_t v) { return filter.is_repeated(place_of(filter, vertices[v])); });
}

// Returns for each vertex one at the same position, the same for all of them; nothing if all
// positions differ.
Array<uint32_t> one_at_position(const std::vector<glm::dvec3>& vertices, const ThreadPool& pool) {
  const Array<uint32_t> some = repeated_vertices(vertices, pool);
  const auto position = [&](uint32_t i) -> const glm::dvec3& { return vertices[some[i]]; };
  PositionIndex index(pool, some.size(), position);
  Array<uint32_t> found(some.size());
  const size_t own = pool.sum_parts(some.size(), [&](size_t begin, size_t end) {
    return index.insert(static_cast<uint32_t>(begin), static_cast<uint32_t>(end),
                        found.begin() + begin);
  });
  if (own == some.size()) return {};
  Array<uint32_t> one(vertices.size());
  pool.for_parts(one.size(), [&](size_t, size_t begin, size_t end) {
    std::iota(one.begin() + begin, one.begin() + end, static_cast<uint32_t>(begin));
  });
  pool.for_parts(some.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) one[some[i]] = some[found[i]];
  });
  return one;
}

using CornerNumbers = std::array<uint32_t, 3>;

/// The faces of a mesh by their corners' positions: vertices at one position are one.
class FacesByPosition {
 public:
  FacesByPosition(const Mesh& mesh, Array<uint32_t> one) : mesh_(mesh), one_(std::move(one)) {}

  CornerNumbers operator[](size_t face) const {
    const glm::uvec3& f = mesh_.faces[face];
    if (one_.size() == 0) return {f.x, f.y, f.z};
    return {one_[f.x], one_[f.y], one_[f.z]};
  }
  size_t size() const { return mesh_.faces.size(); }
  size_t vertex_count() const { return mesh_.vertices.size(); }

 private:
  const Mesh& mesh_;
  const Array<uint32_t> one_;
};

// The least first.
CornerNumbers in_order(CornerNumbers c) {
  if (c[0] > c[1]) std::swap(c[0], c[1]);
  if (c[1] > c[2]) std::swap(c[1], c[2]);
  if (c[0] > c[1]) std::swap(c[0], c[1]);
  return c;
}

/// The places of faces in a filter, which do not depend on the order of corners. Faces with close
/// corner numbers are in one line of memory, and neighbours in a file mostly have these.
class FacePlaces {
 public:
  FacePlaces(const RepeatFilter& filter, size_t vertex_count)
      : scale_((filter.places() / RepeatFilter::kLine << 32) / vertex_count) {}

  uint64_t operator()(const CornerNumbers& c) const {
    const uint64_t x = c[0], y = c[1], z = c[2];
    const uint64_t line = std::min({x, y, z}) * scale_ >> 32;
    const uint64_t hash = ((x + y + z) * kMix + x * x + y * y + z * z) * kMix;
    return line * RepeatFilter::kLine + multiply(hash, RepeatFilter::kLine).high;
  }

 private:
  uint64_t scale_;
};

// The faces that may have the same positions as another one.
std::vector<CornerNumbers> repeated_faces(const FacesByPosition& faces, const ThreadPool& pool) {
  RepeatFilter filter(pool, faces.size());
  const FacePlaces place(filter, faces.vertex_count());
  pool.for_parts(faces.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) filter.mark(place(faces[f]));
  });
  const Array<uint32_t> some = chosen_of(
      pool, faces.size(), [&](uint32_t f) { return filter.is_repeated(place(faces[f])); });
  std::vector<CornerNumbers> repeated;
  resize_together(pool, repeated, some.size());
  pool.for_parts(some.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) repeated[i] = in_order(faces[some[i]]);
  });
  return repeated;
}

// Groups faces by their least corner, by counting, and sorts the faces of a corner by the other
// two: neighbours in memory stay neighbours, which a hash would scatter, and no file can make it
// slow.
class FaceGroups {
 public:
  FaceGroups(std::vector<CornerNumbers> faces, size_t vertex_count, const ThreadPool& pool)
      : faces_(std::move(faces)), pool_(pool), end_(filled(pool, vertex_count, uint32_t{0})) {}

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
  uint32_t add(uint32_t vertex, uint32_t count) {
    return std::atomic_ref<uint32_t>(end_[vertex]).fetch_add(count, std::memory_order_relaxed);
  }

  // Counts in runs: consecutive faces often share their least corner. All faces of a fan do, and
  // threads would wait for each other.
  void count() {
    pool_.for_parts(faces_.size(), [&](size_t, size_t begin, size_t end) {
      uint32_t vertex = 0, run = 0;
      for (size_t f = begin; f < end; ++f) {
        const uint32_t least = faces_[f][0];
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
        const auto [i, j, k] = faces_[f];
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

  const std::vector<CornerNumbers> faces_;
  const ThreadPool& pool_;
  Array<uint32_t> end_;  // the end of a vertex's faces, where the next one's begin
  Array<uint64_t> others_;
};

}  // namespace

uint64_t count_duplicates(const Mesh& mesh, Positions positions, const ThreadPool& pool) {
  Array<uint32_t> one;
  if (positions == Positions::kAny) one = one_at_position(mesh.vertices, pool);
  std::vector<CornerNumbers> faces = repeated_faces(FacesByPosition(mesh, std::move(one)), pool);
  if (faces.empty()) return 0;
  return FaceGroups(std::move(faces), mesh.vertices.size(), pool).duplicates();
}

}  // namespace vkh
