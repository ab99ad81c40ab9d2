// The rules of vkhausdorff.h that the caller must keep, asserted: a debug build names the rule that
// is broken, and a build with NDEBUG has none of this.
#pragma once

#include "engine/context.h"

namespace vkh {

#ifdef NDEBUG
inline void check_build(const Limits&, const VkhMesh&, const VkhHierarchy&, const VkhMemory*) {}
inline void check_begin(const VkhProblem&) {}
inline void check_task(const VkhTask&) {}
inline void check_problem(const VkhContext_T&, const VkhProblem&) {}
inline void check_move(const VkhProblem&, const VkhMemory&) {}
inline void check_report(VkBuffer, VkDeviceSize) {}
inline void check_statistics(VkBuffer, VkDeviceSize) {}
inline void check_cells(const VkhContext_T&, const VkhProblem&, const VkhCells&) {}
inline void check_closest(const VkhContext_T&, const VkhHierarchy&, const VkhClosestQuery&) {}
inline void check_profile(const VkhProfile*) {}
#else
// `scratch`: null for a refit, whose BVH has been built.
void check_build(const Limits& limits, const VkhMesh& mesh, const VkhHierarchy& hierarchy,
                 const VkhMemory* scratch);
// The rules of what the begin alone reads, and of what the rest of a run reads, too.
void check_begin(const VkhProblem& problem);
void check_task(const VkhTask& task);
void check_problem(const VkhContext_T& context, const VkhProblem& problem);
// The rules of a move into `to`.
void check_move(const VkhProblem& problem, const VkhMemory& to);
void check_report(VkBuffer buffer, VkDeviceSize offset);
void check_statistics(VkBuffer buffer, VkDeviceSize offset);
void check_cells(const VkhContext_T& context, const VkhProblem& problem, const VkhCells& cells);
void check_closest(const VkhContext_T& context, const VkhHierarchy& b,
                   const VkhClosestQuery& query);
void check_profile(const VkhProfile* profile);
#endif

}  // namespace vkh
