#include "host/mesh/mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <functional>
#include <future>
#include <numeric>
#include <system_error>

#include "host/base/float_environment.h"
#include "host/base/hash_index.h"
#include "host/base/text_scanner.h"

namespace vkh {
namespace {

// Sums products of doubles without rounding, whatever their exponents. Every finite double is an
// integer times 2^-1074, so a product is one times 2^-2148, less than 2^2048 in size; the sum of a
// few is held in two's complement with bit 0 worth 2^-2148 and at least 60 bits to spare at the
// top.
class ExactSum {
 public:
  void add_product(double a, double b, bool negative) {
    int exponent_a = 0, exponent_b = 0;
    const auto mantissa_a = mantissa(a, exponent_a);
    const auto mantissa_b = mantissa(b, exponent_b);
    const unsigned __int128 product = static_cast<unsigned __int128>(mantissa_a) * mantissa_b;
    add(product, static_cast<unsigned>(exponent_a + exponent_b + 2148),
        negative != (std::signbit(a) != std::signbit(b)));
  }

  bool is_zero() const {
    return std::all_of(limbs_.begin(), limbs_.end(), [](uint64_t limb) { return limb == 0; });
  }

 private:
  // |x| = result * 2^exponent, exponent in [-1074, 971], result < 2^53.
  static uint64_t mantissa(double x, int& exponent) {
    const auto bits = std::bit_cast<uint64_t>(x);
    const auto field = static_cast<int>(bits >> 52 & 0x7ff);
    const uint64_t fraction = bits & ((uint64_t{1} << 52) - 1);
    exponent = std::max(field, 1) - 1075;
    return field == 0 ? fraction : fraction | uint64_t{1} << 52;
  }

  // A product has at most 106 bits; shifted by up to 63 it covers three limbs.
  void add(unsigned __int128 product, unsigned shift, bool negative) {
    const unsigned bit = shift % 64;
    const std::array<uint64_t, 3> parts = {
        static_cast<uint64_t>(product << bit), static_cast<uint64_t>(product >> (64 - bit)),
        bit == 0 ? 0 : static_cast<uint64_t>(product >> 64 >> (64 - bit))};
    uint64_t carry = negative ? 1 : 0;
    for (size_t i = shift / 64, part = 0; i < limbs_.size(); ++i, ++part) {
      const uint64_t added = part < parts.size() ? parts[part] : 0;
      const unsigned __int128 sum =
          static_cast<unsigned __int128>(limbs_[i]) + (negative ? ~added : added) + carry;
      limbs_[i] = static_cast<uint64_t>(sum);
      carry = static_cast<uint64_t>(sum >> 64);
    }
  }

  std::array<uint64_t, 67> limbs_{};
};

using Point2 = std::array<double, 2>;

// (a-c) x (b-c) == 0, multiplied out so that every term is a product of given coordinates.
bool is_collinear_exactly(const Point2& a, const Point2& b, const Point2& c) {
  ExactSum sum;
  sum.add_product(a[0], b[1], false);
  sum.add_product(a[0], c[1], true);
  sum.add_product(c[0], b[1], true);
  sum.add_product(a[1], b[0], true);
  sum.add_product(a[1], c[0], false);
  sum.add_product(c[1], b[0], false);
  return sum.is_zero();
}

// Without exact arithmetic: false where rounding leaves it open.
bool surely_not_collinear(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double size = std::abs(left) + std::abs(right);
  // Seven roundings of 2^-53 at most lie between left - right and the true value, relative to size;
  // 1e-15 is nine. Above 1e-280 what underflow adds (2^-1074 a product) is far below that.
  // Overflow gives inf or nan and fails the comparison.
  return size > 1e-280 && std::abs(left - right) > 1e-15 * size;
}

// Exact for all finite coordinates: the cross product of two edges is zero if and only if the
// triangle's three projections along the axes are collinear. One that is surely not decides: a face
// in a plane of the axes has two that are, which would cost exact sums.
bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  if (a == b || b == c || c == a) return true;
  const std::array<std::array<Point2, 3>, 3> projections = {
      {{{{a.x, a.y}, {b.x, b.y}, {c.x, c.y}}},
       {{{a.y, a.z}, {b.y, b.z}, {c.y, c.z}}},
       {{{a.z, a.x}, {b.z, b.x}, {c.z, c.x}}}}};
  const auto surely_not = [](const auto& p) { return surely_not_collinear(p[0], p[1], p[2]); };
  const auto exactly = [](const auto& p) { return is_collinear_exactly(p[0], p[1], p[2]); };
  return std::none_of(projections.begin(), projections.end(), surely_not) &&
         std::all_of(projections.begin(), projections.end(), exactly);
}

void check_indices(const Mesh& mesh) {
  const size_t vertex_count = mesh.vertices.size();
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const glm::uvec3 face = mesh.faces[f];
    const uint32_t greatest = std::max({face.x, face.y, face.z});
    if (greatest < vertex_count) continue;
    const std::string count = std::to_string(vertex_count);
    reject(mesh.name, "face " + std::to_string(f),
           "index " + std::to_string(greatest) + " of " + count + " vertices",
           "indices below " + count);
  }
}

void check_finite(const Mesh& mesh, size_t vertex) {
  const glm::dvec3& p = mesh.vertices[vertex];
  if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) return;
  std::array<char, 96> text;
  std::snprintf(text.data(), text.size(), "(%.9g, %.9g, %.9g) is not finite", p.x, p.y, p.z);
  reject(mesh.name, "vertex " + std::to_string(vertex), text.data(), "finite coordinates");
}

// Keeps the order of those that stay. Only they have to be finite: scanners and exporters leave
// nan in vertices that nothing uses.
void drop_unreferenced(Mesh& mesh) {
  constexpr uint32_t kUnused = UINT32_MAX;
  std::vector<uint32_t> renamed(mesh.vertices.size(), kUnused);
  for (const glm::uvec3& face : mesh.faces) renamed[face.x] = renamed[face.y] = renamed[face.z] = 0;
  uint32_t kept = 0;
  for (size_t v = 0; v < renamed.size(); ++v) {
    if (renamed[v] == kUnused) continue;
    check_finite(mesh, v);
    mesh.vertices[kept] = mesh.vertices[v];
    renamed[v] = kept++;
  }
  mesh.counts.unreferenced = renamed.size() - kept;
  if (mesh.counts.unreferenced == 0) return;
  mesh.vertices.resize(kept);
  for (glm::uvec3& face : mesh.faces) {
    face = {renamed[face.x], renamed[face.y], renamed[face.z]};
  }
}

uint64_t count_degenerate(const Mesh& mesh) {
  const FloatEnvironment ours;  // on a thread of its own
  return static_cast<uint64_t>(
      std::count_if(mesh.faces.begin(), mesh.faces.end(), [&](const glm::uvec3& f) {
        return is_degenerate(mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]);
      }));
}

// The first vertex at the same position, for each vertex.
std::vector<uint32_t> first_at_position(const std::vector<glm::dvec3>& vertices) {
  HashIndex index(
      vertices.size(),
      [&, secret = hash_secret()](uint32_t v) { return hash_position(secret, vertices[v]); },
      [&](uint32_t v, uint32_t w) { return same_position(vertices[v], vertices[w]); });
  std::vector<uint32_t> first(vertices.size());
  for (uint32_t v = 0; v < first.size(); ++v) first[v] = index.insert(v);
  return first;
}

// Brought together by their least corner, by counting, and those of a corner sorted by the other
// two: neighbours in memory stay neighbours, which a hash would scatter, and no file can make it
// slow.
uint64_t count_duplicates(const Mesh& mesh) {
  const std::vector<uint32_t> first = first_at_position(mesh.vertices);
  const auto corners_of = [&first](const glm::uvec3& f) {
    std::array<uint32_t, 3> corners = {first[f.x], first[f.y], first[f.z]};
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::vector<uint32_t> end(first.size() +
                            1);  // where a vertex's faces end, and the next one's are
  for (const glm::uvec3& f : mesh.faces) ++end[corners_of(f)[0] + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<uint64_t> others(mesh.faces.size());
  for (const glm::uvec3& f : mesh.faces) {
    const auto [i, j, k] = corners_of(f);
    others[end[i]++] = uint64_t{j} << 32 | k;
  }
  uint64_t duplicates = 0;
  auto begin = others.begin();
  for (size_t v = 0; v < first.size(); ++v) {
    const auto stop = others.begin() + end[v];
    std::sort(begin, stop);
    duplicates += static_cast<uint64_t>(stop - std::unique(begin, stop));
    begin = stop;
  }
  return duplicates;
}

}  // namespace

Mesh make_mesh(std::string name, std::vector<glm::dvec3> vertices, std::vector<glm::uvec3> faces) {
  const FloatEnvironment ours;
  Mesh mesh{.name = std::move(name),
            .vertices = std::move(vertices),
            .faces = std::move(faces),
            .counts = {},
            .notes = {}};
  if (mesh.faces.empty()) reject(mesh.name, "face 0", "there is no face", "at least one triangle");
  if (std::max(mesh.faces.size(), mesh.vertices.size()) >= UINT32_MAX) {
    reject(mesh.name, "element 4294967294", "too many elements", "fewer than 2^32 - 1");
  }
  check_indices(mesh);
  drop_unreferenced(mesh);
  mesh.counts.vertices = mesh.vertices.size();
  mesh.counts.faces = mesh.faces.size();
  constexpr size_t kFacesOfThread = 1 << 14;  // 1 ms
  const auto policy =
      mesh.faces.size() < kFacesOfThread ? std::launch::deferred : std::launch::async;
  std::future<uint64_t> degenerate;
  try {
    degenerate = std::async(policy, count_degenerate, std::cref(mesh));
  } catch (const std::system_error&) {  // no thread to be had
    degenerate = std::async(std::launch::deferred, count_degenerate, std::cref(mesh));
  }
  mesh.counts.duplicate = count_duplicates(mesh);
  mesh.counts.degenerate = degenerate.get();
  return mesh;
}

}  // namespace vkh
