// The steps from a question and its meshes to an answer. Each stands here once: the command line,
// a batch and Python call them with solvers of their own.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>

#include "host/answer/pair_notes.h"
#include "vkhausdorff/answer.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/question.h"
#include "vkhausdorff/solver.h"
#include "vkhausdorff/stream.h"
#include "vkhausdorff/work_meter.h"

namespace vkh {

/// Hears of a question's progress, on the working threads, and may end it. Any of the functions may
/// be empty.
struct Observer {
  std::function<bool()> goes_on = {};                ///< false: end, with a true answer
  std::function<double()> left_s = {};               ///< the seconds left for all of it
  std::function<bool(const Progress&)> search = {};  ///< of the search; false: end
  std::function<void(const SideCount&)> cells = {}, leaves = {};  ///< of a survey; a certificate
  /// Hears the answer after the search, after the search for the worst point, and after surveys.
  std::function<void(const Answer&)> found = {};

  bool is_to_go_on() const { return !goes_on || goes_on(); }
  double time_left_s() const;  ///< infinite where there is no limit
};

/// Two meshes that the caller keeps. `prepared`: B on the device of the one solver, or null.
/// `kept`: for h(a, b) and h(b, a), if later steps should reuse the meshes as the solver has framed
/// them.
struct AskedMeshes {
  const Mesh& a;
  const Mesh& b;
  const PreparedMesh* prepared = nullptr;
  std::array<KeptPair, 2>* kept = nullptr;

  /// h(a, b), or h(b, a).
  PairView view(bool back = false) const {
    KeptPair* const own = kept != nullptr ? &(*kept)[back ? 1 : 0] : nullptr;
    if (back) return {.a = b, .b = a, .kept = own};
    return {.a = a,
            .b = b,
            .prepared = prepared,
            .kept = own,
            .kept_back = kept != nullptr ? &(*kept)[1] : nullptr};
  }
};

/// A mesh to move, and the one to lay it on. `prepared`: B on the device of the solver, or null.
struct FitMeshes {
  Mesh& a;
  const Mesh& b;
  const PreparedMesh* prepared = nullptr;
};

/// A mesh and its shape. A caller keeps both for a mesh of many pairs.
struct ShapedMesh {
  std::shared_ptr<const ReadMesh> mesh;
  MeshShape shape;
};
ShapedMesh shaped(std::shared_ptr<const ReadMesh> mesh);

/// The answer before anything is read: [0, infinity). Throws UsageError as check_question() of
/// rules.h does.
Answer unread_answer(const Question& question);

/// Puts A where the question says: in B's unit, where both units are known and differ, and by the
/// matrix. Call it before begin_answer(); if the question asks for a fit, it does nothing, and
/// fit_a() does both. Throws UsageError for a unit that contradicts a file's own, and InputError
/// for a matrix that cannot be read or is no rotation.
void place_a(const Question& question, Mesh& a, const Mesh& b);
/// Whether place_a() or fit_a() would change A.
bool is_placed(const Question& question, const Mesh& a, const Mesh& b);
/// Puts A where place_a() does, and from there where align() finds it: by one matrix for both.
/// Throws what place_a() and Solver throw, and Interrupted where the observer ends it.
void fit_a(const Question& question, Solver& solver, const Observer& observer,
           const FitMeshes& meshes);

/// Fills in the answer's counts, its unit, its lengths in that unit, and a first upper bound: no
/// point of either mesh is farther from the other mesh than the joint diagonal and both deltas.
/// Throws UsageError for units that contradict each other and for lengths that cannot be converted
/// to the files' unit, and InputError if a share is asked of a mesh without area.
void begin_answer(const Question& question, const ShapedMesh& a, const ShapedMesh& b,
                  Answer& answer);

/// The ends of a picture's colours, in the files' unit; a 0 has no unit. Throws UsageError that
/// names --range for ends that are reversed, or cannot be converted.
Enclosure range_in_files(const std::array<Length, 2>& range, const Answer& answer);

/// The pipelines that each run of a question takes, so that one set serves search, survey and
/// proof; whether a tolerance that is a length is fine is not known before the meshes.
EngineOptions engine_of(const Question& question);

/// The budget of each run of a question, and the switches that were asked for.
SolveOptions run_options(const Question& question);

/// The options for an interval as narrow as such an answer needs. `known` has its meshes.
SolveOptions solve_options(const Question& question, const Answer& known);

/// Refuses, with UsageError or InputError and before any work, meshes without sides if the question
/// asks for sides.
void check_sides(const Question& question, const Mesh& a, const Mesh& b);

/// Encloses the distance that is asked for: one direction or both, a part of A, over all solvers,
/// or face by face. `answer` has its meshes. Throws what Solver throws, and UsageError for what
/// cannot be asked together.
void solve(const Question& question, std::span<Solver* const> solvers, const AskedMeshes& meshes,
           const Observer& observer, Answer& answer);

/// Does what follows once the distance is enclosed: surveys A, and B in the reverse direction, and
/// narrows the intervals by what they find; proves the upper bounds; checks the answer on the host.
/// A survey or a certificate is left out, with a note, where the device or the host lacks memory.
void finish(const Question& question, Solver& solver, const AskedMeshes& meshes,
            const Observer& observer, Answer& answer);

/// Takes the reports of a pair that a stream solved, in place of solve(). `result` has no error.
void take_reports(const Question& question, StreamResult&& result, Answer& answer);
/// Whether a direction was ended by the caller.
bool is_cancelled(const Answer& answer);

/// Adds, after a run, notes on the memory that it took of `asked` bytes.
void add_memory_notes(uint64_t asked, Answer& answer);

/// The bytes of a certificate of an answer with proofs (docs/certificate-file.md). Throws
/// OutputError if the run ended before there was one.
std::string certificate_text(const Answer& answer, const AskedMeshes& meshes);

}  // namespace vkh
