#include "host/solve/worker.h"

#include <algorithm>
#include <chrono>

#include "host/base/parallel.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

double gpu_ms(const Report& r) { return r.times.hierarchy_ms + r.times.solve_ms; }

// Pairs of a group are timed together, each while it ran.
double gpu_s(const std::vector<StreamResult>& results) {
  double most = 0;
  for (const StreamResult& r : results)
    most = std::max(most, gpu_ms(r.a_to_b) + (r.b_to_a ? gpu_ms(*r.b_to_a) : 0));
  return most / 1000;
}

void check_meshes(const StreamPair& pair) {
  if (pair.a == nullptr || pair.b == nullptr)
    throw UsageError("pair " + std::to_string(pair.number) +
                     " of a stream: two meshes are needed, not null");
}

// If two devices, or one device twice, were lost while they ran a pair, the pair is assumed to be
// the cause.
constexpr unsigned kMostTries = 2;

}  // namespace

// On a GPU a pair of 10,000 faces leaves most of it idle: 16 at once take half of the time
// (docs/benchmarks.md), and a third worker hides what the host does. A CPU device has no such room.
// A survey takes most of its time on one or two cores of the host, one pair after the other: 8
// lanes took half of the time of 3 on 16 cores (docs/log/metrics.md).
LaneShape shape_for(const StreamOptions& options, const DeviceDescription& device) {
  constexpr size_t kLanes = 3, kMostLanes = 8, kTogether = 16;
  const bool on_cpu = device.is_processor();
  LaneShape shape;
  const size_t lanes =
      options.surveys ? std::clamp(thread_count() / 2, kLanes, kMostLanes) : kLanes;
  const size_t together = options.surveys ? 1 : kTogether;
  shape.lanes = options.lanes != 0 ? options.lanes : on_cpu ? 1 : lanes;
  shape.together = options.together != 0 ? options.together : on_cpu ? 1 : together;
  shape.bytes = device.memory_bytes / 2 / shape.lanes;
  return shape;
}

void Worker::work() {
  for (;;) {
    Group group = share_.queue.take(device_.shape.together, device_.shape.bytes);
    if (device_
            .is_lost) {  // pairs that another worker gave back wait until the device is open again
      share_.queue.put_back(std::move(group));
      return;
    }
    if (group.empty()) return;
    const auto start = std::chrono::steady_clock::now();
    const bool goes_on = solve(std::move(group));
    const std::chrono::duration<double> busy = std::chrono::steady_clock::now() - start;
    share_.count(busy.count(), 0);
    if (!goes_on) return;
  }
}

void Worker::solve_all(Group& group) {
  std::vector<std::shared_ptr<const PreparedMesh>> prepared;
  for (WaitingPair& one : group) {
    check_meshes(one.pair);
    const bool is_prepared = one.pair.shares_b && device_.device != nullptr;
    prepared.push_back(is_prepared ? device_.prepared.get(solver_, one.pair.b) : nullptr);
    if (!one.pair.before) continue;
    one.pair.before(solver_, prepared.back().get(), one.pair);
    one.pair.before = {};  // a pair that is tried again is as it was left
  }
  std::vector<SolveOptions> options;
  std::vector<PairView> views;
  options.reserve(group.size());  // views refer to them
  for (size_t i = 0; i < group.size(); ++i) {
    const WaitingPair& one = group[i];
    options.push_back(one.pair.options);
    options.back().engine.stage_times = false;
    options.back().progress = [this, &pair = one.pair](Progress p) {
      p.pair = pair.number;
      return !share_.is_cancelled && (!pair.options.progress || pair.options.progress(p));
    };
    views.push_back({.a = *one.pair.a,
                     .b = *one.pair.b,
                     .prepared = prepared[i].get(),
                     .options = &options.back()});
  }
  std::vector<StreamResult> results(group.size());
  if (group[0].pair.symmetric) {
    std::vector<SymmetricReport> found = solver_.symmetrics(views);
    for (size_t i = 0; i < group.size(); ++i) {
      results[i].a_to_b = std::move(found[i].a_to_b);
      results[i].b_to_a = std::move(found[i].b_to_a);
    }
  } else {
    std::vector<Report> found = solver_.distances(views);
    for (size_t i = 0; i < group.size(); ++i) results[i].a_to_b = std::move(found[i]);
  }
  if (device_.device != nullptr) share_.count(0, gpu_s(results));
  for (size_t i = 0; i < group.size(); ++i) {
    results[i].number = group[i].pair.number;
    if (group[i].pair.beside) group[i].pair.beside(solver_, results[i]);
  }
  for (StreamResult& result : results) share_.deliver(std::move(result));
}

bool Worker::find_lost() {
  if (device_.device != nullptr && device_.device->is_lost()) device_.is_lost = true;
  return device_.is_lost;
}

void Worker::give_up(const WaitingPair& one) {
  share_.deliver({.number = one.pair.number,
                  .a_to_b = {},
                  .b_to_a = std::nullopt,
                  .error = std::current_exception()});
  share_.queue.done(1);
}

// Pairs that were too large together may fit alone, and one pair's error must not end the others.
bool Worker::retry_apart(Group group) {
  for (size_t i = 0; i < group.size(); ++i) {
    Group one;
    one.push_back(std::move(group[i]));
    if (solve(std::move(one))) continue;
    group.erase(group.begin(), group.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    share_.queue.put_back(std::move(group));
    return false;
  }
  return true;
}

bool Worker::solve(Group group) {
  try {
    solve_all(group);
    share_.queue.done(group.size());
    return true;
  } catch (const DeviceError&) {
    if (find_lost()) {
      const bool is_to_blame = group.size() == 1 && group[0].tries + 1 >= kMostTries;
      if (is_to_blame) {
        give_up(group[0]);
      } else {
        for (WaitingPair& one : group) ++one.tries;
        share_.queue.put_back(std::move(group));
      }
      return false;
    }
    if (group.size() == 1) give_up(group[0]);
  } catch (...) {
    if (group.size() == 1) give_up(group[0]);
  }
  return group.size() <= 1 || retry_apart(std::move(group));
}

}  // namespace vkh
