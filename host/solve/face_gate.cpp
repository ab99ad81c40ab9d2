#include "vkhausdorff/face_gate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

#include "host/base/float_environment.h"
#include "host/base/rounding.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"

namespace vkh {
namespace {

using Clock = std::chrono::steady_clock;
using Faces = std::vector<uint32_t>;  ///< faces of A, in the order of their limits

void check_limits(const Mesh& a, std::span<const Limit> limits) {
  if (limits.size() != a.faces.size()) {
    throw UsageError("expected a limit for each of " + std::to_string(a.faces.size()) +
                     " faces, not " + std::to_string(limits.size()));
  }
  for (size_t i = 0; i < limits.size(); ++i) {
    const Limit& limit = limits[i];
    if (limit.within > 0 && limit.within <= limit.beyond && std::isfinite(limit.beyond)) continue;
    throw UsageError("the limit of face " + std::to_string(i) + " must be positive and finite");
  }
}

/// The part of A with these faces alone.
Mesh part_of(const Mesh& a, const Faces& faces) {
  std::vector<uint32_t> place(a.vertices.size(), UINT32_MAX);
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> corners;
  corners.reserve(faces.size());
  for (const uint32_t face : faces) {
    glm::uvec3 corner = a.faces[face];
    for (int k = 0; k < 3; ++k) {
      uint32_t& known = place[corner[k]];
      if (known == UINT32_MAX) {
        known = static_cast<uint32_t>(vertices.size());
        vertices.push_back(a.vertices[corner[k]]);
      }
      corner[k] = known;
    }
    corners.push_back(corner);
  }
  Mesh part = make_mesh(a.name, std::move(vertices), std::move(corners));
  part.delta = a.delta;
  part.unit = a.unit;
  return part;
}

/// The search: groups of faces that are still to be decided.
class Search {
 public:
  Search(Solver& solver, const Mesh& a, const Mesh& b, std::span<const Limit> limits,
         const SolveOptions& options)
      : solver_(solver),
        a_(a),
        limits_(limits),
        options_(options),
        start_(Clock::now()),
        b_((solver.make_ready(options.engine), solver.prepare(b))) {
    const double diagonal_a = diagonal_of(a).least();
    if (!options_.tolerance_is_absolute && diagonal_a > 0) {  // a fraction of A, not of its parts
      options_.tolerance = multiply_down(options_.tolerance, diagonal_a);
      options_.tolerance_is_absolute = true;
    }
    options_.progress = [this, &listen = options.progress](const Progress& progress) {
      is_cancelled_ = listen && !listen(progress);
      return !is_cancelled_;
    };
  }

  FaceGate run() {
    gather();
    while (!open_.empty() && out_.verdict != Verdict::kBeyond && !is_over()) {
      Faces group = std::move(open_.back());
      open_.pop_back();
      decide(std::move(group));
    }
    const bool is_beyond = out_.verdict == Verdict::kBeyond;
    const bool all_within = out_.within == a_.faces.size();
    if (!is_beyond) {
      out_.verdict = all_within ? Verdict::kWithin : Verdict::kUndecided;
      out_.limit = largest_limit();
    }
    complete(is_beyond || all_within, !open_.empty());
    return std::move(out_);
  }

 private:
  bool is_over() const { return is_cancelled_ || left_s() <= 0; }
  double left_s() const {
    const std::chrono::duration<double> elapsed = Clock::now() - start_;
    return options_.time_limit_s - elapsed.count();
  }

  const Limit& least(const Faces& group) const { return limits_[group.front()]; }
  const Limit& most(const Faces& group) const { return limits_[group.back()]; }
  Limit largest_limit() const {
    return *std::max_element(limits_.begin(), limits_.end(),
                             [](const Limit& x, const Limit& y) { return x.beyond < y.beyond; });
  }

  /// Fills in the values for all of A, not just for the parts that were solved.
  void complete(bool is_decided, bool is_open) {
    Report& r = out_.report;
    const Box box = bounding_box(a_);
    if (is_open || out_.runs == 0) {
      r.upper = farthest_in(join(box, bounding_box(b_.mesh())), add_up(a_.delta, b_.mesh().delta));
      r.status = is_cancelled_ ? Status::kCancelled : Status::kTime;
    }
    if (!is_decided && !is_open && open_status_) r.status = *open_status_;
    if (is_decided) r.status = Status::kLimit;
    r.diagonal_a = diagonal(box);
    r.mesh_a = a_.counts;
    r.limit = out_.limit;
  }

  /// Gathers groups of limits within a factor of two. The least limits come first.
  void gather() {
    Faces faces(a_.faces.size());
    std::iota(faces.begin(), faces.end(), 0u);
    std::stable_sort(faces.begin(), faces.end(),
                     [&](uint32_t x, uint32_t y) { return limits_[x].within < limits_[y].within; });
    std::vector<Faces> groups;
    for (const uint32_t face : faces) {
      if (groups.empty() || limits_[face].within > 2 * least(groups.back()).within)
        groups.emplace_back();
      groups.back().push_back(face);
    }
    open_.assign(std::make_move_iterator(groups.rbegin()), std::make_move_iterator(groups.rend()));
  }

  /// Makes one run: it ends if all faces are within the least limit or one is beyond the largest,
  /// and otherwise closes.
  void decide(Faces group) {
    options_.limit = {least(group).within, most(group).beyond};
    SolveOptions options = options_;
    options.time_limit_s = std::max(left_s(), 1e-3);
    Report r = solver_.distance(part_of(a_, group), b_, options);
    ++out_.runs;
    r.witness_a.set_face(a_, group[std::min<uint64_t>(r.witness_a.face, group.size() - 1)]);
    const double lower = r.lower, upper = r.upper;
    const Status status = r.status;
    // A run that ended in its first submission has not called the callback.
    if (!is_cancelled_) options_.progress({.wave = r.waves, .lower = lower, .upper = upper});
    const bool is_beyond = r.has_witness && lower > limits_[r.witness_a.face].beyond;
    add(std::move(r), is_beyond);
    if (is_beyond) return;
    const auto first_open = std::partition_point(
        group.begin(), group.end(), [&](uint32_t face) { return limits_[face].within < upper; });
    out_.within += static_cast<uint64_t>(group.end() - first_open);
    const bool is_split = first_open != group.end();
    group.erase(first_open, group.end());
    if (group.empty()) return;
    if (is_split && least(group).within < most(group).within) {
      open_.push_back(std::move(group));
    } else {
      halve(std::move(group), is_split, status);
    }
  }

  /// Splits the group by limits. Faces of one limit that were asked about alone stay undecided.
  void halve(Faces group, bool is_smaller, Status status) {
    if (least(group).within == most(group).within) {
      if (is_smaller) open_.push_back(std::move(group));
      if (!is_smaller) open_status_ = status;
      return;
    }
    const double middle = limits_[group[group.size() / 2]].within;
    auto at = std::partition_point(group.begin(), group.end(),
                                   [&](uint32_t face) { return limits_[face].within < middle; });
    if (at == group.begin()) {
      at = std::partition_point(group.begin(), group.end(),
                                [&](uint32_t face) { return limits_[face].within <= middle; });
    }
    open_.emplace_back(at, group.end());
    group.erase(at, group.end());
    open_.push_back(std::move(group));
  }

  /// Adds one run to the whole: the largest upper bound, and the largest lower bound with its
  /// witness. A run that decides gives its own lower bound and witness instead.
  void add(Report r, bool is_beyond) {
    if (is_beyond) {
      out_.verdict = Verdict::kBeyond;
      out_.limit = limits_[r.witness_a.face];
    }
    Report& all = out_.report;
    const double upper = std::max(all.upper, r.upper);
    const double lower = is_beyond ? r.lower : std::max(all.lower, r.lower);  // that of the witness
    if (out_.runs == 1 || is_beyond || r.lower > all.lower) {
      r.candidates += all.candidates;
      r.queries += all.queries;
      r.waves += all.waves;
      all = std::move(r);
    } else {
      all.candidates += r.candidates;
      all.queries += r.queries;
      all.waves += r.waves;
      all.status = r.status;
    }
    all.lower = lower;
    all.upper = upper;
  }

  Solver& solver_;
  const Mesh& a_;
  std::span<const Limit> limits_;
  SolveOptions options_;
  Clock::time_point start_;
  PreparedMesh b_;
  bool is_cancelled_ = false;
  std::optional<Status> open_status_;  ///< status of faces that stay undecided
  std::vector<Faces> open_;            ///< the next one is last
  FaceGate out_;
};

}  // namespace

FaceGate gate_faces(Solver& solver, const Mesh& a, const Mesh& b, std::span<const Limit> limits,
                    const SolveOptions& options) {
  check_mesh(a);
  check_limits(a, limits);
  const FloatEnvironment ours;
  return Search(solver, a, b, limits, options).run();
}

}  // namespace vkh
