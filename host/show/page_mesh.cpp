// Decimation by a grid: it must lose no bound, but need not be beautiful.
#include "host/show/page_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "host/base/hash_index.h"
#include "host/base/parallel.h"
#include "host/show/camera.h"

namespace vkh {
namespace {

constexpr uint32_t kNone = UINT32_MAX;
constexpr double kMostCells = 1 << 20;  // along a side: three such numbers are 60 bits of a key
constexpr int kTries = 12;              // each shrinks or grows the cells by a sixth or more
constexpr double kFull = 0.8;           // share of most_faces: worth no further try

using Cells = std::array<uint32_t, 3>;

/// One decimation, by cells of a given number along the longest side; ends early if that is too
/// many.
class Clusters {
 public:
  Clusters(const Mesh& mesh, const Place& place, size_t most_faces, double cells)
      : mesh_(mesh), place_(place), most_(most_faces), cells_(cells) {}

  std::optional<Shown> shown() {
    if (!put_into_cells() || !keep_faces() || !stand_for_the_rest()) return std::nullopt;
    mesh_vertices_to_cells();
    out_.place = place_;
    out_.is_decimated = true;
    return std::move(out_);
  }

 private:
  uint64_t key_of(const glm::dvec3& point) const {
    const glm::dvec3 t = place_.unit(point);
    const auto along = [&](double x) {
      return static_cast<uint64_t>(std::clamp(x * cells_, 0.0, cells_ - 1));
    };
    return along(t.x) << 40 | along(t.y) << 20 | along(t.z);
  }

  bool put_into_cells() {
    const HashSecret& secret = hash_secret();
    const size_t count = mesh_.vertices.size();
    std::vector<uint64_t> keys(count);
    for (size_t v = 0; v < count; ++v) keys[v] = key_of(mesh_.vertices[v]);
    HashIndex cells(
        most_, [&](uint32_t v) { return keyed_hash(secret, std::array{keys[v]}); },
        [&](uint32_t v, uint32_t w) { return keys[v] == keys[w]; });
    cell_of_.resize(count);
    for (uint32_t v = 0; v < count; ++v) {
      const uint32_t first = cells.insert(v);
      if (first == v && cell_count_ == 3 * most_) return false;
      cell_of_[v] = first == v ? cell_count_++ : cell_of_[first];
    }
    return true;
  }

  Cells cells_of(size_t face) const {
    const glm::uvec3 f = mesh_.faces[face];
    return {cell_of_[f.x], cell_of_[f.y], cell_of_[f.z]};
  }
  Cells sorted_cells_of(size_t face) const {
    Cells cells = cells_of(face);
    std::sort(cells.begin(), cells.end());
    return cells;
  }
  static bool is_triangle(const Cells& c) { return c[0] != c[1] && c[1] != c[2] && c[2] != c[0]; }

  bool add(const glm::uvec3& corners, const Cells& cells) {
    if (out_.faces.size() == most_) return false;
    for (const uint32_t cell : cells) {
      if (stand_in_[cell] == kNone) stand_in_[cell] = static_cast<uint32_t>(out_.faces.size());
    }
    out_.faces.push_back(corners);
    return true;
  }

  // Keeps faces whose corners are in three cells, one for each set of three cells.
  bool keep_faces() {
    const HashSecret& secret = hash_secret();
    HashIndex triples(
        most_,
        [&](uint32_t f) {
          const Cells c = sorted_cells_of(f);
          return keyed_hash(secret, std::array{uint64_t{c[0]} << 32 | c[1], uint64_t{c[2]}});
        },
        [&](uint32_t f, uint32_t g) { return sorted_cells_of(f) == sorted_cells_of(g); });
    stand_in_.assign(cell_count_, kNone);
    out_.face_of.assign(mesh_.faces.size(), kNone);
    for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      const Cells c = cells_of(f);
      if (!is_triangle(c)) continue;
      const uint32_t first = triples.insert(f);
      if (first == f && !add({c[0], c[1], c[2]}, c)) return false;
      out_.face_of[f] =
          first == f ? static_cast<uint32_t>(out_.faces.size() - 1) : out_.face_of[first];
    }
    return true;
  }

  // Gives each face within one cell or two a shown face that touches them, or otherwise shows it
  // itself.
  bool stand_for_the_rest() {
    for (size_t f = 0; f < mesh_.faces.size(); ++f) {
      if (out_.face_of[f] != kNone) continue;
      const Cells c = cells_of(f);
      const auto known =
          std::find_if(c.begin(), c.end(), [&](uint32_t cell) { return stand_in_[cell] != kNone; });
      if (known == c.end() && !add_as_it_is(f, c)) return false;
      out_.face_of[f] = known == c.end() ? stand_in_[c[0]] : stand_in_[*known];
    }
    return true;
  }

  bool add_as_it_is(size_t face, const Cells& cells) {
    const auto first = static_cast<uint32_t>(cell_count_ + apart_.size());
    const glm::uvec3 f = mesh_.faces[face];
    for (const uint32_t v : {f.x, f.y, f.z}) apart_.push_back(place_.unit(mesh_.vertices[v]));
    return add({first, first + 1, first + 2}, cells);
  }

  // A cell's vertex is the mean of those in it. It is only a place for display: no bound rests on
  // it.
  void mesh_vertices_to_cells() {
    std::vector<glm::dvec3>& sums = out_.vertices;
    std::vector<double> counts(cell_count_);
    sums.assign(cell_count_, glm::dvec3(0));
    for (size_t v = 0; v < cell_of_.size(); ++v) {
      sums[cell_of_[v]] += place_.unit(mesh_.vertices[v]);
      ++counts[cell_of_[v]];
    }
    for (size_t c = 0; c < cell_count_; ++c) sums[c] /= counts[c];
    sums.insert(sums.end(), apart_.begin(), apart_.end());
  }

  const Mesh& mesh_;
  const Place& place_;
  size_t most_;
  double cells_;
  uint32_t cell_count_ = 0;
  std::vector<uint32_t> cell_of_;   // one per vertex
  std::vector<uint32_t> stand_in_;  // the first shown face that touches each cell
  std::vector<glm::dvec3> apart_;   // corners of faces that are shown as they are
  Shown out_;
};

Shown whole(const Mesh& mesh, const Place& place) {
  Shown shown;
  shown.place = place;
  shown.faces = mesh.faces;
  shown.vertices.reserve(mesh.vertices.size());
  for (const glm::dvec3& v : mesh.vertices) shown.vertices.push_back(place.unit(v));
  shown.face_of.resize(mesh.faces.size());
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) shown.face_of[f] = f;
  return shown;
}

// The factor by which more cells give about as many faces as there may be: they are a surface's.
double growth(size_t faces, size_t most) {
  const double room = 0.95 * static_cast<double>(most) / static_cast<double>(faces);
  return std::clamp(std::sqrt(room), 1.1, 4.0);
}

}  // namespace

glm::dvec3 Place::unit(const glm::dvec3& point) const {
  if (!(size > 0)) return glm::dvec3(0);
  return (point / 2.0 - lo / 2.0) / (size / 2);  // halves: a difference of doubles may overflow
}

Place place_of(const Mesh& mesh) {
  glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi = -lo;
  for (const glm::dvec3& v : mesh.vertices) {
    for (int i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], v[i]);
      hi[i] = std::max(hi[i], v[i]);
    }
  }
  const glm::dvec3 side = hi / 2.0 - lo / 2.0;
  const double longest = 2 * std::max({side.x, side.y, side.z});
  return {lo, std::min(longest, std::numeric_limits<double>::max())};
}

Shown shown_of(const Mesh& mesh, size_t most_faces) {
  const Place place = place_of(mesh);
  if (mesh.faces.size() <= most_faces) return whole(mesh, place);
  std::optional<Shown> best;
  double cells = std::clamp(std::sqrt(static_cast<double>(most_faces)), 1.0, kMostCells);
  for (int i = 0; i < kTries || !best; ++i) {
    std::optional<Shown> found = Clusters(mesh, place, most_faces, cells).shown();
    if (!found && best) break;
    if (!found) {
      cells = std::max(1.0, std::floor(cells * 0.8));
      continue;
    }
    const size_t faces = found->faces.size();
    best = std::move(found);
    if (static_cast<double>(faces) >= kFull * static_cast<double>(most_faces)) break;
    const double next =
        std::min(std::ceil(cells * (cells > 1e3 ? 4 : growth(faces, most_faces))), kMostCells);
    if (next == cells) break;
    cells = next;
  }
  return std::move(*best);
}

namespace {

// Sorts blocks at once, and then merges two neighbours each.
void sort_together(std::vector<uint64_t>& keys) {
  const auto at = [&](size_t i) {
    return keys.begin() + static_cast<std::ptrdiff_t>(std::min(i, keys.size()));
  };
  for_each_block(keys.size(),
                 [&](size_t, size_t begin, size_t end) { std::sort(at(begin), at(end)); });
  for (size_t sorted = kBlock; sorted < keys.size(); sorted *= 2) {
    for_each_range_of(2 * sorted, keys.size(), [&](size_t, size_t begin, size_t end) {
      std::inplace_merge(at(begin), at(begin + sorted), at(end));
    });
  }
}

// Vertices that a page cannot tell apart are one.
class Corners {
 public:
  explicit Corners(size_t faces) : keys_(3 * faces) {}

  // Call it once for each corner, on any thread.
  void set(size_t face, size_t corner, const glm::dvec3& in_place) {
    uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = key << 16 |
            static_cast<uint64_t>(std::lround(std::clamp(in_place[axis], 0.0, 1.0) * 65535));
    keys_[3 * face + corner] = key;
  }

  // Makes the vertices, and faces of three corners each.
  void put_into(ShownMesh& shown) const {
    std::vector<uint64_t> known = keys_;
    sort_together(known);
    known.erase(std::unique(known.begin(), known.end()), known.end());
    for (const uint64_t key : known)
      shown.vertices.push_back({static_cast<uint16_t>(key >> 32), static_cast<uint16_t>(key >> 16),
                                static_cast<uint16_t>(key)});
    const auto number = [&](uint64_t key) {
      return static_cast<uint32_t>(std::lower_bound(known.begin(), known.end(), key) -
                                   known.begin());
    };
    shown.faces.resize(keys_.size() / 3);
    for_each_block(shown.faces.size(), [&](size_t, size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f)
        shown.faces[f] = {number(keys_[3 * f]), number(keys_[3 * f + 1]), number(keys_[3 * f + 2])};
    });
  }

 private:
  std::vector<uint64_t> keys_;
};

ShownMesh mesh_of_cells(const Mesh& mesh, const std::vector<ShownCell>& cells) {
  ShownMesh shown{.place = place_of(mesh)};
  Corners corners(cells.size());
  shown.values.resize(cells.size());
  for_each_block(cells.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const glm::uvec3 f = mesh.faces[cells[i].face];
      const glm::dvec3 a = shown.place.unit(mesh.vertices[f.x]);
      const glm::dvec3 b = shown.place.unit(mesh.vertices[f.y]);
      const glm::dvec3 c = shown.place.unit(mesh.vertices[f.z]);
      size_t corner = 0;
      for (const glm::dvec3& w : weights_of({.corners = cells[i].corners}))
        corners.set(i, corner++, w.x * a + w.y * b + w.z * c);
      shown.values[i] = cells[i].value;
    }
  });
  corners.put_into(shown);
  return shown;
}

// The value of a shown face, for all faces that it stands for.
class Worst {
 public:
  void add(const ShownValue& value) {
    for (const double at : value.at) {
      if (std::abs(at) > std::abs(farthest_)) farthest_ = at;
      lower_ = std::min(lower_, at - value.width);
      upper_ = std::max(upper_, at + value.width);
    }
    hatched_ += value.is_hatched ? 1 : 0;
    sideless_ += value.is_sideless ? 1 : 0;
    ++count_;
  }
  bool has_any() const { return count_ > 0; }
  ShownValue value() const {
    ShownValue all{.at = {farthest_, farthest_, farthest_}};
    all.width = std::max(upper_ - farthest_, farthest_ - lower_);
    all.width += (all.width + std::abs(farthest_)) * 0x1p-40;
    all.is_hatched = 2 * hatched_ > count_;
    all.is_sideless = count_ > 0 && sideless_ == count_;
    return all;
  }

 private:
  double farthest_ = 0;
  double lower_ = std::numeric_limits<double>::infinity(), upper_ = -lower_;
  size_t hatched_ = 0, sideless_ = 0, count_ = 0;
};

// A part without a side, shown together with others, may be on either side of B.
void add_to(Worst& worst, ShownValue value, bool is_signed) {
  worst.add(value);
  if (!is_signed || !value.is_sideless) return;
  for (double& at : value.at) at = -at;
  value.is_sideless = false;
  worst.add(value);
}

ShownMesh decimated_mesh(const Mesh& mesh, const CellMap& map, const drawing::MapScale& scale,
                         size_t most_faces) {
  const Shown few = shown_of(mesh, most_faces);
  ShownMesh shown{.place = few.place, .is_decimated = true};
  Corners corners(few.faces.size());
  for (size_t i = 0; i < few.faces.size(); ++i) {
    const glm::uvec3& f = few.faces[i];
    size_t corner = 0;
    for (const uint32_t v : {f.x, f.y, f.z}) corners.set(i, corner++, few.vertices[v]);
  }
  corners.put_into(shown);
  std::vector<Worst> worst(few.faces.size()), left_out(map.max_distance ? few.faces.size() : 0);
  for (const MapCell& cell : map.cells) {
    std::vector<Worst>& to = map.is_left_out(cell) ? left_out : worst;
    add_to(to[few.face_of[cell.face]], shown_value(map, scale, cell), map.has_sides);
  }
  for (size_t f = 0; f < worst.size(); ++f) {
    const bool is_left_out = !worst[f].has_any() && map.max_distance && left_out[f].has_any();
    shown.values.push_back(is_left_out ? left_out[f].value() : worst[f].value());
    shown.values.back().is_left_out = is_left_out;
  }
  return shown;
}

}  // namespace

ShownMesh shown_mesh(const Mesh& mesh, const CellMap& map, const drawing::MapScale& scale,
                     size_t most_faces) {
  ShownMesh shown = mesh.faces.size() <= most_faces
                        ? mesh_of_cells(mesh, shown_cells(mesh, map, scale, most_faces))
                        : decimated_mesh(mesh, map, scale, most_faces);
  if (!mesh.are_points || !(shown.place.size > 0)) return shown;
  const double fewer =
      static_cast<double>(mesh.faces.size()) / static_cast<double>(shown.faces.size());
  shown.spacing = drawing::spacing_of(mesh) * std::sqrt(fewer) / shown.place.size;
  return shown;
}

}  // namespace vkh
