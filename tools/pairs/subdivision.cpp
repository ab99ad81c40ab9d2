#include "tools/pairs/subdivision.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "host/base/parallel.h"
#include "vkhausdorff/error.h"

namespace vkh::pairs {
namespace {

uint64_t key_of(uint32_t i, uint32_t j) { return uint64_t{std::min(i, j)} << 32 | std::max(i, j); }

// Several threads make rows of this many parts, which go to the disk at once: some megabytes.
constexpr size_t kParts = 16;
constexpr size_t kRowsOfPart = 1 << 14;

/// Appends elements 0 to count - 1 by write(rows, i), each of about `rows_each` rows.
template <class Write>
void stream(PlyStream& out, size_t count, size_t rows_each, const Write& write) {
  const size_t of_part = std::max<size_t>(kRowsOfPart / std::max<size_t>(rows_each, 1), 1);
  std::vector<std::vector<char>> parts(kParts);
  for (size_t begin = 0; begin < count; begin += kParts * of_part) {
    for_each_index(kParts, [&](size_t part) {
      parts[part].clear();
      const size_t end = std::min(count, begin + (part + 1) * of_part);
      for (size_t i = begin + part * of_part; i < end; ++i) write(parts[part], i);
    });
    for (const std::vector<char>& rows : parts) out.add_rows(rows);
  }
}

bool is_float(double x) { return static_cast<double>(static_cast<float>(x)) == x; }

}  // namespace

Subdivision::Subdivision(const Mesh& mesh, uint32_t levels)
    : mesh_(mesh), levels_(levels), n_(1u << levels) {
  if (levels > kMostLevels) {
    throw UsageError("--levels " + std::to_string(levels) + ": expected at most " +
                     std::to_string(kMostLevels));
  }
  find_edges();
  count_elements();
  check_points();
}

void Subdivision::find_edges() {
  if (n_ == 1) return;
  edges_.reserve(3 * mesh_.faces.size());
  for (const glm::uvec3& f : mesh_.faces) {
    for (const uint64_t key : {key_of(f.x, f.y), key_of(f.y, f.z), key_of(f.z, f.x)})
      edges_.push_back(key);
  }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

void Subdivision::count_elements() {
  const uint64_t faces = mesh_.faces.size();
  shape_.face_count = faces * n_ * n_;
  shape_.vertex_count = mesh_.vertices.size();
  if (n_ > 1) shape_.vertex_count += edges_.size() * (n_ - 1) + faces * inside_count();
  if (std::max(shape_.face_count, shape_.vertex_count) >= UINT32_MAX) {
    throw UsageError("--levels " + std::to_string(levels_) + ": " + mesh_.name + " would have " +
                     std::to_string(shape_.face_count) + " faces and " +
                     std::to_string(shape_.vertex_count) +
                     " vertices, expected fewer than 2^32 - 1 of each");
  }
}

template <class Use>
void Subdivision::for_edge(const Use& use) const {
  for (uint32_t j = 1; j < n_; ++j) use(Weights{n_ - j, j, 0});
}

template <class Use>
void Subdivision::for_inside(const Use& use) const {
  for (uint32_t l = 1; l + 1 < n_; ++l) {
    for (uint32_t j = 1; j + l < n_; ++j) use(Weights{n_ - j - l, j, l});
  }
}

std::array<Average, 3> Subdivision::point_of(const Corners& corners, const Weights& weights) const {
  std::array<Average, 3> point;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<double, 3> values{};
    for (size_t c = 0; c < 3; ++c) values[c] = mesh_.vertices[corners[c]][axis];
    point[static_cast<size_t>(axis)] = average(values, weights, levels_);
  }
  return point;
}

Subdivision::Corners Subdivision::ends_of(size_t edge) const {
  const auto low = static_cast<uint32_t>(edges_[edge] >> 32);
  const auto high = static_cast<uint32_t>(edges_[edge]);
  return {low, high, low};
}

void Subdivision::refuse(const std::string& place, const Inexact& inexact) const {
  const auto over_n = [&](size_t corner) {
    return std::to_string(inexact.weights[corner]) + "/" + std::to_string(n_);
  };
  throw InputError(mesh_.name + ": " + place + ": the point at " + over_n(0) + ", " + over_n(1) +
                   ", " + over_n(2) + " of its corners takes " + std::to_string(inexact.bits) +
                   " bits on the " + "xyz"[inexact.axis] +
                   " axis, and a double has 53; expected fewer --levels, or --grid " +
                   std::to_string(53 - levels_) + " or less");
}

std::string Subdivision::place_of(size_t element) const {
  if (element >= edges_.size()) return "face " + std::to_string(element - edges_.size());
  const Corners ends = ends_of(element);
  return "edge of vertices " + std::to_string(ends[0]) + " and " + std::to_string(ends[1]);
}

std::optional<Subdivision::Inexact> Subdivision::first_inexact(
    size_t element, std::atomic<bool>& any_double) const {
  std::optional<Inexact> found;
  const auto look_at = [&](const Corners& corners, const Weights& weights) {
    if (found) return;
    const std::array<Average, 3> point = point_of(corners, weights);
    for (size_t axis = 0; axis < 3 && !found; ++axis) {
      if (!point[axis].is_exact)
        found = {weights, axis, point[axis].bits};
      else if (!is_float(point[axis].value))
        any_double = true;
    }
  };
  if (element < edges_.size()) {
    for_edge([&](const Weights& weights) { look_at(ends_of(element), weights); });
  } else {
    const glm::uvec3& f = mesh_.faces[element - edges_.size()];
    for_inside([&](const Weights& weights) { look_at({f.x, f.y, f.z}, weights); });
  }
  return found;
}

// The first in the file's order, whatever thread finds one: points after a refused one are skipped,
// points before it are checked.
void Subdivision::check_points() {
  constexpr size_t kOfPiece = 1024;
  const size_t all = edges_.size() + (n_ > 2 ? mesh_.faces.size() : 0);
  std::atomic<bool> any_double = std::any_of(
      mesh_.vertices.begin(), mesh_.vertices.end(),
      [](const glm::dvec3& v) { return !(is_float(v.x) && is_float(v.y) && is_float(v.z)); });
  std::atomic<size_t> first_bad = SIZE_MAX;
  for_each_index((all + kOfPiece - 1) / kOfPiece, [&](size_t piece) {
    const size_t end = std::min(all, (piece + 1) * kOfPiece);
    for (size_t i = piece * kOfPiece; i < end && i < first_bad; ++i) {
      if (!first_inexact(i, any_double)) continue;
      size_t known = first_bad;
      while (i < known && !first_bad.compare_exchange_weak(known, i)) {
      }
    }
  });
  if (first_bad != SIZE_MAX) refuse(place_of(first_bad), *first_inexact(first_bad, any_double));
  shape_.is_double = any_double;
}

Subdivision::FaceEdges Subdivision::edges_of(size_t face) const {
  const glm::uvec3& f = mesh_.faces[face];
  FaceEdges out{};
  for (int e = 0; e < 3; ++e) {
    const uint32_t from = f[e], to = f[(e + 1) % 3];
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), key_of(from, to));
    out.first[static_cast<size_t>(e)] = first_of_edge(static_cast<size_t>(found - edges_.begin()));
    out.is_reversed[static_cast<size_t>(e)] = from > to;
  }
  return out;
}

uint32_t Subdivision::index_of(size_t face, const FaceEdges& edges, const Weights& weights) const {
  for (size_t e = 0; e < 3; ++e) {
    const size_t next = (e + 1) % 3, other = (e + 2) % 3;
    if (weights[e] == n_) return mesh_.faces[face][static_cast<int>(e)];
    if (weights[other] != 0 || weights[e] == 0 || weights[next] == 0) continue;
    const uint32_t pieces = edges.is_reversed[e] ? weights[e] : weights[next];
    return static_cast<uint32_t>(edges.first[e] + pieces - 1);
  }
  // Row l of the inside holds n - 1 - l corners.
  const uint64_t j = weights[1], l = weights[2];
  const uint64_t before = (l - 1) * (n_ - 1) - (l - 1) * l / 2;
  return static_cast<uint32_t>(first_of_edge(edges_.size()) + face * inside_count() + before + j -
                               1);
}

void Subdivision::write_children(std::vector<char>& rows, size_t face) const {
  const glm::uvec3& f = mesh_.faces[face];
  if (n_ == 1) return write_face(rows, f.x, f.y, f.z);
  const FaceEdges edges = edges_of(face);
  const auto corner = [&](uint32_t j, uint32_t l) {
    return index_of(face, edges, {n_ - j - l, j, l});
  };
  for (uint32_t l = 0; l < n_; ++l) {
    for (uint32_t j = 0; j + l < n_; ++j) {
      write_face(rows, corner(j, l), corner(j + 1, l), corner(j, l + 1));
      if (j + l + 2 > n_) continue;
      write_face(rows, corner(j + 1, l), corner(j + 1, l + 1), corner(j, l + 1));
    }
  }
}

void Subdivision::write(const std::string& path) const {
  PlyStream out(path, shape_);
  for (const glm::dvec3& v : mesh_.vertices) out.add_vertex(v);
  const auto points = [&](std::vector<char>& rows, const Corners& corners) {
    return [&, corners](const Weights& weights) {
      const std::array<Average, 3> p = point_of(corners, weights);
      write_vertex(rows, {p[0].value, p[1].value, p[2].value}, shape_.is_double);
    };
  };
  stream(out, edges_.size(), n_ - 1,
         [&](std::vector<char>& rows, size_t edge) { for_edge(points(rows, ends_of(edge))); });
  const size_t faces = mesh_.faces.size();
  if (n_ > 2) {
    stream(out, faces, inside_count(), [&](std::vector<char>& rows, size_t face) {
      const glm::uvec3& f = mesh_.faces[face];
      for_inside(points(rows, Corners{f.x, f.y, f.z}));
    });
  }
  stream(out, faces, size_t{n_} * n_,
         [&](std::vector<char>& rows, size_t face) { write_children(rows, face); });
  out.finish();
}

}  // namespace vkh::pairs
