// The rules of vkhausdorff.h that the caller must keep. With VKH_CONTEXT_CHECK_CALLS any build
// tells the caller which one is broken; otherwise a debug build asserts them, and a build with
// NDEBUG does not check.
#pragma once

#include <cassert>
#include <mutex>
#include <unordered_set>

#include "engine/workspace.h"

namespace vkh {

// Whether the pointers of a call are given; the rule is a part of the asserted expression, so that
// assert prints it.
#define VKH_POINTERS(rules, rule, are_given) \
  (assert((rules).is_reporting() || ((rule) && (are_given))), (rules).pointers(rule, are_given))

// The command buffers in which a checked call broke a rule. They must not be submitted.
class Misuses {
 public:
  Misuses(VkhMisuse callback, void* user) : callback_(callback), user_(user) {}
  void add(VkCommandBuffer commands, const char* rule);
  bool has(VkCommandBuffer commands);
  void forget(VkCommandBuffer commands);

 private:
  VkhMisuse callback_;
  void* user_;
  std::mutex mutex_;
  std::unordered_set<VkCommandBuffer> commands_;
};

// The rules of one call. Each check looks at some of them, and returns whether all have been kept
// so far; a call whose rules are not kept records nothing.
class Rules {
 public:
  Rules(const VkhContext_T& context, VkCommandBuffer commands)
      : context_(context), commands_(commands) {}

  bool is_reporting() const { return context_.misuses != nullptr; }
  bool pointers(const char* rule, bool are_given);
  // `scratch`: null for a refit, whose BVH has been built.
  bool build(const VkhMesh& mesh, const VkhHierarchy& hierarchy, const VkhMemory* scratch);
  // The rules for what only the begin reads, and for what the rest of a run reads, too.
  bool begin(const VkhProblem& problem);
  bool problem(const VkhProblem& problem);
  bool task(const VkhTask& task);
  // The rules of a move into `to`.
  bool move(const VkhProblem& problem, const VkhMemory& to);
  bool report(VkBuffer buffer, VkDeviceSize offset);
  bool statistics(VkBuffer buffer, VkDeviceSize offset);
  bool cells(const VkhProblem& problem, const VkhCells& cells);
  // The rules of a survey's calls. `cells`: the number of cells, now or afterwards.
  bool survey(const VkhProblem& problem, const VkhSurvey& survey, uint64_t cells);
  bool survey_output(VkBuffer buffer, VkDeviceSize offset);
  bool closest(const VkhHierarchy& b, const VkhClosestQuery& query);
  bool profile(const VkhProfile* profile);

  const VkhContext_T& context() const { return context_; }

 private:
  bool are_checked() const;
  void broken(const char* rule);
  void memory(const VkhMemory& memory);
  void ranges(const VkhHierarchy& hierarchy, const StreamSizes& needed);
  void mesh(const VkhMesh& mesh);

  const VkhContext_T& context_;
  VkCommandBuffer commands_;
  bool kept_ = true;
};

}  // namespace vkh
