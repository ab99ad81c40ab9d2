#include "host/app/device_report.h"

#include <array>
#include <cstring>

#include "host/answer/json_object.h"
#include "host/app/device_properties.h"
#include "host/base/decimal.h"
#include "host/mesh/default_pair.h"
#include "vkhausdorff/solver.h"

namespace vkh {
namespace {

constexpr int kSizes = 3;

// Each face becomes four, by the middles of its edges. A's and B's coordinates are floats, whose
// middles are doubles.
Mesh split(const Mesh& mesh) {
  std::vector<DVec3> vertices = mesh.vertices;
  std::vector<UVec3> faces;
  vertices.reserve(vertices.size() + 3 * mesh.faces.size());
  faces.reserve(4 * mesh.faces.size());
  for (const UVec3& f : mesh.faces) {
    const auto first = static_cast<uint32_t>(vertices.size());
    const DVec3 &a = mesh.vertices[f.x], &b = mesh.vertices[f.y], &c = mesh.vertices[f.z];
    for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      vertices.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2});
    faces.push_back({f.x, first, first + 2});
    faces.push_back({f.y, first + 1, first});
    faces.push_back({f.z, first + 2, first + 1});
    faces.push_back({first, first + 1, first + 2});
  }
  return make_mesh(mesh.name, std::move(vertices), std::move(faces));
}

void add_interval(Json& json, double lower, double upper) {
  json["lower"] = lower;
  json["lower_hex"] = hex_float(lower);
  json["upper"] = upper;
  json["upper_hex"] = hex_float(upper);
}

Json row_of(const Report& r) {
  Json row = {{"faces_a", r.mesh_a.faces}, {"faces_b", r.mesh_b.faces}};
  add_interval(row, r.lower, r.upper);
  row["status"] = status_name(r.status);
  row["bvh_ms"] = r.times.hierarchy_ms;
  row["solve_ms"] = r.times.solve_ms;
  row["upload_ms"] = r.times.upload_ms;
  row["wall_ms"] = r.times.wall_ms;
  return row;
}

Json devices_json(const std::vector<DeviceDescription>& devices) {
  Json rows = Json::array();
  for (const DeviceDescription& d : devices)
    rows.push_back({{"index", d.index},
                    {"name", d.name},
                    {"type", d.type},
                    {"driver", d.driver},
                    {"api_version", d.api_version},
                    {"memory_bytes", d.memory_bytes},
                    {"usable", d.usable},
                    {"reason", text_or_null(d.reason)}});
  return rows;
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

Json self_check_json(const Examination& found) {
  Json json = {{"passed", found.passed}, {"distance", found.distance}};
  add_interval(json, found.lower, found.upper);
  return json;
}

}  // namespace

// The first run makes the pipelines and is not timed.
std::string timed_sizes(Device& device) {
  MeshPair pair = default_pair();
  Solver solver(device);
  solver.distance(pair.a, pair.b);
  Json rows = Json::array();
  for (int size = 0; size < kSizes; ++size) {
    if (size > 0) pair = {split(pair.a), split(pair.b)};
    rows.push_back(row_of(solver.distance(pair.a, pair.b)));
  }
  return rows.dump();
}

std::string device_report(const Machine& machine, const Device* device, const Examination* found,
                          const std::string& sizes, const std::string& problem) {
  Json json = {{"schema", "vkhausdorff.device-report/1"},
               {"version", program_version()},
               {"system", system_name()},
               {"loader", machine.loader},
               {"problem", text_or_null(problem)},
               {"devices", devices_json(machine.devices)}};
  json["device"] = device == nullptr ? Json() : properties_json(*device);
  json["arithmetic"] = found == nullptr ? Json() : arithmetic_json(found->arithmetic);
  json["subgroup_operations"] = found == nullptr ? Json() : groups_json(found->arithmetic);
  json["self_check"] = found == nullptr ? Json() : self_check_json(*found);
  json["sizes"] = sizes.empty() ? Json() : Json::parse(sizes);
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace vkh
