// Allocations of the host's and the engine's own, failed on purpose: each ends in std::bad_alloc, a
// DeviceError, or the answer that is possible without it; nothing is left, and kept objects still
// work.
#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "tests/shapes/shapes.h"
#include "tests/support/program.h"
#include "tests/support/tally.h"
#include "tests/verification/faults/failing_new.h"
#include "tests/verification/faults/trial.h"
#include "vkhausdorff/answer.h"
#include "vkhausdorff/device.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/solver.h"

namespace {

using namespace vkh;
using namespace vkh::test;

FaultTable& table() {
  static FaultTable one("memory");
  return one;
}

std::string ended_by_memory(const std::function<std::string()>& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return "std::bad_alloc";
  } catch (const DeviceError& error) {
    return std::string("DeviceError: ") + error.what();
  }
}

/// Chooses trials evenly spread, with the first and the last among them.
std::vector<uint64_t> spread(uint64_t count, uint64_t most) {
  const char* wanted = std::getenv("VKH_FAULTS");
  if (wanted != nullptr && std::string(wanted) == "all") most = count;
  std::vector<uint64_t> places;
  const uint64_t steps = std::min(count, most);
  for (uint64_t i = 0; i < steps; ++i)
    places.push_back(1 + (steps == 1 ? 0 : i * (count - 1) / (steps - 1)));
  return places;
}

/// `work` fills its answer, and destroys all that it makes.
void try_all(const std::string& what, uint64_t most, const std::function<std::string()>& work) {
  const Watchdog outer;
  const std::string answer = work();
  const uint32_t alive = layer().live();
  failing_new().arm(0, false);
  CHECK(work() == answer);
  const uint64_t count = failing_new().disarm();
  CAPTURE(what);
  REQUIRE(count > 0);
  uint64_t failed = 0;
  for (const uint64_t n : spread(count, most)) {
    for (const bool onwards : {false, true}) {
      CAPTURE(n);
      CAPTURE(onwards);
      const Watchdog watchdog;
      layer().arm("");
      failing_new().arm(n, onwards);
      const std::string end = ended_by_memory(work);
      failing_new().disarm();
      CHECK((end == answer || end == "std::bad_alloc" || end.starts_with("DeviceError: ")));
      CHECK(layer().violations() == 0);
      CHECK(layer().live() == alive);
      failed += end == answer ? 0 : 1;
      table().add(what,
                  "allocation " + std::to_string(n) + "/" + std::to_string(count) +
                      (onwards ? " and all after it" : ""),
                  end == answer ? "answer" : end);
    }
    CHECK(ended_by_memory(work) == answer);
  }
  CHECK(failed > 0);
}

std::string counts_of(const Mesh& mesh) {
  return std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.faces.size());
}

TEST_CASE("files") {
  layer();
  const std::string obj = write_file("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\n");
  const std::string off = write_file("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::string ply = write_file(
      "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 "
      "0\n3 0 1 2\n");
  const std::string stl =
      write_file("m.stl",
                 "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                 "0\nendloop\nendfacet\nendsolid a\n");
  for (const std::string& path : {obj, off, ply, stl})
    try_all("read " + path.substr(path.size() - 3), 200,
            [&] { return counts_of(read_mesh(path)); });
}

TEST_CASE("devices") {
  layer();
  try_all("list", 60, [] { return std::to_string(list_devices().size()); });
  try_all("device", 60, [] { return Device().description().name; });
}

TEST_CASE("a run, and the table of its answer") {
  layer();
  Device device;
  Solver solver(device);
  const Mesh a = noisy(icosphere(1, 1), 0.05, 1), b = icosphere(1, 1);
  SolveOptions options;
  options.memory_bytes = 4 << 20;
  options.engine.coverage = true;
  const auto text = [](const Report& r) { return hex(r.lower) + hex(r.upper); };
  try_all("distance", 40, [&] { return text(solver.distance(a, b, options)); });
  try_all("prepared", 20, [&] { return text(solver.distance(a, solver.prepare(b), options)); });
  try_all("together", 20, [&] {
    const std::array pairs{PairView{a, b}, PairView{b, a}};
    const std::vector<Report> reports = solver.distances(pairs, options);
    return text(reports[0]) + text(reports[1]);
  });
  Answer answer;
  answer.a_to_b = solver.distance(a, b, options);
  try_all("table", 200, [&] {
    std::ostringstream out;
    print_table(out, answer, true);
    return out ? out.str() : throw std::bad_alloc();  // a stream keeps it to itself
  });
}

TEST_CASE("a start") {
  layer();
  Device device;
  try_all("start", 4, [&] {
    Solver solver(device);
    solver.make_ready();
    return std::string("ready");
  });
}

// Only a return code may come out of a C interface, no exception.
TEST_CASE("the C API") {
  layer();
  Device device;
  const VkhDeviceInfo info = device.engine_info();
  try_all("vkhQuerySupport", 100, [&] {
    const VkhResult result = vkhQuerySupport(&info, nullptr, 0);
    CHECK((result == VKH_SUCCESS || result == VKH_ERROR_UNSUPPORTED));
    return result == VKH_SUCCESS ? std::string() : throw std::bad_alloc();
  });
  const auto create_context = [&](VkBool32 by_address) {
    VkhContextCreateInfo create{};
    create.size = sizeof(create);
    create.device = info;
    if (by_address == VK_TRUE) create.flags = VKH_CONTEXT_BY_ADDRESS;
    VkhContext context = nullptr;
    const VkhResult result = vkhCreateContext(&create, &context);
    CHECK((context != nullptr) == (result == VKH_SUCCESS));
    vkhDestroyContext(context);
    return result == VKH_SUCCESS ? std::string() : throw std::bad_alloc();
  };
  try_all("vkhCreateContext", 6, [&] { return create_context(VK_FALSE); });
  if (device.has_addresses())
    try_all("vkhCreateContext by address", 6, [&] { return create_context(VK_TRUE); });
}

}  // namespace
