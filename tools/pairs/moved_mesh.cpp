#include <algorithm>
#include <cmath>

#include "tools/pairs/moved.h"
#include "tools/pairs/ply_stream.h"

namespace vkh::pairs {
namespace {

// SplitMix64 (Steele, Lea, Flood 2014).
uint64_t next(uint64_t& state) {
  uint64_t z = state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// x + y if that is exact: Knuth's two-sum leaves nothing.
bool add_exactly(double& x, double y) {
  const double sum = x + y, part = sum - x;
  const double rest = (x - (sum - part)) + (y - part);
  x = sum;
  return rest == 0 && std::isfinite(sum);
}

}  // namespace

Move draw_move(uint64_t number, double size) {
  uint64_t state = number;
  Move move;
  for (int i = 2; i > 0; --i)
    std::swap(move.axes[static_cast<size_t>(i)],
              move.axes[next(state) % (static_cast<uint64_t>(i) + 1)]);
  for (double& sign : move.signs) sign = (next(state) & 1) != 0 ? -1 : 1;
  move.exponent = static_cast<int>(next(state) % 41) - 20;
  const bool shifts = next(state) % 4 == 0;
  for (int i = 0; shifts && i < 3; ++i)
    move.shift[i] = std::ldexp(size, move.exponent) * (static_cast<double>(next(state) % 17) - 8);
  return move;
}

bool move_exactly(Mesh& mesh, const Move& move) {
  for (glm::dvec3& v : mesh.vertices) {
    const glm::dvec3 from = v;
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<size_t>(i);
      const double place = move.signs[axis] * from[move.axes[axis]];
      v[i] = std::ldexp(place, move.exponent);
      if (std::ldexp(v[i], -move.exponent) != place || !add_exactly(v[i], move.shift[i]))
        return false;
    }
  }
  return true;
}

bool is_float(const Mesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](const glm::dvec3& v) { return glm::dvec3(glm::vec3(v)) == v; });
}

void write_ply(const Mesh& mesh, const std::string& path) {
  PlyStream ply(path, {.vertex_count = mesh.vertices.size(),
                       .face_count = mesh.faces.size(),
                       .is_double = !is_float(mesh)});
  for (const glm::dvec3& v : mesh.vertices) ply.add_vertex(v);
  for (const glm::uvec3& f : mesh.faces) ply.add_face(f.x, f.y, f.z);
  ply.finish();
}

}  // namespace vkh::pairs
