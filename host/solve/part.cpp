#include "host/solve/part.h"

#include <algorithm>
#include <atomic>

#include "host/base/float_environment.h"
#include "host/base/parallel.h"
#include "host/base/rounding.h"
#include "host/solve/switches.h"
#include "vkhausdorff/frame.h"

namespace vkh {
namespace {

// A range of faces that is copied at once.
struct Piece {
  size_t from, to, count;
};

std::vector<Piece> pieces_of(const FaceRanges& ranges) {
  std::vector<Piece> pieces;
  size_t to = 0;
  for (const FaceRange& range : ranges) {
    for (size_t from = range.begin; from < range.end; from += kBlock) {
      pieces.push_back({from, to, std::min(kBlock, range.end - from)});
      to += pieces.back().count;
    }
  }
  return pieces;
}

// Marks the vertices that are used and numbers them: their places in the part, in their order.
// Threads may mark the same vertex.
class Places {
 public:
  explicit Places(size_t vertices) : used_(vertices), place_(vertices) {}

  void use(const glm::uvec3& face) {
    for (int k = 0; k < 3; ++k) used_[face[k]].store(true, std::memory_order_relaxed);
  }
  /// Numbers the vertices once all are marked. Returns how many there are.
  size_t number() {
    std::vector<size_t> before(block_count(used_.size()) + 1);
    for_each_block(used_.size(), [&](size_t block, size_t begin, size_t end) {
      size_t count = 0;
      for (size_t v = begin; v < end; ++v) count += is_used(v) ? 1 : 0;
      before[block + 1] = count;
    });
    for (size_t block = 1; block < before.size(); ++block) before[block] += before[block - 1];
    for_each_block(used_.size(), [&](size_t block, size_t begin, size_t end) {
      auto next = static_cast<uint32_t>(before[block]);
      for (size_t v = begin; v < end; ++v) {
        if (is_used(v)) place_[v] = next++;
      }
    });
    return before.back();
  }
  bool is_used(size_t v) const { return used_[v].load(std::memory_order_relaxed); }
  uint32_t operator[](size_t v) const { return place_[v]; }

 private:
  std::vector<std::atomic<bool>> used_;
  std::vector<uint32_t> place_;
};

// A block is small enough for work that lies together to be shared: of BrunoLevy_v8_engine against
// its alphawrap the half with more queries has 1.01 times the mean's in blocks of 1024, 1.9 times
// in five turns or one. It is large enough for few vertices to be in two parts, whose seeds both
// ask for them: of alecjacobson_igea 1.68 times as many in blocks of 16, 1.19 times of 4096.
size_t block_of_turns(size_t faces, size_t count) {
  constexpr size_t kTurns = 32, kLargest = 65536;
  return std::clamp<size_t>(faces / count / kTurns, 1, kLargest);
}

// Sets the options that depend on all of A, which a part does not know.
SolveOptions options_of_part(const SolveOptions& options, const Diagonal& of_a) {
  SolveOptions out = options;
  const double tolerance = multiply_down(options.tolerance, of_a.least());
  if (options.tolerance_is_absolute || !(tolerance > 0)) return out;  // nor is it of a part
  out.engine.fine = options.engine.fine || options.tolerance < kFineTolerance;
  out.tolerance = tolerance;
  out.tolerance_is_absolute = true;
  return out;
}

}  // namespace

FaceRanges part_in_order(size_t faces, size_t index, size_t count) {
  const size_t each = faces / count, larger = faces % count;
  const size_t begin = index * each + std::min(index, larger);
  return {{begin, begin + each + (index < larger ? 1 : 0)}};
}

FaceRanges part_by_turns(size_t faces, size_t index, size_t count) {
  const size_t block = block_of_turns(faces, count);
  FaceRanges ranges;
  for (size_t begin = index * block; begin < faces; begin += count * block)
    ranges.push_back({begin, std::min(begin + block, faces)});
  return ranges;
}

Mesh part_of(const Mesh& a, const FaceRanges& ranges) {
  const std::vector<Piece> pieces = pieces_of(ranges);
  Mesh part;
  part.name = a.name;
  part.delta = a.delta;
  part.unit = a.unit;
  part.faces.resize(pieces.empty() ? 0 : pieces.back().to + pieces.back().count);
  Places places(a.vertices.size());
  for_each_index(pieces.size(), [&](size_t i) {
    const Piece& piece = pieces[i];
    for (size_t k = 0; k < piece.count; ++k) {
      part.faces[piece.to + k] = a.faces[piece.from + k];
      places.use(part.faces[piece.to + k]);
    }
  });
  part.vertices.resize(places.number());
  for_each_block(a.vertices.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      if (places.is_used(v)) part.vertices[places[v]] = a.vertices[v];
    }
  });
  for_each_block(part.faces.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      for (int k = 0; k < 3; ++k) part.faces[i][k] = places[part.faces[i][k]];
    }
  });
  part.counts.vertices = part.vertices.size();
  part.counts.faces = part.faces.size();
  return part;
}

uint64_t face_of_whole(const FaceRanges& ranges, uint64_t face) {
  for (const FaceRange& range : ranges) {
    const size_t count = range.end - range.begin;
    if (face < count) return range.begin + face;
    face -= count;
  }
  return ranges.empty() ? face : ranges.back().end - 1;  // no part has such a face
}

Report distance_of_part(const Distance& distance, const Mesh& a, const FaceRanges& ranges,
                        const Mesh& b, const SolveOptions& options) {
  const FloatEnvironment ours;
  check_mesh(a);
  const Diagonal of_a = diagonal_of(a);
  Report r = distance(part_of(a, ranges), b, options_of_part(options, of_a));
  r.diagonal_a = of_a.held();
  r.mesh_a = a.counts;
  if (r.has_witness) r.witness_a.set_face(a, face_of_whole(ranges, r.witness_a.face));
  return r;
}

}  // namespace vkh
