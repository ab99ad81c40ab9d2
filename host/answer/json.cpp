// An answer as JSON.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/vkhausdorff.h"
#include "host/answer/answer.h"
#include "host/base/decimal.h"
#include "host/base/float_environment.h"
#include "host/base/rounding.h"

namespace vkh {
namespace {

using Json = nlohmann::ordered_json;

/// Members in order. nlohmann cannot write a number as it is told to, and the bounds must be
/// written as they were rounded, so the outermost object is put together as text.
class JsonObject {
 public:
  void add_text(const char* key, const std::string& json) {
    members_ += (members_.empty() ? "\"" : ",\"") + std::string(key) + "\":" + json;
  }
  // Bytes of a file name that are no UTF-8 are replaced, for they must not cost the answer.
  void add(const char* key, const Json& value) {
    add_text(key, value.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  void add_bound(const std::string& key, double value, Rounding rounding) {
    add_text(key.c_str(),
             std::isfinite(value) ? decimal(value, kJsonDigits, rounding) : std::string("null"));
    add((key + "_hex").c_str(), hex_float(value));
  }
  std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

Json vector_json(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Json witness_json(const Report& r) {
  return {{"a",
           {{"face", r.witness_a.face},
            {"barycentric", vector_json(r.witness_a.barycentric)},
            {"point", vector_json(r.witness_a.point)}}},
          {"b", {{"face", r.witness_b.face}, {"point", vector_json(r.witness_b.point)}}}};
}

// The delta is written so that it is read back as the same double.
Json mesh_json(const std::string& file, const MeshCounts& counts, const MeshPlace& place) {
  return {{"file", file},
          {"vertices", counts.vertices},
          {"faces", counts.faces},
          {"unreferenced", counts.unreferenced},
          {"degenerate", counts.degenerate},
          {"duplicate", counts.duplicate},
          {"polygons", counts.polygons},
          {"delta", place.delta},
          {"unit", place.unit.empty() ? Json() : Json(place.unit)}};
}

Json device_json(const DeviceDescription& d) {
  return {{"index", d.index},
          {"name", d.name},
          {"driver", d.driver},
          {"type", d.type},
          {"api_version", d.api_version},
          {"memory_bytes", d.memory_bytes}};
}

Json times_json(const Times& t) {
  return {{"load_ms", t.load_ms},           {"setup_ms", t.setup_ms}, {"upload_ms", t.upload_ms},
          {"hierarchy_ms", t.hierarchy_ms}, {"solve_ms", t.solve_ms}, {"wall_ms", t.wall_ms}};
}

Json stages_json(const std::vector<StageStats>& stages) {
  Json rows = Json::array();
  for (const StageStats& s : stages) {
    rows.push_back({{"name", s.name}, {"gpu_ms", s.gpu_ms}, {"times", s.times}});
  }
  return rows;
}

Json culled_json(const std::vector<CullCount>& culled) {
  Json json = Json::object();
  for (const CullCount& c : culled) json[c.name] = c.candidates;
  return json;
}

Json wave_stats_json(const std::vector<WaveStats>& waves) {
  Json rows = Json::array();
  for (const WaveStats& w : waves) {
    rows.push_back({{"wave", w.wave},
                    {"parents", w.parents},
                    {"candidates", w.candidates},
                    {"queries", w.queries},
                    {"survivors", w.survivors},
                    {"deferred", w.deferred},
                    {"lower", w.lower},
                    {"upper", w.upper}});
  }
  return rows;
}

void add_head(JsonObject& json, const char* schema, const CertifiedInterval& interval) {
  json.add("schema", schema);
  json.add("version", program_version());
  json.add("status", status_name(interval.status));
  json.add("stop_reason", stop_reason(interval.status));
  json.add_bound("lower", interval.lower, Rounding::kDown);
  json.add_bound("upper", interval.upper, Rounding::kUp);
  json.add("gap", interval.gap);
}

/// One direction's parts, in that direction's own words: mesh_a is where it starts.
struct Directed {
  const Report& report;
  const std::string& file_a;
  const std::string& file_b;
  const char* diagonal_of;  ///< the mesh whose diagonal resolved the tolerance, in those words
};

Json tolerance_json(const Tolerance& asked, const Report& r, const char* diagonal_of) {
  return {{"requested", asked.requested},
          {"absolute", r.tolerance},
          {"diagonal_of", asked.is_absolute ? Json(nullptr) : Json(diagonal_of)},
          {"diagonal_a", r.diagonal_a}};
}

std::string verified_json(const Report& r) {
  const WitnessCheck& check = *r.witness_check;
  JsonObject json;
  json.add("witness", check.holds);
  json.add_bound("distance_lower", check.distance_lower, Rounding::kDown);
  json.add_bound("distance_upper", check.distance_upper, Rounding::kUp);
  if (r.coverage_check) {
    const CoverageCheck& c = *r.coverage_check;
    json.add("coverage", c.holds);
    json.add("faces", {{"whole", c.whole}, {"waiting", c.waiting}, {"wrong", c.wrong}});
    json.add("closed", c.closed);
  }
  return json.text();
}

std::string directed_json(const Answer& answer, const Directed& d) {
  const Report& r = d.report;
  JsonObject json;
  add_head(json, "vkhausdorff.distance/1", {r.lower, r.upper, r.gap(), r.status});
  json.add("tolerance", tolerance_json(answer.tolerance, r, d.diagonal_of));
  json.add("known_lower", r.known_lower);
  json.add("witness", witness_json(r));
  if (r.witness_check) json.add_text("verified", verified_json(r));
  json.add("mesh_a", mesh_json(d.file_a, r.mesh_a, r.place_a));
  json.add("mesh_b", mesh_json(d.file_b, r.mesh_b, r.place_b));
  json.add("device", device_json(r.device));
  json.add("times", times_json(r.times));
  json.add("stages", stages_json(r.stages));
  json.add("culled", culled_json(r.culled));
  json.add("waves", r.waves);
  json.add("wave_stats", wave_stats_json(r.wave_stats));
  json.add("candidates", r.candidates);
  json.add("queries", r.queries);
  json.add("peak_frontier", r.peak_frontier);
  json.add("workspace_bytes", r.workspace_bytes);
  json.add("preset", r.preset);
  json.add("switched_on", r.switched_on);
  json.add("switched_off", r.switched_off);
  json.add("notes", answer.notes);
  return json.text();
}

}  // namespace

const char* program_version() { return VKH_VERSION_STRING; }

const char* stop_reason(Status status) {
  switch (status) {
    case Status::kClosed:
      return "the interval meets the tolerance";
    case Status::kPrecision:
      return "what is left cannot be decided in this arithmetic";
    case Status::kTime:
      return "the time budget ended";
    case Status::kWaves:
      return "the wave budget ended";
    case Status::kMemory:
      return "the memory did not hold what had to be refined";
    case Status::kCancelled:
      return "it was interrupted";
    case Status::kPruned:
      return "it exceeds the other direction's lower bound by no more than the tolerance";
  }
  return "unknown";
}

CertifiedInterval interval_of(const Answer& answer) {
  const Report& r = answer.a_to_b;
  if (!answer.b_to_a) return {r.lower, r.upper, r.gap(), r.status};
  return symmetric_interval(r, *answer.b_to_a);
}

std::string to_json(const Answer& answer) {
  std::string forward =
      directed_json(answer, {answer.a_to_b, answer.file_a, answer.file_b, "mesh_a"});
  if (!answer.b_to_a) return forward;
  JsonObject json;
  add_head(json, "vkhausdorff.symmetric/1", interval_of(answer));
  json.add("tolerance", tolerance_json(answer.tolerance, answer.a_to_b, "mesh_a"));
  json.add_text(
      "directed",
      "[" + forward + "," +
          directed_json(answer, {*answer.b_to_a, answer.file_b, answer.file_a, "mesh_b"}) + "]");
  return json.text();
}

}  // namespace vkh
