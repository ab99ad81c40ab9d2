// The steps that begin an answer: before anything is read, and once both meshes are.
#include <ctime>
#include <limits>

#include "host/answer/mesh_notes.h"
#include "host/answer/pair_notes.h"
#include "host/answer/placing.h"
#include "host/answer/rules.h"
#include "host/answer/steps.h"
#include "host/base/reject.h"
#include "host/base/rounding.h"
#include "host/base/system.h"
#include "host/survey/statistics.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/note.h"
#include "vkhausdorff/polygon.h"

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

/// The notes on a mesh's file. The one on ambiguous polygons is made again, since place() may have
/// changed their ambiguity.
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

// Refuses a share of a mesh without area.
void check_area(const Question& question, const Mesh& mesh) {
  if (question.metrics && (mesh.are_points || !areas_of(mesh).is_positive()))
    reject(mesh.name, "", mesh.are_points ? "points" : "faces without area",
           "a surface: metrics weigh distances by area");
  if (!question.max || !question.area || areas_of(mesh).is_positive()) return;
  reject(mesh.name, "", "faces without area",
         "a surface, of which --area " + question.area_requested + " asks a share");
}

// Refuses, for points, what only a surface has.
void check_points(const Question& question, const Mesh& a, const Mesh& b) {
  const auto check_from = [&](const Mesh& from, const Mesh& to) {
    if (question.asks_for_sides()) refuse_points(to, question.option("signed"), "sides");
    if (question.is_by_face()) refuse_points(from, question.option("face-max"), "faces");
  };
  check_from(a, b);
  if (question.symmetric) check_from(b, a);
}

// Corners that are off a plane by less than a tenth of the tolerance, as decimals of a slanted
// plane are, make no difference. With any_triangulation the interval itself is wider by them.
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

/// Resolves limits that differ by side: the larger one is what no point may exceed.
void resolve_sides(const Question& question, const Diagonal& of_a, Answer& answer) {
  AskedSides& sides = *answer.max->sides;
  const std::string option = question.option("max");
  sides.limits = {limit_in_files(sides.over, option.c_str(), answer.unit, of_a),
                  limit_in_files(sides.under, option.c_str(), answer.unit, of_a)};
  answer.max->limit = sides.limits.larger();
  const bool is_over = sides.limits.over.within > sides.limits.under.within;
  answer.max->length = is_over ? sides.over : sides.under;
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

ShapedMesh shaped(std::shared_ptr<const ReadMesh> mesh) {
  const MeshShape shape = shape_of(*mesh);
  return {std::move(mesh), shape};
}

void begin_answer(const Question& question, const ShapedMesh& shaped_a, const ShapedMesh& shaped_b,
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
  // A run with a limit may end by the limit, at any tolerance.
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
  if (question.max_sides) resolve_sides(question, of_a, answer);
  if (!question.face_max_a.empty()) answer.max->faces_a->faces = a.faces.size();
  if (!question.face_max_b.empty()) answer.max->faces_b->faces = b.faces.size();
}

}  // namespace vkh
