#include "vkhausdorff/asking.h"

#include <system_error>
#include <vector>

#include "host/answer/asking_state.h"
#include "host/answer/stop.h"
#include "host/base/begin_now.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

/// The meshes and solvers of a caller.
class GivenMeshes : public AskingSource {
 public:
  GivenMeshes(std::shared_ptr<const ReadMesh> a, std::shared_ptr<const ReadMesh> b,
              std::span<Solver* const> solvers, double time_limit_s, std::stop_token stop)
      : a_(std::move(a)),
        b_(std::move(b)),
        solvers_(solvers.begin(), solvers.end()),
        time_limit_s_(time_limit_s),
        stop_(std::move(stop)) {
    if (a_ == nullptr || b_ == nullptr) throw UsageError("Asking: expected two meshes, not null");
    if (solvers_.empty()) throw UsageError("Asking: expected a Solver");
  }

  void read(AskedPair& pair) override { pair.take(a_, shaped(b_)); }
  std::span<Solver* const> open(double& /*ms*/) override { return solvers_; }
  void end(Answer& answer) override { answer.waits.total = 1000 * seconds_since(start_); }
  bool is_called_off() const override { return stop_.stop_requested(); }
  double left_s() const override { return time_limit_s_ - seconds_since(start_); }

 private:
  const std::shared_ptr<const ReadMesh> a_, b_;
  const std::vector<Solver*> solvers_;
  const double time_limit_s_;
  const std::stop_token stop_;
  const Clock::time_point start_ = Clock::now();
};

Question of_meshes(Question question) {
  if (question.metrics) question.symmetric = true;
  if (question.command.empty())
    question.command = question.metrics ? "metrics" : question.max ? "gate" : "distance";
  return question;
}

}  // namespace

Asking::Asking(Question question, std::shared_ptr<const ReadMesh> a,
               std::shared_ptr<const ReadMesh> b, std::span<Solver* const> solvers,
               std::stop_token stop)
    : Asking([&] {
        const double time_limit_s = question.budget.time_limit_s;
        return std::make_shared<AskingState>(
            of_meshes(std::move(question)),
            std::make_unique<GivenMeshes>(std::move(a), std::move(b), solvers, time_limit_s,
                                          std::move(stop)));
      }()) {}

Asking::Asking(std::shared_ptr<AskingState> state) : state_(std::move(state)) {
  try {
    thread_ = std::thread([at = state_] { at->run(); });
  } catch (const std::system_error&) {
    state_->run();
  }
}

Asking::~Asking() {
  if (!thread_.joinable()) return;
  cancel();
  thread_.join();
}

void Asking::leave() {
  if (thread_.joinable()) leave_thread(std::move(thread_));
}

void Asking::cancel() { state_->cancel(); }

bool Asking::wait(Deadline deadline) const { return state_->wait(deadline); }

Answer Asking::known() const { return state_->known(); }

WorkDone Asking::done() const { return state_->done(); }

Answer Asking::answer() const {
  state_->check();
  return known();
}

}  // namespace vkh
