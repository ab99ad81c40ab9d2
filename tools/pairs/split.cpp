// Splits every face of both meshes of a pair at its edges' midpoints, k times: 4^k times the faces,
// and the same surfaces, so that h is the small pair's exactly. Each midpoint is checked to be
// exact in double before anything is written; the first that is not is named.
//
//   vkh_split A B --levels K --out-a A.ply --out-b B.ply [--grid J --small-a S.ply --small-b T.ply]
//
// --grid J first rounds both meshes to a common grid, and the rounded pair is then the small pair:
// --small-a and --small-b keep it. With 2^E the least power of two that no coordinate of either
// mesh exceeds in size, the grid's step is 2^(E-J). So a coordinate takes J bits at most, and one
// that is split K times J + K: any J up to 53 - K is exact in double, any up to 24 - K in float.
//
// Exit code 2 for a wrong command, 4 for a file that cannot be read or split.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "host/base/system.h"
#include "tools/pairs/subdivision.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace {

using namespace vkh;
using vkh::pairs::Subdivision;

struct Arguments {
  std::string a, b, out_a, out_b, small_a, small_b;
  uint32_t levels = 0;
  std::optional<int> grid;
};

/// The least E such that no coordinate exceeds 2^E in size.
int exponent_above(const Mesh& mesh) {
  double greatest = 0;
  for (const glm::dvec3& v : mesh.vertices)
    greatest = std::max({greatest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  int exponent = 0;
  const double fraction = std::frexp(greatest, &exponent);
  return fraction == 0.5 ? exponent - 1 : exponent;
}

/// Rounds to the nearest multiple of 2^step, ties to even. A multiple has 53 bits at most, like the
/// argument.
void round_to_grid(Mesh& mesh, int step) {
  for (glm::dvec3& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis)
      v[axis] = std::ldexp(std::nearbyint(std::ldexp(v[axis], -step)), step);
  }
}

void round_both(Mesh& a, Mesh& b, int grid) {
  const int step = std::max(exponent_above(a), exponent_above(b)) - grid;
  round_to_grid(a, step);
  round_to_grid(b, step);
  std::printf("grid: both rounded to multiples of 2^%d\n", step);
}

void write(const Mesh& mesh, uint32_t levels, const std::string& path) {
  if (path.empty()) return;
  const Subdivision split(mesh, levels);
  split.write(path);
  std::printf("%s\n", pairs::summary(path, split.shape()).c_str());
}

void run(const Arguments& args) {
  Mesh a = read_mesh(path_of(args.a)), b = read_mesh(path_of(args.b));
  if (args.grid) round_both(a, b, *args.grid);
  const Subdivision split_a(a, args.levels), split_b(b, args.levels);  // before anything is written
  write(a, 0, args.small_a);
  write(b, 0, args.small_b);
  split_a.write(args.out_a);
  std::printf("%s\n", pairs::summary(args.out_a, split_a.shape()).c_str());
  split_b.write(args.out_b);
  std::printf("%s\n", pairs::summary(args.out_b, split_b.shape()).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Arguments args;
  CLI::App app("Splits a pair's faces at midpoints: more faces, the same distance.", "vkh_split");
  app.add_option("A", args.a, "Mesh A")->required();
  app.add_option("B", args.b, "Mesh B")->required();
  app.add_option("--levels", args.levels, "Times that each face is split into four")->required();
  app.add_option("--grid", args.grid, "First round both to 2^-GRID of their common size")
      ->check(CLI::Range(1, 53));
  app.add_option("--out-a", args.out_a, "PLY for what A becomes")->required();
  app.add_option("--out-b", args.out_b, "PLY for what B becomes")->required();
  app.add_option("--small-a", args.small_a, "PLY for A before it is split");
  app.add_option("--small-b", args.small_b, "PLY for B before it is split");
  CLI11_PARSE(app, argc, argv);
  try {
    run(args);
    return 0;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "vkh_split: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vkh_split: %s\n", error.what());
    return 4;
  }
}
