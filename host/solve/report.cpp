// The words for a report's results, and the interval of one or two directions.
#include "vkhausdorff/report.h"

#include <algorithm>

#include "host/base/float_environment.h"
#include "host/base/rounding.h"

namespace vkh {
namespace {

/// The status of the direction that keeps a symmetric interval open: the one with the larger upper.
Status open_status(const Report& r, const Report& back) {
  // If the forward direction pruned it (and not a bound that a caller knew), the reverse direction
  // decides nothing.
  const bool pruned =
      back.status == Status::kPruned && is_within(r.lower, back.upper, back.tolerance);
  const bool back_closed = back.status == Status::kClosed || pruned;
  const bool open_there = back_closed || (r.status != Status::kClosed && r.upper >= back.upper);
  const Status status = (open_there ? r : back).status;
  // Each direction is closed, but to tolerances that differ.
  return status == Status::kClosed ? Status::kPrecision : status;
}

}  // namespace

const char* status_name(Status status) {
  switch (status) {
    case Status::kClosed:
      return "closed";
    case Status::kPrecision:
      return "precision";
    case Status::kTime:
      return "time";
    case Status::kWaves:
      return "waves";
    case Status::kMemory:
      return "memory";
    case Status::kCancelled:
      return "cancelled";
    case Status::kPruned:
      return "pruned";
    case Status::kLimit:
      return "limit";
  }
  return "unknown";
}

const char* verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kWithin:
      return "pass";
    case Verdict::kBeyond:
      return "fail";
    case Verdict::kUndecided:
      break;
  }
  return "undecided";
}

Verdict verdict_of(double lower, double upper, const Limit& limit) {
  if (upper <= limit.within) return Verdict::kWithin;
  return lower > limit.beyond ? Verdict::kBeyond : Verdict::kUndecided;
}

bool is_decided(double lower, double upper, const Limit& limit) {
  return limit.within > 0 && verdict_of(lower, upper, limit) != Verdict::kUndecided;
}

double gap_of(double lower, double upper, double diagonal_a) {
  const FloatEnvironment ours;
  const double width = width_up(lower, upper);
  return diagonal_a > 0 ? divide_up(width, diagonal_a) : width;
}

double Report::gap() const { return gap_of(lower, upper, diagonal_a); }

CertifiedInterval symmetric_interval(const Report& r, const Report& back) {
  const FloatEnvironment ours;
  CertifiedInterval both;
  both.lower = std::max(r.lower, back.lower);
  both.upper = std::max(r.upper, back.upper);
  both.gap = gap_of(both.lower, both.upper, r.diagonal_a);
  // The whole is closed if both directions are closed with one tolerance, or if one is and the
  // other cannot reach it: the width shows either.
  const double tolerance = std::min(r.tolerance, back.tolerance);
  const bool closed = is_within(both.lower, both.upper, tolerance);
  both.status = closed ? Status::kClosed : open_status(r, back);
  return both;
}

}  // namespace vkh
