// Where A lies: the steps that convert its unit, place it by a matrix, and fit it.
#include "host/answer/placing.h"

#include "host/answer/steps.h"
#include "host/base/system.h"
#include "host/read/transform.h"
#include "vkhausdorff/align.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/place.h"

namespace vkh {

namespace {

/// The unit of a mesh: its file's own, or else the question's; empty if it is unknown. A unit
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

Units units_of(const Question& question, const Mesh& a, const Mesh& b) {
  check_unit_is_used(question, a, b);
  return {unit_of(question, a, false), unit_of(question, b, true)};
}

bool is_placed(const Question& question, const Mesh& a, const Mesh& b) {
  if (a.placed) return false;
  return question.align || question.transform || !question.transform_file.empty() ||
         units_of(question, a, b).differ();
}

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

}  // namespace vkh
