#include "vkhausdorff/asking.h"

#include <future>
#include <thread>
#include <vector>

#include "host/answer/asked_pair.h"
#include "host/answer/known_answer.h"
#include "host/base/float_environment.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

using Clock = std::chrono::steady_clock;

Question of_meshes(Question question) {
  if (question.metrics) question.symmetric = true;
  if (question.command.empty())
    question.command = question.metrics ? "metrics" : question.max ? "gate" : "distance";
  return question;
}

}  // namespace

struct Asking::State {
  State(Question asked, std::shared_ptr<const ReadMesh> mesh_a,
        std::shared_ptr<const ReadMesh> mesh_b, std::span<Solver* const> on)
      : question(of_meshes(std::move(asked))),
        a(std::move(mesh_a)),
        b(std::move(mesh_b)),
        solvers(on.begin(), on.end()),
        known(question) {
    if (a == nullptr || b == nullptr) throw UsageError("Asking: expected two meshes, not null");
    if (solvers.empty()) throw UsageError("Asking: expected a Solver");
  }

  ~State() {
    stop.request_stop();
    if (thread.joinable()) thread.join();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  double left_s() const {
    const std::chrono::duration<double> spent = Clock::now() - start;
    return question.budget.time_limit_s - spent.count();
  }
  Observer observer() {
    return {.goes_on = [this] { return !stop.stop_requested() && left_s() > 0; },
            .left_s = [this] { return left_s(); },
            .search =
                [this](const Progress& progress) {
                  known.hear(progress);
                  return !stop.stop_requested();
                },
            .cells = [this](const SideCount& side) { known.hear_cells(side); },
            .leaves = [this](const SideCount& side) { known.hear_leaves(side); },
            .found = [this](const Answer& answer) { known.keep(answer); }};
  }
  void work();
  void run(const std::stop_token& callers);

  const Question question;
  const std::shared_ptr<const ReadMesh> a, b;
  const std::vector<Solver*> solvers;
  const Clock::time_point start = Clock::now();
  KnownAnswer known;
  std::promise<void> over;
  std::shared_future<void> result = over.get_future().share();
  std::stop_source stop;
  std::thread thread;
};

void Asking::State::work() {
  const FloatEnvironment ours;
  const Observer heard = observer();
  Solver& first = *solvers.front();
  AskedPair pair(question);
  pair.take(a, shaped(b));
  pair.fit(first, heard);
  known.begin(pair.answer());
  known.open(first.device().description());
  pair.solve(solvers, heard);
  pair.finish(first, heard);
  Answer& answer = pair.answer();
  answer.waits.total = 1000 * std::chrono::duration<double>(Clock::now() - start).count();
  known.end(answer);
}

void Asking::State::run(const std::stop_token& callers) {
  const std::stop_callback passed_on(callers, [this] { stop.request_stop(); });
  try {
    work();
    over.set_value();
  } catch (...) {
    over.set_exception(std::current_exception());
  }
}

Asking::Asking(Question question, std::shared_ptr<const ReadMesh> a,
               std::shared_ptr<const ReadMesh> b, std::span<Solver* const> solvers,
               std::stop_token stop)
    : state_(std::make_unique<State>(std::move(question), std::move(a), std::move(b), solvers)) {
  state_->thread =
      std::thread([state = state_.get(), callers = std::move(stop)] { state->run(callers); });
}

Asking::~Asking() = default;

void Asking::cancel() { state_->stop.request_stop(); }

bool Asking::wait(Deadline deadline) const {
  return state_->result.wait_until(deadline) == std::future_status::ready;
}

Answer Asking::known() const { return state_->known.answer(); }

WorkDone Asking::done() const { return state_->known.done(); }

Answer Asking::answer() const {
  state_->result.get();
  return known();
}

}  // namespace vkh
