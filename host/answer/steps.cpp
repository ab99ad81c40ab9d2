#include "host/answer/steps.h"

#include <algorithm>
#include <ctime>
#include <limits>

#include "host/answer/pair_notes.h"
#include "host/base/error.h"
#include "host/base/note.h"
#include "host/base/rounding.h"
#include "host/base/system.h"
#include "host/solve/frame.h"
#include "host/survey/statistics.h"

namespace vkh {

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
std::string unit_of(const Question& question, const Mesh& a, const Mesh& b) {
  for (const Mesh* mesh : {&a, &b}) {
    if (!question.unit.empty() && !mesh->unit.empty() && mesh->unit != question.unit)
      throw UsageError("--unit " + question.unit + ": " + mesh->name + " is in " + mesh->unit);
  }
  if (!question.unit.empty()) return question.unit;
  if (a.unit == b.unit || b.unit.empty()) return a.unit;
  return a.unit.empty() ? b.unit : "";
}

std::vector<Note> notes_on_units(const Question& question, const std::string& a,
                                 const std::string& b) {
  if (a == b || !question.unit.empty()) return {};
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
void check_units(const Question& question, const std::string& a, const std::string& b) {
  if (question.max && !a.empty() && !b.empty() && a != b)
    throw UsageError("gate: A is in " + a + " and B in " + b + ": convert one of them");
}

}  // namespace

Answer unread_answer(const Question& question) {
  Answer known;
  known.command = question.command;
  known.words = question.words;
  known.started = utc_now();
  known.host = host_name();
  known.part = question.part;
  known.inputs[0].path = question.file_a;
  known.inputs[1].path = question.file_b;
  known.tolerance = question.tolerance;
  if (question.max)
    known.max = Asked{.length = *question.max,
                      .limit = {},
                      .area = question.area,
                      .area_requested = question.area_requested};
  // The limits are undecided until more is known: an earlier answer must not forget them.
  if (!question.face_max_a.empty()) known.max->faces_a = FaceLimits{.path = question.face_max_a};
  if (!question.face_max_b.empty()) known.max->faces_b = FaceLimits{.path = question.face_max_b};
  known.a_to_b.upper = std::numeric_limits<double>::infinity();
  if (question.symmetric) known.b_to_a = known.a_to_b;
  return known;
}

namespace {

// Refuses a share of no area, which is no question.
void check_area(const Question& question, const Mesh& mesh) {
  if (!question.max || !question.area || areas_of(mesh).is_positive()) return;
  throw InputError(mesh.name + ": faces without area; expected a surface, of which --area " +
                   question.area_requested + " asks a share");
}

}  // namespace

namespace {

// Corners that are off a plane by less than a tenth of the tolerance, as decimals of a slanted
// plane are, make no difference. The interval says so itself where it is wider by them.
void drop_small_ambiguities(double tolerance, Input& input) {
  std::erase_if(input.notes, [&](const Note& note) {
    return note.code == NoteCode::kAmbiguity && *note.value <= 0.1 * tolerance;
  });
}

}  // namespace

double take_meshes(const Question& question, const Mesh& a, const Mesh& b, Answer& answer) {
  return take_meshes(question, {a, bounding_box(a)}, {b, bounding_box(b)}, answer);
}

double take_meshes(const Question& question, const BoxedMesh& boxed_a, const BoxedMesh& boxed_b,
                   Answer& answer) {
  const auto& [a, box_a] = boxed_a;
  const auto& [b, box_b] = boxed_b;
  check_units(question, a.unit, b.unit);
  check_area(question, a);
  if (question.symmetric) check_area(question, b);
  const double farthest = farthest_in(join(box_a, box_b), add_up(a.delta, b.delta));
  const double diagonal_a = diagonal(box_a);
  answer.inputs = {input_of(a), input_of(b)};
  answer.unit = unit_of(question, a, b);
  answer.notes = notes_on_units(question, a.unit, b.unit);
  answer.inputs[0].box = box_a;
  answer.inputs[1].box = box_b;
  for (Note& note : notes_on_boxes(box_a, box_b, answer.unit))
    answer.notes.push_back(std::move(note));
  for (Report* r : {&answer.a_to_b, answer.b_to_a ? &*answer.b_to_a : nullptr}) {
    if (r == nullptr) continue;
    r->diagonal_a = diagonal_a;
    r->upper = farthest;
    r->tolerance =
        in_files(question.tolerance, question.option("tol").c_str(), answer.unit, diagonal_a)
            .within;
  }
  for (Input& input : answer.inputs) drop_small_ambiguities(answer.a_to_b.tolerance, input);
  // A run with a limit may end by that, whatever its tolerance is.
  const bool is_share = question.tolerance.of == Length::Of::kDiagonal;
  if (is_share && diagonal_a == 0 && !question.max)
    answer.notes.push_back(
        note_of(NoteCode::kTolerance, "A is one point, so that " + question.tolerance.requested +
                                          " of its diagonal is 0: give " + question.option("tol") +
                                          " as a length, such as "
                                          "1e-6abs"));
  if (question.max)
    answer.max->limit =
        limit_in_files(*question.max, question.option("max").c_str(), answer.unit, diagonal_a);
  if (!question.face_max_a.empty()) answer.max->faces_a->faces = a.faces.size();
  if (!question.face_max_b.empty()) answer.max->faces_b->faces = b.faces.size();
  return farthest;
}

SolveOptions solve_options(const Question& question, const Answer& known) {
  SolveOptions options = question.options;
  options.tolerance_is_absolute = question.tolerance.of != Length::Of::kDiagonal;
  options.tolerance =
      options.tolerance_is_absolute ? known.a_to_b.tolerance : question.tolerance.number;
  // The survey decides a question about area.
  if (known.max && !known.max->area) options.limit = known.max->limit;
  options.coverage = question.verify;
  if (question.known_lower)
    options.known_lower =
        limit_in_files(*question.known_lower, question.option("known-lower").c_str(), known.unit,
                       known.a_to_b.diagonal_a)
            .within;
  return options;
}

void take_reports(const Question& question, StreamResult&& result, Answer& answer) {
  answer.a_to_b = std::move(result.a_to_b);
  answer.b_to_a = std::move(result.b_to_a);
  add_memory_notes(question.options.memory_bytes, answer);
  answer.waits.total = answer.waits.read + answer.a_to_b.times.wall_ms +
                       (answer.b_to_a ? answer.b_to_a->times.wall_ms : 0);
}

bool is_cancelled(const Answer& answer) {
  return answer.a_to_b.status == Status::kCancelled ||
         (answer.b_to_a && answer.b_to_a->status == Status::kCancelled);
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
