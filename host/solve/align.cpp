#include "vkhausdorff/align.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "host/base/float128.h"
#include "host/base/float_environment.h"
#include "host/mesh/area_samples.h"
#include "host/mesh/principal_axes.h"
#include "host/read/transform.h"
#include "host/solve/pose_fitter.h"
#include "vkhausdorff/frame.h"

namespace vkh {
namespace {

constexpr size_t kFew = 300, kSome = 2000;  // samples of the first two stages
constexpr size_t kForAxes = 40'000;
constexpr double kFar = 100;         // sizes: what lies farther off is shifted first
constexpr double kBad = 0.01;        // of the size: a trimmed rms that asks for more starts
constexpr double kPoor = 0.02;       // of the size: a trimmed rms that is noted
constexpr double kLeastShare = 0.6;  // of the samples: fewer within their noise are noted
constexpr double kGap = 0.1;         // of the largest variance: closer ones leave an axis open
constexpr double kElsewhere = 0.02;  // of the size, between two places
constexpr double kAsGood = 1.02, kRival = 1.1;
// A is called a mirror image if its mirror image is four times closer, and A is off by more than a
// scan is: the capped rms of both, the latter as a share of the size. A part that is its own mirror
// image, or nearly so, is about as close either way.
constexpr double kMirrored = 0.25, kOff = 0.003;
constexpr size_t kPlaces = 3;

using Candidates = std::vector<Candidate>;

/// The principal axes of a mesh's samples.
struct Shape {
  PrincipalAxes axes;
  double size() const {
    const double size = std::sqrt(axes.variances.x + axes.variances.y + axes.variances.z);
    return std::isfinite(size) ? size : 0;
  }
  bool has_axes() const { return axes.variances[2] > 0; }
  /// Whether the two smaller, or the two larger, of its variances are about the same.
  bool is_round(int lower) const {
    return axes.variances[lower + 1] - axes.variances[lower] < kGap * axes.variances[2];
  }
};

Shape shape_from(const Mesh& mesh) { return {principal_axes_of(area_samples(mesh, kForAxes))}; }

FitFrame frame_of(const Shape& a, const Shape& b, const Mesh& mesh_b) {
  FitFrame frame{.centre_a = a.axes.centroid, .centre_b = b.axes.centroid};
  const double size = std::max(a.size(), b.size());
  frame.size = size > 0 ? size : 1;
  const Box box = bounding_box(mesh_b);
  const double largest = std::max(glm::length(box.lo), glm::length(box.hi));
  frame.nearby = 1e-9 * frame.size + 0x1p-45 * largest;
  return frame;
}

Candidate turned(const glm::dquat& turn) { return {.pose = {.turn = turn}}; }

/// Reverses one principal axis of A: any mirror image of A is this one, turned and shifted.
std::vector<DVec3> mirrored(const std::vector<DVec3>& samples, const Shape& a) {
  const glm::dvec3 centre = a.axes.centroid, axis = a.axes.axes[0];
  std::vector<DVec3> out;
  out.reserve(samples.size());
  for (const DVec3& sample : samples) {
    const glm::dvec3 p(sample);
    out.push_back(p - 2 * glm::dot(p - centre, axis) * axis);
  }
  return out;
}

/// Lays A's axes on B's: as they are, and with each two of them reversed.
Candidates by_axes(const Shape& a, const Shape& b) {
  Candidates starts;
  if (!a.has_axes() || !b.has_axes()) return starts;
  const glm::dmat3 from(a.axes.axes), to(b.axes.axes);
  const double hand =
      glm::dot(glm::cross(from[0], from[1]), from[2]) * glm::dot(glm::cross(to[0], to[1]), to[2]) <
              0
          ? -1
          : 1;
  for (const auto& [x, y] : {std::pair{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
    const glm::dmat3 signs(glm::dvec3(x, 0, 0), glm::dvec3(0, y, 0),
                           glm::dvec3(0, 0, x * y * hand));
    starts.push_back(turned(glm::normalize(glm::quat_cast(to * signs * glm::transpose(from)))));
  }
  return starts;
}

/// Turns that are spread evenly: super-Fibonacci spirals (Alexa, CVPR 2022).
Candidates all_around() {
  constexpr size_t kCount = 150;
  constexpr double kPsi = 1.533751168755204288118041;
  Candidates starts;
  for (size_t i = 0; i < kCount; ++i) {
    const double s = static_cast<double>(i) + 0.5, t = s / static_cast<double>(kCount);
    const double inner = std::sqrt(t), outer = std::sqrt(1 - t);
    const double alpha = 2 * std::numbers::pi * s / std::numbers::sqrt2;
    const double beta = 2 * std::numbers::pi * s / kPsi;
    starts.push_back(turned({outer * std::cos(beta), inner * std::sin(alpha),
                             inner * std::cos(alpha), outer * std::sin(beta)}));
  }
  return starts;
}

/// The pose turned on about an axis of B, in small steps.
Candidates around(const glm::dvec3& axis, const Pose& pose) {
  constexpr int kCount = 60;
  Candidates starts;
  for (int i = 1; i < kCount; ++i) {
    const double half = std::numbers::pi * i / kCount;
    const glm::dvec3 part = std::sin(half) * axis;
    const glm::dquat by(std::cos(half), part.x, part.y, part.z);
    starts.push_back({.pose = {.turn = by * pose.turn, .shift = by * pose.shift}});
  }
  return starts;
}

bool ranks_before(const Candidate& x, const Candidate& y) { return x.capped < y.capped; }

/// The search for a place: many starts with few samples, the best with more.
class PlaceSearch {
 public:
  PlaceSearch(Solver& solver, const Mesh& a, const PreparedMesh& b, const AlignOptions& options)
      : options_(options),
        a_(a),
        shape_a_(shape_from(a)),
        shape_b_(shape_from(b.mesh())),
        frame_(frame_of(shape_a_, shape_b_, b.mesh())),
        few_(area_samples(a, kFew)),
        some_(area_samples(a, kSome)),
        fitter_(solver, b, frame_, options_.goes_on) {}

  Alignment find();

 private:
  Candidates starts_as_turned() const;
  void search_on();
  void add_best(Candidates more);
  bool is_elsewhere(const Pose& x, const Pose& y) const;
  Candidates kept() const;
  Candidate chosen(Candidates candidates);
  std::optional<double> closer_mirrored(const Candidate& best);
  MatrixRows matrix_of(const Pose& pose) const;

  const AlignOptions& options_;
  const Mesh& a_;
  const Shape shape_a_, shape_b_;
  const FitFrame frame_;
  const std::vector<DVec3> few_, some_;
  PoseFitter fitter_;
  Candidates all_;  // the first ones are where A lies, as it is turned
  size_t as_given_ = 0;
  std::optional<double> rival_;
};

/// Begins where A lies and with its centre on B's.
Candidates PlaceSearch::starts_as_turned() const {
  Candidates first;
  const glm::dvec3 shift = frame_.centre_a - frame_.centre_b;
  if (glm::length(shift) <= kFar * frame_.size) first.push_back({.pose = {.shift = shift}});
  first.push_back({});
  return first;
}

/// Settles roughly, and keeps the candidates that rank first.
void PlaceSearch::add_best(Candidates more) {
  constexpr size_t kBest = 20;
  fitter_.refine(more, std::span(few_).first(kFew / 3), {.steps = 6});
  std::sort(more.begin(), more.end(), ranks_before);
  more.resize(std::min(more.size(), kBest));
  fitter_.refine(more, few_, {.steps = 20});
  all_.insert(all_.end(), more.begin(), more.end());
}

/// Adds starts if the first ones do not decide: there is no good fit, or the axes are not unique.
void PlaceSearch::search_on() {
  const auto best = [&] { return std::min_element(all_.begin(), all_.end(), ranks_before); };
  const bool is_bad = !(best()->trimmed <= kBad * frame_.size);
  const bool round_about_last = shape_b_.is_round(0), round_about_first = shape_b_.is_round(1);
  if (is_bad || (round_about_first && round_about_last)) add_best(all_around());
  if (round_about_first == round_about_last) return;
  const glm::dvec3 axis = shape_b_.axes.axes[round_about_last ? 2 : 0];
  add_best(around(axis, best()->pose));
}

bool PlaceSearch::is_elsewhere(const Pose& x, const Pose& y) const {
  double sum = 0;
  for (const DVec3& sample : few_) {
    const glm::dvec3 from_centre = glm::dvec3(sample) - frame_.centre_a;
    const glm::dvec3 off = x(from_centre) - y(from_centre);
    sum += glm::dot(off, off);
  }
  return std::sqrt(sum / static_cast<double>(few_.size())) > kElsewhere * frame_.size;
}

/// Finds the best places that differ.
Candidates PlaceSearch::kept() const {
  Candidates order = all_;
  std::stable_sort(order.begin(), order.end(), ranks_before);
  Candidates best;
  for (const Candidate& one : order) {
    const bool is_new = std::all_of(best.begin(), best.end(), [&](const Candidate& other) {
      return is_elsewhere(one.pose, other.pose);
    });
    if (is_new) best.push_back(one);
    if (best.size() == kPlaces) break;
  }
  return best;
}

/// Chooses the best one after more steps with more samples. Another place that is as good is a
/// rival; the place that A was given is preferred to a rival.
Candidate PlaceSearch::chosen(Candidates candidates) {
  fitter_.refine(candidates, some_, {.steps = 20});
  for (Candidate& one : candidates) fitter_.measure(one, some_, Counting::kNearest);
  std::stable_sort(candidates.begin(), candidates.end(), ranks_before);
  const double rounding = frame_.nearby;
  Candidate best = candidates.front();
  for (const Candidate& one : candidates) {
    const bool is_as_given =
        std::any_of(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(as_given_),
                    [&](const Candidate& given) { return !is_elsewhere(one.pose, given.pose); });
    if (!is_as_given || one.capped > kAsGood * candidates.front().capped + rounding) continue;
    best = one;
    break;
  }
  for (const Candidate& one : candidates) {
    if (!is_elsewhere(one.pose, best.pose) || one.capped > kRival * best.capped + rounding)
      continue;
    rival_ = std::min(rival_.value_or(one.trimmed), one.trimmed);
  }
  return best;
}

/// Lays A's mirror image on B, whose axes are A's, and returns how close it is where that is far
/// closer than A.
std::optional<double> PlaceSearch::closer_mirrored(const Candidate& best) {
  if (!(best.capped > kOff * frame_.size)) return {};
  Candidates images = by_axes(shape_a_, shape_b_);
  if (images.empty()) return {};
  const std::vector<DVec3> few = mirrored(few_, shape_a_), some = mirrored(some_, shape_a_);
  fitter_.refine(images, few, {});
  std::stable_sort(images.begin(), images.end(), ranks_before);
  Candidates closest{images.front()};
  fitter_.refine(closest, some, {.steps = 20});
  fitter_.measure(closest[0], some, Counting::kNearest);
  if (!(closest[0].capped <= kMirrored * best.capped)) return {};
  return closest[0].capped;
}

// The shift is rounded once, so that a mesh far from the origin is off by half a unit of its
// coordinates' last place, and not by its turn.
MatrixRows PlaceSearch::matrix_of(const Pose& pose) const {
  const glm::dquat& q = pose.turn;
  MatrixRows rows = scene::affine_of({.rotation = {q.x, q.y, q.z, q.w}})->m;
  for (int i = 0; i < 3; ++i) {
    auto& row = rows[static_cast<size_t>(i)];
    Float128 shift = float128(frame_.centre_b[i]) + float128(pose.shift[i]);
    for (int j = 0; j < 3; ++j)
      shift = shift - float128(row[static_cast<size_t>(j)]) * float128(frame_.centre_a[j]);
    row[3] = static_cast<double>(shift);
  }
  return rows;
}

Alignment PlaceSearch::find() {
  all_ = starts_as_turned();
  as_given_ = all_.size();
  for (const Candidate& one : by_axes(shape_a_, shape_b_)) all_.push_back(one);
  fitter_.refine(all_, few_, {});
  search_on();
  Candidates best{chosen(kept())};
  const std::optional<double> mirrored = closer_mirrored(best[0]);
  const std::vector<DVec3> many = area_samples(a_, std::max<size_t>(options_.samples, kSome));
  fitter_.refine(best, many, {.counting = Counting::kNoise, .steps = 20, .least_move = 1e-3});
  fitter_.measure(best[0], many, Counting::kNoise);
  const bool is_poor = !(best[0].trimmed <= kPoor * frame_.size) || !(best[0].share >= kLeastShare);
  return {.matrix = matrix_of(best[0].pose),
          .fit = {.rms = best[0].used,
                  .share = best[0].share,
                  .samples = many.size(),
                  .is_poor = is_poor,
                  .rival = rival_,
                  .mirrored = mirrored}};
}

}  // namespace

Alignment align(Solver& solver, const Mesh& a, const PreparedMesh& b, const AlignOptions& options) {
  FloatEnvironment ours;
  check_mesh(a);
  AlignOptions heard = options;
  if (options.goes_on)
    heard.goes_on = [&](size_t done) {
      return ours.outside([&] { return options.goes_on(done); });
    };
  return PlaceSearch(solver, a, b, heard).find();
}

Alignment align(Solver& solver, const Mesh& a, const Mesh& b, const AlignOptions& options) {
  return align(solver, a, solver.prepare(b), options);
}

}  // namespace vkh
