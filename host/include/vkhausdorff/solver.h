// Takes two meshes and returns a certified interval; blocking.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "vkhausdorff/closest_points.h"
#include "vkhausdorff/device.h"
#include "vkhausdorff/mesh.h"
#include "vkhausdorff/report.h"
#include "vkhausdorff/solve_options.h"

namespace vkh {

struct FramedPair;
class NativeRuns;     // host/solve/native_runs.h
struct SurveyedPair;  // host/solve/cells.h

/// Mesh B on the device with its BVH, for many A's. Made by a Solver, used by any Solver of the
/// same device, outlives neither the device nor its owner's handles.
class PreparedMesh {
 public:
  PreparedMesh(PreparedMesh&&) noexcept;
  PreparedMesh& operator=(PreparedMesh&&) noexcept;
  ~PreparedMesh();
  const Mesh& mesh() const;
  /// Returns whether h(a, this) is found with what is kept. False: A reaches four times farther
  /// than B, or B is a single point; distance() then does what it does without preparation.
  bool serves(const Mesh& a) const;

 private:
  friend class Solver;
  struct Impl;
  explicit PreparedMesh(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Two meshes that do not change between calls, as a Solver has framed them; null before the first
/// call. If no other run came between, they are still on its device.
using KeptPair = std::shared_ptr<const FramedPair>;

/// Two meshes that the caller keeps, and how their distance is to be found.
struct PairView {
  const Mesh& a;
  const Mesh& b;
  const PreparedMesh* prepared = nullptr;  ///< b on the device; its answer is that of distance()
  const SolveOptions* options = nullptr;   ///< the pair's own; null: those of the call. `engine`
                                           ///< and memory should be the same for all
  /// frame_pair(a, b) of frame.h, or with a prepared `b` whose frame serves `a` both in that frame,
  /// made before, on any thread, for two meshes that check_mesh() let pass; null: the call checks
  /// and frames them.
  const FramedPair* framed = nullptr;
  /// Points to a variable of the caller that belongs to these two meshes; null: nothing is kept for
  /// a later call.
  KeptPair* kept = nullptr;
  KeptPair* kept_back = nullptr;  ///< of h(b, a), for symmetrics()
};

/// The processor alone, in doubles, in place of a Vulkan device. It needs no loader and no driver.
struct NativeProcessor {
  size_t threads = 0;  ///< 0: one for each core. Answers have the same bits for any number
};

/// Describes it: "native, AMD EPYC, 2 threads", of type "native". Its index is no device's.
DeviceDescription describe(const NativeProcessor& processor);

/// Keeps pipelines and buffers of one device between runs. Calls from several threads run one after
/// the other; Solvers of their own on the same Device run at once. Everything throws InputError
/// that names the mesh, and a vertex or face of it, if a mesh is invalid (check_mesh); any content
/// is safe, as long as it does not change during the call; DeviceError if the device is lost or out
/// of memory; and UsageError for an unknown switch, a tolerance that is not positive and finite, or
/// a call from a progress callback of the same Solver.
class Solver {
 public:
  /// `cache_folder`: where pipelines are kept between processes, in files of their own for each
  /// driver and build; empty: nowhere.
  explicit Solver(Device& device, const std::filesystem::path& cache_folder = {});
  /// A solver on the device of another, with its own buffers. The two share pipelines: what either
  /// creates, both can use.
  struct SharesPipelines {};
  Solver(SharesPipelines, const Solver& other);
  /// A solver without a device. Presets, switches, a run over several solvers and device() throw
  /// UsageError. A prepared mesh is kept for closest points; distance() uses its mesh as if it had
  /// not been prepared.
  explicit Solver(const NativeProcessor& processor);
  ~Solver();
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  /// Creates the pipelines that a run with these options needs. Otherwise the first run does that.
  /// It is the slow part of a start, so meshes may be read meanwhile.
  void make_ready(const EngineOptions& options = {});
  /// Describes what runs: the device, or the processor.
  const DeviceDescription& description() const;
  /// Throws UsageError if there is no device.
  const Device& device() const;

  /// Encloses h(a, b).
  Report distance(const Mesh& a, const Mesh& b, const SolveOptions& options = {});

  /// Encloses h(a, b) of each, all at once: a large GPU, which one pair of 10,000 faces leaves
  /// mostly idle, takes 16 in half of the time (vkhCmdRunTasks). Every bound is that of distance().
  /// Each pair has a workspace of options.memory_bytes to itself, 99 MiB as a rule where that is 0,
  /// and the solver keeps them. Give pairs of similar size, about 16, and no more than fit the
  /// device's memory. Times in a report are those of all pairs together while it ran, and stages
  /// are not timed; options.progress is called for each pair, and its false ends that pair.
  std::vector<Report> distances(std::span<const PairView> pairs, const SolveOptions& options = {});
  /// Does the same for h(b, a) after that, and returns both as symmetric() has them.
  /// PairView::prepared has no reverse direction.
  std::vector<SymmetricReport> symmetrics(std::span<const PairView> pairs,
                                          const SolveOptions& options = {});

  /// Uploads B and builds its BVH.
  PreparedMesh prepare(Mesh b);
  /// Encloses h(a, b). The answer depends on a and b alone, not on the A's before.
  Report distance(const Mesh& a, const PreparedMesh& b, const SolveOptions& options = {});

  /// Finds the point of B closest to each of `points`, which are in B's coordinates, and encloses
  /// its distance. The points go to the device in batches of about 0.1 s. `goes_on` is called
  /// between them, and if it returns false, Interrupted is thrown. Throws InputError that names the
  /// row if a point is not finite. A point's answer depends on b and the point alone. Where a point
  /// is farther from B than 2^14 times B's size, B is built once more in a frame for such points.
  ClosestPoints closest(const PreparedMesh& b, std::span<const DVec3> points,
                        const ClosestGoesOn& goes_on = {});
  ClosestPoints closest(const Mesh& b, std::span<const DVec3> points,
                        const ClosestGoesOn& goes_on = {});

  /// Encloses max(h(a, b), h(b, a)). The reverse direction has the forward direction's tolerance,
  /// what is left of the time, but at least half of it, and is pruned by the forward direction's
  /// lower bound. It is not searched if the forward direction is beyond options.limit: its interval
  /// is then true, but wide.
  SymmetricReport symmetric(const Mesh& a, const Mesh& b, const SolveOptions& options = {});

 private:
  // host/solve/held_pairs.h
  friend Report distance_since(Solver&, const PairView&, const SolveOptions&,
                               const std::function<double()>&);
  friend void hold_pairs(Solver&, std::span<const PairView>, const SolveOptions&,
                         const std::function<void(std::span<const SurveyedPair>)>&);
  struct Impl;
  std::vector<Report> run(std::span<const PairView> pairs, const std::vector<SolveOptions>& options,
                          const std::function<double()>& known_since = {});
  Impl& on_device() const;
  std::unique_ptr<Impl> impl_;                // null: on the processor alone
  std::unique_ptr<const NativeRuns> native_;  // null: on a device
};

}  // namespace vkh
