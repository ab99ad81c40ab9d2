#include "host/app/doctor.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <ostream>

#include "host/app/device_properties.h"
#include "host/app/device_report.h"
#include "host/app/self_test.h"
#include "host/base/decimal.h"
#include "host/base/output_file.h"
#include "host/mesh/mesh_pair.h"
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

void self_check(std::ostream& out, Device& device, Examination& found) {
  const MeshPair pair = self_check_pair();
  const auto start = std::chrono::steady_clock::now();
  Solver solver(device);
  const Report r = solver.distance(pair.a, pair.b);
  const auto elapsed = std::chrono::duration_cast<std::chrono::milliseconds>(
      std::chrono::steady_clock::now() - start);
  const bool encloses = r.lower <= kSelfCheckDistance && kSelfCheckDistance <= r.upper;
  found.lower = r.lower;
  found.upper = r.upper;
  found.distance = kSelfCheckDistance;
  found.passed = encloses && r.status == Status::kClosed;
  out << "self-check  true distance " << decimal(kSelfCheckDistance, 17, Rounding::kDown)
      << (encloses ? " lies in [" : " is NOT in [") << decimal(r.lower, 9, Rounding::kDown) << ", "
      << decimal(r.upper, 9, Rounding::kUp) << "], " << status_name(r.status) << ", after "
      << elapsed.count() << " ms: " << (found.passed ? "passed" : "FAILED") << std::endl;
}

/// Measures the properties of arithmetic that the certificate relies on.
void check_arithmetic(std::ostream& out, const Device& device, Examination& found) {
  found.arithmetic = run_self_test(device);
  const SelfTestResult& r = found.arithmetic;
  out << "arithmetic  " << r.items << " hard inputs, " << r.composed << " composed expressions: ";
  if (!r.fault.empty()) {
    out << "FAILED: " << r.fault << '\n';
    return;
  }
  out << "passed; + - * round " << (r.rounds_to_nearest ? "to nearest" : "to a neighbour")
      << ", division within " << decimal(r.worst_quotient_ulp, 3, Rounding::kUp)
      << " ulp (2.5 allowed), roots within " << decimal(r.worst_root_ulp, 3, Rounding::kUp)
      << " (6), results under 2^-126 " << (r.flushes ? "flushed" : "kept") << ", subgroups of "
      << r.largest_subgroup << "; subgroup operations tried " << r.group_views() << " times, "
      << r.partial_views() << " of them on a part of a subgroup\n";
}

void print_device(std::ostream& out, const DeviceDescription& d) {
  out << "  " << d.index << "  " << d.name << " (" << d.type << "), driver " << d.driver
      << ", Vulkan " << d.api_version << ", "
      << decimal(static_cast<double>(d.memory_bytes) / 0x1p30, 3, Rounding::kDown)
      << " GiB: " << (d.usable ? "usable" : "not usable: " + d.reason) << '\n';
}

void print_devices(std::ostream& out, const std::vector<DeviceDescription>& devices) {
  for (const DeviceDescription& d : devices) print_device(out, d);
  if (devices.empty()) out << "  none\n";
  out.flush();
}

void print_chosen(std::ostream& out, const DeviceDescription& chosen) {
  out << "chosen      " << chosen.index << "  " << chosen.name
      << (chosen.type == "cpu" ? " (a CPU device, no GPU)" : "") << "\ndriver      "
      << chosen.driver << ", Vulkan " << chosen.api_version << std::endl;
}

/// Returns whether the device can be trusted. Throws DeviceError where a check could not be run.
bool examine(std::ostream& out, Device& device, const Machine& machine, const OutputFile* report) {
  Examination found;
  check_arithmetic(out, device, found);
  self_check(out, device, found);
  const bool is_sound = found.arithmetic.fault.empty() && found.passed;
  if (report == nullptr) return is_sound;
  std::string sizes, problem;
  try {
    sizes = timed_sizes(device);
  } catch (const DeviceError& error) {
    problem = error.what();
  }
  report->write(device_report(machine, &device, &found, sizes, problem));
  return is_sound;
}

}  // namespace

bool examine_devices(std::ostream& out, const std::string& selector, const OutputFile* report) {
  Machine machine;
  std::optional<Device> device;
  try {
    out << "vkhausdorff " << program_version() << '\n';
    machine.loader = loader_version();
    out << "loader      Vulkan " << machine.loader << "\ndevices, the preferred first\n";
    machine.devices = list_devices();
    print_devices(out, machine.devices);
    device.emplace(DeviceRequest{.selector = selector});
    print_chosen(out, device->description());
    return examine(out, *device, machine, report);
  } catch (const DeviceError& error) {
    if (report != nullptr)
      report->write(device_report(machine, device ? &*device : nullptr, nullptr, "", error.what()));
    throw;
  }
}

}  // namespace vkh
