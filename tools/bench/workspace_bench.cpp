// The time of a run in workspaces of each named size, and of any number of candidates, against that
// in the recommended one: four families of pairs, whose A has 1 to 100,000 faces. Runs alternate
// between the sizes; the least of their times on the device counts, the BVH apart.
//
//   vkh_bench workspace [--device D] [--faces N] [--runs 5] [--tol 1e-6] [--candidates 256,1024]
//                       [--gpu-profile]
//
// With --gpu-profile a CPU device runs the waves that a GPU runs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/vkhausdorff.h"
#include "tests/shapes/shapes.h"
#include "tools/bench/bench.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/solver.h"

namespace vkh::bench {
namespace {

using Context = std::unique_ptr<VkhContext_T, void (*)(VkhContext)>;

struct Arguments {
  std::string device;
  uint32_t faces = 100'000;
  int runs = 5;
  double tolerance = 1e-6;
  std::vector<uint32_t> candidates;
  bool gpu_profile = false;
};

struct Pair {
  std::string family;
  Mesh a, b;
};

// A workspace, and the least time of a run in it.
struct Size {
  std::string name;
  VkDeviceSize bytes;
  double ms = std::numeric_limits<double>::infinity();
  Report report = {};
};

// A context of the device's defaults, or of a GPU's, which knows what workspaces it needs.
Context context_on(const Device& device, const Arguments& arguments) {
  VkhContextCreateInfo info{};
  info.size = sizeof(info);
  info.device = device.engine_info();
  if (arguments.gpu_profile) info.deviceKind = VKH_DEVICE_KIND_WIDE;
  VkhContext context = nullptr;
  const VkhResult result = vkhCreateContext(&info, &context);
  if (result != VKH_SUCCESS) throw DeviceError(vkhResultString(result));
  return {context, vkhDestroyContext};
}

// A triangle, and a square of two, above a bumpy field; a mesh beside itself, coarser, where few
// candidates stay; a mesh whose every face is about as far from a fine ball, where many do; and a
// ball within another one.
std::vector<Pair> pairs(uint32_t most_faces) {
  std::vector<Pair> all;
  for (const uint32_t cells : {12u, 72u}) {
    const Mesh field = test::height_field(cells, 1);
    all.push_back(
        {"few", test::single_triangle({0.1, 0.1, 0.3}, {0.9, 0.2, 0.3}, {0.4, 0.9, 0.3}), field});
    all.push_back({"few", test::square_patch(1, 0.3), field});
  }
  const Mesh ball = test::translated(test::icosphere(1.1, 5), {0.003, 0.002, 0.001});
  all.push_back({"coarse", test::cube(0.6), ball});
  for (const uint32_t halvings : {1u, 3u, 4u, 6u})
    all.push_back({"coarse", test::icosphere(1, halvings), ball});
  for (const uint32_t cells : {8u, 22u, 72u, 224u})
    all.push_back({"twins", test::height_field(cells, 1), test::height_field(cells, 2)});
  for (const uint32_t halvings : {1u, 3u, 4u, 6u})
    all.push_back({"balls", test::icosphere(1, halvings), test::icosphere(1.01, halvings)});
  std::erase_if(all, [&](const Pair& pair) { return pair.a.faces.size() > most_faces; });
  return all;
}

std::vector<Size> sizes_of(VkhContext context, const Mesh& a, const Arguments& arguments) {
  const auto vertices = static_cast<uint32_t>(a.vertices.size());
  const auto faces = static_cast<uint32_t>(a.faces.size());
  VkhWorkspaceRequirements needed{};
  const VkhResult result = vkhGetWorkspaceRequirements(context, vertices, faces, &needed);
  if (result != VKH_SUCCESS) throw DeviceError(vkhResultString(result));
  std::vector<Size> sizes = {{"recommended", needed.recommended},
                             {"compact", needed.compact},
                             {"minimum", needed.minimum}};
  for (const uint32_t count : arguments.candidates)
    sizes.push_back({std::to_string(count), vkhGetWorkspaceSize(context, vertices, faces, count)});
  return sizes;
}

void measure(Solver& solver, const Pair& pair, const Arguments& arguments,
             std::vector<Size>& sizes) {
  for (int run = 0; run <= arguments.runs; ++run) {  // the first one warms up
    for (Size& size : sizes) {
      SolveOptions options;
      options.tolerance = arguments.tolerance;
      options.time_limit_s = 60;
      options.memory_bytes = size.bytes;
      options.engine.stage_times = false;
      if (arguments.gpu_profile) {
        options.engine.enabled = {"wide", "group_walk", "split_twice"};
        options.engine.disabled = {"centroid", "parent_samples"};
      }
      size.report = solver.distance(pair.a, pair.b, options);
      if (run > 0) size.ms = std::min(size.ms, size.report.times.solve_ms);
    }
  }
}

void print(const Pair& pair, const std::vector<Size>& sizes) {
  for (const Size& size : sizes)
    std::printf("%s,%zu,%s,%llu,%.3f,%.2f,%u,%llu,%llu,%.3g\n", pair.family.c_str(),
                pair.a.faces.size(), size.name.c_str(), static_cast<unsigned long long>(size.bytes),
                size.ms, size.ms / sizes[0].ms, size.report.waves,
                static_cast<unsigned long long>(size.report.candidates),
                static_cast<unsigned long long>(size.report.peak_frontier), size.report.gap());
  std::fflush(stdout);
}

int run(const Arguments& arguments) {
  Device device({.selector = arguments.device});
  const Context context = context_on(device, arguments);
  Solver solver(device);
  std::printf("family,faces,size,bytes,ms,times_recommended,waves,candidates,peak,gap\n");
  for (const Pair& pair : pairs(arguments.faces)) {
    std::vector<Size> sizes = sizes_of(context.get(), pair.a, arguments);
    measure(solver, pair, arguments, sizes);
    print(pair, sizes);
  }
  return 0;
}

}  // namespace

Measure add_workspace(CLI::App& app) {
  const auto args = std::make_shared<Arguments>();
  app.add_option("--device", args->device);
  app.add_option("--faces", args->faces, "the most faces of A");
  app.add_option("--runs", args->runs);
  app.add_option("--tol", args->tolerance);
  app.add_option("--candidates", args->candidates)->delimiter(',');
  app.add_flag("--gpu-profile", args->gpu_profile, "the waves of a GPU, on any device");
  return [args] { return run(*args); };
}

}  // namespace vkh::bench
