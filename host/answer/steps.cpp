#include "host/answer/steps.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>
#include <limits>

#include "host/answer/pair_notes.h"
#include "host/answer/rules.h"
#include "host/base/decimal.h"
#include "host/base/reject.h"
#include "host/base/rounding.h"
#include "host/base/system.h"
#include "host/read/transform.h"
#include "host/solve/switches.h"
#include "host/survey/statistics.h"
#include "vkhausdorff/align.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/note.h"
#include "vkhausdorff/place.h"

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

/// What the polygons leave open may have grown since the file was read: place().
std::vector<Note> notes_on(const ReadMesh& mesh) {
  std::vector<Note> notes = mesh.notes;
  for (Note& note : notes) {
    if (note.code == NoteCode::kAmbiguity) note = note_on_ambiguity(mesh.polygons);
  }
  return notes;
}

Input input_of(const ReadMesh& mesh) {
  return {.path = mesh.name,
          .is_read = true,
          .are_points = mesh.are_points,
          .counts = mesh.counts,
          .place = {mesh.delta, mesh.unit},
          .notes = notes_on(mesh)};
}

/// The unit of a mesh: its file's own, else the one in the request; empty if it is unknown. A unit
/// for one of both files may not contradict it.
std::string unit_of(const Question& question, const Mesh& mesh, bool is_b) {
  if (mesh.placed) return mesh.unit;
  const std::string& own = is_b ? question.unit_b : question.unit_a;
  if (!mesh.unit.empty() && !own.empty() && mesh.unit != own)
    throw UsageError(question.option(is_b ? "unit-b" : "unit-a") + " " + own + ": " + mesh.name +
                     " is in " + mesh.unit);
  if (!mesh.unit.empty()) return mesh.unit;
  return own.empty() ? question.unit : own;
}

/// Refuses a unit for files without one where both have another.
void check_unit_is_used(const Question& question, const Mesh& a, const Mesh& b) {
  if (question.unit.empty() || a.placed || a.unit.empty() || b.unit.empty()) return;
  if (a.unit == question.unit || b.unit == question.unit) return;
  throw UsageError(question.option("unit") + " " + question.unit + ": " + a.name + " is in " +
                   a.unit + ", and " + b.name + " in " + b.unit);
}

struct Units {
  std::string a, b;
  bool differ() const { return !a.empty() && !b.empty() && a != b; }
};

Units units_of(const Question& question, const Mesh& a, const Mesh& b) {
  check_unit_is_used(question, a, b);
  return {unit_of(question, a, false), unit_of(question, b, true)};
}

std::vector<Note> notes_on_units(const Mesh& a, const Units& units) {
  if (a.placed && a.placed->from != a.unit)
    return {note_of(NoteCode::kConverted, "A was converted from " + a.placed->from + " to " +
                                              a.unit + ", in which B is")};
  if (units.a == units.b) return {};
  const bool a_says = !units.a.empty();
  return {note_of(NoteCode::kUnitAssumed, std::string(a_says ? "B" : "A") +
                                              "'s file does not say what it is in: taken as " +
                                              (a_says ? units.a : units.b) + ", as " +
                                              (a_says ? "A" : "B") + " is")};
}

}  // namespace

Answer unread_answer(const Question& question) {
  check_question(question);
  Answer known;
  static_cast<Stated&>(known) = question;
  known.started = utc_now();
  known.host = host_name();
  known.inputs[0].path = question.file_a;
  known.inputs[1].path = question.file_b;
  if (question.max)
    known.max = Asked{.length = *question.max,
                      .limit = {},
                      .area = question.area,
                      .area_requested = question.area_requested};
  if (question.max_sides)
    known.max->sides = AskedSides{question.max_sides->over, question.max_sides->under, {}};
  // The limits are undecided until more is known: an earlier answer must not forget them.
  if (!question.face_max_a.empty()) known.max->faces_a = FaceLimits{.path = question.face_max_a};
  if (!question.face_max_b.empty()) known.max->faces_b = FaceLimits{.path = question.face_max_b};
  known.a_to_b.upper = std::numeric_limits<double>::infinity();
  if (question.metrics) {
    Metrics& metrics = known.metrics.emplace();
    metrics.percentile = question.metrics->percentile;
    metrics.figures = question.metrics->figures;
    metrics.normals = question.metrics->normals;
  }
  if (question.symmetric) known.b_to_a = known.a_to_b;
  return known;
}

namespace {

// Refuses a share of no area, which is no question.
void check_area(const Question& question, const Mesh& mesh) {
  if (question.metrics && (mesh.are_points || !areas_of(mesh).is_positive()))
    reject(mesh.name, "", mesh.are_points ? "points" : "faces without area",
           "a surface: metrics weigh distances by area");
  if (!question.max || !question.area || areas_of(mesh).is_positive()) return;
  reject(mesh.name, "", "faces without area",
         "a surface, of which --area " + question.area_requested + " asks a share");
}

// Refuses what a surface alone has.
void check_points(const Question& question, const Mesh& a, const Mesh& b) {
  const auto check_from = [&](const Mesh& from, const Mesh& to) {
    if (question.asks_for_sides()) refuse_points(to, question.option("signed"), "sides");
    if (question.is_by_face()) refuse_points(from, question.option("face-max"), "faces");
  };
  check_from(a, b);
  if (question.symmetric) check_from(b, a);
}

// Corners that are off a plane by less than a tenth of the tolerance, as decimals of a slanted
// plane are, make no difference. The interval says so itself where it is wider by them.
void drop_small_ambiguities(double tolerance, Input& input) {
  std::erase_if(input.notes, [&](const Note& note) {
    return note.code == NoteCode::kAmbiguity && *note.value <= 0.1 * tolerance;
  });
}

std::optional<PlacedInput> placed_of(const Question& question, const Mesh& a) {
  if (!a.placed) return std::nullopt;
  return PlacedInput{.by = a.placed->by,
                     .from = a.placed->from,
                     .file = question.transform_file,
                     .fit = a.placed->fit};
}

/// A figure as people read it: rounded up, and its unit.
std::string rms_text(double rms, const Answer& answer) {
  return with_unit(decimal(rms, 3, Rounding::kUp), answer.unit);
}

/// A fit is no proof: what it found is told with it.
void add_notes_on_fit(Answer& answer) {
  if (!answer.placed || !answer.placed->fit) return;
  const FoundFit& fit = *answer.placed->fit;
  const std::string share = number_text(100 * fit.share, std::chars_format::general, 3) + " %";
  answer.notes.push_back(note_of(NoteCode::kFit,
                                 "A was moved by a fit that was found, not proven the best: " +
                                     share + " of its samples count, and lie " +
                                     rms_text(fit.rms, answer) + " from B (root mean square)",
                                 {fit.rms, answer.unit}));
  if (fit.is_poor)
    answer.notes.push_back(
        note_of(NoteCode::kPoorFit,
                "the fit is far from B, or of a part of A: look at it, or give a start by "
                "--transform"));
  if (fit.rival)
    answer.notes.push_back(note_of(NoteCode::kOtherFit,
                                   "another place of A is about as close to B (" +
                                       rms_text(*fit.rival, answer) + "): is the part symmetric?",
                                   {*fit.rival, answer.unit}));
  if (fit.mirrored)
    answer.notes.push_back(note_of(
        NoteCode::kMirrored,
        "A looks like a mirror image of B: mirrored, all of it would lie " +
            rms_text(*fit.mirrored, answer) + " from B (root mean square): was one axis reversed?",
        {*fit.mirrored, answer.unit}));
}

/// From a surface to points the farthest places lie between points.
void add_note_on_points(const Question& question, const Mesh& a, const Mesh& b, Answer& answer) {
  const bool to_b = b.are_points && !a.are_points;
  const bool to_a = question.symmetric && a.are_points && !b.are_points;
  if (!to_a && !to_b) return;
  answer.notes.push_back(
      note_of(NoteCode::kPoints,
              std::string(to_b ? "A to B" : "B to A") +
                  " is to points: it is no less than the gaps between them, and is slow to close"));
}

/// A matrix that stretches by s moves points by s times their distance from the origin. That counts
/// from a tenth of the tolerance on.
void add_note_on_stretch(const Box& box, Answer& answer) {
  if (!answer.placed || !answer.placed->by.matrix) return;
  const double stretch = 1.5 * stretch_of(*answer.placed->by.matrix);
  glm::dvec3 farthest;
  for (int i = 0; i < 3; ++i) farthest[i] = std::max(std::abs(box.lo[i]), std::abs(box.hi[i]));
  const double moved = stretch * glm::length(farthest);
  if (!(moved > 0.1 * answer.a_to_b.tolerance)) return;
  if (!std::isfinite(moved)) {
    answer.notes.push_back(
        note_of(NoteCode::kStretch,
                "the matrix is no exact rotation: it stretches A by more than 1e308 %"));
    return;
  }
  answer.notes.push_back(note_of(NoteCode::kStretch,
                                 "the matrix is no exact rotation: it stretches A by up to " +
                                     decimal(100 * stretch, 3, Rounding::kUp) +
                                     " %, which moves its points by up to " +
                                     with_unit(decimal(moved, 3, Rounding::kUp), answer.unit),
                                 {moved, answer.unit}));
}

}  // namespace

Enclosure range_in_files(const std::array<Length, 2>& range, const Answer& answer) {
  const auto resolved = [&](const Length& length) {
    return length.number == 0
               ? 0
               : in_files(length, "--range", answer.unit, diagonal_of_a(answer)).within;
  };
  const Enclosure ends{resolved(range[0]), resolved(range[1])};
  if (ends.lower > ends.upper)
    throw UsageError("--range '" + range[0].requested + "," + range[1].requested +
                     "': expected the shorter length first");
  return ends;
}

namespace {

/// Resolves limits that differ by side: the larger one is what no point may exceed.
void take_sides(const Question& question, const Diagonal& of_a, Answer& answer) {
  AskedSides& sides = *answer.max->sides;
  const std::string option = question.option("max");
  sides.limits = {limit_in_files(sides.over, option.c_str(), answer.unit, of_a),
                  limit_in_files(sides.under, option.c_str(), answer.unit, of_a)};
  answer.max->limit = sides.limits.larger();
  const bool is_over = sides.limits.over.within > sides.limits.under.within;
  answer.max->length = is_over ? sides.over : sides.under;
}

}  // namespace

bool is_placed(const Question& question, const Mesh& a, const Mesh& b) {
  if (a.placed) return false;
  return question.align || question.transform || !question.transform_file.empty() ||
         units_of(question, a, b).differ();
}

namespace {

struct AskedPlace {
  MeshTransform by;
  std::string unit;  ///< of the outcome
};

/// The unit and the matrix that the question has for A.
AskedPlace placement_of(const Question& question, const Mesh& a, const Mesh& b) {
  MeshTransform placement{.matrix = question.transform};
  std::string name = question.option("transform");
  if (!question.transform_file.empty()) {
    name = question.transform_file;
    if (!placement.matrix) placement.matrix = read_matrix(path_of(name));
  }
  if (placement.matrix) check_matrix(name, *placement.matrix, question.may_stretch);
  const Units units = units_of(question, a, b);
  if (units.differ()) {
    const UnitRatio ratio = unit_ratio(units.a, units.b);
    placement.numerator = ratio.numerator;
    placement.denominator = ratio.denominator;
  }
  return {placement, units.differ() ? units.b : units.a};
}

void place_by(const Question& question, const AskedPlace& placement, const Units& units, Mesh& a) {
  a.unit = units.a;
  place(a, placement.by, placement.unit, question.certificate);
}

/// Where the question has put A before a fit: A itself, or a copy.
const Mesh& start_of(const AskedPlace& placement, const Mesh& a, std::optional<Mesh>& moved) {
  if (placement.by.is_identity()) return a;
  moved.emplace(a);
  place(*moved, placement.by, placement.unit, false);
  return *moved;
}

}  // namespace

void place_a(const Question& question, Mesh& a, const Mesh& b) {
  if (question.align || !is_placed(question, a, b)) return;
  place_by(question, placement_of(question, a, b), units_of(question, a, b), a);
}

void fit_a(const Question& question, Solver& solver, const Observer& observer,
           const FitMeshes& meshes) {
  auto& [a, b, prepared] = meshes;
  if (a.placed || !question.align) return;
  const Units units = units_of(question, a, b);
  AskedPlace placement = placement_of(question, a, b);
  AlignOptions options;
  options.goes_on = [&observer](size_t) { return observer.is_to_go_on(); };
  solver.make_ready(engine_of(question));
  std::optional<Mesh> moved;
  const Mesh& start = start_of(placement, a, moved);
  const Alignment found = prepared != nullptr ? align(solver, start, *prepared, options)
                                              : align(solver, start, b, options);
  moved.reset();
  std::optional<MatrixRows>& matrix = placement.by.matrix;
  matrix = matrix ? scene::compose({.m = found.matrix}, {.m = *matrix}).m : found.matrix;
  place_by(question, placement, units, a);
  a.placed->fit = found.fit;
}

ShapedMesh shaped(std::shared_ptr<const ReadMesh> mesh) {
  const MeshShape shape = shape_of(*mesh);
  return {std::move(mesh), shape};
}

void take_meshes(const Question& question, const ShapedMesh& shaped_a, const ShapedMesh& shaped_b,
                 Answer& answer) {
  const ReadMesh &a = *shaped_a.mesh, &b = *shaped_b.mesh;
  const MeshShape &shape_a = shaped_a.shape, &shape_b = shaped_b.shape;
  const Box &box_a = shape_a.box, &box_b = shape_b.box;
  const Units units = units_of(question, a, b);
  if (units.differ())
    throw UsageError("A is in " + units.a + " and B in " + units.b + ": convert one of them");
  check_points(question, a, b);
  check_area(question, a);
  if (question.symmetric) check_area(question, b);
  const double farthest = farthest_in(join(box_a, box_b), add_up(a.delta, b.delta));
  const Diagonal of_a(diagonal(box_a), a.delta);
  answer.inputs = {input_of(a), input_of(b)};
  answer.unit = units.b.empty() ? units.a : units.b;
  answer.notes = notes_on_units(a, units);
  answer.placed = placed_of(question, a);
  answer.inputs[0].box = box_a;
  answer.inputs[1].box = box_b;
  const bool is_fitted = a.placed && a.placed->fit;
  for (Note& note :
       notes_on_pair(shape_a, shape_b, answer.unit, question.option("unit"), is_fitted))
    answer.notes.push_back(std::move(note));
  for (Report* r : {&answer.a_to_b, answer.b_to_a ? &*answer.b_to_a : nullptr}) {
    if (r == nullptr) continue;
    r->diagonal_a = of_a.held();
    r->upper = farthest;
    r->tolerance =
        in_files(question.tolerance, question.option("tol").c_str(), answer.unit, of_a).within;
  }
  if (question.map_range) (void)range_in_files(*question.map_range, answer);
  add_note_on_stretch(box_a, answer);
  add_notes_on_fit(answer);
  add_note_on_points(question, a, b, answer);
  for (Input& input : answer.inputs) drop_small_ambiguities(answer.a_to_b.tolerance, input);
  // A run with a limit may end by that, whatever its tolerance is.
  const bool is_share = question.tolerance.of == Length::Of::kDiagonal;
  if (is_share && of_a.held() == 0 && !question.max)
    answer.notes.push_back(
        note_of(NoteCode::kTolerance, "A is one point, so that " + question.tolerance.requested +
                                          " of its diagonal is 0: give " + question.option("tol") +
                                          " as a length, such as "
                                          "1e-6abs"));
  if (question.max)
    answer.max->limit =
        limit_in_files(*question.max, question.option("max").c_str(), answer.unit, of_a);
  if (question.max_sides) take_sides(question, of_a, answer);
  if (!question.face_max_a.empty()) answer.max->faces_a->faces = a.faces.size();
  if (!question.face_max_b.empty()) answer.max->faces_b->faces = b.faces.size();
}

EngineOptions engine_of(const Question& question) {
  const Length& tolerance = question.tolerance;
  EngineOptions engine = question.engine;
  const bool is_fine = tolerance.of == Length::Of::kDiagonal && tolerance.number < kFineTolerance;
  engine.fine = engine.fine || is_fine;
  engine.cells = engine.cells || question.asks_for_cells();
  engine.closest = engine.closest || question.align;
  engine.coverage = engine.coverage || question.verify;
  return engine;
}

SolveOptions run_options(const Question& question) {
  return {.time_limit_s = question.budget.time_limit_s,
          .wave_limit = question.budget.wave_limit,
          .memory_bytes = question.budget.memory_bytes,
          .engine = question.engine};
}

SolveOptions solve_options(const Question& question, const Answer& known) {
  SolveOptions options = run_options(question);
  options.engine = engine_of(question);
  options.tolerance_is_absolute = question.tolerance.of != Length::Of::kDiagonal;
  options.tolerance =
      options.tolerance_is_absolute ? known.a_to_b.tolerance : question.tolerance.number;
  // The survey decides a question about area.
  if (known.max && !known.max->area) options.limit = known.max->limit;
  // The surveys bound each distance: a search would narrow the largest one alone.
  if (question.metrics && !question.metrics->asks_for({"hausdorff"}))
    options.wave_limit = std::min(options.wave_limit, 1u);
  if (question.known_lower)
    options.known_lower =
        limit_in_files(*question.known_lower, question.option("known-lower").c_str(), known.unit,
                       diagonal_of_a(known))
            .within;
  return options;
}

void take_reports(const Question& question, StreamResult&& result, Answer& answer) {
  answer.a_to_b = std::move(result.a_to_b);
  answer.b_to_a = std::move(result.b_to_a);
  add_memory_notes(question.budget.memory_bytes, answer);
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
