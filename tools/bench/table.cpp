#include "tools/bench/table.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "engine/stages.h"

namespace vkh::bench {
namespace {

// The stages of the BVH, the seed, the moves to more room, those of the waves, each once,
// and the report.
std::vector<std::string> stage_names() {
  std::vector<std::string> names = {"morton", "sort", "hierarchy", "seed", "move"};
  const auto add = [&](const char* name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
  };
  for (const Stage& stage : kStages) add(stage.column);
  add("report");
  return names;
}

template <class F>
double median_of(const std::vector<Report>& reports, F value) {
  std::vector<double> values;
  values.reserve(reports.size());
  for (const Report& r : reports) values.push_back(value(r));
  return median(values);
}

double stage_ms(const Report& r, const std::string& name) {
  for (const StageStats& s : r.stages) {
    if (s.name == name) return s.gpu_ms;
  }
  return 0;
}

double median_time(const std::vector<Report>& reports, double Times::*member) {
  return median_of(reports, [&](const Report& r) { return r.times.*member; });
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double gpu_ms(const Report& report) { return report.times.hierarchy_ms + report.times.solve_ms; }

bool Outcome::repeats() const {
  const auto is_same = [&](const Report& r) {
    return r.lower == last().lower && r.upper == last().upper;
  };
  return std::all_of(reports.begin(), reports.end(), is_same) &&
         std::all_of(staged.begin(), staged.end(), is_same);
}

bool intervals_meet(const std::vector<Outcome>& outcomes) {
  double lower = 0, upper = std::numeric_limits<double>::infinity();
  for (const Outcome& o : outcomes) {
    for (const Report& r : o.reports) {
      lower = std::max(lower, r.lower);
      upper = std::min(upper, r.upper);
    }
  }
  return lower <= upper;
}

void print_header() {
  std::printf(
      "pair,family,preset,faces_a,faces_b,status,verdict,lower,upper,gap,waves,candidates,queries,"
      "peak,workspace_mib,runs,load_ms,setup_ms,upload_ms,hierarchy_ms,solve_ms,gpu_ms,wall_ms");
  for (const std::string& stage : stage_names()) std::printf(",stage_%s_ms", stage.c_str());
  std::printf("\n");
}

void print_row(const Row& row, const Outcome& o, bool meets) {
  const Report& r = o.last();
  const double hierarchy = median_time(o.reports, &Times::hierarchy_ms);
  const double solve = median_time(o.reports, &Times::solve_ms);
  using Count = unsigned long long;
  std::printf("%s,%s,%s,%llu,%llu,%s,%s,%.17g,%.17g,%.3g,%u,%llu,%llu,%llu,%.1f,%zu",
              row.pair.c_str(), row.family.c_str(), o.variant.c_str(), Count{r.mesh_a.faces},
              Count{r.mesh_b.faces}, status_name(r.status),
              !meets         ? "DISJOINT"
              : !o.repeats() ? "UNREPEATABLE"
                             : "ok",
              r.lower, r.upper, r.gap(), r.waves, Count{r.candidates}, Count{r.queries},
              Count{r.peak_frontier}, static_cast<double>(r.workspace_bytes) / 0x1p20,
              o.reports.size());
  std::printf(",%.3f,%.3f,%.3f,%.4f,%.4f,%.4f,%.3f", o.load_ms, o.setup_ms,
              median_time(o.reports, &Times::upload_ms), hierarchy, solve, hierarchy + solve,
              median_time(o.reports, &Times::wall_ms));
  const std::vector<Report>& staged = o.staged.empty() ? o.reports : o.staged;
  for (const std::string& stage : stage_names())
    std::printf(",%.4f", median_of(staged, [&](const Report& x) { return stage_ms(x, stage); }));
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace vkh::bench
