#include "host/app/doctor.h"

#include <chrono>
#include <cstdint>
#include <ostream>

#include "host/app/device_properties.h"
#include "host/app/self_test.h"
#include "host/base/decimal.h"
#include "host/mesh/default_pair.h"
#include "host/mesh/mesh_pair.h"
#include "host/native/arithmetic_check.h"
#include "vkhausdorff/answer.h"
#include "vkhausdorff/device.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/solver.h"

namespace vkh {
namespace {

/// The distance of a square between two walls, at x = -1 and x = 45/64: its farthest points lie on
/// the line halfway between them, inside both of its faces, at 109/128 from either wall. No vertex
/// of A is there.
constexpr double kSelfCheckDistance = 109.0 / 128;
MeshPair self_check_pair() {
  const auto wall = [](double x) {
    return std::vector<glm::dvec3>{{x, -4, -2}, {x, 4, -2}, {x, 0, 6}};
  };
  std::vector<glm::dvec3> walls = wall(-1);
  for (const glm::dvec3& corner : wall(45.0 / 64)) walls.push_back(corner);
  return {
      make_mesh("square", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}),
      make_mesh("walls", std::move(walls), {{0, 1, 2}, {3, 4, 5}})};
}

/// The doctor's output, and the same as JSON, or null.
struct Findings {
  std::ostream& out;
  Json* json;
  void add(const char* key, const Json& value) const {
    if (json != nullptr) (*json)[key] = value;
  }
};

bool self_check(const Findings& found, Solver& solver) {
  const MeshPair pair = self_check_pair();
  const auto start = std::chrono::steady_clock::now();
  const Report r = solver.distance(pair.a, pair.b);
  const auto elapsed = std::chrono::duration_cast<std::chrono::milliseconds>(
      std::chrono::steady_clock::now() - start);
  const bool encloses = r.lower <= kSelfCheckDistance && kSelfCheckDistance <= r.upper;
  const bool passed = encloses && r.status == Status::kClosed;
  found.add("self_check", {{"passed", passed},
                           {"distance", kSelfCheckDistance},
                           {"lower", r.lower},
                           {"upper", r.upper},
                           {"ms", elapsed.count()}});
  found.out << "self-check  true distance " << decimal(kSelfCheckDistance, 17, Rounding::kDown)
            << (encloses ? " lies in [" : " is NOT in [") << decimal(r.lower, 9, Rounding::kDown)
            << ", " << decimal(r.upper, 9, Rounding::kUp) << "], " << status_name(r.status)
            << ", after " << elapsed.count() << " ms: " << (passed ? "passed" : "FAILED")
            << std::endl;
  return passed;
}

Json arithmetic_json(const SelfTestResult& r) {
  return {{"passed", r.fault.empty()},
          {"fault", text_or_null(r.fault)},
          {"inputs", r.items},
          {"composed_expressions", r.composed},
          {"rounds_to_nearest", r.rounds_to_nearest},
          {"flushes", r.flushes},
          {"worst_quotient_ulp", r.worst_quotient_ulp},
          {"worst_root_ulp", r.worst_root_ulp},
          {"largest_subgroup", r.largest_subgroup}};
}

Json groups_json(const SelfTestResult& r) {
  Json rows = Json::array();
  for (size_t flow = 0; flow < kFlowNames.size(); ++flow) {
    const GroupTally& tally = r.groups[flow];
    Json wrong = Json::object();
    for (size_t i = 0; i < kGroupOperations.size(); ++i)
      wrong[kGroupOperations[i]] = tally.wrong[i];
    rows.push_back({{"where", kFlowNames[flow]},
                    {"views", tally.views},
                    {"partial", tally.partial},
                    {"wrong", wrong}});
  }
  return rows;
}

/// Measures the properties of arithmetic that the certificate relies on.
bool check_arithmetic(const Findings& found, const Device& device) {
  const SelfTestResult r = run_self_test(device);
  found.add("arithmetic", arithmetic_json(r));
  found.add("subgroup_operations", groups_json(r));
  std::ostream& out = found.out;
  out << "arithmetic  " << r.items << " hard inputs, " << r.composed << " composed expressions: ";
  if (!r.fault.empty()) {
    out << "FAILED: " << r.fault << '\n';
    return false;
  }
  out << "passed; + - * round " << (r.rounds_to_nearest ? "to nearest" : "to a neighbour")
      << ", division within " << decimal(r.worst_quotient_ulp, 3, Rounding::kUp)
      << " ulp (2.5 allowed), roots within " << decimal(r.worst_root_ulp, 3, Rounding::kUp)
      << " (6), results under 2^-126 " << (r.flushes ? "flushed" : "kept") << ", subgroups of "
      << r.largest_subgroup << "; subgroup operations tried " << r.group_views() << " times, "
      << r.partial_views() << " of them on a part of a subgroup\n";
  return true;
}

/// The first run makes the pipelines, and the second is timed.
Json times_json(Solver& solver) {
  const MeshPair pair = default_pair();
  solver.distance(pair.a, pair.b);
  const Report r = solver.distance(pair.a, pair.b);
  return {{"faces_a", r.mesh_a.faces},
          {"faces_b", r.mesh_b.faces},
          {"status", status_name(r.status)},
          {"upload_ms", r.times.upload_ms},
          {"hierarchy_ms", r.times.hierarchy_ms},
          {"solve_ms", r.times.solve_ms},
          {"wall_ms", r.times.wall_ms}};
}

Json description_json(const DeviceDescription& d) {
  return {{"index", d.index},
          {"name", d.name},
          {"type", d.type},
          {"driver", d.driver},
          {"api_version", d.api_version},
          {"memory_bytes", d.memory_bytes},
          {"usable", d.usable},
          {"reason", text_or_null(d.reason)}};
}

void print_device(std::ostream& out, const DeviceDescription& d) {
  out << "  " << d.index << "  " << d.name << " (" << d.type << "), driver " << d.driver
      << ", Vulkan " << d.api_version << ", "
      << decimal(static_cast<double>(d.memory_bytes) / 0x1p30, 3, Rounding::kDown)
      << " GiB: " << (d.usable ? "usable" : "not usable: " + d.reason) << '\n';
}

void print_devices(const Findings& found) {
  const std::vector<DeviceDescription> devices = list_devices();
  Json rows = Json::array();
  for (const DeviceDescription& d : devices) {
    print_device(found.out, d);
    rows.push_back(description_json(d));
  }
  if (devices.empty()) found.out << "  none\n";
  found.out.flush();
  found.add("devices", rows);
}

void print_chosen(std::ostream& out, const DeviceDescription& chosen) {
  out << "chosen      " << chosen.index << "  " << chosen.name
      << (chosen.type == "cpu" ? " (a CPU device, no GPU)" : "") << "\ndriver      "
      << chosen.driver << ", Vulkan " << chosen.api_version << std::endl;
}

bool examine_native(const Findings& found) {
  const std::string fault = native::arithmetic_fault();
  found.add("arithmetic", {{"passed", fault.empty()}, {"fault", text_or_null(fault)}});
  found.out << "arithmetic  "
            << (fault.empty() ? "passed; each operation rounds to nearest, and nothing is flushed"
                              : "FAILED: " + fault)
            << '\n';
  Solver solver{NativeProcessor()};
  const bool is_sound = self_check(found, solver) && fault.empty();
  if (found.json != nullptr) found.add("times", times_json(solver));
  return is_sound;
}

bool examine_device(const Findings& found, const std::string& selector) {
  const std::string loader = loader_version();
  found.add("loader", loader);
  found.out << "loader      Vulkan " << loader << "\ndevices, the preferred first\n";
  print_devices(found);
  Device device(DeviceRequest{.selector = selector});
  print_chosen(found.out, device.description());
  found.add("device", properties_json(device));
  const bool is_exact = check_arithmetic(found, device);
  Solver solver(device);
  const bool is_sound = self_check(found, solver) && is_exact;
  if (found.json != nullptr) found.add("times", times_json(solver));
  return is_sound;
}

bool examine(const Findings& found, const std::string& selector) {
  const std::string native = describe(NativeProcessor()).name;
  found.add("native", native);
  found.out << "vkhausdorff " << program_version() << "\nprocessor   " << native
            << ": by --device native, without Vulkan" << std::endl;
  return selector == kNative ? examine_native(found) : examine_device(found, selector);
}

}  // namespace

bool examine_devices(std::ostream& out, const std::string& selector, Json* json) {
  const Findings found{out, json};
  found.add("schema", "vkhausdorff.doctor/1");
  found.add("version", program_version());
  found.add("system", system_name());
  found.add("problem", nullptr);
  for (const char* part : {"native", "loader", "devices", "device", "arithmetic",
                           "subgroup_operations", "self_check", "times"})
    found.add(part, nullptr);
  try {
    return examine(found, selector);
  } catch (const DeviceError& error) {
    found.add("problem", error.what());
    throw;
  }
}

}  // namespace vkh
