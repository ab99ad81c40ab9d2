#include "vkhausdorff/mesh.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include "host/base/decimal.h"
#include "host/base/float_environment.h"
#include "host/base/reject.h"
#include "host/mesh/make_mesh.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

/// The least number that threads have found.
class Least {
 public:
  void see(uint64_t number) {
    uint64_t least = least_;
    while (number < least && !least_.compare_exchange_weak(least, number)) {
    }
  }
  bool found() const { return least_ != kNone; }
  size_t number() const { return least_; }

 private:
  static constexpr uint64_t kNone = UINT64_MAX;
  std::atomic<uint64_t> least_ = kNone;
};

void check_indices(const Mesh& mesh, const ThreadPool& pool) {
  const size_t vertex_count = mesh.vertices.size();
  const auto greatest = [](const glm::uvec3& f) { return std::max({f.x, f.y, f.z}); };
  Least wrong;
  pool.for_parts(mesh.faces.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      if (greatest(mesh.faces[f]) >= vertex_count) return wrong.see(f);
    }
  });
  if (!wrong.found()) return;
  const std::string count = std::to_string(vertex_count);
  reject(mesh.name, "face " + std::to_string(wrong.number()),
         "index " + std::to_string(greatest(mesh.faces[wrong.number()])) + " of " + count +
             " vertices",
         "indices below " + count);
}

bool is_finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

[[noreturn]] void reject_vertex(const Mesh& mesh, size_t vertex) {
  const glm::dvec3& p = mesh.vertices[vertex];
  reject(mesh.name, "vertex " + std::to_string(vertex),
         "(" + coordinates_text(p.x, p.y, p.z) + ") is not finite", "finite coordinates");
}

// Tests for exponents of all ones, without a branch: compilers vectorise it.
uint64_t not_finite(const glm::dvec3& p) {
  constexpr uint64_t kExponent = uint64_t{0x7ff} << 52;
  const auto is_it = [](double x) {
    return uint64_t{(std::bit_cast<uint64_t>(x) & kExponent) == kExponent};
  };
  return is_it(p.x) | is_it(p.y) | is_it(p.z);
}

void check_finite(const Mesh& mesh, const ThreadPool& pool) {
  Least wrong;
  pool.for_parts(mesh.vertices.size(), [&](size_t, size_t begin, size_t end) {
    uint64_t any = 0;
    for (size_t v = begin; v < end; ++v) any |= not_finite(mesh.vertices[v]);
    for (size_t v = begin; any != 0 && v < end; ++v) {
      if (not_finite(mesh.vertices[v]) != 0) return wrong.see(v);
    }
  });
  if (wrong.found()) reject_vertex(mesh, wrong.number());
}

// Returns 1 for each vertex that a face uses, else 0. Several threads read a flag before they set
// it: a line of memory that no thread writes to is every core's. A thread alone is faster without.
Array<uint8_t> used_vertices(const Mesh& mesh, const ThreadPool& pool) {
  Array<uint8_t> used = filled(pool, mesh.vertices.size(), uint8_t{0});
  const bool is_alone = pool.threads() == 1;
  pool.for_parts(mesh.faces.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      for (int i = 0; i < 3; ++i) {
        const std::atomic_ref<uint8_t> flag(used[mesh.faces[f][i]]);
        if (is_alone || flag.load(std::memory_order_relaxed) == 0)
          flag.store(1, std::memory_order_relaxed);
      }
    }
  });
  return used;
}

// Moves each part's vertices to the part's begin, on all threads; then the parts to the front.
void drop_unused(Mesh& mesh, const Array<uint8_t>& used, const ThreadPool& pool) {
  std::vector<size_t> starts(ThreadPool::parts_of(used.size()));
  pool.for_parts(used.size(), [&](size_t part, size_t begin, size_t end) {
    size_t to = begin;
    for (size_t v = begin; v < end; ++v) {
      if (used[v] != 0) mesh.vertices[to++] = mesh.vertices[v];
    }
    starts[part] = to - begin;
  });
  const size_t kept = starts_of(starts);
  for (size_t part = 0; part < starts.size(); ++part) {
    const size_t next = part + 1 < starts.size() ? starts[part + 1] : kept;
    const auto from = mesh.vertices.begin() + static_cast<std::ptrdiff_t>(part * ThreadPool::kPart);
    std::copy_n(from, next - starts[part],
                mesh.vertices.begin() + static_cast<std::ptrdiff_t>(starts[part]));
  }
  Array<uint32_t> renamed(used.size());
  pool.for_parts(used.size(), [&](size_t part, size_t begin, size_t end) {
    auto number = static_cast<uint32_t>(starts[part]);
    for (size_t v = begin; v < end; ++v) renamed[v] = used[v] != 0 ? number++ : 0;
  });
  pool.for_parts(mesh.faces.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      glm::uvec3& face = mesh.faces[f];
      face = {renamed[face.x], renamed[face.y], renamed[face.z]};
    }
  });
  mesh.vertices.resize(kept);
}

// Keeps the order of the vertices that stay. Only they have to be finite: scanners and exporters
// leave nan in vertices that nothing uses.
void drop_unreferenced(Mesh& mesh, const ThreadPool& pool) {
  const Array<uint8_t> used = used_vertices(mesh, pool);
  Least wrong;
  const size_t kept = pool.sum_parts(used.size(), [&](size_t begin, size_t end) {
    size_t count = 0;
    for (size_t v = begin; v < end; ++v) {
      count += used[v];
      if (used[v] != 0 && !is_finite(mesh.vertices[v])) wrong.see(v);
    }
    return count;
  });
  if (wrong.found()) reject_vertex(mesh, wrong.number());
  mesh.counts.unreferenced = used.size() - kept;
  if (mesh.counts.unreferenced > 0) drop_unused(mesh, used, pool);
}

uint64_t count_degenerate(const Mesh& mesh, const ThreadPool& pool) {
  return pool.sum_parts(mesh.faces.size(), [&](size_t begin, size_t end) {
    size_t count = 0;
    for (size_t i = begin; i < end; ++i) {
      const glm::uvec3& f = mesh.faces[i];
      const bool degenerate =
          is_degenerate(mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]);
      count += degenerate ? 1 : 0;
    }
    return count;
  });
}

void check_points(const Mesh& mesh, const ThreadPool& pool) {
  if (!mesh.are_points) return;
  Least wrong;
  pool.for_parts(mesh.faces.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      if (mesh.faces[f] != glm::uvec3(static_cast<uint32_t>(f))) return wrong.see(f);
    }
  });
  const bool all = mesh.faces.size() == mesh.vertices.size();
  if (wrong.found() || !all)
    reject(mesh.name, "face " + std::to_string(wrong.found() ? wrong.number() : mesh.faces.size()),
           "are_points, and this face is not the point of its number", "make_points()");
}

void check_sizes(const Mesh& mesh) {
  if (mesh.faces.empty()) reject(mesh.name, "face 0", "there is no face", "at least one triangle");
  if (std::max(mesh.faces.size(), mesh.vertices.size()) >= UINT32_MAX)
    reject(mesh.name, "element 4294967294", "too many elements", "fewer than 2^32 - 1");
}

}  // namespace

void check_mesh(const Mesh& mesh) {
  check_sizes(mesh);
  const ThreadPool pool(threads_for(mesh_bytes(mesh)), {}, {});
  check_indices(mesh, pool);
  check_points(mesh, pool);
  check_finite(mesh, pool);
  if (!(mesh.delta >= 0) || !std::isfinite(mesh.delta))
    reject(mesh.name, "delta", std::to_string(mesh.delta), "a finite number, at least 0");
  if (!mesh.file_faces.is_valid(mesh.faces.size()))
    reject(mesh.name, "face " + std::to_string(mesh.faces.size()), "file_faces names more",
           "those of " + std::to_string(mesh.faces.size()) + " triangles");
}

void refuse_any_triangulation(const Mesh& a, const Mesh& b, const std::string& what) {
  for (const Mesh* mesh : {&a, &b}) {
    if (mesh->polygons.any_triangulation)
      throw UsageError(
          what + ": is of one triangulation, and polygons of any were asked for: " + mesh->name);
  }
}

Mesh make_mesh(std::string name, std::vector<glm::dvec3> vertices, std::vector<glm::uvec3> faces,
               const ThreadPool& pool, Positions positions) {
  const FloatEnvironment ours;
  Mesh mesh{.name = std::move(name),
            .vertices = std::move(vertices),
            .faces = std::move(faces),
            .counts = {}};
  check_sizes(mesh);
  check_indices(mesh, pool);
  drop_unreferenced(mesh, pool);
  mesh.counts.vertices = mesh.vertices.size();
  mesh.counts.faces = mesh.faces.size();
  mesh.counts.degenerate = count_degenerate(mesh, pool);
  mesh.counts.duplicate = count_duplicates(mesh, positions, pool);
  return mesh;
}

Mesh make_points(std::string name, std::vector<glm::dvec3> points, const ThreadPool& pool) {
  const FloatEnvironment ours;
  Mesh mesh{.name = std::move(name), .vertices = std::move(points), .faces = {}, .counts = {}};
  const size_t count = mesh.vertices.size();
  if (count == 0) reject(mesh.name, "vertex 0", "there is no point", "at least one point");
  if (count >= UINT32_MAX)
    reject(mesh.name, "vertex 4294967294", "too many points", "fewer than 2^32 - 1");
  resize_together(pool, mesh.faces, count);
  pool.for_parts(count, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) mesh.faces[i] = glm::uvec3(static_cast<uint32_t>(i));
  });
  check_finite(mesh, pool);
  mesh.are_points = true;
  mesh.counts.vertices = mesh.counts.faces = mesh.counts.degenerate = count;
  return mesh;
}

Mesh make_points(std::string name, std::vector<glm::dvec3> points) {
  return make_points(std::move(name), std::move(points), ThreadPool());
}

void refuse_points(const Mesh& mesh, const std::string& option, const std::string& lacks) {
  if (mesh.are_points)
    throw UsageError(option + ": " + mesh.name + " is points, which have no " + lacks);
}

Mesh make_mesh(std::string name, std::vector<glm::dvec3> vertices, std::vector<glm::uvec3> faces) {
  return make_mesh(std::move(name), std::move(vertices), std::move(faces), ThreadPool());
}

}  // namespace vkh
