#include <vkhausdorff/mesh_io.h>
#include <vkhausdorff/solver.h>

#include <cstdio>

int main(int argc, char** argv) {  // host B A...
  if (argc < 2) return 2;
  vkh::Device device;  // the best one; or your own, as a vkh::AdoptedDevice
  vkh::Solver solver(device);
  const vkh::PreparedMesh b = solver.prepare(vkh::read_mesh(argv[1]));
  vkh::SolveOptions options;
  options.tolerance = 1e-6;  // of A's diagonal
  options.time_limit_s = 10;
  for (int i = 2; i < argc; ++i) {
    const vkh::Report r = solver.distance(vkh::read_mesh(argv[i]), b, options);
    std::printf("%.17g <= h(%s, B) <= %.17g: %s\n", r.lower, argv[i], r.upper,
                vkh::status_name(r.status));
  }
}
