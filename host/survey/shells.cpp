// Why points have a side (docs/certificate.md, "Sides"). The faces of a mesh whose edges are used
// equally often in both directions have no boundary, so that the number of times that they wind
// round a point is an integer, constant on each connected part of what is not B. Each such part,
// except the unbounded one, where the number is 0, has on its boundary an inner point of a face
// that is not degenerate. Where faces touch in nothing but points, shared edges and parts of
// boundaries, a face's whole front belongs to one part, and so do the fronts of two faces at an
// edge that they alone use. One number, counted in front of one face, holds for the patch of all
// faces that are connected by such edges; behind them it is one more.
#include "host/survey/shells.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <string>

#include "host/base/decimal.h"
#include "host/base/reject.h"
#include "host/mesh/make_mesh.h"
#include "host/survey/sets.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

std::string in_brackets(const DVec3& p) {
  return "(" + shortest_decimal(p.x) + ", " + shortest_decimal(p.y) + ", " + shortest_decimal(p.z) +
         ")";
}

bool precedes(const glm::dvec3& p, const glm::dvec3& q) {
  if (p.x != q.x) return p.x < q.x;
  return p.y != q.y ? p.y < q.y : p.z < q.z;
}

uint64_t edge_key(uint32_t u, uint32_t v) {
  return uint64_t{std::min(u, v)} << 32 | std::max(u, v);
}

// Whether all corners of one triangle lie on an edge's line of the other or beyond it, in the plane
// of both: their insides are then apart, and of two convex sets that are, an edge says so.
bool are_apart(const Corners3& s, const Corners3& t) {
  int axis = 0;
  while (axis < 2 && turn_along(axis, s[0], s[1], s[2]) == 0) ++axis;
  const auto separates = [axis](const Corners3& x, const Corners3& y) {
    const int inward = turn_along(axis, x[0], x[1], x[2]);
    for (size_t i = 0; i < 3; ++i) {
      const auto is_out = [&](const glm::dvec3& p) {
        return turn_along(axis, x[i], x[(i + 1) % 3], p) * inward <= 0;
      };
      if (std::all_of(y.begin(), y.end(), is_out)) return true;
    }
    return false;
  };
  return separates(s, t) || separates(t, s);
}

// The sides of a triangle's corners on another's plane.
struct Sides3 {
  int below = 0, on = 0, above = 0;
  bool is_off() const { return on == 0 && (below == 0 || above == 0); }
  bool is_across() const { return below > 0 && above > 0; }
};
Sides3 sides_of(const Corners3& plane, const Corners3& t) {
  Sides3 sides;
  for (const glm::dvec3& p : t) {
    const int side = orientation(plane[0], plane[1], plane[2], p);
    ++(side < 0 ? sides.below : side > 0 ? sides.above : sides.on);
  }
  return sides;
}

bool an_edge_meets(const Corners3& s, const Corners3& t) {
  for (size_t i = 0; i < 3; ++i) {
    if (segment_meets(s[i], s[(i + 1) % 3], t)) return true;
  }
  return false;
}

enum class Contact { kNone, kTouch, kCross };

// Whether only one edge of t lies in the plane of s, on the line of an edge of s or beyond it: then
// t meets at most the boundary of s.
bool has_edge_beside(const Corners3& t, const Sides3& of_t, const Corners3& s) {
  if (of_t.on != 2 || of_t.is_across()) return false;
  int axis = 0;
  while (axis < 2 && turn_along(axis, s[0], s[1], s[2]) == 0) ++axis;
  const int inward = turn_along(axis, s[0], s[1], s[2]);
  for (size_t i = 0; i < 3; ++i) {
    const auto is_out = [&](const glm::dvec3& p) {
      return orientation(s[0], s[1], s[2], p) != 0 ||
             turn_along(axis, s[i], s[(i + 1) % 3], p) * inward <= 0;
    };
    if (std::all_of(t.begin(), t.end(), is_out)) return true;
  }
  return false;
}

// Classifies what two triangles in different planes have in common beyond shared corners. If one
// has a single corner in the other's plane and the rest on one side, it is that corner. If neither
// has corners on both sides of the other's plane, it is on the boundary of both, and so it is where
// an edge of one lies in the other's plane beside it.
Contact contact_off_plane(const Corners3& s, const Corners3& t, const Sides3& of_s,
                          const Sides3& of_t) {
  const auto is_point = [](const Sides3& x) { return x.on == 1 && !x.is_across(); };
  if (is_point(of_s) || is_point(of_t)) return Contact::kTouch;
  if (!of_s.is_across() && !of_t.is_across()) return Contact::kTouch;
  const bool is_beside = has_edge_beside(t, of_t, s) || has_edge_beside(s, of_s, t);
  return is_beside ? Contact::kTouch : Contact::kCross;
}

// The triangles with their shared corner, if there is one, first. Two triangles with a corner in
// common share more if and only if the edge opposite of it in one meets the other: a ray from it
// leaves one of them there.
bool have_more_in_common(const Corners3& s, const Corners3& t, int shared) {
  if (shared == 0) return an_edge_meets(s, t) || an_edge_meets(t, s);
  return segment_meets(s[1], s[2], t) || segment_meets(t[1], t[2], s);
}

Contact contact_of(const Corners3& s, const Corners3& t, int shared) {
  if (shared == 3) return Contact::kCross;
  const Sides3 of_t = sides_of(s, t);
  if (of_t.is_off()) return Contact::kNone;
  const Sides3 of_s = sides_of(t, s);
  if (of_s.is_off()) return Contact::kNone;
  const bool is_flat = of_t.on == 3;
  if (is_flat && !are_apart(s, t)) return Contact::kCross;
  if (shared == 2 || !have_more_in_common(s, t, shared)) return Contact::kNone;
  return is_flat ? Contact::kTouch : contact_off_plane(s, t, of_s, of_t);
}

}  // namespace

// A face's use of an edge.
struct Shells::EdgeUse {
  uint64_t edge;
  uint32_t face;
  bool is_forward;
  bool operator<(const EdgeUse& other) const {
    return edge < other.edge || (edge == other.edge && face < other.face);
  }
};

namespace {

// Calls work(begin, end) for the uses of each edge.
template <class Uses, class Work>
void each_edge(const Uses& uses, const Work& work) {
  for (size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].edge == uses[begin].edge) ++end;
    work(begin, end);
  }
}

}  // namespace

const char* inside_name(Inside inside) {
  switch (inside) {
    case Inside::kProven:
      return "proven";
    case Inside::kOpen:
      return "open";
    case Inside::kCrossing:
      return "crossing";
    case Inside::kWinding:
      return "winding";
    case Inside::kUndecided:
      return "undecided";
  }
  return "";
}

const char* inside_out_name(InsideOut how) {
  switch (how) {
    case InsideOut::kNone:
      return "none";
    case InsideOut::kPart:
      return "part";
    case InsideOut::kAll:
      return "all";
  }
  return "";
}

Shells::Shells(std::vector<glm::dvec3> vertices, const std::vector<UVec3>& faces,
               const GoesOn& goes_on)
    : vertices_(std::move(vertices)), faces_(faces), tree_({}, {}) {
  set_positions();
  set_kinds();
  mark_two_sided();
  tree_ = TriangleTree(triangles_, in_tree());
  const std::vector<EdgeUse> uses = edge_uses();
  count_edges(uses);
  inside_ = find_inside(uses, goes_on);
  const bool is_told = inside_ == Inside::kProven || inside_ == Inside::kWinding;
  if (!is_told && inside_out_ == InsideOut::kNone && edges_.open == 0 && has_negative_volume())
    inside_out_ = InsideOut::kAll;
}

Inside Shells::find_inside(const std::vector<EdgeUse>& uses, const GoesOn& goes_on) {
  if (edges_.open > 0) return Inside::kOpen;
  const std::optional<bool> do_cross = find_contacts(goes_on);
  if (!do_cross) return Inside::kUndecided;
  return *do_cross ? Inside::kCrossing : wind(uses, goes_on);
}

Shells::Shells(std::vector<glm::dvec3> vertices, const std::vector<UVec3>& faces, OnlyEdges)
    : vertices_(std::move(vertices)), faces_(faces), tree_({}, {}) {
  set_positions();
  count_edges(edge_uses());
}

EdgeCounts Shells::edges_of(const Mesh& mesh) {
  return Shells({mesh.vertices.begin(), mesh.vertices.end()}, mesh.faces, OnlyEdges()).edges_;
}

void refuse_conflicts(const Mesh& mesh) {
  const std::optional<EdgeConflict> first = Shells::edges_of(mesh).first;
  if (!first) return;
  const auto face = [&](size_t i) { return std::to_string(mesh.file_faces.of(first->faces[i])); };
  reject(mesh.name, "faces " + face(0) + " and " + face(1),
         "oriented against each other at the edge from " +
             in_brackets(mesh.vertices[first->vertices[0]]) + " to " +
             in_brackets(mesh.vertices[first->vertices[1]]) + ": there are no sides of it",
         "faces that are oriented alike");
}

void Shells::set_positions() {
  std::vector<uint32_t> order(vertices_.size()), first(vertices_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t u, uint32_t v) {
    if (vertices_[u] == vertices_[v]) return u < v;
    return precedes(vertices_[u], vertices_[v]);
  });
  for (size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && vertices_[order[i]] == vertices_[order[i - 1]];
    first[order[i]] = is_same ? first[order[i - 1]] : order[i];
  }
  for (const UVec3& f : faces_) {
    positions_.push_back({first[f.x], first[f.y], first[f.z]});
    triangles_.push_back({vertices_[f.x], vertices_[f.y], vertices_[f.z]});
  }
}

void Shells::set_kinds() {
  bool are_all_areas = true;
  for (const Corners3& t : triangles_) {
    kind_.push_back(is_degenerate(t[0], t[1], t[2]) ? Kind::kBare : Kind::kArea);
    are_all_areas = are_all_areas && kind_.back() == Kind::kArea;
  }
  if (!are_all_areas) cover();
}

// A degenerate face is the segment between its two farthest corners. It is covered by a face that
// has both of them as corners, if that is one with an area, or is itself covered by one.
void Shells::cover() {
  std::vector<uint64_t> covering;
  const auto add = [&](size_t f) {
    const UVec3& p = positions_[f];
    for (const uint64_t key : {edge_key(p.x, p.y), edge_key(p.y, p.z), edge_key(p.z, p.x),
                               edge_key(p.x, p.x), edge_key(p.y, p.y), edge_key(p.z, p.z)})
      covering.push_back(key);
  };
  const auto segment_of = [&](size_t f) {
    const UVec3& p = positions_[f];
    const auto [least, most] = std::minmax({p.x, p.y, p.z}, [&](uint32_t u, uint32_t v) {
      return precedes(vertices_[u], vertices_[v]);
    });
    return edge_key(least, most);
  };
  for (size_t f = 0; f < kind_.size(); ++f) {
    if (kind_[f] == Kind::kArea) add(f);
  }
  for (bool is_more = true; is_more;) {
    std::sort(covering.begin(), covering.end());
    is_more = false;
    for (size_t f = 0; f < kind_.size(); ++f) {
      if (kind_[f] != Kind::kBare) continue;
      if (!std::binary_search(covering.begin(), covering.end(), segment_of(f))) continue;
      kind_[f] = Kind::kCovered;
      is_more = true;
    }
    for (size_t f = 0; is_more && f < kind_.size(); ++f) {
      if (kind_[f] == Kind::kCovered) add(f);
    }
  }
}

void Shells::mark_two_sided() {
  struct Turned {
    std::array<uint32_t, 3> corners;
    bool is_odd;
    uint32_t face;
  };
  std::vector<Turned> all;
  for (uint32_t f = 0; f < positions_.size(); ++f) {
    const UVec3& p = positions_[f];
    Turned t{{p.x, p.y, p.z}, false, f};
    const auto order = [&](size_t i, size_t j) {
      if (t.corners[i] <= t.corners[j]) return;
      std::swap(t.corners[i], t.corners[j]);
      t.is_odd = !t.is_odd;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    all.push_back(t);
  }
  std::sort(all.begin(), all.end(), [](const Turned& x, const Turned& y) {
    if (x.corners != y.corners) return x.corners < y.corners;
    return x.is_odd != y.is_odd ? y.is_odd : x.face < y.face;
  });
  is_two_sided_.assign(positions_.size(), false);
  for (size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && all[end].corners == all[begin].corners) ++end;
    if (all[begin].is_odd == all[end - 1].is_odd) continue;
    for (size_t i = begin; i < end; ++i) is_two_sided_[all[i].face] = true;
  }
}

std::vector<Shells::EdgeUse> Shells::edge_uses() const {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * positions_.size());
  for (uint32_t f = 0; f < positions_.size(); ++f) {
    const UVec3& p = positions_[f];
    for (int i = 0; i < 3; ++i) {
      const uint32_t u = p[i], v = p[(i + 1) % 3];
      if (u != v) uses.push_back({edge_key(u, v), f, u < v});
    }
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

void Shells::count_edges(const std::vector<EdgeUse>& uses) {
  each_edge(uses, [&](size_t begin, size_t end) {
    const auto count = static_cast<int64_t>(end - begin);
    const auto forward = std::count_if(uses.begin() + static_cast<std::ptrdiff_t>(begin),
                                       uses.begin() + static_cast<std::ptrdiff_t>(end),
                                       [](const EdgeUse& use) { return use.is_forward; });
    if (2 * forward == count) return;
    ++edges_.open;
    if (count > 2) ++edges_.uneven;
    if (count != 2) return;
    ++edges_.conflicts;
    const uint64_t edge = uses[begin].edge;
    if (!edges_.first)
      edges_.first = {{static_cast<uint32_t>(edge >> 32), static_cast<uint32_t>(edge)},
                      {uses[begin].face, uses[begin + 1].face}};
  });
}

std::vector<uint32_t> Shells::in_tree() const {
  std::vector<uint32_t> which;
  for (uint32_t f = 0; f < kind_.size(); ++f) {
    if (kind_[f] != Kind::kCovered) which.push_back(f);
  }
  return which;
}

int Shells::shared_corners(uint32_t f, uint32_t g) const {
  int shared = 0;
  for (int i = 0; i < 3; ++i) {
    const uint32_t p = positions_[f][i];
    const UVec3& q = positions_[g];
    shared += p == q.x || p == q.y || p == q.z ? 1 : 0;
  }
  return shared;
}

// Looks at all pairs of faces with areas whose boxes meet; returns whether some cross. Each pair is
// looked at from its first face. Bare faces are segments without an area, and bound nothing.
// Returns nothing if it was ended.
std::optional<bool> Shells::find_contacts(const GoesOn& goes_on) {
  touches_.assign(faces_.size(), 0);
  std::atomic<bool> do_cross = false;
  const auto first_at = [&](uint32_t f, uint32_t g, int shared) {
    Corners3 t = triangles_[f];
    const UVec3 &p = positions_[f], &q = positions_[g];
    for (int i = 0; shared == 1 && i < 3; ++i) {
      if (p[i] == q.x || p[i] == q.y || p[i] == q.z)
        t = {t[static_cast<size_t>(i)], t[static_cast<size_t>((i + 1) % 3)],
             t[static_cast<size_t>((i + 2) % 3)]};
    }
    return t;
  };
  const auto look = [&](uint32_t f, uint32_t g) {
    const int shared = shared_corners(f, g);
    const Contact contact = contact_of(first_at(f, g, shared), first_at(g, f, shared), shared);
    if (contact == Contact::kTouch) {
      std::atomic_ref<uint8_t>(touches_[f]).store(1, std::memory_order_relaxed);
      std::atomic_ref<uint8_t>(touches_[g]).store(1, std::memory_order_relaxed);
    }
    return contact != Contact::kCross;
  };
  const bool is_whole = each_while(faces_.size(), goes_on, [&](size_t i) {
    const auto f = static_cast<uint32_t>(i);
    if (kind_[f] != Kind::kArea || do_cross) return;
    const TriangleBox mine = box_of(triangles_[f]);
    tree_.walk([&](const TriangleBox& box) { return overlap(box, mine); },
               [&](uint32_t g) {
                 if (g <= f || kind_[g] != Kind::kArea) return true;
                 if (!overlap(box_of(triangles_[g]), mine) || look(f, g)) return true;
                 do_cross = true;
                 return false;
               });
  });
  return is_whole || do_cross ? std::optional<bool>(do_cross) : std::nullopt;
}

// Joins faces at edges that they alone use, if no other face touches them elsewhere: by the first
// face of each patch.
std::vector<uint32_t> Shells::patches(const std::vector<EdgeUse>& uses) const {
  Sets sets(faces_.size());
  each_edge(uses, [&](size_t begin, size_t end) {
    if (end - begin != 2) return;
    const uint32_t f = uses[begin].face, g = uses[begin + 1].face;
    const auto is_clean = [&](uint32_t i) { return kind_[i] == Kind::kArea && touches_[i] == 0; };
    if (is_clean(f) && is_clean(g)) sets.join(f, g);
  });
  std::vector<uint32_t> first(faces_.size());
  for (uint32_t f = 0; f < first.size(); ++f) first[f] = sets.of(f);
  return first;
}

Inside Shells::wind(const std::vector<EdgeUse>& uses, const GoesOn& goes_on) {
  constexpr int kUnknown = INT32_MAX, kTriedFaces = 16;
  const std::vector<uint32_t> first = patches(uses);
  std::vector<uint32_t> members(faces_.size());  // the faces, those of a patch together
  std::iota(members.begin(), members.end(), 0u);
  std::stable_sort(members.begin(), members.end(),
                   [&](uint32_t f, uint32_t g) { return first[f] < first[g]; });
  std::vector<int> front(faces_.size(), kUnknown);
  std::vector<size_t> begins;
  for (size_t i = 0; i < members.size(); ++i) {
    const bool is_first = i == 0 || first[members[i]] != first[members[i - 1]];
    if (is_first && kind_[members[i]] == Kind::kArea) begins.push_back(i);
  }
  const bool is_whole = each_while(begins.size(), goes_on, [&](size_t k) {
    const size_t begin = begins[k];
    for (size_t i = begin; i < std::min(begin + kTriedFaces, members.size()); ++i) {
      if (first[members[i]] != first[members[begin]]) return;
      const std::optional<int> found = front_winding(members[i]);
      if (found) front[begin] = *found;
      if (found) return;
    }
  });
  const auto all_are = [&](int winding) {
    return std::all_of(begins.begin(), begins.end(), [&](size_t i) { return front[i] == winding; });
  };
  if (begins.empty() || !is_whole) return Inside::kUndecided;
  const auto inward =
      std::count_if(begins.begin(), begins.end(), [&](size_t i) { return front[i] < 0; });
  if (inward > 0)
    inside_out_ = static_cast<size_t>(inward) == begins.size() ? InsideOut::kAll : InsideOut::kPart;
  front_ = front[begins[0]];
  if (all_are(0) || all_are(-1)) return Inside::kProven;
  const bool is_known =
      std::none_of(begins.begin(), begins.end(), [&](size_t i) { return front[i] == kUnknown; });
  return is_known ? Inside::kWinding : Inside::kUndecided;
}

// Whether the winding numbers of a closed mesh add up to less than 0 over space: the sum of the
// tetrahedra from one corner to each face. Each determinant is off by less than 8 2^-53 of its
// terms' sizes (sure_orientation), and a sum of n by n 2^-53 of theirs more: n + 16 are taken.
bool Shells::has_negative_volume() const {
  const glm::dvec3 from = triangles_[0][0];
  DeterminantSum volume;
  for (const Corners3& t : triangles_) volume.add({t[0] - from, t[1] - from, t[2] - from});
  return volume.sign(static_cast<double>(triangles_.size()) + 16) < 0;
}

std::optional<int> Shells::front_winding(uint32_t face) const {
  constexpr int kAttempts = 12;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::optional<int> found = winding_beside(face, attempt);
    if (found) return found;
  }
  return {};
}

// Tries a point in front of the face and one behind it. Where the segment between them passes
// through its inside and meets no other face, the first one's number is that of the face's front.
// All that is claimed of the two points is decided exactly.
std::optional<int> Shells::winding_beside(uint32_t face, int attempt) const {
  const Corners3& t = triangles_[face];
  const double v = attempt % 2 == 0 ? 0.3391 : 0.2713, w = attempt % 3 == 0 ? 0.3187 : 0.4129;
  const glm::dvec3 e = t[1] - t[0], f = t[2] - t[0], normal = glm::cross(e, f);
  const glm::dvec3 foot = t[0] + v * e + w * f;
  const double longest = std::max({glm::length(e), glm::length(f), glm::length(t[2] - t[1])});
  const double height = glm::length(normal) / longest * std::ldexp(1.0, -4 - 3 * attempt);
  const glm::dvec3 step = normal * (height / glm::length(normal));
  const glm::dvec3 front = foot + step, behind = foot - step;
  const glm::dvec3 sum = front + behind;
  if (!std::isfinite(sum.x + sum.y + sum.z)) return {};
  if (orientation(t[0], t[1], t[2], front) != 1 || orientation(t[0], t[1], t[2], behind) != -1)
    return {};
  const int turn = orientation(front, behind, t[0], t[1]);
  if (turn == 0 || orientation(front, behind, t[1], t[2]) != turn ||
      orientation(front, behind, t[2], t[0]) != turn)
    return {};
  const TriangleBox around = box_of({front, behind, front});
  const bool is_alone = tree_.walk([&](const TriangleBox& box) { return overlap(box, around); },
                                   [&](uint32_t g) {
                                     return g == face || kind_[g] != Kind::kArea ||
                                            !segment_meets(front, behind, triangles_[g]);
                                   });
  return is_alone ? winding(front) : std::nullopt;
}

// Counts the faces that a ray along the axis leaves to the front, less the faces that it enters:
// the sum of solid angles, which is the same for every direction. No face may be met at an edge.
std::optional<int> Shells::winding_along(int axis, const glm::dvec3& p) const {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  int winding = 0;
  const bool is_counted = tree_.walk(
      [&](const TriangleBox& box) {
        return box.hi[axis] >= p[axis] && box.lo[i] <= p[i] && p[i] <= box.hi[i] &&
               box.lo[j] <= p[j] && p[j] <= box.hi[j];
      },
      [&](uint32_t g) {
        if (kind_[g] != Kind::kArea) return true;
        const Corners3& t = triangles_[g];
        const int x = turn_along(axis, p, t[0], t[1]), y = turn_along(axis, p, t[1], t[2]),
                  z = turn_along(axis, p, t[2], t[0]);
        if (std::min({x, y, z}) < 0 && std::max({x, y, z}) > 0) return true;
        if (x == 0 || y == 0 || z == 0) return false;
        const int side = orientation(t[0], t[1], t[2], p);
        if (side == -x) winding += x;  // the ray meets it: p is on the side that the ray comes from
        return side != 0;
      });
  return is_counted ? std::optional(winding) : std::nullopt;
}

std::optional<int> Shells::winding(const glm::dvec3& p) const {
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<int> found = winding_along(axis, p);
    if (found) return found;
  }
  return {};
}

}  // namespace vkh
