#include <vkhausdorff/certificate.h>
#include <vkhausdorff/mesh_io.h>
#include <vkhausdorff/solver.h>

#include <cstdio>
#include <fstream>

int main(int argc, char** argv) {  // prove A B CERTIFICATE.vhc
  if (argc < 4) return 2;
  const vkh::Mesh a = vkh::read_mesh(argv[1]), b = vkh::read_mesh(argv[2]);
  vkh::Device device;
  vkh::Solver solver(device);
  vkh::SolveOptions options;
  options.tolerance = 1e-6;
  const vkh::Report r = solver.distance(a, b, options);
  const vkh::Proof proof = vkh::prove(solver, {a, b, r, options, {}});  // in a run of its own
  std::ofstream(argv[3], std::ios::binary)
      << vkh::certificate_of({a, {}}, {b, {}}, {r, proof}, {});  // hashes of corners, of no file
  std::printf("%.17g <= h(A, B) <= %.17g\n", r.lower, proof.upper);  // at least r.upper
}
