// A pair on its way from a question to an answer: the order of the steps stands here alone, for the
// command line, a batch, C++ and Python.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "host/answer/input_hashes.h"
#include "host/answer/steps.h"

namespace vkh {

/// One thread at a time.
class AskedPair {
 public:
  /// The answer begins as [0, infinity). Throws UsageError as unread_answer() does.
  explicit AskedPair(Question question);

  /// Names a mesh in the answer, A (0) or B (1), by a `path` in place of its own, and adds hashes.
  void name(size_t mesh, const std::string& path, InputHashes hashes);

  /// Takes both meshes, puts A where the question says, fills in what the meshes determine, and
  /// refuses meshes that cannot have the sides that are asked for: place_a(), begin_answer() and
  /// check_sides(). Throws what these throw. If a fit is asked for, fit() does the first two.
  void take(std::shared_ptr<const ReadMesh> a, ShapedMesh b);
  /// Does the same, and moves this mesh where the other call moves a copy.
  void take(std::shared_ptr<ReadMesh> a, ShapedMesh b);
  /// Lays A onto B, on a device. Does nothing if no fit is asked for. `b`: B on the device of
  /// the solver, or null. Throws what fit_a() and begin_answer() throw.
  void fit(Solver& solver, const Observer& observer, const PreparedMesh* b = nullptr);

  /// vkh::solve() of the pair.
  void solve(std::span<Solver* const> solvers, const Observer& observer,
             const PreparedMesh* b = nullptr);
  /// Takes the reports of a stream in place of solve().
  void take(StreamResult&& result);
  /// vkh::finish() of the pair.
  void finish(Solver& solver, const Observer& observer, const PreparedMesh* b = nullptr);

  const Question& question() const { return question_; }
  const Answer& answer() const { return answer_; }
  Answer& answer() { return answer_; }
  const std::shared_ptr<const ReadMesh>& a() const { return a_; }
  const std::shared_ptr<const ReadMesh>& b() const { return b_.mesh; }

 private:
  ReadMesh& movable_a();
  void begin_answer();
  AskedMeshes meshes(const PreparedMesh* b);

  Question question_;
  Answer answer_;
  std::shared_ptr<const ReadMesh> a_;
  std::shared_ptr<ReadMesh> own_a_;  // A, if no caller holds it too
  ShapedMesh b_;
  std::array<KeptPair, 2> kept_;
};

}  // namespace vkh
