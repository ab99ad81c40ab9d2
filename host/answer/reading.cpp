#include "host/answer/reading.h"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <filesystem>
#include <limits>
#include <memory>

#include "host/answer/session.h"
#include "host/base/begin_now.h"
#include "host/base/error.h"
#include "host/base/note.h"
#include "host/base/rounding.h"
#include "host/base/system.h"
#include "host/read/mesh_io.h"
#include "host/solve/frame.h"
#include "host/survey/statistics.h"

namespace vkh {

MeshPair read_pair(const std::string& file_a, const std::string& file_b, ReadLimits limits,
                   const std::shared_ptr<const Reading>& reading) {
  constexpr uint64_t kWorthwhile = 100'000'000;  // about a second on one core
  uint64_t bytes = 0;
  for (const std::string& file : {file_a, file_b}) {
    std::error_code none;
    const uintmax_t size = std::filesystem::file_size(path_of(file), none);
    if (!none) bytes += size;
  }
  const auto bytes_read = std::make_shared<std::atomic<uint64_t>>(0);
  limits.bytes_read = bytes_read.get();
  limits.keep_going = [bytes_read, bytes, reading] {
    if (bytes >= kWorthwhile) reading->line.show_reading(*bytes_read, bytes);
    return !reading->stop.is_asked();
  };
  auto b = begin_now([file_b, limits] { return read_mesh(path_of(file_b), limits); });
  MeshPair pair{read_mesh(path_of(file_a), limits), {}};
  pair.b = b.get();
  return pair;
}

namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
#ifdef _WIN32
  const bool is_known = gmtime_s(&parts, &now) == 0;
#else
  const bool is_known = gmtime_r(&now, &parts) != nullptr;
#endif
  char text[32] = "";
  if (is_known) std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

Input input_of(const Mesh& mesh) {
  return {.path = mesh.name,
          .is_read = true,
          .counts = mesh.counts,
          .place = {mesh.delta, mesh.unit},
          .notes = mesh.notes};
}

/// The unit of a pair's lengths: the files' own, else the one in the request.
std::string unit_of(const PairJob& job, const Mesh& a, const Mesh& b) {
  for (const Mesh* mesh : {&a, &b}) {
    if (!job.unit.empty() && !mesh->unit.empty() && mesh->unit != job.unit)
      throw UsageError("--unit " + job.unit + ": " + mesh->name + " is in " + mesh->unit);
  }
  if (!job.unit.empty()) return job.unit;
  if (a.unit == b.unit || b.unit.empty()) return a.unit;
  return a.unit.empty() ? b.unit : "";
}

std::vector<std::string> pair_notes(const PairJob& job, const std::string& a,
                                    const std::string& b) {
  if (a == b || !job.unit.empty()) return {};
  if (!a.empty() && !b.empty())
    return {note_of(NoteCode::kUnitsDiffer,
                    "A is in " + a + " and B in " + b + ": neither was converted")};
  const bool a_says = !a.empty();
  return {note_of(NoteCode::kUnitAssumed, std::string(a_says ? "B" : "A") +
                                              "'s file does not say what it is in: taken as " +
                                              (a_says ? a : b) + ", as " + (a_says ? "A" : "B") +
                                              " is")};
}

/// Refuses a verdict on lengths of unknown units, which would be none.
void check_units(const PairJob& job, const std::string& a, const std::string& b) {
  if (job.max && !a.empty() && !b.empty() && a != b)
    throw UsageError("gate: A is in " + a + " and B in " + b + ": convert one of them");
}

}  // namespace

Answer unread_answer(const PairJob& job) {
  Answer known;
  known.command = job.command;
  known.words = job.words;
  known.started = utc_now();
  known.host = host_name();
  known.part = job.part;
  known.inputs[0].path = job.file_a;
  known.inputs[1].path = job.file_b;
  known.tolerance = job.tolerance;
  if (job.max)
    known.max = Asked{.length = *job.max,
                      .limit = {},
                      .area = job.survey.area,
                      .area_requested = job.survey.area_requested};
  // The limits are undecided until more is known: an earlier answer must not forget them.
  if (!job.face_max_a.empty()) known.max->faces_a = FaceLimits{.path = job.face_max_a};
  if (!job.face_max_b.empty()) known.max->faces_b = FaceLimits{.path = job.face_max_b};
  known.a_to_b.upper = std::numeric_limits<double>::infinity();
  if (job.symmetric) known.b_to_a = known.a_to_b;
  return known;
}

namespace {

// Refuses a share of no area, which is no question.
void check_area(const PairJob& job, const Mesh& mesh) {
  if (!job.max || !job.survey.area || areas_of(mesh).is_positive()) return;
  throw InputError(mesh.name + ": faces without area; expected a surface, of which --area " +
                   job.survey.area_requested + " asks a share");
}

}  // namespace

double take_meshes(const PairJob& job, const Mesh& a, const Mesh& b, Answer& answer) {
  check_units(job, a.unit, b.unit);
  check_area(job, a);
  if (job.symmetric) check_area(job, b);
  const Box box_a = bounding_box(a);
  const double farthest = farthest_in(join(box_a, bounding_box(b)), add_up(a.delta, b.delta));
  const double diagonal_a = diagonal(box_a);
  answer.inputs = {input_of(a), input_of(b)};
  answer.unit = unit_of(job, a, b);
  answer.notes = pair_notes(job, a.unit, b.unit);
  for (Report* r : {&answer.a_to_b, answer.b_to_a ? &*answer.b_to_a : nullptr}) {
    if (r == nullptr) continue;
    r->diagonal_a = diagonal_a;
    r->upper = farthest;
    r->tolerance = in_files(job.tolerance, "--tol", answer.unit, diagonal_a).within;
  }
  // A run with a limit may end by that, whatever its tolerance is.
  const bool is_share = job.tolerance.of == Length::Of::kDiagonal;
  if (is_share && diagonal_a == 0 && !job.max)
    answer.notes.push_back(
        note_of(NoteCode::kTolerance, "A is one point, so that " + job.tolerance.requested +
                                          " of its diagonal is 0: give --tol as a length, such as "
                                          "1e-6abs"));
  if (job.max) answer.max->limit = limit_in_files(*job.max, "--max", answer.unit, diagonal_a);
  if (!job.face_max_a.empty()) answer.max->faces_a->faces = a.faces.size();
  if (!job.face_max_b.empty()) answer.max->faces_b->faces = b.faces.size();
  return farthest;
}

SolveOptions asked_options(const PairJob& job, const Answer& known) {
  SolveOptions options = job.options;
  options.tolerance_is_absolute = job.tolerance.of != Length::Of::kDiagonal;
  options.tolerance = options.tolerance_is_absolute ? known.a_to_b.tolerance : job.tolerance.number;
  // The survey decides a question about area.
  if (known.max && !known.max->area) options.limit = known.max->limit;
  options.coverage = job.verify;
  if (job.known_lower)
    options.known_lower =
        limit_in_files(*job.known_lower, "--known-lower", known.unit, known.a_to_b.diagonal_a)
            .within;
  return options;
}

void add_memory_notes(uint64_t asked, Answer& answer) {
  const auto most = [&](uint64_t Report::*bytes) {
    return std::max(answer.a_to_b.*bytes, answer.b_to_a ? (*answer.b_to_a).*bytes : 0);
  };
  const uint64_t in_host = most(&Report::host_memory_bytes);
  if (in_host > 0) {
    answer.notes.push_back(
        note_of(NoteCode::kMemory, "the device has too little memory: it reads " +
                                       std::to_string((in_host + 0xfffff) >> 20) +
                                       " MiB from the host's, slowly"));
  }
  const uint64_t taken = most(&Report::workspace_bytes);
  if (asked > 0 && taken > asked) {
    answer.notes.push_back(
        note_of(NoteCode::kMemory, "--memory is less than a search can do with: " +
                                       std::to_string((taken + 1023) >> 10) + " KiB were taken"));
  }
}

}  // namespace vkh
