// The answer of a run: a certified interval, its witness, why it ended and what it cost.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "vkhausdorff/device_description.h"
#include "vkhausdorff/mesh.h"
#include "vkhausdorff/solve_options.h"

namespace vkh {

/// Why a run ended. Every status comes with a true interval; only kClosed promises its width.
enum class Status {
  kClosed,     ///< upper - lower <= tolerance, in exact arithmetic
  kPrecision,  ///< what is left cannot be decided in this arithmetic; the interval is the honest,
               ///< wider one
  kTime,       ///< the time budget ended
  kWaves,      ///< the wave budget ended
  kMemory,     ///< candidates were spilled and could not be refined
  kCancelled,  ///< the caller asked for the end
  kPruned,     ///< upper <= known_lower + tolerance, which was all that was asked; the interval is
               ///< true, but lower was not sought: only upper is informative
  kLimit,      ///< upper <= limit or lower > limit is proven, which was all that was asked
};
const char* status_name(Status status);  ///< "closed", "precision", "time", "waves", "memory",
                                         ///< "cancelled", "pruned", "limit"

/// The answer to whether a distance is within a limit; each but the last is proven.
enum class Verdict { kWithin, kBeyond, kUndecided };
const char* verdict_name(Verdict verdict);  ///< "pass", "fail", "undecided"

/// A point on a face, in the files' own coordinates.
struct SurfacePoint {
  uint64_t face = 0;  ///< index in Mesh::faces: a triangle
  DVec3 barycentric{};
  DVec3 point{};
  uint64_t file_face = 0;  ///< the number in the file of the face that this triangle is part of,
                           ///< for people

  void set_face(const Mesh& mesh, uint64_t triangle) {
    face = triangle;
    file_face = mesh.file_faces.of(triangle);
  }
};

/// GPU time and counts of one stage, summed over the run.
struct StageStats {
  std::string name;
  double gpu_ms = 0;
  uint64_t times = 0;  ///< number of its parts that were timed
};

/// The number of candidates that a bound of the cascade closed; "lower_raised": later, because
/// lower had risen past their u; "precision": at their u, because nothing finer can be decided.
struct CullCount {
  std::string name;
  uint64_t candidates = 0;
};

/// One row per wave, for the table under --verbose and for plots.
struct WaveStats {
  uint32_t wave = 0;
  uint64_t parents = 0, candidates = 0, queries = 0, survivors = 0, deferred = 0;
  double lower = 0, upper = 0;  ///< heuristic while running, in the files' units
};

struct Times {
  double upload_ms = 0;     ///< meshes to device buffers, frame included
  double hierarchy_ms = 0;  ///< GPU: B's BVH
  double solve_ms = 0;      ///< GPU: seed and waves and report, without the BVH; natively, all
  double wall_ms = 0;       ///< host clock around Solver::distance
};

/// The host's own check of a run, asked for with --verify (host/include/vkhausdorff/verify.h).
struct WitnessCheck {
  double distance_lower = 0, distance_upper = 0;  ///< enclose d(witness, B), in the files' units
  bool holds = false;  ///< every face of B is at least `lower` away from the witness
};

/// The host's check that the closed and the open parts of each face of A are the whole face.
struct CoverageCheck {
  uint64_t whole = 0;    ///< faces whose parts sum to the whole, as exact integers
  uint64_t waiting = 0;  ///< faces without a part: they have no bound yet, and `upper` reflects it
  uint64_t wrong = 0;    ///< the rest: 0 if it holds
  double closed = 0;     ///< share of A's faces that was closed
  bool holds = false;
};

/// Mesh::delta, by which the interval is wider, and Mesh::unit of a mesh.
struct MeshAccuracy {
  double delta = 0;
  std::string unit = {};
};

/// One of several devices, which a run did without.
struct LeftOut {
  size_t device = 0;  ///< index in the given devices
  std::string why;
};

struct Report {
  Status status = Status::kClosed;
  double lower = 0, upper = 0;  ///< the certified interval, in the files' units, rounded outward
  double diagonal_a = 0;        ///< the diagonal of A's bounding box, rounded to nearest
  double tolerance = 0;  ///< in the files' units; for a fraction: of what A's diagonal is at least
  double known_lower = 0;  ///< SolveOptions::known_lower
  Limit limit;             ///< SolveOptions::limit
  SurfacePoint witness_a, witness_b;
  bool has_witness = false;  ///< false: no sample was measured yet
  MeshCounts mesh_a, mesh_b;
  MeshAccuracy place_a, place_b;
  DeviceDescription device;
  std::vector<DeviceDescription> more_devices;  ///< others that took part in a run over several
  std::vector<LeftOut> left_out;                ///< devices that were lost, or had no memory
  uint64_t workspace_bytes = 0;
  uint64_t host_memory_bytes = 0;  ///< bytes without room on the device, which it reads from the
                                   ///< host
  uint32_t waves = 0;
  uint64_t candidates = 0, queries = 0, peak_frontier = 0;
  std::vector<CullCount> culled;
  std::vector<StageStats> stages;
  std::vector<WaveStats> wave_stats;
  Times times;
  std::string preset = "default";
  std::vector<std::string> switched_on, switched_off;  ///< all switches, as they were
  std::optional<WitnessCheck> witness_check;
  std::optional<CoverageCheck> coverage_check;

  double gap() const;  ///< (upper - lower) / diag(A), rounded up
};

/// Judges by the interval alone, no matter what ended the run.
Verdict verdict_of(double lower, double upper, const Limit& limit);
/// Returns whether a limit was asked about, and there is an answer.
bool is_decided(double lower, double upper, const Limit& limit);

/// (upper - lower) / diagonal_a, or the width itself where that is 0; rounded up.
double gap_of(double lower, double upper, double diagonal_a);

struct CertifiedInterval {
  double lower = 0, upper = 0;
  double gap = 0;  ///< (upper - lower) / diag(A), rounded up
  Status status = Status::kClosed;
};
/// The interval of max(h(A,B), h(B,A)): [max of the lowers, max of the uppers].
CertifiedInterval symmetric_interval(const Report& a_to_b, const Report& b_to_a);

/// Both directions. The reverse direction was pruned by the forward one: its own interval is true
/// but may be wide (Status::kPruned).
struct SymmetricReport {
  Report a_to_b, b_to_a;
  CertifiedInterval interval() const { return symmetric_interval(a_to_b, b_to_a); }
};

}  // namespace vkh
