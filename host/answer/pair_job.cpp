#include "host/answer/pair_job.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <new>

#include "host/answer/face_limits.h"
#include "host/answer/input_hashes.h"
#include "host/answer/progress_line.h"
#include "host/answer/reading.h"
#include "host/base/begin_now.h"
#include "host/base/decimal.h"
#include "host/base/error.h"
#include "host/base/float_environment.h"
#include "host/base/note.h"
#include "host/base/sha256.h"
#include "host/mesh/default_pair.h"
#include "host/solve/cells.h"
#include "host/solve/face_gate.h"
#include "host/solve/verify.h"

namespace vkh {
namespace {

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// A job in progress: the state that its threads share, and the answer known so far.
class Progressing {
 public:
  Progressing(const PairJob& asked, const Stop& until)
      : job(asked), stop(until), known_(unread_answer(asked)) {}

  const PairJob job;
  const Stop stop;
  ProgressLine line;
  const Reading reading{line, stop};

  /// Takes the meshes once they are read: then units and a first bound are known.
  void read(const MeshPair& pair, double ms) {
    const std::lock_guard lock(mutex_);
    farthest_ = take_meshes(job, pair.a, pair.b, known_);
    known_.waits.read = ms;
  }
  void open(const DeviceDescription& device, double ms) {
    const std::lock_guard lock(mutex_);
    for (Report* r : directions()) r->device = device;
    known_.waits.start = ms;
  }
  void advance(const Progress& progress) {
    line.show(progress);
    const std::lock_guard lock(mutex_);
    // The progress covers a part of A's faces and bounds none of the others.
    if (known_.max && (known_.max->faces_a || known_.max->faces_b)) return;
    Report& r = progress.back && known_.b_to_a ? *known_.b_to_a : known_.a_to_b;
    r.lower = progress.lower;
    r.upper = std::min(progress.upper, farthest_);
  }

  /// Keeps the answer once all runs have ended; only a survey may be missing.
  void keep(const Answer& answer) {
    const std::lock_guard lock(mutex_);
    known_ = answer;
    is_final_ = true;
  }
  bool is_final() const {
    const std::lock_guard lock(mutex_);
    return is_final_;
  }

  Answer known() const {
    const std::lock_guard lock(mutex_);
    return known_;
  }

 private:
  std::vector<Report*> directions() {
    if (known_.b_to_a) return {&known_.a_to_b, &*known_.b_to_a};
    return {&known_.a_to_b};
  }

  mutable std::mutex mutex_;
  Answer known_;
  bool is_final_ = false;
  double farthest_ = std::numeric_limits<double>::infinity();
};

SolveOptions options_for(Progressing& at, const Answer& known) {
  SolveOptions options = asked_options(at.job, known);
  options.time_limit_s = std::max(at.stop.left_s(), 1e-3);
  options.progress = [&at](const Progress& progress) {
    at.advance(progress);
    return !is_interrupted();
  };
  return options;
}

/// A direction whose faces may have limits of their own, in a file, unless that is empty.
struct GatedSide {
  const std::string& file;
  const Mesh& from;
  const Mesh& to;
  std::optional<FaceLimits>& limits;
};

Report gate(const GatedSide& side, const SolveOptions& options, Solver& solver,
            const Answer& answer) {
  if (side.file.empty()) return solver.distance(side.from, side.to, options);
  const std::vector<Limit> limits = read_face_limits(side.file, side.from, answer.max->limit,
                                                     answer.unit, answer.a_to_b.diagonal_a);
  FaceGate found = gate_faces(solver, side.from, side.to, limits, options);
  side.limits = FaceLimits{.path = side.file,
                           .within = found.within,
                           .faces = side.from.faces.size(),
                           .runs = found.runs,
                           .limit = found.limit,
                           .verdict = found.verdict};
  return std::move(found.report);
}

/// Solves both directions on their own: limits of faces bound nothing in the reverse direction.
void solve_by_face(Progressing& at, const MeshPair& pair, Solver& solver, SolveOptions options,
                   Answer& answer) {
  const PairJob& job = at.job;
  options.tolerance = answer.a_to_b.tolerance;
  options.tolerance_is_absolute = true;
  answer.a_to_b =
      gate({job.face_max_a, pair.a, pair.b, answer.max->faces_a}, options, solver, answer);
  if (!job.symmetric) return;
  options.time_limit_s = std::max(at.stop.left_s(), 1e-3);
  options.progress = [&at](Progress progress) {
    progress.back = true;
    at.advance(progress);
    return !is_interrupted();
  };
  answer.b_to_a =
      gate({job.face_max_b, pair.b, pair.a, answer.max->faces_b}, options, solver, answer);
}

void prove_all(Progressing& at, const MeshPair& pair, Solver& solver, const SolveOptions& options,
               Answer& answer) {
  const auto one = [&](const Mesh& from, const Mesh& to, const Report& report) {
    std::optional<Proof> proof;
    if (!std::isfinite(report.upper)) return proof;
    try {
      proof = prove(solver, {from, to, report, options, [&at](size_t leaves) {
                               at.line.show_proof(leaves);
                               return !at.stop.is_asked();
                             }});
    } catch (const std::bad_alloc&) {
      answer.notes.push_back(
          note_of(NoteCode::kCertificate, "there was no memory for a certificate"));
    } catch (const MemoryError&) {
      answer.notes.push_back(
          note_of(NoteCode::kCertificate, "the device had no memory for a certificate"));
    }
    if (proof && proof->upper > report.upper)
      answer.notes.push_back(
          note_of(NoteCode::kCertificate, "the certificate proves less: " + from.name +
                                              " is within " + shortest_decimal(proof->upper)));
    return proof;
  };
  answer.proof_a = one(pair.a, pair.b, answer.a_to_b);
  if (answer.b_to_a) answer.proof_b = one(pair.b, pair.a, *answer.b_to_a);
}

void solve(Progressing& at, const MeshPair& pair, const Session& session, Answer& answer) {
  Solver& solver = *session.solver;
  SolveOptions options = options_for(at, answer);
  // Uses the pipelines that a survey needs, so that it needs no others.
  if (at.job.asks_for_cells()) options.survey = no_survey;
  const bool by_face = !at.job.face_max_a.empty() || !at.job.face_max_b.empty();
  if (by_face) {
    solve_by_face(at, pair, solver, options, answer);
  } else if (at.job.symmetric) {
    if (!session.more.empty())
      throw UsageError("--symmetric: over several devices ask for each direction by itself");
    SymmetricReport both = solver.symmetric(pair.a, pair.b, options);
    answer.a_to_b = std::move(both.a_to_b);
    answer.b_to_a = std::move(both.b_to_a);
  } else {
    solve_directed(session, pair, options, answer);
  }
  add_memory_notes(options.memory_bytes, answer);
  if (at.job.survey.is_any()) {
    at.keep(answer);
    survey_all({.wish = at.job.survey,
                .a = pair.a,
                .b = pair.b,
                .left_s = [&at] { return at.stop.left_s(); },
                .goes_on = [&at] { return !at.stop.is_asked(); },
                .show = [&at](size_t cells) { at.line.show_survey(cells); }},
               solver, options, answer);
  }
  if (at.job.proof) {
    at.keep(answer);
    prove_all(at, pair, solver, options, answer);
  }
  if (!at.job.verify) return;
  if (answer.a_to_b.has_witness)
    answer.a_to_b.witness_check = verify_witness(pair.a, pair.b, answer.a_to_b);
  if (answer.b_to_a && answer.b_to_a->has_witness)
    answer.b_to_a->witness_check = verify_witness(pair.b, pair.a, *answer.b_to_a);
}

/// Hashes all files that are read, beside the other work; a caller waits only for the result.
class Hashes {
 public:
  explicit Hashes(const std::shared_ptr<Progressing>& at)
      : at_(at), is_wanted_(at->job.hashes && !at->job.file_a.empty()) {
    if (!is_wanted_) return;
    for (const std::string& file : {at->job.file_a, at->job.file_b})
      digests_.push_back(begin_hash(file));
    for (const std::string& file : {at->job.face_max_a, at->job.face_max_b})
      limits_.push_back(begin_hash(file));
  }

  /// Begins with the files beneath both. Call it once both are read: parsing a file for their names
  /// earlier would hold it in memory a second time.
  void begin_beneath() {
    if (!is_wanted_) return;
    for (const std::string& file : {at_->job.file_a, at_->job.file_b}) {
      beneath_.push_back(begin_now([at = at_, file]() -> Beneath {
        ReadLimits limits = at->job.limits;
        limits.keep_going = [at] { return !at->stop.is_asked(); };
        try {
          return hashes_beneath(file, limits);
        } catch (const Interrupted&) {
          return std::nullopt;
        } catch (const std::bad_alloc&) {  // it must not cost the answer
          return std::nullopt;
        }
      }));
    }
  }

  /// Writes the hashes of an input only if those of all its files are known.
  void fill(Answer& answer) {
    for (size_t i = 0; i < beneath_.size(); ++i) {
      Beneath beneath = beneath_[i].get();
      if (!beneath) continue;
      answer.inputs[i].sha256 = digests_[i].get();
      answer.inputs[i].files = std::move(*beneath);
    }
    if (!is_wanted_ || !answer.max) return;
    for (size_t i = 0; i < limits_.size(); ++i) {
      auto& faces = i == 0 ? answer.max->faces_a : answer.max->faces_b;
      if (faces) faces->sha256 = limits_[i].get();
    }
  }

 private:
  using Beneath = std::optional<std::vector<FileHash>>;

  std::future<std::string> begin_hash(const std::string& file) {
    return begin_now([at = at_, file] {
      if (file.empty()) return std::string();
      return sha256_of(path_of(file), [at] { return !at->stop.is_asked(); });
    });
  }

  std::shared_ptr<Progressing> at_;
  bool is_wanted_;
  std::vector<std::future<std::string>> digests_, limits_;
  std::vector<std::future<Beneath>> beneath_;
};

Done work(const std::shared_ptr<Progressing>& shared) {
  Progressing& at = *shared;
  const PairJob& job = at.job;
  Hashes hashes(shared);
  SolveOptions options = job.options;
  const bool apart =
      job.max && !job.survey.area;  // otherwise pipelines for cells are made with the rest
  if (job.asks_for_cells() && !apart) options.survey = no_survey;
  auto opening = begin_now([selector = job.device, several = job.several_devices, options,
                            cache = job.caches ? user_cache_folder() : std::filesystem::path()] {
    return open_session(selector, several, options, cache);
  });
  const auto start = Clock::now();
  const std::shared_ptr<const Reading> reading(shared, &at.reading);  // keeps all of `shared`
  Done done;
  done.pair =
      job.file_a.empty() ? default_pair() : read_pair(job.file_a, job.file_b, job.limits, reading);
  at.read(done.pair, ms_since(start));
  hashes.begin_beneath();
  done.session = opening.get();
  at.open(done.session.device->description(), done.session.setup_ms);
  done.answer = at.known();
  solve(at, done.pair, done.session, done.answer);
  hashes.fill(done.answer);
  return done;
}

/// Returns the answer known so far, for a caller that no longer waits for the run. Unless that
/// answer is final, its status says why the run was stopped.
Done unfinished(Progressing& at) {
  at.line.end();
  Done done;
  done.answer = at.known();
  if (at.is_final()) return done;
  done.answer.a_to_b.status = at.stop.why();
  if (done.answer.b_to_a) done.answer.b_to_a->status = at.stop.why();
  return done;
}

/// Returns true once `result` is ready; false when the job is to wait no longer.
bool wait_for(const std::future<Done>& result, const Progressing& at) {
  constexpr std::chrono::milliseconds kLook(20);
  constexpr double kGraceful = 0.06;  // a run on a GPU ends by itself in it, with more to report
  constexpr double kToAddUp = 3;      // a survey has files to write that the user asked for
  const Stop& stop = at.stop;
  // A certificate proves the final result of the search, so that is waited for too.
  const auto patience = [&] { return at.is_final() || at.job.proof ? kToAddUp : kGraceful; };
  double asked_at = std::numeric_limits<double>::infinity();
  while (result.wait_for(kLook) == std::future_status::timeout) {
    if (!stop.is_asked()) continue;
    asked_at = std::min(asked_at, stop.elapsed_s());
    if (stop.elapsed_s() - asked_at > patience()) return false;
  }
  return true;
}

}  // namespace

Done run_job(const PairJob& job, const Stop& stop) {
  // The state is shared: threads that are left behind still read it.
  const auto at = std::make_shared<Progressing>(job, stop);
  auto result = begin_now([at] {
    const FloatEnvironment ours;
    return work(at);
  });
  Done done;
  try {
    done = wait_for(result, *at) ? result.get() : unfinished(*at);
  } catch (const Interrupted&) {
    done = unfinished(*at);
  }
  at->line.end();
  done.answer.waits.total = stop.elapsed_s() * 1000;
  return done;
}

}  // namespace vkh
