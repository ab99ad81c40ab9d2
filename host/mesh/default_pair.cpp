#include "host/mesh/default_pair.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>

#include "host/mesh/round_to_float.h"

namespace vkh {
namespace {

using glm::dvec2;
using glm::dvec3;

/// The vertex indices around a closed curve, counter-clockwise seen from +z; not repeated at the
/// end.
using Loop = std::vector<uint32_t>;

constexpr double kPi = 3.14159265358979323846;

// Returns (cos, sin) of a share of a full turn. At the axes one of them is 0 exactly, for any libm.
dvec2 direction(double turn) {
  const double quarter = std::floor(4 * turn + 0.5);
  const double x = (turn - quarter / 4) * 2 * kPi;  // at most pi/4
  const double c = std::cos(x), s = std::sin(x);
  switch (static_cast<int>(quarter) & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

double cross(const dvec2& v, const dvec2& w) { return v.x * w.y - v.y * w.x; }

struct Circle {
  dvec2 centre{0};
  double radius = 0;
  uint32_t count = 0;  ///< the number of vertices
};

struct Teeth {
  double root = 0, crest = 0;  ///< radii
  uint32_t count = 0;
  uint32_t columns = 0;  ///< vertices a tooth: half of them, less the flanks, on the crest
};

struct Thread {
  double crest = 0;  ///< the crest's radius; the root's is that of the ring it starts from
  double pitch = 0;
  uint32_t turns = 0;
};

/// Vertices around a full turn, and steps of a quarter turn.
struct Fineness {
  uint32_t columns = 0;  ///< of the shoulder; a multiple of 6
  uint32_t hole_columns = 0;
  uint32_t thread_columns = 0;
  uint32_t fillet_steps = 0;
};

/// Joins loops by bands of triangles. A part is a chain of loops around its cross-section,
/// counter-clockwise in (radius, z), so that every band faces outward.
class PartBuilder {
 public:
  Loop circle(const Circle& c, double z);
  Loop ring(double radius, double z, uint32_t count);
  Loop toothed(const Teeth& teeth, double z);
  Loop keyed(double radius, double z);
  void band(const Loop& from, const Loop& to, const dvec2& centre = dvec2(0));
  void chain(const std::vector<Loop>& loops, const dvec2& centre = dvec2(0));
  Loop fillet(const Loop& foot, const dvec2& centre, double radius, uint32_t steps);
  Loop thread(const Loop& bottom, const Thread& thread);
  void plate(const Loop& inner, const Loop& outer, const std::vector<Loop>& holes, bool faces_up);
  Mesh finish(std::string name) &&;

 private:
  uint32_t add(const dvec2& p, double z);
  void face(uint32_t a, uint32_t b, uint32_t c) { faces_.emplace_back(a, b, c); }
  void fan(const Loop& polygon) {
    for (size_t i = 2; i < polygon.size(); ++i) face(polygon[0], polygon[i - 1], polygon[i]);
  }
  dvec2 plan(uint32_t v) const { return {vertices_[v].x, vertices_[v].y}; }

  std::vector<dvec3> vertices_;
  std::vector<glm::uvec3> faces_;
};

// Rounds to float32 as an STL file would: this drops the last bit of a cosine, which differs
// between machines, for all but one coordinate in 10^8.
uint32_t PartBuilder::add(const dvec2& p, double z) {
  vertices_.push_back(round_to_float({p.x, p.y, z}));
  return static_cast<uint32_t>(vertices_.size() - 1);
}

Loop PartBuilder::circle(const Circle& c, double z) {
  Loop loop;
  for (uint32_t i = 0; i < c.count; ++i) {
    loop.push_back(add(c.centre + c.radius * direction(1.0 * i / c.count), z));
  }
  return loop;
}

Loop PartBuilder::ring(double radius, double z, uint32_t count) {
  return circle({.radius = radius, .count = count}, z);
}

Loop PartBuilder::toothed(const Teeth& teeth, double z) {
  const uint32_t count = teeth.count * teeth.columns;
  Loop loop;
  for (uint32_t i = 0; i < count; ++i) {
    const bool on_crest = 2 * (i % teeth.columns) >= teeth.columns;
    loop.push_back(add((on_crest ? teeth.crest : teeth.root) * direction(1.0 * i / count), z));
  }
  return loop;
}

// A bore of 240 columns with a keyway towards +x, its floor flat.
Loop PartBuilder::keyed(double radius, double z) {
  constexpr double kFloor = 14.5, kHalfWidth = 2.2;
  constexpr int kColumns = 240, kHalfColumns = 6;
  Loop loop;
  for (int i = 0; i < kColumns; ++i) {
    const int column = i <= kColumns / 2 ? i : i - kColumns;  // signed, 0 in the keyway's middle
    const bool in_key = std::abs(column) <= kHalfColumns;
    loop.push_back(in_key ? add({kFloor, kHalfWidth * column / kHalfColumns}, z)
                          : add(radius * direction(1.0 * i / kColumns), z));
  }
  return loop;
}

// Traverses both loops at once by the angle about `centre`, from which both are seen without
// overlap. Loops of different counts give the fans and needles that are typical of CAD
// tessellations.
void PartBuilder::band(const Loop& from, const Loop& to, const dvec2& centre) {
  // Equal angles go to `from` first; far above float32 rounding, far below one column.
  constexpr double kSameAngle = 1e-3;
  size_t start = 0;
  double best = -1;
  const dvec2 first = plan(from[0]) - centre;
  for (size_t j = 0; j < to.size(); ++j) {
    const dvec2 d = plan(to[j]) - centre;
    const double cosine = glm::dot(first, d) / std::sqrt(glm::dot(d, d) * glm::dot(first, first));
    if (cosine > best) best = cosine, start = j;
  }
  size_t i = 0, j = 0;
  while (i < from.size() || j < to.size()) {
    const uint32_t v = from[i % from.size()], v_next = from[(i + 1) % from.size()];
    const uint32_t w = to[(start + j) % to.size()], w_next = to[(start + j + 1) % to.size()];
    const double turn = cross(plan(v_next) - centre, plan(w_next) - centre);
    if (j == to.size() || (i < from.size() && turn > -kSameAngle)) {
      face(v, v_next, w);
      ++i;
    } else {
      face(v, w_next, w);
      ++j;
    }
  }
}

void PartBuilder::chain(const std::vector<Loop>& loops, const dvec2& centre) {
  for (size_t i = 0; i + 1 < loops.size(); ++i) band(loops[i], loops[i + 1], centre);
}

// A quarter of a hollow torus from an upward to an outward face; `centre` is in (radius, z).
Loop PartBuilder::fillet(const Loop& foot, const dvec2& centre, double radius, uint32_t steps) {
  std::vector<Loop> rings{foot};
  for (uint32_t step = 1; step <= steps; ++step) {
    const dvec2 d = direction(0.25 * step / steps);
    const dvec2 at = centre - radius * dvec2(d.y, d.x);
    rings.push_back(ring(at.x, at.y, static_cast<uint32_t>(foot.size())));
  }
  chain(rings);
  return rings.back();
}

// One trapezoidal ridge around a cylinder, as four helical strands with blunt ends. Strand 0 starts
// at the bottom ring's first vertex, is its own neighbour one turn up, and ends at the top ring's.
Loop PartBuilder::thread(const Loop& bottom, const Thread& thread) {
  const auto count = static_cast<uint32_t>(bottom.size());
  const double z = vertices_[bottom[0]].z;
  const double root = std::sqrt(glm::dot(plan(bottom[0]), plan(bottom[0])));
  Loop top = ring(root, z + thread.pitch * (thread.turns + 1), count);
  const uint32_t end = thread.turns * count;

  std::array<std::vector<uint32_t>, 4> strands;
  for (uint32_t s = 0; s < 4; ++s) {
    const uint32_t last = s == 0 ? end + count : end;
    const double radius = s == 0 || s == 3 ? root : thread.crest;
    for (uint32_t t = 0; t <= last; ++t) {
      const bool on_ring = s == 0 && (t == 0 || t == last);
      const double height = z + thread.pitch * (1.0 * t / count + s / 4.0);
      strands[s].push_back(on_ring ? (t == 0 ? bottom : top)[0]
                                   : add(radius * direction(1.0 * t / count), height));
    }
  }
  const auto quad = [&](uint32_t a, uint32_t a_next, uint32_t b, uint32_t b_next) {
    if (a != b) face(a, a_next, b);
    if (a_next != b_next) face(a_next, b_next, b);
  };
  const auto& [a, b, c, d] = strands;
  for (uint32_t t = 0; t + 1 < count; ++t) {
    quad(bottom[t], bottom[t + 1], a[t], a[t + 1]);
    quad(a[end + t + 1], a[end + t + 2], top[t + 1], top[(t + 2) % count]);
  }
  for (uint32_t t = 0; t < end; ++t) {
    quad(a[t], a[t + 1], b[t], b[t + 1]);
    quad(b[t], b[t + 1], c[t], c[t + 1]);
    quad(c[t], c[t + 1], d[t], d[t + 1]);
    quad(d[t], d[t + 1], a[t + count], a[t + count + 1]);
  }
  // Strand 3 begins and ends on the step that strand 0 leaves between itself and the ring.
  fan({bottom[count - 1], bottom[0], d[0], a[count], a[count - 1]});
  fan({a[end + 1], top[1], top[0], d[end], a[end]});
  fan({a[0], b[0], c[0], d[0]});
  fan({a[end], d[end], c[end], b[end]});
  return top;
}

// A flat ring between two loops, cut into one sector per hole; both counts are multiples of the
// holes'.
void PartBuilder::plate(const Loop& inner, const Loop& outer, const std::vector<Loop>& holes,
                        bool faces_up) {
  const size_t sectors = holes.size();
  for (size_t k = 0; k < sectors; ++k) {
    Loop border;
    for (size_t i = k * outer.size() / sectors; i <= (k + 1) * outer.size() / sectors; ++i) {
      border.push_back(outer[i % outer.size()]);
    }
    for (size_t i = (k + 1) * inner.size() / sectors + 1; i-- > k * inner.size() / sectors;) {
      border.push_back(inner[i % inner.size()]);
    }
    dvec2 centre(0);
    for (uint32_t v : holes[k]) centre += plan(v) / static_cast<double>(holes[k].size());
    if (faces_up) {
      band(border, holes[k], centre);
    } else {
      band(holes[k], border, centre);
    }
  }
}

Mesh PartBuilder::finish(std::string name) && {
  return make_mesh(std::move(name), std::move(vertices_), std::move(faces_));
}

struct BoltHoles {
  std::vector<Loop> bottoms, tops;
};

// Six counterbored through holes, chamfered below, from z = 0 to z = 12.
BoltHoles bolt_holes(PartBuilder& part, uint32_t columns) {
  constexpr uint32_t kHoles = 6;
  constexpr double kPitchRadius = 42;
  constexpr std::array<dvec2, 5> kProfile{dvec2(7.5, 12), {7.5, 8}, {4.5, 8}, {4.5, 0.5}, {5, 0}};
  BoltHoles holes;
  for (uint32_t k = 0; k < kHoles; ++k) {
    const dvec2 centre = kPitchRadius * direction((k + 0.5) / kHoles);
    std::vector<Loop> loops;
    loops.reserve(kProfile.size());
    for (const dvec2& p : kProfile) loops.push_back(part.circle({centre, p.x, columns}, p.y));
    part.chain(loops, centre);
    holes.tops.push_back(loops.front());
    holes.bottoms.push_back(loops.back());
  }
  return holes;
}

Mesh coupling_hub(const Fineness& fine, std::string name) {
  constexpr uint32_t kRimColumns = 240, kSplineColumns = 144;  // bands to teeth are not flat
  const uint32_t columns = fine.columns, thread_columns = fine.thread_columns;
  constexpr Teeth kRim{.root = 54, .crest = 55, .count = 100, .columns = 6};
  constexpr Teeth kSplines{.root = 23.6, .crest = 25.2, .count = 24, .columns = 16};
  PartBuilder part;
  const BoltHoles holes = bolt_holes(part, fine.hole_columns);

  const Loop bore_bottom = part.keyed(13, 0);
  const Loop flange_inner = part.ring(18, 0, columns), flange_outer = part.ring(53, 0, kRimColumns);
  part.band(bore_bottom, flange_inner);
  part.plate(flange_inner, flange_outer, holes.bottoms, false);

  const Loop rim_top = part.ring(53, 12, kRimColumns);
  part.chain({flange_outer, part.toothed(kRim, 1), part.toothed(kRim, 11), rim_top});

  const Loop fillet_foot = part.ring(30, 12, columns);
  part.plate(fillet_foot, rim_top, holes.tops, true);
  const Loop shoulder = part.fillet(fillet_foot, {30, 19}, 7, fine.fillet_steps);

  const Loop thread_foot = part.ring(22, 38, thread_columns);
  part.chain({shoulder, part.toothed(kSplines, 19), part.toothed(kSplines, 36),
              part.ring(22, 36.5, kSplineColumns), thread_foot});
  const Loop thread_top = part.thread(thread_foot, {.crest = 23.2, .pitch = 2, .turns = 8});

  part.chain({thread_top, part.ring(22, 58, thread_columns), part.ring(20.5, 59.5, thread_columns),
              part.keyed(13, 59.5), part.keyed(12, 58.5), part.keyed(12, 1), bore_bottom});
  return std::move(part).finish(std::move(name));
}

}  // namespace

MeshPair default_pair() {
  MeshPair pair;
  pair.a =
      coupling_hub({.columns = 240, .hole_columns = 64, .thread_columns = 144, .fillet_steps = 16},
                   "coupling hub");
  pair.b =
      coupling_hub({.columns = 120, .hole_columns = 32, .thread_columns = 72, .fillet_steps = 8},
                   "coupling hub, coarser");
  pair.a.unit = pair.b.unit = "mm";
  return pair;
}

}  // namespace vkh
