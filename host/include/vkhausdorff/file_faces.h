// Maps a triangle of a mesh to its face of the file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <vector>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

/// A file's faces are numbered from 0 as they stand in it. One of more than three corners is fanned
/// into triangles that follow each other, and one of fewer has none. If each is a triangle, nothing
/// is kept; otherwise runs of faces with equally many triangles, so that a mesh of quads is one
/// run.
class FileFaces {
 public:
  /// A run of faces that follow each other: the number of triangles and faces up to its end.
  struct Run {
    uint32_t triangles = 0, faces = 0;
    bool operator==(const Run&) const = default;
  };

  FileFaces() = default;
  /// Takes the runs() of another FileFaces. is_valid() checks whether they fit a mesh.
  explicit FileFaces(std::vector<Run> runs) : runs_(std::move(runs)) {}
  bool is_valid(uint64_t triangle_count) const {
    Run before;
    for (const Run& run : runs_) {
      if (run.faces <= before.faces || run.triangles < before.triangles ||
          (run.triangles - before.triangles) % (run.faces - before.faces) != 0)
        return false;
      before = run;
    }
    return before.triangles <= triangle_count;
  }

  bool are_triangles() const { return runs_.empty(); }
  const std::vector<Run>& runs() const { return runs_; }

  uint64_t of(uint64_t triangle) const {
    const auto run = std::partition_point(runs_.begin(), runs_.end(),
                                          [&](const Run& r) { return r.triangles <= triangle; });
    const Run before = run == runs_.begin() ? Run{} : *std::prev(run);
    const uint64_t beyond = triangle - before.triangles;
    if (run == runs_.end()) return before.faces + beyond;
    return before.faces +
           beyond / ((run->triangles - before.triangles) / (run->faces - before.faces));
  }
  /// The faces of all triangles of a mesh, in their order.
  std::vector<uint32_t> of_all(size_t triangle_count) const {
    std::vector<uint32_t> faces(triangle_count);
    Run before;
    auto at = faces.begin();
    for (const Run& run : runs_) {
      const uint32_t each = (run.triangles - before.triangles) / (run.faces - before.faces);
      for (uint32_t face = before.faces; each > 0 && face < run.faces; ++face)
        at = std::fill_n(at, each, face);
      before = run;
    }
    std::iota(at, faces.end(), before.faces);
    return faces;
  }
  /// The number of the file's faces, for a mesh of `triangle_count` triangles.
  uint64_t count(uint64_t triangle_count) const {
    return end().faces + (triangle_count - end().triangles);
  }

  /// Adds the next face that is not one triangle, with its first triangle's number. There are fewer
  /// than 2^32 faces and triangles in all.
  void add(size_t first, size_t triangle_count) {
    extend(after_triangles(first));
    extend({static_cast<uint32_t>(first + triangle_count), end().faces + 1});
  }
  /// Adds the faces of the file's next block, with its first triangle's number.
  void append(const FileFaces& block, size_t first) {
    if (block.are_triangles()) return;
    const Run start = after_triangles(first);
    extend(start);
    for (const Run& run : block.runs_)
      extend({start.triangles + run.triangles, start.faces + run.faces});
  }

 private:
  Run end() const { return runs_.empty() ? Run{} : runs_.back(); }
  Run after_triangles(size_t first) const {
    const auto triangles = static_cast<uint32_t>(first);
    return {triangles, end().faces + (triangles - end().triangles)};
  }

  void extend(const Run& to) {
    const Run from = end();
    if (to.faces == from.faces) return;
    const Run before = runs_.size() > 1 ? runs_[runs_.size() - 2] : Run{};
    const auto product = [](uint32_t x, uint32_t y) { return uint64_t{x} * y; };
    const bool is_same = product(from.triangles - before.triangles, to.faces - from.faces) ==
                         product(to.triangles - from.triangles, from.faces - before.faces);
    if (!runs_.empty() && is_same) {
      runs_.back() = to;
    } else {
      runs_.push_back(to);
    }
  }

  std::vector<Run> runs_;
};

}  // namespace vkh
