#include <atomic>
#include <cstdio>
#include <vkhausdorff/vkhausdorff.hpp>

int main(int argc, char** argv) {  // many B A...
  if (argc < 3) return 2;
  const auto b = std::make_shared<const vkh::Mesh>(vkh::read_mesh(argv[1]));
  vkh::StreamOptions options;  // options.devices = {"0", "1"} takes two
  std::atomic<int> failed = 0;
  const auto deliver = [&](vkh::StreamResult&& r) {  // one at a time, as pairs end
    if (r.error) {
      ++failed;
    } else {
      std::printf("%zu: %.17g <= h <= %.17g\n", r.number, r.a_to_b.lower, r.a_to_b.upper);
    }
  };
  vkh::PairStream stream(options, deliver);
  for (int i = 2; i < argc; ++i) {
    vkh::StreamPair pair;
    pair.number = static_cast<size_t>(i - 2);
    pair.a = std::make_shared<const vkh::Mesh>(vkh::read_mesh(argv[i]));
    pair.b = b;
    pair.shares_b = true;  // B is prepared once on each device
    stream.push(std::move(pair));
  }
  stream.finish();

  vkh::Device device;  // and one mesh against limits of its faces, and points against a mesh
  vkh::Solver solver(device);
  const vkh::Mesh a = vkh::read_mesh(argv[2]);
  const std::vector<vkh::Limit> limits(a.faces.size(), vkh::Limit{0.5, 0.5});
  const vkh::FaceGate gate = vkh::gate_faces(solver, a, *b, limits, {});
  const vkh::ClosestPoints closest = solver.closest(*b, a.vertices);
  std::printf("%s; the first corner of A is %.17g from B\n", vkh::verdict_name(gate.verdict),
              closest.upper[0]);
  return failed;
}
