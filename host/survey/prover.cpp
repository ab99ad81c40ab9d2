#include "vkhausdorff/prover.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "host/base/parallel.h"
#include "host/base/rounding.h"
#include "host/mesh/same_faces.h"
#include "host/solve/cell_corners.h"
#include "host/solve/held_pairs.h"
#include "host/survey/proof_tree.h"

namespace vkh {
namespace {

using Clock = std::chrono::steady_clock;

constexpr unsigned kMostHalvings = 100;  // docs/certificate-file.md

// A part without a proof yet.
struct Open {
  uint32_t node;
  uint32_t face;
  uint8_t depth = 0;
  bool has_cell = true;  // its corners are multiples of 2^-20
  uint8_t searched =
      0;  // its depth, or an ancestor's, when all of B was searched for it last; 0: never
  bool is_proven = false;
  gpu::Cell cell{};
  Part part;
  Hints hints;
};

// Whether all corners are one: halves of such a part would be the part itself.
bool is_point(const Part& part) {
  const auto is_first = [&](const Point2& p) { return p.hi == part[0].hi && p.lo == part[0].lo; };
  return is_first(part[1]) && is_first(part[2]);
}

// The corner opposite the part's longest edge. It only steers.
uint8_t opposite_longest(const Part& part) {
  const auto length = [&](size_t i, size_t j) {
    return glm::distance(part[i].hi - part[j].hi, part[j].lo - part[i].lo);
  };
  const double la = length(1, 2), lb = length(2, 0), lc = length(0, 1);
  if (la >= lb && la >= lc) return 0;
  return lb >= lc ? 1 : 2;
}

// Makes a half: the middle of the edge opposite corner `opposite` in the place of corner `gone`.
Open half_of(const Open& open, uint32_t node, uint8_t opposite, size_t gone) {
  Open half = open;
  const size_t j = (opposite + 1u) % 3, k = (opposite + 2u) % 3;
  half.node = node;
  ++half.depth;
  half.part[gone] = between(open.part[j], open.part[k], 0.5);
  if (!half.has_cell) return half;
  const lib::Bary3 t = corners_of(open.cell);
  std::array<glm::uvec2, 3> at = {t.a, t.b, t.c};
  const glm::uvec2 twice = at[j] + at[k];
  half.has_cell = (twice.x & 1u) == 0 && (twice.y & 1u) == 0;
  if (!half.has_cell) return half;
  at[gone] = {twice.x / 2, twice.y / 2};
  set_corners(half.cell, {at[0], at[1], at[2]});
  return half;
}

class Prover {
 public:
  Prover(const SurveyedPair& pair, const ProofJob& job, Proof& result)
      : bound_(pair.bound),
        report_(job.report),
        goes_on_(job.goes_on),
        result_(result),
        exponent_(pair.frame.exponent),
        delta_(add_up(job.a.delta, job.b.delta)),
        a_(job.a, exponent_),
        b_(job.b, exponent_),
        upper_(target(report_.upper)),
        spare_(std::ldexp(spare_of(report_), exponent_)),
        batch_(pair.on_cpu ? 1024 : 65536) {
    if (upper_ <= 0) same_ = same_faces(job.b, job.a);
  }

  void prove() {
    const Clock::time_point start = Clock::now();
    double most = 0;
    for (size_t first = 0; first < a_.face_count(); first += kFacesAtOnce)
      most = std::max(most, prove(first, std::min(kFacesAtOnce, a_.face_count() - first)));
    most = std::max(most, raised_);
    result_.upper = most > 0 ? std::max(report_.upper, given(most)) : report_.upper;
    result_.ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  }

 private:
  static constexpr size_t kFacesAtOnce = size_t{1} << 16,  // their open parts take the memory
      kPartsAtOnce = size_t{1} << 15, kMostOpen = size_t{1} << 21;
  static constexpr size_t kPartsATurn = 256;  // for a thread
  static constexpr uint8_t kSmall = 8;        // halvings
  static constexpr size_t kFew = 64;
  static constexpr double kMore = 256 * 0x1p-52;
  // If an edge of B crosses a face in its plane, the parts at the edge are never proven to 0: then
  // this many parts of this size may use more and more.
  static constexpr uint8_t kVerySmall = 24, kSearchAgain = 8;
  // If the run's bound is as tight as doubles allow over a whole area, millions of parts come close
  // to it. Then parts may use more and more of what the tolerance leaves.
  static constexpr size_t kPiled = size_t{1} << 15;
  static constexpr double kMoreATurn = 64;
  static constexpr double kDoubt = 1 + 0x1p-20;         // eight ulp of a float
  static constexpr size_t kMostSeen = size_t{1} << 27;  // faces, in all searches: seconds
  static constexpr size_t kManySmall = size_t{1} << 12;

  // Half of what the interval may still grow by, in the files' units. A bound that is within a
  // limit stays within it.
  static double spare_of(const Report& r) {
    double left = add_down(r.tolerance, -width_up(r.lower, r.upper));
    if (r.limit.within > 0 && r.upper <= r.limit.within)
      left = std::min(left, add_down(r.limit.within, -r.upper));
    return std::isfinite(left) ? std::max(left / 2, 0.0) : 0;
  }

  // Converts a length of the files to the scaled meshes, less their error, rounded down.
  double target(double upper) const {
    const double scaled = std::ldexp(add_down(upper, -delta_), exponent_);
    return std::isnormal(scaled) || scaled == 0 ? scaled : std::nextafter(scaled, -1.0);
  }
  // Converts a length of the scaled meshes to the files' units, rounded up.
  double given(double scaled) const {
    const double length = std::ldexp(scaled, -exponent_);
    return add_up(std::isnormal(length) ? length : std::nextafter(length, 1.0), delta_);
  }

  // Proves `count` faces from the first on; returns the largest bound that a leaf had to be raised
  // to.
  double prove(size_t first, size_t count) {
    ProofTree tree(count);
    std::vector<Open> open(count);
    for (size_t i = 0; i < count; ++i) open[i] = whole(static_cast<uint32_t>(first + i), i);
    double raised = 0;
    more_ = kMore;
    while (!open.empty()) {
      std::vector<Open> halves;
      has_few_ = open.size() <= kFew;
      for (size_t begin = 0; begin < open.size(); begin += kPartsAtOnce) {
        const size_t end = std::min(begin + kPartsAtOnce, open.size());
        std::vector<Open> some(open.begin() + static_cast<std::ptrdiff_t>(begin),
                               open.begin() + static_cast<std::ptrdiff_t>(end));
        const bool gives_up = ended() || halves.size() > kMostOpen;
        raised = std::max(raised, gives_up ? give_up(some, tree) : advance(some, tree, halves));
      }
      open = std::move(halves);
      const uint8_t depth = open.empty() ? 0 : open.front().depth;
      if (depth >= kVerySmall && open.size() > kManySmall) more_ *= 4;
      if (depth >= kSmall && depth < kVerySmall && open.size() > kPiled)
        more_ = std::max(more_, std::min(kMoreATurn * more_, spare_));
    }
    result_.blocks += tree.written();
    result_.bytes = result_.blocks.size();
    return raised;
  }

  // Proves as many as it can, and halves the rest.
  double advance(std::vector<Open>& some, ProofTree& tree, std::vector<Open>& halves) {
    double raised = close(some, tree);
    ask(some);
    search(some);
    raised = std::max(raised, close(some, tree));
    return std::max(raised, halve(some, tree, halves));
  }

  Open whole(uint32_t face, size_t node) const {
    Open open;
    open.node = static_cast<uint32_t>(node);
    open.face = face;
    open.part = a_.part(face);
    open.cell.face = face;
    open.cell.start = gpu::kNone;
    const lib::Bary3 root = lib::whole_root();
    set_corners(open.cell, {root.a, root.b, root.c});
    if (!same_.empty() && same_[face] != kNoFace) open.hints.add(same_[face]);
    return open;
  }

  bool ended() {
    if (!ended_ && goes_on_ && !goes_on_(result_.leaves)) ended_ = true;
    return ended_;
  }

  // Adds leaves for the parts that a hint proves; the others stay, in their order. Points and small
  // parts may use a little more than the bound, unless few parts are left: these are around the
  // farthest point of A, where halving goes on until only roundings are left.
  double close(std::vector<Open>& some, ProofTree& tree) {
    std::vector<std::optional<Leaf>> found(some.size());
    std::atomic<bool> took_more = false;
    const size_t turns = (some.size() + kPartsATurn - 1) / kPartsATurn;
    for_each_index(turns, [&](size_t turn) {
      const size_t end = std::min(some.size(), (turn + 1) * kPartsATurn);
      for (size_t i = turn * kPartsATurn; i < end; ++i) {
        found[i] = proof_of(some[i].part, b_, some[i].hints, upper_);
        if (found[i] || !may_take_more(some[i])) continue;
        found[i] = proof_of(some[i].part, b_, some[i].hints, upper_ + more_);
        if (found[i]) took_more = true;
      }
    });
    for (size_t i = 0; i < some.size(); ++i) {
      some[i].is_proven = found[i].has_value();
      if (found[i]) add(some[i].node, *found[i], tree);
    }
    std::erase_if(some, [](const Open& one) { return one.is_proven; });
    return took_more ? upper_ + more_ : 0;
  }

  bool may_take_more(const Open& one) const {
    return is_point(one.part) || (one.depth >= kSmall && !has_few_);
  }

  void add(uint32_t node, const Leaf& leaf, ProofTree& tree) {
    tree.prove(node, leaf);
    ++result_.leaves;
    if (leaf.alone != Leaf::kUncut) ++result_.cut_leaves;
  }

  // Chooses the parts for which all of B is searched: parts too small for the device, points, and
  // small parts whose known faces exceed the bound only by a float's rounding, since the device may
  // have missed a nearer face. Of the others only the farthest: if all of B is too far from it, the
  // bound must be raised, and halving the rest would be in vain.
  std::vector<Open*> to_search(std::vector<Open>& open) {
    std::vector<Open*> sought;
    Open* farthest = nullptr;
    double most = upper_ * kDoubt;
    for (Open& one : open) {
      const bool is_new = one.searched == 0 || one.depth - one.searched >= kSearchAgain;
      if (!is_new || seen_ > (one.has_cell ? kMostSeen / 2 : kMostSeen)) continue;
      const bool may_halve = one.has_cell && !is_point(one.part);
      if (may_halve && (one.depth < kSmall || one.depth % kSearchAgain != 0)) continue;
      const double least = may_halve ? nearest_of(one.part, b_, one.hints).upper : 0;
      if (least > most) {
        most = least;
        farthest = &one;
      } else if (least <= upper_ * kDoubt) {
        seen_ += b_.face_count();
        sought.push_back(&one);
      }
    }
    if (farthest != nullptr) sought.push_back(farthest);
    return sought;
  }

  // Finds the nearest faces of B to each on the host, and again when the part is that much smaller.
  void search(std::vector<Open>& open) {
    const std::vector<Open*> sought = to_search(open);
    for_each_index(sought.size(), [&](size_t i) {
      sought[i]->hints = nearest_faces(sought[i]->part, b_);
      sought[i]->searched = sought[i]->depth;
    });
    for (const Open* one : sought) heed(*one);
  }

  // A middle that is farther from all of B than the bound refutes the run. The rest is then proven
  // to the bound that this part can have: otherwise halving would go on for millions of parts.
  void heed(const Open& searched) {
    const double from_b = middle_distance_up(searched.part, b_.corners(searched.hints.face[0]));
    if (from_b <= upper_ + kMore) return;
    upper_ = std::max(upper_, nearest_of(searched.part, b_, searched.hints).upper);
    raised_ = upper_;
  }

  // Asks the device which faces of B are near. Parts that are too small for it keep their hints.
  void ask(std::vector<Open>& open) {
    std::vector<Open*> asked;
    for (Open& one : open) {
      if (one.has_cell) asked.push_back(&one);
    }
    for (size_t first = 0; first < asked.size();) {
      const size_t count = std::min(batch_, asked.size() - first);
      ask(std::span(asked).subspan(first, count));
      first += count;
      if (first < asked.size() && ended()) return;
    }
  }

  void ask(std::span<Open* const> asked) {
    std::vector<gpu::Cell> cells;
    std::vector<gpu::CellBounds> bounds(asked.size());
    for (const Open* one : asked) cells.push_back(one->cell);
    const Clock::time_point start = Clock::now();
    bound_({.cells = cells, .first = 0, .bounds = bounds});
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    for (size_t i = 0; i < asked.size(); ++i) learn(*asked[i], bounds[i]);
    result_.asked_cells += asked.size();
    const auto fits = static_cast<size_t>(kSubmissionMs * static_cast<double>(asked.size()) / ms);
    batch_ = std::clamp(fits, kLeastBatch, std::min(4 * batch_, kMostBatch));
  }

  void learn(Open& one, const gpu::CellBounds& found) const {
    const Hints before = one.hints;
    one.hints = {};
    for (const uint32_t face : {found.face_a, found.face_b, found.face_c, found.face})
      one.hints.add(face);
    if (report_.has_witness) one.hints.add(static_cast<uint32_t>(report_.witness_b.face));
    for (size_t i = 0; i < before.count; ++i) one.hints.add(before.face[i]);
    one.cell.start = found.triangle;
  }

  // Halves the parts. Points, and parts that may not be halved again, get the bound that can be
  // proven for them.
  double halve(const std::vector<Open>& some, ProofTree& tree, std::vector<Open>& halves) {
    std::vector<Open> last;
    for (const Open& one : some) {
      if (one.depth >= kMostHalvings || is_point(one.part)) {
        last.push_back(one);
        continue;
      }
      const uint8_t opposite = opposite_longest(one.part);
      const uint32_t node = tree.halve(one.node, opposite);
      halves.push_back(half_of(one, node, opposite, (opposite + 2u) % 3));
      halves.push_back(half_of(one, node + 1, opposite, (opposite + 1u) % 3));
    }
    return give_up(last, tree);
  }

  // Returns the largest bound that is left.
  double give_up(const std::vector<Open>& open, ProofTree& tree) {
    double most = 0;
    for (const Open& one : open) {
      Hints hints = one.hints;
      if (hints.count == 0) hints.add(0);
      const Nearest nearest = nearest_of(one.part, b_, hints);
      add(one.node, nearest.leaf, tree);
      most = std::max(most, nearest.upper);
      ++result_.unproven;
    }
    return most;
  }

  static constexpr double kSubmissionMs = 50;  // so that Ctrl-C takes effect
  static constexpr size_t kLeastBatch = 64, kMostBatch = size_t{1} << 20;

  const BoundCells& bound_;
  const Report& report_;
  const std::function<bool(size_t)>& goes_on_;
  Proof& result_;
  int exponent_;
  double delta_;
  ScaledMesh a_, b_;
  double upper_;  // bound in the scaled meshes
  const double
      spare_;  // the bound may grow by this much, and the interval is still as narrow as asked
  std::vector<uint32_t> same_;  // where that is 0: one face of B for each of A
  double more_ = kMore;
  bool has_few_ = false;
  double raised_ = 0;  // upper_, if the run's was refuted
  size_t seen_ = 0;
  size_t batch_;
  bool ended_ = false;
};

}  // namespace

Proof prove(Solver& solver, const ProofJob& job) {
  refuse_any_triangulation(job.a, job.b, "certificate");
  Proof proof;
  SolveOptions options = job.options;
  options.progress = {};
  hold_pair(solver, {.a = job.a, .b = job.b}, options,
            [&](const SurveyedPair& pair) { Prover(pair, job, proof).prove(); });
  return proof;
}

}  // namespace vkh
