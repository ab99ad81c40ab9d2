#include "host/solve/join_reports.h"

#include <algorithm>
#include <array>

#include "host/base/rounding.h"

namespace vkh {
namespace {

void copy_witness(const Report& from, Report& to) {
  to.lower = from.lower;
  to.witness_a = from.witness_a;
  to.witness_b = from.witness_b;
  to.has_witness = from.has_witness;
}

/// Adds each item to the one with its name, or appends it.
template <class Named, class Add>
void add_by_name(const std::vector<Named>& more, std::vector<Named>& all, const Add& add) {
  for (const Named& one : more) {
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const Named& x) { return x.name == one.name; });
    if (same == all.end())
      all.push_back(one);
    else
      add(one, *same);
  }
}

void add_stages(const std::vector<StageStats>& stages, std::vector<StageStats>& all) {
  add_by_name(stages, all, [](const StageStats& one, StageStats& sum) {
    sum.gpu_ms += one.gpu_ms;
    sum.times += one.times;
  });
}

void add_coverage(const std::optional<CoverageCheck>& part, std::optional<CoverageCheck>& all) {
  if (!part || !all) return all.reset();
  const auto faces = [](const CoverageCheck& c) {
    return static_cast<double>(c.whole + c.waiting + c.wrong);
  };
  const double before = faces(*all), more = faces(*part);
  all->closed = (all->closed * before + part->closed * more) / std::max(before + more, 1.0);
  all->whole += part->whole;
  all->waiting += part->waiting;
  all->wrong += part->wrong;
  all->holds = all->holds && part->holds;
}

void add_work(const Report& part, Report& all) {
  all.waves = std::max(all.waves, part.waves);
  all.candidates += part.candidates;
  all.queries += part.queries;
  add_stages(part.stages, all.stages);
  add_culled(part.culled, all.culled);
}

void add(const Report& part, Report& all) {
  if (part.lower > all.lower || !all.has_witness) copy_witness(part, all);
  all.upper = std::max(all.upper, part.upper);
  add_work(part, all);
  all.peak_frontier += part.peak_frontier;
  all.workspace_bytes += part.workspace_bytes;
  all.host_memory_bytes += part.host_memory_bytes;
  all.times.upload_ms = std::max(all.times.upload_ms, part.times.upload_ms);
  all.times.hierarchy_ms = std::max(all.times.hierarchy_ms, part.times.hierarchy_ms);
  all.times.solve_ms = std::max(all.times.solve_ms, part.times.solve_ms);
  add_coverage(part.coverage_check, all.coverage_check);
}

}  // namespace

void add_culled(const std::vector<CullCount>& culled, std::vector<CullCount>& all) {
  add_by_name(culled, all,
              [](const CullCount& one, CullCount& sum) { sum.candidates += one.candidates; });
}

Report joined_report(std::span<const Report> parts) {
  Report all = parts[0];
  all.wave_stats.clear();
  for (const Report& part : parts.subspan(1)) add(part, all);
  return all;
}

Status joined_status(const Report& whole, std::span<const Report> parts) {
  if (is_within(whole.lower, whole.upper, whole.tolerance)) return Status::kClosed;
  if (whole.known_lower > 0 && is_within(whole.known_lower, whole.upper, whole.tolerance))
    return Status::kPruned;
  if (is_decided(whole.lower, whole.upper, whole.limit)) return Status::kLimit;
  constexpr std::array order{Status::kCancelled, Status::kTime, Status::kWaves, Status::kMemory};
  for (const Status status : order) {
    for (const Report& part : parts) {
      if (part.status == status) return status;
    }
  }
  return Status::kPrecision;
}

Report narrowed(const Report& first, Report second) {
  if (first.lower > second.lower && first.has_witness) copy_witness(first, second);
  second.upper = std::min(first.upper, second.upper);
  second.peak_frontier = std::max(first.peak_frontier, second.peak_frontier);
  add_work(first, second);
  second.times.upload_ms += first.times.upload_ms;
  second.times.hierarchy_ms += first.times.hierarchy_ms;
  second.times.solve_ms += first.times.solve_ms;
  return second;
}

}  // namespace vkh
