#include "tests/shapes/hard_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace vkh::test {
namespace {

using glm::dvec3;

uint32_t some(Random& random, uint32_t most) { return 1 + random.below(most); }

double log10_uniform(Random& random, double lo, double hi) {
  return std::pow(10.0, random.range(lo, hi));
}

Mesh triangles(const char* name, const std::vector<std::array<dvec3, 3>>& corners) {
  std::vector<dvec3> vertices;
  std::vector<glm::uvec3> faces;
  for (const auto& t : corners) {
    const auto first = static_cast<uint32_t>(vertices.size());
    vertices.insert(vertices.end(), t.begin(), t.end());
    faces.emplace_back(first, first + 1, first + 2);
  }
  return make_mesh(name, std::move(vertices), std::move(faces));
}

template <class Function>
Mesh mapped(const Mesh& mesh, const Function& function) {
  std::vector<dvec3> vertices = mesh.vertices;
  for (dvec3& v : vertices) v = function(v);
  return make_mesh(mesh.name, std::move(vertices), mesh.faces);
}

Mesh any_mesh(Random& random) {
  const uint64_t seed = random.bits();
  switch (random.below(9)) {
    case 0:
      return needles(seed, some(random, 20));
    case 1:
      return slivers(seed, some(random, 20));
    case 2:
      return caps(seed, some(random, 20));
    case 3:
      return degenerate_faces(seed, some(random, 15));
    case 4:
      return single_triangle(random.in_cube(1.0), random.in_cube(1.0), random.in_cube(1.0));
    case 5:
      return height_field(2 + some(random, 6), 1);
    case 6:
      return icosphere(random.range(0.3, 1.0), random.below(2));
    case 7:
      return cube(random.range(0.2, 1.0));
    default:
      return soup(seed, some(random, 30));
  }
}

HardPair of(Mesh a, Mesh b) {
  return {.pair = {std::move(a), std::move(b)}, .exact = {}, .largest_gap_at_zero = {}};
}

HardPair mixed(Random& random) {
  Mesh a = any_mesh(random);
  return of(std::move(a), any_mesh(random));
}

template <Mesh (*kMake)(uint64_t, uint32_t), uint32_t kMost>
HardPair thin(Random& random) {
  Mesh a = kMake(random.bits(), some(random, kMost));
  return of(std::move(a),
            random.below(2) == 0 ? any_mesh(random) : kMake(random.bits(), some(random, kMost)));
}

HardPair duplicates(Random& random) {
  const Mesh a = with_duplicates(any_mesh(random), random.bits());
  const Mesh b = any_mesh(random);
  return of(a, with_duplicates(random.below(2) == 0 ? b : joined(b, a), random.bits()));
}

/// Triangles of a coarse grid in one plane, so that they overlap exactly.
Mesh coplanar_triangles(Random& random, const dvec3& u, const dvec3& v) {
  std::vector<std::array<dvec3, 3>> all(some(random, 12));
  for (auto& t : all) {
    for (dvec3& p : t) {
      const double x = random.below(9), y = random.below(9);
      p = x * u + y * v;
    }
  }
  return triangles("coplanar", all);
}

HardPair coplanar(Random& random) {
  const dvec3 u = glm::floor(random.in_cube(8.0)) / 8.0;
  const dvec3 v = glm::floor(random.in_cube(8.0)) / 8.0;
  Mesh a = coplanar_triangles(random, u, v);
  return of(std::move(a), coplanar_triangles(random, u, v));
}

/// B is symmetric about x = 0, where A has vertices, edges and whole faces.
HardPair bisectors(Random& random) {
  const Mesh half = translated(any_mesh(random), {random.range(0.0, 1.5), 0.0, 0.0});
  const Mesh other = mapped(half, [](const dvec3& p) { return dvec3(-p.x, p.y, p.z); });
  std::vector<std::array<dvec3, 3>> all(some(random, 8));
  for (auto& t : all) {
    for (dvec3& p : t) {
      p = random.in_cube(1.5);
      if (random.below(3) != 0) p.x = 0.0;
    }
  }
  return of(triangles("on bisectors", all), joined(half, other));
}

/// A's farthest point has many closest points: the centre of a cube, an octahedron, a sphere.
HardPair equal_distances(Random& random) {
  const double size = std::ldexp(1.0, static_cast<int>(random.below(5)) - 2);
  const auto near = [&] { return glm::floor(random.in_cube(4.0)) / 4.0; };
  std::vector<std::array<dvec3, 3>> all(some(random, 6));
  for (auto& t : all) {
    const dvec3 p = near();
    t = {p, -p, random.below(2) == 0 ? p : near()};
  }
  const Mesh shells[] = {cube(size), icosphere(size, random.below(3)), icosphere(size, 0),
                         uv_sphere(size, 4, 8), joined(cube(size), cube(2.0 * size))};
  return of(triangles("equal distances", all), shells[random.below(5)]);
}

HardPair scaled_by(Random& random, double factor) {
  const HardPair small = mixed(random);
  const auto grow = [&](const dvec3& p) { return p * factor; };
  return of(mapped(small.pair.a, grow), mapped(small.pair.b, grow));
}
HardPair huge_coordinates(Random& random) { return scaled_by(random, 1e18); }
HardPair tiny_coordinates(Random& random) { return scaled_by(random, 1e-18); }

/// Whole multiples of the smallest double, or of a larger subnormal.
HardPair subnormal(Random& random) {
  const double unit = random.below(2) == 0 ? 5e-324 : 1e-312;
  const double reach = random.below(2) == 0 ? 4.0 : 1000.0;
  const auto collapse = [&](const dvec3& p) { return glm::round(p * reach) * unit; };
  const HardPair normal = mixed(random);
  return of(mapped(normal.pair.a, collapse), mapped(normal.pair.b, collapse));
}

HardPair far_away(Random& random) {
  const dvec3 by = 1e6 * random.direction();
  const bool single = random.below(3) == 0;  // then the size is a few ulp
  const auto move = [&](const dvec3& p) {
    const dvec3 moved = p * 1e-3 + by;
    return single ? dvec3(glm::vec3(moved)) : moved;
  };
  const HardPair near = mixed(random);
  return of(mapped(near.pair.a, move), mapped(near.pair.b, move));
}

HardPair powers_of_two(Random& random) {
  const HardPair pair = mixed(random);
  const auto exponent = [&](int most) {
    return static_cast<int>(random.below(2 * static_cast<uint32_t>(most) + 1)) - most;
  };
  const int both = random.below(2) == 0 ? exponent(900) : exponent(40);
  const int apart = random.below(2) == 0 ? 0 : exponent(30);
  return of(scaled(pair.pair.a, both), scaled(pair.pair.b, both + apart));
}

/// Huge triangles next to tiny ones, in both meshes.
HardPair huge_and_tiny(Random& random) {
  const auto both = [&] {
    const Mesh large = scaled(any_mesh(random), static_cast<int>(random.below(20)));
    const Mesh little = scaled(any_mesh(random), -static_cast<int>(random.below(20)));
    return joined(large, translated(little, random.in_cube(2.0)));
  };
  Mesh a = random.below(2) == 0 ? both() : scaled(any_mesh(random), -10);
  return of(std::move(a), both());
}

HardPair twins(Random& random) {
  const Mesh mesh = any_mesh(random);
  return of(mesh, noisy(mesh, log10_uniform(random, -12.0, -1.0), random.bits()));
}

HardPair single_precision(Random& random) {
  const HardPair pair = mixed(random);
  return of(in_float32(pair.pair.a), in_float32(pair.pair.b));
}

/// h(A, A), or A with its faces shuffled, repeated or joined by others.
HardPair self(Random& random) {
  const Mesh mesh = any_mesh(random);
  HardPair out = of(mesh, mesh);
  const uint32_t change = random.below(4);
  if (change == 1) out.pair.b = permuted(mesh, random.bits());
  if (change == 2) out.pair.b = with_duplicates(mesh, random.bits());
  if (change == 3) out.pair.b = joined(any_mesh(random), mesh);
  out.exact = 0.0;
  out.tolerance = 1e-9;
  // Other faces may be larger than A: 1e-9 refers to the joint box then, which is not tested.
  if (change < 3) out.largest_gap_at_zero = 1e-9;
  return out;
}

/// The patch of paper section 6.1: h(A, A + (0, 0, delta)) = delta.
HardPair patch(Random& random) {
  const double delta = log10_uniform(random, -12.0, 6.0);
  const uint32_t cells = random.below(2) == 0 ? 1 : some(random, 4);
  HardPair out = of(square_patch(cells, 0.0),
                    square_patch(random.below(2) == 0 ? cells : some(random, 4), delta));
  out.exact = delta;
  return out;
}

/// B is A moved along its vertices' normals: about all of A is equally far.
HardPair offset(Random& random) {
  const Mesh shapes[] = {icosphere(1.0, random.below(3)), torus(1.0, 0.3, some(random, 9) + 3, 5),
                         height_field(2 + some(random, 6), 1), cube(1.0)};
  const Mesh& a = shapes[random.below(4)];
  std::vector<dvec3> normals(a.vertices.size(), dvec3(0.0));
  for (const glm::uvec3& f : a.faces) {
    const dvec3 p = a.vertices[f.x];
    const dvec3 normal = glm::cross(a.vertices[f.y] - p, a.vertices[f.z] - p);
    for (int i = 0; i < 3; ++i) normals[f[i]] += normal;
  }
  const double by = log10_uniform(random, -4.0, -0.3);
  std::vector<dvec3> moved = a.vertices;
  for (size_t i = 0; i < moved.size(); ++i) moved[i] += by * glm::normalize(normals[i]);
  return of(a, make_mesh("offset", std::move(moved), a.faces));
}

struct Family {
  const char* name;
  HardPair (*make)(Random&);
};

constexpr Family kFamilies[] = {{"mixed", mixed},
                                {"needles", thin<needles, 30>},
                                {"slivers", thin<slivers, 30>},
                                {"caps", thin<caps, 30>},
                                {"degenerate", thin<degenerate_faces, 20>},
                                {"soup", thin<soup, 40>},
                                {"duplicates", duplicates},
                                {"coplanar", coplanar},
                                {"bisectors", bisectors},
                                {"equal", equal_distances},
                                {"huge", huge_coordinates},
                                {"tiny", tiny_coordinates},
                                {"subnormal", subnormal},
                                {"far", far_away},
                                {"powers", powers_of_two},
                                {"sizes", huge_and_tiny},
                                {"twins", twins},
                                {"float32", single_precision},
                                {"self", self},
                                {"patch", patch},
                                {"offset", offset}};

}  // namespace

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const Family& family : kFamilies) names.emplace_back(family.name);
  return names;
}

HardPair hard_pair(size_t family, uint64_t seed) {
  Random random(seed);
  return kFamilies[family].make(random);
}

}  // namespace vkh::test
