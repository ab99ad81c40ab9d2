// A build with asserts reports a caller that breaks a rule of the header, with the rule's name.
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

#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

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

struct Misuse {
  const char* rule;
  std::function<void(VkhMesh&)> mesh;
  std::function<void(VkhProblem&)> problem;
};

}  // namespace

TEST_CASE("a rule that is broken is named") {
#ifdef NDEBUG
  std::puts("api_misuse_test: skipped, this build asserts nothing");
  std::exit(77);
#endif
  ApiMesh a(icosphere(1.0, 1)), b(icosphere(1.1, 1));
  ApiPair pair(a, b, 1e-3f);
  pair.run([&](VkCommandBuffer commands) { pair.build(commands); });
  const auto none = [](auto&) {};
  const Misuse misuses[] = {
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
      {"coverageBuffer: with a context", none,
       [](VkhProblem& p) { p.options.coverageBuffer = p.workspace.buffer; }}};
  for (const Misuse& misuse : misuses) {
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
