#include "host/answer/merge_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "host/base/error.h"
#include "host/base/float_environment.h"
#include "host/base/note.h"
#include "host/base/reject.h"
#include "host/base/rounding.h"
#include "host/base/system.h"
#include "host/solve/joined.h"

namespace vkh {
namespace {

constexpr std::array kStatuses{Status::kClosed, Status::kPrecision, Status::kTime,
                               Status::kWaves,  Status::kMemory,    Status::kCancelled,
                               Status::kPruned, Status::kLimit};

/// The fields of an answer that are compared.
struct Part {
  const WrittenAnswer* written;
  uint64_t index, count;
  std::string version;
  std::array<std::vector<FileHash>, 2> files;  ///< A's and B's, the mesh file first, by its hash
  std::string reading;                         ///< the faces of the files that were read
  Report report;                               ///< interval, status, tolerance, what was known
};

Status status_named(const std::string& name) {
  const auto found = std::find_if(kStatuses.begin(), kStatuses.end(),
                                  [&](Status status) { return name == status_name(status); });
  if (found == kStatuses.end()) throw InputError("status '" + name + "'");
  return *found;
}

Report report_of(const Json& json) {
  const Json& direction = json.at("directions").at(0);
  const Json& interval = direction.at("interval");
  Report r;
  r.lower = bound_in(interval, "lower");
  r.upper = bound_in(interval, "upper");
  if (r.lower > r.upper || std::isinf(r.lower))
    throw InputError("an interval whose lower end is above its upper");
  r.status = status_named(direction.at("status"));
  r.tolerance = json.at("tolerance").at("absolute");
  r.diagonal_a = json.at("tolerance").at("diagonal");
  r.known_lower = direction.at("known_lower");
  r.has_witness = !direction.at("witness").is_null();
  if (r.lower > 0 && !r.has_witness) throw InputError("a lower bound without a witness");
  return r;
}

FileHash hash_of(const Json& path, const Json& digest) {
  if (!digest.is_string()) throw InputError("no SHA-256 of a file that was read");
  return {path.get<std::string>(), digest.get<std::string>()};
}

/// Leaves out the names of A and B themselves: parts may be measured in several folders.
std::vector<FileHash> files_of(const Json& input) {
  std::vector<FileHash> files{hash_of("", input.at("sha256"))};
  if (!input.contains("files"))
    throw InputError(
        "no word on files that were read besides A and B, as answers have since 0.2.0");
  for (const Json& file : input.at("files"))
    files.push_back(hash_of(file.at("path"), file.at("sha256")));
  return files;
}

/// Describes how both files were read: the faces, and the notes on polygons and bodies, which
/// options decide.
std::string reading_of(const Json& json) {
  std::string text;
  for (const Json& input : json.at("inputs")) {
    text += input.at("faces").dump();
    for (const Note& note : notes_in(input)) {
      if (is_for_servers(note.code)) text += '\n' + line_of(note);
    }
    text += '\n';
  }
  return text;
}

/// Checks that counts that are added up over parts are whole numbers.
void check_counts(const Json& direction) {
  std::vector<const Json*> objects{&direction.at("counts")};
  if (direction.contains("culled")) objects.push_back(&direction.at("culled"));
  if (direction.contains("verified") && direction.at("verified").contains("faces"))
    objects.push_back(&direction.at("verified").at("faces"));
  for (const Json* counts : objects) {
    for (const auto& [key, value] : counts->items()) (void)count_in(*counts, key);
  }
}

Part parsed(const WrittenAnswer& written) {
  const Json& json = written.json;
  try {
    if (!is_part(json) || json.at("schema") != "vkhausdorff.answer/2")
      throw InputError("no answer of a part");
    check_bounds(json);
    check_counts(json.at("directions").at(0));
    return {.written = &written,
            .index = count_in(json.at("part"), "index"),
            .count = count_in(json.at("part"), "count"),
            .version = json.at("version"),
            .files = {files_of(json.at("inputs").at(0)), files_of(json.at("inputs").at(1))},
            .reading = reading_of(json),
            .report = report_of(json)};
  } catch (const Json::exception& error) {
    reject(written.file, written.place, error.what(), "an answer of 'distance --part'");
  } catch (const InputError& error) {
    reject(written.file, written.place, error.what(), "an answer of 'distance --part'");
  }
}

void check_alike(const Part& part, const Part& first) {
  const WrittenAnswer& at = *part.written;
  const auto same = [&](const auto& value, const auto& of_first, const char* what) {
    if (value != of_first)
      reject(at.file, at.place, std::string("another ") + what,
             "that of " + first.written->file + ": " + first.written->place);
  };
  same(part.count, first.count, "number of parts");
  for (size_t i = 0; i < part.files.size(); ++i) {
    const char* name = i == 0 ? "A" : "B";
    same(part.files[i].front(), first.files[i].front(), name);
    same(part.files[i], first.files[i], (std::string("file beneath ") + name).c_str());
  }
  same(part.reading, first.reading, "choice of --bodies or --polygons");
  same(part.report.tolerance, first.report.tolerance, "tolerance");
  same(at.json.at("tolerance").at("unit"), first.written->json.at("tolerance").at("unit"), "unit");
  same(part.version, first.version, "version");
}

void check_complete(const std::vector<Part>& parts) {
  const WrittenAnswer& at = *parts[0].written;
  for (size_t i = 0; i < parts.size(); ++i) {
    const WrittenAnswer& of_it = *parts[i].written;
    if (parts[i].index >= parts[i].count)
      reject(of_it.file, of_it.place, "a part that cannot be", "a part from 0");
    if (i > 0 && parts[i].index == parts[i - 1].index)
      reject(of_it.file, of_it.place, "part " + std::to_string(parts[i].index) + " once more",
             "each part once");
  }
  std::string missing;
  uint64_t next = 0, count = 0;
  for (const Part& part : parts) {
    for (; next < part.index && ++count <= 5; ++next)
      missing += (missing.empty() ? "" : ", ") + std::to_string(next);
    next = part.index + 1;
  }
  for (; next < parts[0].count && ++count <= 5; ++next)
    missing += (missing.empty() ? "" : ", ") + std::to_string(next);
  if (!missing.empty())
    reject(at.file, at.place, "without part " + missing + (count > 5 ? ".." : ""),
           "all " + std::to_string(parts[0].count) + " parts");
}

/// Parses the answers, checks that they are all the parts of one comparison, each once, and returns
/// them in the order of their numbers.
std::vector<Part> checked(const std::vector<WrittenAnswer>& written) {
  std::vector<Part> parts;
  parts.reserve(written.size());
  for (const WrittenAnswer& one : written) parts.push_back(parsed(one));
  for (const Part& part : parts) check_alike(part, parts[0]);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& x, const Part& y) { return x.index < y.index; });
  check_complete(parts);
  return parts;
}

const Json& direction_of(const Part& part) { return part.written->json.at("directions").at(0); }

/// The part that has the witness.
const Part& farthest(const std::vector<Part>& parts) {
  return *std::max_element(parts.begin(), parts.end(), [](const Part& x, const Part& y) {
    return x.report.lower < y.report.lower;
  });
}

Report whole_of(const std::vector<Part>& parts) {
  std::vector<Report> reports;
  reports.reserve(parts.size());
  for (const Part& part : parts) reports.push_back(part.report);
  Report whole = joined_report(reports);
  for (const Report& r : reports) whole.known_lower = std::max(whole.known_lower, r.known_lower);
  whole.status = joined_status(whole, reports);
  return whole;
}

std::string interval_text(const Report& whole, const Json& unit) {
  JsonObject json;
  json.add_bound("lower", whole.lower, Rounding::kDown);
  json.add_bound("upper", whole.upper, Rounding::kUp);
  json.add("gap", whole.gap());
  json.add("unit", unit);
  return json.text();
}

Json largest_of(const std::vector<const Json*>& objects) {
  Json out = *objects[0];
  for (const Json* one : objects) {
    for (const auto& [key, value] : one->items()) {
      if (!out.contains(key) || value > out[key]) out[key] = value;
    }
  }
  return out;
}

Json sum_of(const std::vector<const Json*>& objects) {
  Json out = Json::object();
  for (const Json* one : objects) {
    for (const auto& [key, value] : one->items())
      out[key] = out.value(key, uint64_t{0}) + value.get<uint64_t>();
  }
  return out;
}

/// The member `key` of every part's direction; empty: one part has none.
std::vector<const Json*> members(const std::vector<Part>& parts, const char* key) {
  std::vector<const Json*> all;
  for (const Part& part : parts) {
    const Json& direction = direction_of(part);
    if (!direction.contains(key)) return {};
    all.push_back(&direction.at(key));
  }
  return all;
}

/// Returns the check of the witness's part; nothing may be lost of any part.
std::string verified_text(const std::vector<Part>& parts) {
  const Json& of_witness = direction_of(farthest(parts)).at("verified");
  JsonObject json;
  json.add("witness", of_witness.at("witness"));
  json.add_bound("distance_lower", bound_in(of_witness, "distance_lower"), Rounding::kDown);
  json.add_bound("distance_upper", bound_in(of_witness, "distance_upper"), Rounding::kUp);
  bool holds = true;
  std::vector<const Json*> faces;
  for (const Json* one : members(parts, "verified")) {
    if (!one->contains("coverage")) return json.text();
    holds = holds && one->at("coverage").get<bool>();
    faces.push_back(&one->at("faces"));
  }
  json.add("coverage", holds);
  json.add("faces", sum_of(faces));
  return json.text();
}

Json counts_of(const std::vector<Part>& parts) {
  const std::vector<const Json*> all = members(parts, "counts");
  Json counts = largest_of(all);
  const Json sums = sum_of(all);
  for (const char* key : {"candidates", "queries"}) counts[key] = sums.at(key);
  return counts;
}

std::string direction_text(const std::vector<Part>& parts, const Report& whole) {
  JsonObject json;
  for (const auto& [key, value] : direction_of(farthest(parts)).items()) {
    if (key == "status") {
      json.add("status", status_name(whole.status));
    } else if (key == "stop_reason") {
      json.add("stop_reason", stop_reason(whole.status));
    } else if (key == "interval") {
      json.add_text("interval", interval_text(whole, value.at("unit")));
    } else if (key == "known_lower") {
      json.add("known_lower", whole.known_lower);
    } else if (key == "verified") {
      if (!members(parts, "verified").empty()) json.add_text("verified", verified_text(parts));
    } else if (key == "times") {
      json.add("times", largest_of(members(parts, "times")));
    } else if (key == "counts") {
      json.add("counts", counts_of(parts));
    } else if (key == "culled") {
      json.add("culled", sum_of(members(parts, "culled")));
    } else {
      json.add(key.c_str(), key == "stages" || key == "wave_stats" ? Json::array() : value);
    }
  }
  return json.text();
}

std::string words_of(const Json& json, const Report& whole) {
  Answer answer;
  const Json& unit = json.at("tolerance").at("unit");
  if (unit.is_string()) answer.unit = unit;
  answer.tolerance.requested = json.at("tolerance").at("requested");
  answer.a_to_b = whole;
  return in_words(answer);
}

/// Returns each note once, in the order of the parts.
Json notes_of(const std::vector<Part>& parts) {
  Json notes = Json::array();
  for (const Part& part : parts) {
    for (const Json& note : part.written->json.at("notes")) {
      if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    }
  }
  return notes;
}

/// The devices besides that of the witness's part.
Json more_devices(const std::vector<Part>& parts, const Json& first) {
  Json devices = Json::array();
  const auto add = [&](const Json& device) {
    const bool is_known = std::find(devices.begin(), devices.end(), device) != devices.end();
    if (!device.is_null() && device != first && !is_known) devices.push_back(device);
  };
  for (const Part& part : parts) {
    add(part.written->json.at("device"));
    if (!part.written->json.contains("more_devices")) continue;
    for (const Json& device : part.written->json.at("more_devices")) add(device);
  }
  return devices;
}

/// The words as the user typed them, without options of one part alone.
Json arguments_of(const Json& typed) {
  Json out = Json::array();
  for (size_t i = 0; i < typed.size(); ++i) {
    const auto& word = typed[i].get_ref<const std::string&>();
    const bool is_alone = word == "--part" || word == "--known-lower";
    if (is_alone) ++i;
    if (!is_alone && !word.starts_with("--part=") && !word.starts_with("--known-lower="))
      out.push_back(word);
  }
  return out;
}

Json waits_of(const std::vector<Part>& parts) {
  std::vector<const Json*> all;
  all.reserve(parts.size());
  for (const Part& part : parts) all.push_back(&part.written->json.at("times"));
  return largest_of(all);
}

Json started_first(const std::vector<Part>& parts) {
  Json first = parts[0].written->json.at("started");
  for (const Part& part : parts) first = std::min(first, part.written->json.at("started"));
  return first;
}

void add_member(JsonObject& json, const std::string& key, const Json& value,
                const std::vector<Part>& parts, const Report& whole) {
  const Json& base = farthest(parts).written->json;
  if (key == "words") return json.add("words", words_of(base, whole));
  if (key == "status") return json.add("status", status_name(whole.status));
  if (key == "stop_reason") return json.add("stop_reason", stop_reason(whole.status));
  if (key == "part") return json.add("parts", parts.size());
  if (key == "interval") return json.add_text("interval", interval_text(whole, value.at("unit")));
  if (key == "directions")
    return json.add_text("directions", "[" + direction_text(parts, whole) + "]");
  if (key == "notes") return json.add("notes", notes_of(parts));
  if (key == "times") return json.add("times", waits_of(parts));
  if (key == "arguments") return json.add("arguments", arguments_of(value));
  if (key == "started") return json.add("started", started_first(parts));
  if (key != "more_devices") json.add(key.c_str(), value);
  if (key != "driver") return;
  const Json devices = more_devices(parts, base.at("device"));
  if (!devices.empty()) json.add("more_devices", devices);
}

}  // namespace

bool is_part(const Json& answer) { return answer.is_object() && answer.contains("part"); }

std::vector<WrittenAnswer> read_parts(const std::vector<std::string>& files) {
  std::vector<WrittenAnswer> parts;
  for (const std::string& path : files) {
    std::error_code none;
    // A second read of a pipe would wait without end.
    if (std::filesystem::exists(path_of(path), none) &&
        !std::filesystem::is_regular_file(path_of(path), none))
      reject(path, "", "is no file", "results in files, which are read twice");
    std::ifstream file(path_of(path), std::ios::binary);
    if (!file) reject(path, "", "cannot be read", "results");
    uint64_t number = 0;
    for (std::string line; std::getline(file, line);) {
      const std::string place = "line " + std::to_string(++number);
      Json json = Json::parse(line, nullptr, false);
      if (parts.empty() && !is_part(json)) return {};
      if (json.is_discarded()) reject(path, place, vkh::quoted(line), "a JSON object a line");
      parts.push_back({path, place, std::move(json)});
    }
    if (file.bad()) throw InputError({.file = path, .problem = "cannot be read"});
  }
  return parts;
}

std::string merge_parts(const std::vector<WrittenAnswer>& written) {
  const FloatEnvironment ours;
  const std::vector<Part> parts = checked(written);
  const Report whole = whole_of(parts);
  JsonObject json;
  try {
    for (const auto& [key, value] : farthest(parts).written->json.items())
      add_member(json, key, value, parts, whole);
  } catch (const Json::exception& error) {
    const WrittenAnswer& at = *parts[0].written;
    reject(at.file, at.place, error.what(), "answers of 'distance --part'");
  }
  return json.text();
}

}  // namespace vkh
