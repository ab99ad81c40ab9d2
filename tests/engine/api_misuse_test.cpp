// A caller that breaks a rule of the header learns its name: by an assert, or in any build by a
// context that checks calls.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

#ifndef NDEBUG
struct Ended {
  int signal = 0;
  std::string said;
};

/// Runs in a process of its own: asserts stand before the first call of Vulkan.
Ended ended(const std::function<void()>& call) {
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGABRT, SIG_DFL);  // doctest's handler would report it
    dup2(ends[1], STDERR_FILENO);
    call();
    _exit(0);
  }
  close(ends[1]);
  Ended out;
  std::array<char, 512> text{};
  for (ssize_t n = 0; (n = read(ends[0], text.data(), text.size())) > 0;)
    out.said.append(text.data(), static_cast<size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  out.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return out;
}
#endif

struct Misuse {
  const char* rule;
  std::function<void(VkhMesh&)> mesh;
  std::function<void(VkhProblem&)> problem;
};

const auto none = [](auto&) {};

/// Rules that vkhCmdBegin looks at.
const std::vector<Misuse>& misuses_of_begin() {
  static const std::vector<Misuse> all{
      {"vertexStride: a multiple of 4", [](VkhMesh& m) { m.vertexStride = 13; }, none},
      {"vertexStride: at least 12", [](VkhMesh& m) { m.vertexStride = 8; }, none},
      {"vertexOffset: a multiple of 4", [](VkhMesh& m) { m.vertexOffset = 2; }, none},
      {"indexType: VK_INDEX_TYPE", [](VkhMesh& m) { m.indexType = VkIndexType(77); }, none},
      {"indexOffset: a multiple", [](VkhMesh& m) { m.indexOffset = 2; }, none},
      {"vertexBuffer: not null", [](VkhMesh& m) { m.vertexBuffer = VK_NULL_HANDLE; }, none},
      {"faceCount: 1 to 2^28", [](VkhMesh& m) { m.faceCount = 0; }, none},
      {"vertexCount: 1 to 2^28", [](VkhMesh& m) { m.vertexCount = 0; }, none},
      {"workspace: at least", none, [](VkhProblem& p) { p.workspace.size = 4096; }},
      {"offset: a multiple of 256", none, [](VkhProblem& p) { p.workspace.offset = 4; }},
      {"workspace and ::b: apart", none,
       [](VkhProblem& p) { p.workspace.buffer = p.b.memory.buffer; }},
      {"cullTolerance: at least 0", none, [](VkhProblem& p) { p.options.cullTolerance = -1; }},
      {"cullTolerance: at least 0", none, [](VkhProblem& p) { p.options.cullTolerance = NAN; }},
      {"b: a hierarchy that was built", none, [](VkhProblem& p) { p.b.faceCount = 0; }},
      {"size: sizeof(VkhRunOptions)", none, [](VkhProblem& p) { p.options.size = 0; }},
      {"coverageBuffer: with a context", none,
       [](VkhProblem& p) { p.options.coverageBuffer = p.workspace.buffer; }}};
  return all;
}

/// A context that checks calls, and the first rule that it told of since the last clear.
class CheckingContext {
 public:
  CheckingContext() {
    VkhContextCreateInfo info = create_info(VKH_CONTEXT_CHECK_CALLS, VKH_DEVICE_KIND_NARROW);
    info.onMisuse = [](void* user, VkCommandBuffer recorded, const char* rule) {
      auto& self = *static_cast<CheckingContext*>(user);
      if (self.said.empty()) self.said = rule;
      self.commands = recorded;
    };
    info.misuseUser = this;
    REQUIRE(vkhCreateContext(&info, &context_) == VKH_SUCCESS);
  }
  ~CheckingContext() { vkhDestroyContext(context_); }
  CheckingContext(const CheckingContext&) = delete;
  CheckingContext& operator=(const CheckingContext&) = delete;
  VkhContext get() const { return context_; }

  std::string said;
  VkCommandBuffer commands = VK_NULL_HANDLE;

 private:
  VkhContext context_ = nullptr;
};

/// Records a call that breaks the rule, in any build.
void check_told(CheckingContext& context, ApiPair& pair, const char* rule,
                const std::function<void(VkCommandBuffer)>& call) {
  CAPTURE(rule);
  context.said.clear();
  const VkCommandBuffer commands = pair.commands().record(call);
  CHECK(context.said.find(rule) != std::string::npos);
  CHECK(context.commands == commands);
  CHECK(vkhGetRecordingResult(context.get(), commands) == VKH_ERROR_MISUSE);
  vkhReleaseCommandBuffer(context.get(), commands);
  CHECK(vkhGetRecordingResult(context.get(), commands) == VKH_SUCCESS);
}

}  // namespace

#ifndef NDEBUG
TEST_CASE("a rule that is broken is named") {
  ApiMesh a(icosphere(1.0, 1)), b(icosphere(1.1, 1));
  ApiPair pair(a, b, 1e-3f);
  pair.run([&](VkCommandBuffer commands) { pair.build(commands); });
  for (const Misuse& misuse : misuses_of_begin()) {
    CAPTURE(misuse.rule);
    const Ended end = ended([&] {
      VkhProblem problem = pair.problem();
      misuse.mesh(problem.a);
      misuse.problem(problem);
      vkhCmdBegin(pair.context(), VK_NULL_HANDLE, &problem, nullptr);
    });
    CHECK(end.signal == SIGABRT);
    CHECK(end.said.find(misuse.rule) != std::string::npos);
  }
  const Ended refit = ended([&] {
    VkhMesh other = b.view();
    other.faceCount -= 1;
    vkhCmdRefitHierarchy(pair.context(), VK_NULL_HANDLE, &other, &pair.problem().b, nullptr);
  });
  CHECK(refit.signal == SIGABRT);
  CHECK(refit.said.find("a mesh with the counts of the build") != std::string::npos);
  const Misuse moves[] = {
      {"vkhCmdMoveRun: the run's own workspace, or one apart", none,
       [](VkhProblem& p) { p.workspace.offset += 256; }},
      {"vkhCmdMoveRun: a workspace apart from VkhProblem::b", none,
       [](VkhProblem& p) { p.workspace.buffer = p.b.memory.buffer; }},
      {"vkhCmdMoveRun: at least as large", none, [](VkhProblem& p) { p.workspace.size -= 256; }}};
  for (const Misuse& misuse : moves) {
    CAPTURE(misuse.rule);
    const Ended end = ended([&] {
      VkhProblem problem = pair.problem(), moved = problem;
      misuse.problem(moved);
      vkhCmdMoveRun(pair.context(), VK_NULL_HANDLE, &problem, &moved.workspace, nullptr);
    });
    CHECK(end.signal == SIGABRT);
    CHECK(end.said.find(misuse.rule) != std::string::npos);
  }
  const Ended cells = ended([&] {
    const VkhCells asked{VK_NULL_HANDLE, 0, 0, 1, pair.report_buffer(), 0};
    vkhCmdBoundCells(pair.context(), VK_NULL_HANDLE, &pair.problem(), &asked, nullptr);
  });
  CHECK(cells.signal == SIGABRT);
  CHECK(cells.said.find("vkhCmdBoundCells: a context of VKH_CONTEXT_CELLS") != std::string::npos);
  const Ended closest = ended([&] {
    const VkhClosestQuery asked{pair.report_buffer(), 0, 1, VK_FALSE, pair.report_buffer(), 0};
    vkhCmdFindClosest(pair.context(), VK_NULL_HANDLE, &pair.problem().b, &asked, nullptr);
  });
  CHECK(closest.signal == SIGABRT);
  CHECK(closest.said.find("vkhCmdFindClosest: a context of VKH_CONTEXT_CLOSEST") !=
        std::string::npos);
  const Ended report = ended([&] {
    vkhCmdWriteReport(pair.context(), VK_NULL_HANDLE, &pair.problem(), pair.report_buffer(), 4,
                      nullptr);
  });
  CHECK(report.signal == SIGABRT);
  CHECK(report.said.find("an offset that is a multiple of 256") != std::string::npos);
}
#endif

TEST_CASE(
    "with VKH_CONTEXT_CHECK_CALLS a broken rule is told in any build, and nothing is recorded") {
  CheckingContext context;
  ApiMesh a(icosphere(1.0, 1)), b(icosphere(1.1, 1));
  ApiPair pair(a, b, 1e-3f, context.get());
  pair.run([&](VkCommandBuffer commands) { pair.build(commands); });
  for (const Misuse& misuse : misuses_of_begin()) {
    check_told(context, pair, misuse.rule, [&](VkCommandBuffer commands) {
      VkhProblem problem = pair.problem();
      misuse.mesh(problem.a);
      misuse.problem(problem);
      vkhCmdBegin(context.get(), commands, &problem, nullptr);
    });
  }
  check_told(context, pair, "vkhCmdBegin: problem: not null", [&](VkCommandBuffer commands) {
    vkhCmdBegin(context.get(), commands, nullptr, nullptr);
  });
  check_told(context, pair, "vkhCmdBuildHierarchy: mesh", [&](VkCommandBuffer commands) {
    vkhCmdBuildHierarchy(context.get(), commands, nullptr, nullptr, nullptr, nullptr);
  });
  check_told(context, pair, "a mesh with the counts of the build", [&](VkCommandBuffer commands) {
    VkhMesh other = b.view();
    other.faceCount -= 1;
    vkhCmdRefitHierarchy(context.get(), commands, &other, &pair.problem().b, nullptr);
  });
  check_told(context, pair, "an offset that is a multiple of 256", [&](VkCommandBuffer commands) {
    vkhCmdWriteReport(context.get(), commands, &pair.problem(), pair.report_buffer(), 4, nullptr);
  });
  check_told(context, pair, "an offset that is a multiple of 4", [&](VkCommandBuffer commands) {
    vkhCmdWriteStatistics(context.get(), commands, &pair.problem(), pair.report_buffer(), 2,
                          nullptr);
  });
  check_told(context, pair, "at least as large", [&](VkCommandBuffer commands) {
    VkhMemory less = pair.problem().workspace;
    less.size -= 256;
    vkhCmdMoveRun(context.get(), commands, &pair.problem(), &less, nullptr);
  });
  check_told(context, pair, "VkhTask::size", [&](VkCommandBuffer commands) {
    VkhTask tasks[] = {pair.task(2), pair.task(2)};
    tasks[1].size = 0;
    vkhCmdRunTasks(context.get(), commands, 2, tasks, nullptr);
  });
}

TEST_CASE("checks of calls change no bit, and are silent where rules are kept") {
  CheckingContext context;
  ApiMesh a(icosphere(1.0, 2)), b(icosphere(1.1, 2));
  const VkhContextCreateInfo plain = create_info(0, VKH_DEVICE_KIND_NARROW);
  VkhContext other = nullptr;
  REQUIRE(vkhCreateContext(&plain, &other) == VKH_SUCCESS);
  {
    ApiPair with(a, b, 1e-4f, context.get()), without(a, b, 1e-4f, other);
    std::vector<VkhReport> reports;
    for (ApiPair* pair : {&with, &without}) {
      const VkhTask task = pair->task(8);
      reports.push_back(pair->run([&](VkCommandBuffer commands) {
        vkhCmdRunTasks(pair->context(), commands, 1, &task, nullptr);
        record_host_barrier(commands);
        CHECK(vkhGetRecordingResult(pair->context(), commands) == VKH_SUCCESS);
      }));
    }
    CHECK(is_same(reports[0], reports[1]));
    CHECK(context.said.empty());
  }
  vkhDestroyContext(other);
}
