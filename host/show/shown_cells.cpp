#include "host/show/shown_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "host/base/parallel.h"
#include "host/solve/cell_corners.h"

namespace vkh {
namespace {

using drawing::MapScale;

constexpr double kColours = 400;       // more steps of the bar than people can tell apart
constexpr double kRounding = 0x1p-40;  // more than the sums of a width lose

lib::Bary3 corners_at(const std::array<uint32_t, 4>& words) {
  return lib::unpack_corners({words[0], words[1], words[2], words[3]});
}
std::array<uint32_t, 4> words_of(const lib::Bary3& corners) {
  const glm::uvec4 w = lib::pack_corners(corners);
  return {w.x, w.y, w.z, w.w};
}

/// A cell while the halvings that it comes from are sought.
struct Part {
  lib::Bary3 corners;
  uint32_t cell;
  bool is_first = false;  ///< of the last halving's halves
};

/// The halving of a triangle at the middle of an edge, the line from the corner opposite to it.
class Halving {
 public:
  Halving(const lib::Bary3& t, uint32_t corner)
      : halves(lib::halves_of(t, corner, lib::middle_opposite(t, corner))),
        from_(halves.first.a),
        way_(Way(halves.first.c) - from_) {
    if (side(halves.first.b) < 0) way_ = -way_;
  }

  /// Sorts the parts into halves, as far as the line passes through none of them; returns whether
  /// that is all.
  bool sort(std::span<Part> parts) const {
    for (Part& part : parts) {
      const int64_t x = side(part.corners.a), y = side(part.corners.b), z = side(part.corners.c);
      if (std::min({x, y, z}) < 0 && std::max({x, y, z}) > 0) return false;
      part.is_first = x + y + z > 0;
    }
    return true;
  }

  lib::Halves halves;

 private:
  using Way = glm::vec<2, int64_t>;

  /// Positive on the first half's side of the line, negative on the other's.
  int64_t side(const glm::uvec2& p) const {
    const Way at = Way(p) - from_;
    return way_.x * at.y - way_.y * at.x;
  }

  Way from_, way_;
};

/// A cell, or two halves as one.
struct Node {
  ShownCell cell;
  double area = 0, unresolved = 0;  // shares of the mesh's
  double cost =
      0;  // of showing it as one cell, or of showing its halves as one each, whichever is more
};

/// The halvings of faces, with the cost of undoing each, and the cells that are then left.
class Halvings {
 public:
  Halvings(const CellMap& map, const MapScale& scale)
      : map_(map), scale_(scale), unseen_(scale.length() / kColours) {}

  /// Finds the halvings that the cells of one face come from.
  void add_face(std::span<const uint32_t> cells) {
    parts_.clear();
    for (const uint32_t i : cells) parts_.push_back({corners_at(map_.cells[i].corners), i});
    find(lib::whole_root(), parts_);
    ++faces_;
  }

  /// The costs of all halvings.
  const std::vector<double>& costs() const { return costs_; }

  /// Adds the cells that are left if all halvings that cost up to `most_cost` are undone.
  void add_left(double most_cost, std::vector<ShownCell>& left) const {
    Walk walk{.most_cost = most_cost, .left = left};
    for (size_t face = 0; face < faces_; ++face) {
      const Node whole = undone(lib::whole_root(), walk);
      if (whole.cost <= most_cost) left.push_back(whole.cell);
    }
  }

 private:
  static constexpr uint32_t kCell = 3;

  /// A triangle that is halved at the edge opposite that corner; kCell: a cell.
  struct Piece {
    uint32_t opposite, cell = 0;
  };
  struct Walk {
    const double most_cost;
    std::vector<ShownCell>& left;
    size_t piece = 0, cost = 0;  ///< the next ones
  };

  Node leaf_of(uint32_t number) const {
    const MapCell& cell = map_.cells[number];
    Node node{.cell = {cell.corners, cell.face, shown_value(map_, scale_, cell)},
              .area = static_cast<double>(cell.share)};
    node.unresolved = node.cell.value.is_hatched ? node.area : 0;
    return node;
  }

  // The corner of the halving that the parts come from, which cuts none of them. It is the only
  // one: another would meet the first in the triangle's centroid, which is no corner of a cell.
  static uint32_t halved_at(const lib::Bary3& t, std::span<Part> parts) {
    for (uint32_t corner = 0; corner < 3; ++corner) {
      if (Halving(t, corner).sort(parts)) return corner;
    }
    throw std::logic_error("cells are no halves of their face");
  }

  Node find(const lib::Bary3& t, std::span<Part> parts) {
    if (parts.size() == 1) {
      pieces_.push_back({kCell, parts[0].cell});
      return leaf_of(parts[0].cell);
    }
    const uint32_t opposite = halved_at(t, parts);
    const lib::Halves halves = Halving(t, opposite).halves;
    const auto cut =
        std::partition(parts.begin(), parts.end(), [](const Part& p) { return p.is_first; });
    const auto count = static_cast<size_t>(cut - parts.begin());
    if (count == 0 || count == parts.size()) throw std::logic_error("cells do not tile their face");
    const size_t number = costs_.size();
    costs_.push_back(0);
    pieces_.push_back({opposite});
    const Node first = find(halves.first, parts.first(count));
    const Node both = joined(t, opposite, first, find(halves.second, parts.subspan(count)));
    costs_[number] = both.cost;
    return both;
  }

  Node undone(const lib::Bary3& t, Walk& walk) const {
    const Piece& piece = pieces_[walk.piece++];
    if (piece.opposite == kCell) return leaf_of(piece.cell);
    const double cost = costs_[walk.cost++];
    const lib::Halves halves = Halving(t, piece.opposite).halves;
    const Node first = undone(halves.first, walk), second = undone(halves.second, walk);
    if (cost <= walk.most_cost) return joined(t, piece.opposite, first, second);
    for (const Node* half : {&first, &second}) {
      if (half->cost <= walk.most_cost) walk.left.push_back(half->cell);
    }
    return {.cell = {}, .cost = cost};
  }

  // A half without a side beside one with a side is shown as if it were on B, as widely as it is.
  static ShownValue with_side(ShownValue value) {
    if (!value.is_sideless) return value;
    value.width += *std::max_element(value.at.begin(), value.at.end());
    value.at = {};
    value.is_sideless = false;
    return value;
  }

  Node joined(const lib::Bary3& t, uint32_t opposite, const Node& first, const Node& second) const {
    const bool is_alike = first.cell.value.is_sideless == second.cell.value.is_sideless;
    const ShownValue x = is_alike ? first.cell.value : with_side(first.cell.value);
    const ShownValue y = is_alike ? second.cell.value : with_side(second.cell.value);
    Node both{.cell = {words_of(t), first.cell.face, {}},
              .area = first.area + second.area,
              .unresolved = first.unresolved + second.unresolved};
    ShownValue& value = both.cell.value;
    const uint32_t next = (opposite + 1) % 3, last = (opposite + 2) % 3;
    value.at[opposite] = std::abs(x.at[0]) >= std::abs(y.at[0]) ? x.at[0] : y.at[0];
    value.at[next] = x.at[1];
    value.at[last] = y.at[2];
    const double middle = (x.at[1] + y.at[2]) / 2;
    const double off_x =
        std::max(std::abs(x.at[0] - value.at[opposite]), std::abs(x.at[2] - middle));
    const double off_y =
        std::max(std::abs(y.at[0] - value.at[opposite]), std::abs(y.at[1] - middle));
    const double off = std::max(off_x, off_y);
    value.width = std::max(x.width + off_x, y.width + off_y);
    value.width += (value.width + std::abs(middle)) * kRounding;
    value.is_sideless = x.is_sideless;
    value.is_hatched = both.unresolved > both.area / 2;
    value.is_left_out = x.is_left_out && y.is_left_out;
    const bool has_same = is_alike && x.is_left_out == y.is_left_out;
    const double seen = has_same ? (value.is_left_out ? 0 : off) : std::max(off, scale_.length());
    const double cost = seen > unseen_ ? seen * both.area : 0;
    both.cost = std::max({cost, first.cost, second.cost});
    return both;
  }

  const CellMap& map_;
  const MapScale& scale_;
  const double unseen_;
  // Both with what is before its halves, and a first half before the second.
  std::vector<Piece> pieces_;
  std::vector<double> costs_;
  size_t faces_ = 0;
  std::vector<Part> parts_;  // of one face
};

/// The numbers of a map's cells, by faces.
class CellsByFace {
 public:
  CellsByFace(const Mesh& mesh, const CellMap& map)
      : first_(mesh.faces.size() + 1), cells_(map.cells.size()) {
    for (const MapCell& cell : map.cells) ++first_[cell.face + 1];
    for (size_t f = 1; f < first_.size(); ++f) first_[f] += first_[f - 1];
    std::vector<size_t> next(first_.begin(), first_.end() - 1);
    for (size_t i = 0; i < cells_.size(); ++i)
      cells_[next[map.cells[i].face]++] = static_cast<uint32_t>(i);
  }
  size_t face_count() const { return first_.size() - 1; }
  std::span<const uint32_t> of(size_t face) const {
    return std::span(cells_).subspan(first_[face], first_[face + 1] - first_[face]);
  }

 private:
  std::vector<size_t> first_;
  std::vector<uint32_t> cells_;
};

/// The halvings of all faces, in lots in the order of the faces.
std::vector<Halvings> halvings_of(const Mesh& mesh, const CellMap& map, const MapScale& scale) {
  constexpr size_t kLot = 256;
  const CellsByFace cells(mesh, map);
  std::vector<Halvings> lots((cells.face_count() + kLot - 1) / kLot, Halvings(map, scale));
  for_each_range_of(kLot, cells.face_count(), [&](size_t number, size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      if (!cells.of(f).empty()) lots[number].add_face(cells.of(f));
    }
  });
  return lots;
}

/// The cost of the last halving to undo, if the `undo` cheapest ones are undone.
double cost_for(std::vector<double> costs, size_t undo) {
  if (undo == 0 || costs.empty()) return 0;
  const size_t at = std::min(undo, costs.size()) - 1;
  std::nth_element(costs.begin(), costs.begin() + static_cast<std::ptrdiff_t>(at), costs.end());
  return costs[at];
}

}  // namespace

ShownValue shown_value(const CellMap& map, const MapScale& scale, const MapCell& cell) {
  const float most = std::max({cell.estimate[0], cell.estimate[1], cell.estimate[2]});
  const double farthest = static_cast<double>(most) * map.unit;
  const double upper = map.around(static_cast<double>(most), static_cast<double>(cell.width)).upper;
  ShownValue value{.width = upper - farthest + upper * kRounding,
                   .is_hatched = scale.is_unresolved(cell),
                   .is_sideless = scale.is_without_side(cell),
                   .is_left_out = scale.is_left_out(cell)};
  for (size_t i = 0; i < 3; ++i)
    value.at[i] = value.is_sideless ? static_cast<double>(cell.estimate[i]) * map.unit
                                    : scale.distance_at(cell, i);
  if (map.has_sides && cell.side == SurfaceSide::kUnsigned && !value.is_sideless)
    value.width = upper * (1 + kRounding);
  return value;
}

std::vector<ShownCell> shown_cells(const Mesh& mesh, const CellMap& map, const MapScale& scale,
                                   size_t most) {
  const std::vector<Halvings> lots = halvings_of(mesh, map, scale);
  std::vector<double> costs;
  for (const Halvings& lot : lots)
    costs.insert(costs.end(), lot.costs().begin(), lot.costs().end());
  const size_t count = map.cells.size();
  const double most_cost = cost_for(std::move(costs), count > most ? count - most : 0);
  std::vector<std::vector<ShownCell>> left(lots.size());
  for_each_index(lots.size(), [&](size_t i) { lots[i].add_left(most_cost, left[i]); });
  std::vector<ShownCell> shown;
  for (const std::vector<ShownCell>& cells : left)
    shown.insert(shown.end(), cells.begin(), cells.end());
  return shown;
}

namespace {

// A map of whole faces; value(face) returns {the shown distance, its width}.
template <class Value>
CellMap map_of_faces(const Mesh& mesh, const Value& value) {
  CellMap map;
  double whole = 0;
  std::vector<double> areas;
  for (const glm::uvec3& f : mesh.faces) {
    const glm::dvec3 a = mesh.vertices[f.x];
    areas.push_back(length(cross(mesh.vertices[f.y] - a, mesh.vertices[f.z] - a)));
    whole += areas.back();
  }
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [shown, width] = value(f);
    if (std::isfinite(shown)) map.unit = std::max(f == 0 ? 0 : map.unit, shown);
  }
  if (!(map.unit > 0)) map.unit = 1;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [shown, width] = value(f);
    const auto at = static_cast<float>(shown / map.unit);
    const double off = width / map.unit + static_cast<double>(at) * 0x1p-23;
    map.cells.push_back({.corners = words_of(lib::whole_root()),
                         .face = f,
                         .estimate = {at, at, at},
                         .width = static_cast<float>(off),
                         .share = static_cast<float>(whole > 0 ? areas[f] / whole : 0)});
  }
  return map;
}

}  // namespace

CellMap map_of_bounds(const Mesh& mesh, const Field& field, double bar) {
  CellMap map = map_of_faces(mesh, [&](uint32_t f) {
    const double lower = field.lower[f], upper = field.upper[f];
    if (!std::isfinite(upper)) return std::pair(lower, upper);
    return std::pair((lower + upper) / 2, (upper - lower) / 2);
  });
  map.bar = bar;
  return map;
}

CellMap map_of_lower_bounds(const Mesh& mesh, const Field& field) {
  return map_of_faces(mesh, [&](uint32_t f) { return std::pair(field.lower[f], 0.0); });
}

}  // namespace vkh
