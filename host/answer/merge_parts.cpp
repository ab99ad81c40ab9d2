#include "host/answer/merge_parts.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "host/base/float_environment.h"
#include "host/base/reject.h"
#include "host/base/system.h"
#include "host/solve/join_reports.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace {

/// The answer of a part, and the data by which parts are compared.
struct Part {
  const WrittenAnswer* written;
  Answer answer;
  std::array<std::vector<FileHash>, 2> files;  ///< A's and B's, the mesh file first, by its hash
  std::string reading;                         ///< the faces of the files that were read
};

/// Leaves out the names of A and B themselves: parts may be measured in several folders.
std::vector<FileHash> files_of(const Input& input) {
  std::vector<FileHash> files{{"", input.sha256}};
  files.insert(files.end(), input.files.begin(), input.files.end());
  for (const FileHash& file : files) {
    if (file.sha256.empty()) throw InputError("no SHA-256 of a file that was read");
  }
  return files;
}

/// Describes how both files were read: the faces, and the notes on polygons and bodies, which
/// options decide.
std::string reading_of(const Answer& answer) {
  std::string text;
  for (const Input& input : answer.inputs) {
    text += std::to_string(input.counts.faces) + (input.are_points ? " points" : "");
    for (const Note& note : input.notes) {
      if (is_for_servers(note.code)) text += '\n' + line_of(note);
    }
    text += '\n';
  }
  return text;
}

Part parsed(const WrittenAnswer& written) {
  try {
    if (!is_part(written.json)) throw InputError("no answer of a part");
    Part part{.written = &written, .answer = answer_from(written.json), .files = {}, .reading = {}};
    const Answer& answer = part.answer;
    if (answer.b_to_a || answer.max) throw InputError("more than one direction's interval");
    if (answer.a_to_b.lower > 0 && !answer.a_to_b.has_witness)
      throw InputError("a lower bound without a witness");
    part.files = {files_of(answer.inputs[0]), files_of(answer.inputs[1])};
    part.reading = reading_of(answer);
    return part;
  } catch (const InputError& error) {
    const ErrorParts& parts = error.parts();
    reject(written.file, written.place, parts.problem,
           parts.expected.empty() ? "an answer of 'distance --part'" : parts.expected);
  }
}

/// Leaves out the matrix's file, of which each part has its own.
MeshTransform placed_by(const Answer& answer) {
  return answer.placed ? answer.placed->by : MeshTransform{};
}

void check_alike(const Part& part, const Part& first) {
  const WrittenAnswer& at = *part.written;
  const auto same = [&](const auto& value, const auto& of_first, const char* what) {
    if (value != of_first)
      reject(at.file, at.place, std::string("another ") + what,
             "that of " + first.written->file + ": " + first.written->place);
  };
  const Answer &here = part.answer, &there = first.answer;
  same(here.part->count, there.part->count, "number of parts");
  for (size_t i = 0; i < part.files.size(); ++i) {
    const char* name = i == 0 ? "A" : "B";
    same(part.files[i].front(), first.files[i].front(), name);
    same(part.files[i], first.files[i], (std::string("file beneath ") + name).c_str());
  }
  same(placed_by(here), placed_by(there), "--transform or unit");
  same(part.reading, first.reading, "choice of --bodies or --polygons");
  same(here.a_to_b.tolerance, there.a_to_b.tolerance, "tolerance");
  same(here.unit, there.unit, "unit");
  same(here.version, there.version, "version");
}

/// "1, 2, 5": the numbers below `all` that no part has, five of them at most.
std::string missing_parts(const std::vector<Part>& parts, uint64_t all) {
  constexpr uint64_t kMostNamed = 5;
  std::string text;
  auto part = parts.begin();
  for (uint64_t index = 0, missing = 0; index < all; ++index) {
    if (part != parts.end() && part->answer.part->index == index) {
      ++part;
    } else if (++missing > kMostNamed) {
      return text + "..";
    } else {
      text += (text.empty() ? "" : ", ") + std::to_string(index);
    }
  }
  return text;
}

void check_complete(const std::vector<Part>& parts) {
  const WrittenAnswer& at = *parts[0].written;
  for (size_t i = 0; i < parts.size(); ++i) {
    const WrittenAnswer& of_it = *parts[i].written;
    const PartOf& part = *parts[i].answer.part;
    if (part.index >= part.count)
      reject(of_it.file, of_it.place, "a part that cannot be", "a part from 0");
    if (i > 0 && part.index == parts[i - 1].answer.part->index)
      reject(of_it.file, of_it.place, "part " + std::to_string(part.index) + " once more",
             "each part once");
  }
  const uint64_t all = parts[0].answer.part->count;
  const std::string missing = missing_parts(parts, all);
  if (!missing.empty())
    reject(at.file, at.place, "without part " + missing, "all " + std::to_string(all) + " parts");
}

/// Parses the answers, checks that they are all the parts of one comparison, each once, and returns
/// them in the order of their numbers.
std::vector<Part> checked(const std::vector<WrittenAnswer>& written) {
  std::vector<Part> parts;
  parts.reserve(written.size());
  for (const WrittenAnswer& one : written) parts.push_back(parsed(one));
  for (const Part& part : parts) check_alike(part, parts[0]);
  std::stable_sort(parts.begin(), parts.end(), [](const Part& x, const Part& y) {
    return x.answer.part->index < y.answer.part->index;
  });
  check_complete(parts);
  return parts;
}

/// The part that has the witness.
const Part& farthest(const std::vector<Part>& parts) {
  return *std::max_element(parts.begin(), parts.end(), [](const Part& x, const Part& y) {
    return x.answer.a_to_b.lower < y.answer.a_to_b.lower;
  });
}

/// Keeps the largest of each figure of parts that may have run at the same time.
void keep_largest(const Report& part, Report& all) {
  all.known_lower = std::max(all.known_lower, part.known_lower);
  all.peak_frontier = std::max(all.peak_frontier, part.peak_frontier);
  all.workspace_bytes = std::max(all.workspace_bytes, part.workspace_bytes);
  all.times.wall_ms = std::max(all.times.wall_ms, part.times.wall_ms);
  add_culled(part.culled, all.culled);
}

/// Joins the reports, the one that has the witness first: its device, switches and check are the
/// whole's. There is no check if a part was not checked.
Report whole_of(const std::vector<Part>& parts) {
  const Part& first = farthest(parts);
  std::vector<Report> reports{first.answer.a_to_b};
  for (const Part& part : parts) {
    if (&part != &first) reports.push_back(part.answer.a_to_b);
  }
  Report whole = joined_report(reports);
  whole.stages.clear();
  whole.culled.clear();
  whole.peak_frontier = whole.workspace_bytes = 0;
  for (const Report& r : reports) {
    keep_largest(r, whole);
    if (!r.witness_check) whole.witness_check.reset();
  }
  whole.status = joined_status(whole, reports);
  return whole;
}

/// Returns each note once, in the order of the parts.
std::vector<Note> notes_of_all(const std::vector<Part>& parts) {
  std::vector<Note> notes;
  for (const Part& part : parts) {
    for (const Note& note : part.answer.notes) {
      if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    }
  }
  return notes;
}

bool is_same_device(const DeviceDescription& x, const DeviceDescription& y) {
  return x.index == y.index && x.name == y.name && x.type == y.type &&
         x.api_version == y.api_version && x.memory_bytes == y.memory_bytes;
}

/// The devices besides the first one, which is that of the witness's part.
std::vector<DeviceDescription> devices_besides(const DeviceDescription& first,
                                               const std::vector<Part>& parts) {
  std::vector<DeviceDescription> devices;
  const auto add = [&](const DeviceDescription& device) {
    const auto is_it = [&](const DeviceDescription& x) { return is_same_device(x, device); };
    if (!device.name.empty() && !is_it(first) &&
        std::none_of(devices.begin(), devices.end(), is_it))
      devices.push_back(device);
  };
  for (const Part& part : parts) {
    add(part.answer.a_to_b.device);
    for (const DeviceDescription& device : part.answer.a_to_b.more_devices) add(device);
  }
  return devices;
}

/// The words as the user typed them, without options of one part alone.
std::vector<std::string> arguments_of(const std::vector<std::string>& typed) {
  std::vector<std::string> out;
  for (size_t i = 0; i < typed.size(); ++i) {
    const std::string& word = typed[i];
    const bool is_alone = word == "--part" || word == "--known-lower";
    if (is_alone) ++i;
    if (!is_alone && !word.starts_with("--part=") && !word.starts_with("--known-lower="))
      out.push_back(word);
  }
  return out;
}

void join_times(const Answer& part, Answer& whole) {
  whole.waits.read = std::max(whole.waits.read, part.waits.read);
  whole.waits.start = std::max(whole.waits.start, part.waits.start);
  whole.waits.total = std::max(whole.waits.total, part.waits.total);
  whole.started = std::min(whole.started, part.started);
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
      Json json = parse_json(line);
      if (parts.empty() && !is_part(json)) return {};
      if (json.is_discarded()) reject(path, place, vkh::quoted(line), "a JSON object a line");
      parts.push_back({path, place, std::move(json)});
    }
    if (file.bad()) throw InputError({.file = path, .problem = "cannot be read"});
  }
  return parts;
}

Answer merge_parts(const std::vector<WrittenAnswer>& written) {
  const FloatEnvironment ours;
  const std::vector<Part> parts = checked(written);
  Answer whole = farthest(parts).answer;
  whole.a_to_b = whole_of(parts);
  whole.a_to_b.more_devices = devices_besides(whole.a_to_b.device, parts);
  whole.notes = notes_of_all(parts);
  whole.words = arguments_of(whole.words);
  whole.first_line.clear();
  whole.part.reset();
  whole.parts = parts.size();
  for (const Part& part : parts) join_times(part.answer, whole);
  return whole;
}

}  // namespace vkh
