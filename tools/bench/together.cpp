#include "tools/bench/together.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>

#include "tools/bench/table.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/stream.h"

namespace vkh::bench {
namespace {

struct Loaded {
  Mesh a, b;
  uint64_t faces() const { return a.faces.size() + b.faces.size(); }
};

struct Cost {
  std::vector<double> gpu_ms, wall_ms;

  void add(double gpu, double wall) {
    gpu_ms.push_back(gpu);
    wall_ms.push_back(wall);
  }
};

// If several run side by side, the time of the last to end contains all submissions.
double longest_gpu_ms(const std::vector<Report>& reports) {
  double longest = 0;
  for (const Report& r : reports) longest = std::max(longest, gpu_ms(r));
  return longest;
}

bool is_same(const Report& x, const Report& y) {
  return x.status == Status::kClosed && y.status == Status::kClosed && x.lower == y.lower &&
         x.upper == y.upper && x.candidates == y.candidates && x.queries == y.queries;
}

std::vector<Report> run_alone(Solver& solver, const std::vector<PairView>& pairs,
                              const SolveOptions& options, Cost& cost) {
  std::vector<Report> reports;
  double gpu = 0, wall = 0;
  for (const PairView& p : pairs) {
    reports.push_back(solver.distance(p.a, p.b, options));
    gpu += gpu_ms(reports.back());
    wall += reports.back().times.wall_ms;
  }
  cost.add(gpu, wall);
  return reports;
}

class Totals {
 public:
  void add(const std::string& family, double alone, double together) {
    for (const std::string& of : {family, std::string("all")}) {
      alone_[of] += alone;
      together_[of] += together;
    }
  }
  void print() const {
    for (const auto& [family, alone] : alone_)
      std::printf("# %s: alone %.2f ms, together %.2f ms of GPU time\n", family.c_str(), alone,
                  together_.at(family));
  }

 private:
  std::map<std::string, double> alone_, together_;
};

struct Group {
  std::string family;
  std::vector<const Loaded*> pairs;
};

int run_group(Solver& solver, const Group& group, int repeat, const SolveOptions& options,
              Totals& totals) {
  std::vector<PairView> pairs;
  uint64_t faces = 0;
  for (const Loaded* loaded : group.pairs) {
    pairs.push_back({loaded->a, loaded->b});
    faces += loaded->faces();
  }
  Cost unused, alone, together;
  const std::vector<Report> expected = run_alone(solver, pairs, options, unused);
  int wrong = 0;
  solver.distances(pairs, options);
  for (int i = 0; i < repeat; ++i) {
    run_alone(solver, pairs, options, alone);
    const std::vector<Report> found = solver.distances(pairs, options);
    together.add(longest_gpu_ms(found), found[0].times.wall_ms);
    for (size_t p = 0; p < pairs.size(); ++p) wrong += is_same(found[p], expected[p]) ? 0 : 1;
  }
  std::printf("%s,%zu,%llu,%s,%.4f,%.4f,%.3f,%.3f\n", group.family.c_str(), pairs.size(),
              static_cast<unsigned long long>(faces), wrong == 0 ? "ok" : "DIFFERENT",
              median(alone.gpu_ms), median(together.gpu_ms), median(alone.wall_ms),
              median(together.wall_ms));
  std::fflush(stdout);
  totals.add(group.family, median(alone.gpu_ms), median(together.gpu_ms));
  return wrong;
}

}  // namespace

int run_together(Solver& solver, const std::vector<Row>& rows, const Groups& groups,
                 SolveOptions options) {
  options.engine.stage_times = false;
  std::map<std::string, std::vector<Loaded>> families;
  for (const Row& row : rows)
    families[row.family].push_back({read_mesh(row.file_a), read_mesh(row.file_b)});
  std::printf(
      "family,pairs,faces,verdict,alone_gpu_ms,together_gpu_ms,alone_wall_ms,together_wall_ms\n");
  Totals totals;
  int wrong = 0;
  for (auto& [family, pairs] : families) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Loaded& x, const Loaded& y) { return x.faces() < y.faces(); });
    for (size_t from = 0; from < pairs.size(); from += groups.size) {
      Group group{family, {}};
      for (size_t i = from; i < std::min(from + groups.size, pairs.size()); ++i)
        group.pairs.push_back(&pairs[i]);
      wrong += run_group(solver, group, groups.repeat, options, totals);
    }
  }
  totals.print();
  return wrong;
}

void run_stream(const std::string& device, const std::vector<Row>& rows, const Groups& groups,
                const SolveOptions& options) {
  using Clock = std::chrono::steady_clock;
  std::vector<StreamPair> pairs;
  for (const Row& row : rows) {
    StreamPair& pair = pairs.emplace_back();
    pair.a = std::make_shared<Mesh>(read_mesh(row.file_a));
    pair.b = std::make_shared<Mesh>(read_mesh(row.file_b));
    pair.options = options;
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const StreamPair& x, const StreamPair& y) {
    return x.a->faces.size() + x.b->faces.size() < y.a->faces.size() + y.b->faces.size();
  });
  const size_t passes = static_cast<size_t>(groups.repeat) * 6 + 1;
  std::vector<Clock::time_point> ends(passes);
  size_t delivered = 0;
  StreamOptions asked;
  asked.devices = {device};
  asked.together = groups.size;
  PairStream stream(asked, [&](const StreamResult&) {
    if (++delivered % pairs.size() == 0) ends[delivered / pairs.size() - 1] = Clock::now();
  });
  for (size_t pass = 0; pass < passes; ++pass) {
    for (const StreamPair& pair : pairs) stream.push(pair);
  }
  stream.finish();
  std::vector<double> ms;
  for (size_t pass = 1; pass < passes; ++pass)
    ms.push_back(std::chrono::duration<double, std::milli>(ends[pass] - ends[pass - 1]).count());
  std::printf("# stream: %.2f ms of wall time a pass of %zu pairs; GPU %.2f\n", median(ms),
              pairs.size(), stream.times().gpu_s * 1000 / static_cast<double>(passes));
}

}  // namespace vkh::bench
