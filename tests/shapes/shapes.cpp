#include "tests/shapes/shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "host/mesh/round_to_float.h"

namespace vkh::test {
namespace {

/// A mesh under construction. Faces are given as corner indices.
struct Builder {
  std::vector<glm::dvec3> vertices = {};
  std::vector<glm::uvec3> faces = {};

  void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto first = static_cast<uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c});
    faces.emplace_back(first, first + 1, first + 2);
  }
  void quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    faces.emplace_back(a, b, c);
    faces.emplace_back(a, c, d);
  }
  Mesh finish(const char* name) && {
    return make_mesh(name, std::move(vertices), std::move(faces));
  }
};

/// The same faces over other vertices.
template <class Function>
Mesh with_vertices(const Mesh& mesh, Function&& function) {
  std::vector<glm::dvec3> vertices = mesh.vertices;
  for (glm::dvec3& v : vertices) v = function(v);
  return make_mesh(mesh.name, std::move(vertices), mesh.faces);
}

template <class T>
void shuffle(std::vector<T>& items, Random& random) {
  for (size_t i = items.size(); i > 1; --i) {
    std::swap(items[i - 1], items[random.below(static_cast<uint32_t>(i))]);
  }
}

/// (rows + 1) x (columns + 1) vertices from a function of (row, column), two triangles per cell.
template <class Function>
Mesh grid(const char* name, uint32_t rows, uint32_t columns, Function&& vertex) {
  Builder out;
  for (uint32_t i = 0; i <= rows; ++i) {
    for (uint32_t j = 0; j <= columns; ++j) out.vertices.push_back(vertex(i, j));
  }
  const uint32_t pitch = columns + 1;
  for (uint32_t i = 0; i < rows; ++i) {
    for (uint32_t j = 0; j < columns; ++j) {
      const uint32_t v = i * pitch + j;
      out.quad(v, v + 1, v + 1 + pitch, v + pitch);
    }
  }
  return std::move(out).finish(name);
}

/// Triangles over a random base edge; `apex` places the third corner from the edge, a unit vector
/// across it and a height of 1e-2 .. 1e-12 of its length.
template <class Function>
Mesh thin_triangles(const char* name, uint64_t seed, uint32_t count, Function&& apex) {
  Random random(seed);
  Builder out;
  for (uint32_t i = 0; i < count; ++i) {
    const glm::dvec3 a = random.in_cube(1.0);
    const glm::dvec3 b = a + random.range(0.1, 1.0) * random.direction();
    const glm::dvec3 across = glm::normalize(glm::cross(b - a, random.direction()));
    const double height = glm::length(b - a) * std::pow(10.0, random.range(-12.0, -2.0));
    out.triangle(a, b, apex(random, a, b, height * across));
  }
  return std::move(out).finish(name);
}

double turns(uint32_t part, uint32_t whole) {
  return 2.0 * std::numbers::pi * static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

uint64_t Random::bits() {
  uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Random::unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
double Random::range(double lo, double hi) { return lo + (hi - lo) * unit(); }

uint32_t Random::below(uint32_t count) {
  return static_cast<uint32_t>(((bits() >> 32) * static_cast<uint64_t>(count)) >> 32);
}

glm::dvec3 Random::in_cube(double half_extent) {
  const double x = range(-half_extent, half_extent);
  const double y = range(-half_extent, half_extent);
  return {x, y, range(-half_extent, half_extent)};
}

glm::dvec3 Random::direction() {
  const double z = range(-1.0, 1.0);
  const double angle = range(0.0, 2.0 * std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Mesh square_patch(uint32_t cells, double z, double size) {
  return grid("square_patch", cells, cells, [&](uint32_t i, uint32_t j) {
    return glm::dvec3(size * j / cells, size * i / cells, z);
  });
}

Mesh big_plane(double half_extent, double z) {
  return grid("big_plane", 1, 1, [&](uint32_t i, uint32_t j) {
    return glm::dvec3(half_extent * (2.0 * j - 1.0), half_extent * (2.0 * i - 1.0), z);
  });
}

Mesh single_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  Builder out;
  out.triangle(a, b, c);
  return std::move(out).finish("single_triangle");
}

Mesh cube(double half_extent) {
  Builder out;
  for (uint32_t i = 0; i < 8; ++i) {
    const glm::dvec3 sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    out.vertices.push_back(half_extent * sign);
  }
  out.quad(0, 2, 3, 1);
  out.quad(4, 5, 7, 6);
  out.quad(0, 1, 5, 4);
  out.quad(2, 6, 7, 3);
  out.quad(0, 4, 6, 2);
  out.quad(1, 3, 7, 5);
  return std::move(out).finish("cube");
}

Mesh icosphere(double radius, uint32_t subdivisions) {
  Builder out;
  const double golden = std::numbers::phi;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 4; ++i) {
      glm::dvec3 v(0.0);
      v[(axis + 1) % 3] = i & 1 ? 1.0 : -1.0;
      v[(axis + 2) % 3] = i & 2 ? golden : -golden;
      out.vertices.push_back(glm::normalize(v) * radius);
    }
  }
  // The faces are the triples of vertices at mutual distance one edge, turned outward.
  const double edge = 1.1 * 2.0 * radius / std::sqrt(1.0 + golden * golden);
  const auto& v = out.vertices;
  const auto near = [&](uint32_t i, uint32_t j) { return glm::distance(v[i], v[j]) < edge; };
  for (uint32_t i = 0; i < 12; ++i) {
    for (uint32_t j = i + 1; j < 12; ++j) {
      for (uint32_t k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
        const bool outward = glm::dot(glm::cross(v[j] - v[i], v[k] - v[i]), v[i]) > 0;
        out.faces.emplace_back(i, outward ? j : k, outward ? k : j);
      }
    }
  }
  for (uint32_t step = 0; step < subdivisions; ++step) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto next = static_cast<uint32_t>(out.vertices.size());
      const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), next);
      if (fresh) {
        const glm::dvec3 sum = out.vertices[a] + out.vertices[b];
        out.vertices.push_back(glm::normalize(sum) * radius);
      }
      return at->second;
    };
    for (const glm::uvec3 f : std::exchange(out.faces, {})) {
      const glm::uvec3 m(middle(f.x, f.y), middle(f.y, f.z), middle(f.z, f.x));
      out.faces.insert(out.faces.end(), {{f.x, m.x, m.z}, {m.x, f.y, m.y}, {m.z, m.y, f.z}, m});
    }
  }
  return std::move(out).finish("icosphere");
}

Mesh uv_sphere(double radius, uint32_t stacks, uint32_t slices) {
  Builder out;
  out.vertices.emplace_back(0.0, 0.0, radius);
  for (uint32_t i = 1; i < stacks; ++i) {
    const double polar = 0.5 * turns(i, stacks);
    for (uint32_t j = 0; j < slices; ++j) {
      const double r = radius * std::sin(polar);
      out.vertices.emplace_back(r * std::cos(turns(j, slices)), r * std::sin(turns(j, slices)),
                                radius * std::cos(polar));
    }
  }
  const auto south = static_cast<uint32_t>(out.vertices.size());
  out.vertices.emplace_back(0.0, 0.0, -radius);
  const uint32_t last = south - slices;
  for (uint32_t j = 0; j < slices; ++j) {
    const uint32_t k = (j + 1) % slices;
    out.faces.emplace_back(0, 1 + j, 1 + k);
    for (uint32_t row = 1; row < last; row += slices) {
      out.quad(row + j, row + slices + j, row + slices + k, row + k);
    }
    out.faces.emplace_back(last + j, south, last + k);
  }
  return std::move(out).finish("uv_sphere");
}

Mesh torus(double major_radius, double minor_radius, uint32_t major_cells, uint32_t minor_cells) {
  Builder out;
  for (uint32_t i = 0; i < major_cells; ++i) {
    for (uint32_t j = 0; j < minor_cells; ++j) {
      const double r = major_radius + minor_radius * std::cos(turns(j, minor_cells));
      out.vertices.emplace_back(r * std::cos(turns(i, major_cells)),
                                r * std::sin(turns(i, major_cells)),
                                minor_radius * std::sin(turns(j, minor_cells)));
    }
  }
  for (uint32_t i = 0; i < major_cells; ++i) {
    const uint32_t row = i * minor_cells;
    const uint32_t next = (i + 1) % major_cells * minor_cells;
    for (uint32_t j = 0; j < minor_cells; ++j) {
      const uint32_t k = (j + 1) % minor_cells;
      out.quad(row + j, next + j, next + k, row + k);
    }
  }
  return std::move(out).finish("torus");
}

Mesh v_lid() { return big_plane(1.0); }

Mesh v_sheet(double depth, double valley_x) {
  return grid("v_sheet", 1, 2, [&](uint32_t i, uint32_t j) {
    const double x = j == 0 ? -1.0 : j == 1 ? valley_x : 1.0;
    return glm::dvec3(x, 2.0 * i - 1.0, j == 1 ? -depth : 0.0);
  });
}

double v_lid_distance(double depth, double valley_x) {
  // At (x, y, 0) the left side is (x + 1) * sin(left) away and the right one (1 - x) * sin(right),
  // sines of the angles at the rim; the lid's farthest line is where the two are equal.
  const double left = depth / std::hypot(depth, 1.0 + valley_x);
  const double right = depth / std::hypot(depth, 1.0 - valley_x);
  return 2.0 * left * right / (left + right);
}

Mesh height_field(uint32_t cells, uint32_t stride, double amplitude) {
  const uint32_t count = cells / stride;
  return grid("height_field", count, count, [&](uint32_t i, uint32_t j) {
    const double x = static_cast<double>(j * stride) / cells;
    const double y = static_cast<double>(i * stride) / cells;
    return glm::dvec3(x, y, amplitude * std::sin(7.0 * x + 1.0) * std::cos(5.0 * y * (1.0 + x)));
  });
}

Mesh soup(uint64_t seed, uint32_t count) {
  Random random(seed);
  Builder out;
  for (uint32_t i = 0; i < count; ++i) {
    const glm::dvec3 at = random.in_cube(0.5);
    const double size = 0.5 * std::pow(2.0, random.range(-8.0, 0.0));
    const glm::dvec3 a = at + random.in_cube(size);
    const glm::dvec3 b = at + random.in_cube(size);
    out.triangle(a, b, at + random.in_cube(size));
  }
  return std::move(out).finish("soup");
}

Mesh needles(uint64_t seed, uint32_t count) {
  return thin_triangles("needles", seed, count,
                        [](Random&, const glm::dvec3&, const glm::dvec3& b,
                           const glm::dvec3& offset) { return b + offset; });
}

Mesh slivers(uint64_t seed, uint32_t count) {
  return thin_triangles(
      "slivers", seed, count,
      [](Random& random, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& offset) {
        const double at = random.unit();
        return a + (at * at * at) * (b - a) + offset;
      });
}

Mesh caps(uint64_t seed, uint32_t count) {
  return thin_triangles("caps", seed, count,
                        [](Random&, const glm::dvec3& a, const glm::dvec3& b,
                           const glm::dvec3& offset) { return 0.5 * (a + b) + offset; });
}

Mesh degenerate_faces(uint64_t seed, uint32_t count) {
  Random random(seed);
  Builder out;
  for (uint32_t i = 0; i < count; ++i) {
    // Multiples of 1/64: the middle of two of them is exact, so the three are exactly collinear.
    const auto point = [&] { return glm::floor(random.in_cube(1.0) * 64.0) / 64.0; };
    const glm::dvec3 a = point();
    const glm::dvec3 b = point();
    if (i % 3 == 0) out.triangle(a, a, a);
    if (i % 3 == 1) out.triangle(a, b, b);
    if (i % 3 == 2) out.triangle(a, 0.5 * (a + b), b);
  }
  return std::move(out).finish("degenerate_faces");
}

Mesh with_duplicates(const Mesh& mesh, uint64_t seed) {
  Random random(seed);
  std::vector<glm::uvec3> faces = mesh.faces;
  for (size_t i = 0; i <= mesh.faces.size() / 10; ++i) {
    const glm::uvec3 f = mesh.faces[random.below(static_cast<uint32_t>(mesh.faces.size()))];
    faces.push_back(random.below(2) == 0 ? glm::uvec3(f.y, f.z, f.x) : glm::uvec3(f.z, f.y, f.x));
  }
  return make_mesh(mesh.name, mesh.vertices, std::move(faces));
}

Mesh joined(const Mesh& a, const Mesh& b) {
  std::vector<glm::dvec3> vertices = a.vertices;
  std::vector<glm::uvec3> faces = a.faces;
  const auto offset = static_cast<uint32_t>(a.vertices.size());
  vertices.insert(vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const glm::uvec3& f : b.faces) faces.push_back(f + glm::uvec3(offset));
  return make_mesh(a.name + "+" + b.name, std::move(vertices), std::move(faces));
}

Mesh translated(const Mesh& mesh, const glm::dvec3& by) {
  return with_vertices(mesh, [&](const glm::dvec3& v) { return v + by; });
}

Mesh rotated(const Mesh& mesh, const glm::dvec3& axis, double angle) {
  const glm::dvec3 n = glm::normalize(axis);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return with_vertices(mesh, [&](const glm::dvec3& v) {
    return c * v + s * glm::cross(n, v) + (1.0 - c) * glm::dot(n, v) * n;
  });
}

Mesh scaled(const Mesh& mesh, int exponent) {
  const double factor = std::ldexp(1.0, exponent);
  return with_vertices(mesh, [&](const glm::dvec3& v) { return v * factor; });
}

Mesh permuted(const Mesh& mesh, uint64_t seed) {
  Random random(seed);
  std::vector<uint32_t> order(mesh.vertices.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  shuffle(order, random);
  std::vector<glm::dvec3> vertices(order.size());
  for (size_t i = 0; i < order.size(); ++i) vertices[order[i]] = mesh.vertices[i];
  std::vector<glm::uvec3> faces;
  for (const glm::uvec3& f : mesh.faces) {
    const glm::uvec3 g(order[f.x], order[f.y], order[f.z]);
    const uint32_t turn = random.below(3);
    faces.push_back(turn == 0   ? g
                    : turn == 1 ? glm::uvec3(g.y, g.z, g.x)
                                : glm::uvec3(g.z, g.x, g.y));
  }
  shuffle(faces, random);
  return make_mesh(mesh.name, std::move(vertices), std::move(faces));
}

Mesh noisy(const Mesh& mesh, double amplitude, uint64_t seed) {
  Random random(seed);
  return with_vertices(mesh, [&](const glm::dvec3& v) {
    return v + amplitude * random.unit() * random.direction();
  });
}

Mesh in_float32(const Mesh& mesh) {
  return with_vertices(mesh, [](const glm::dvec3& v) { return round_to_float(v); });
}

std::pair<glm::dvec3, glm::dvec3> bounding_box(const Mesh& mesh) {
  std::pair<glm::dvec3, glm::dvec3> box(mesh.vertices.at(0), mesh.vertices.at(0));
  for (const glm::dvec3& v : mesh.vertices) {
    box.first = glm::min(box.first, v);
    box.second = glm::max(box.second, v);
  }
  return box;
}

double diagonal(const Mesh& mesh) {
  const auto [lo, hi] = bounding_box(mesh);
  return glm::distance(lo, hi);
}

std::array<glm::dvec3, 3> corners(const Mesh& mesh, uint32_t face) {
  const glm::uvec3 f = mesh.faces.at(face);
  return {mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]};
}

}  // namespace vkh::test
