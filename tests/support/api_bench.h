// A pair of meshes on the test device through the C API alone, with the barriers that the header
// requires and no more.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/vkhausdorff_experimental.h"
#include "host/gpu/memory.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/mesh.h"

namespace vkh::test {

/// The layout of a mesh in its buffers.
struct MeshLayout {
  uint32_t stride = 12;
  uint32_t vertex_offset = 0;
  uint32_t index_offset = 0;
  bool is_16bit = false;
};

/// A mesh in buffers of its own, rounded to float32, which it keeps as `mesh` too.
class ApiMesh {
 public:
  explicit ApiMesh(const Mesh& mesh, MeshLayout layout = {});
  /// Writes new positions, for the same faces. Do not call it while a submission runs.
  void move(const Mesh& moved);
  const Mesh& mesh() const { return mesh_; }
  const VkhMesh& view() const { return view_; }

 private:
  Mesh mesh_;
  MeshLayout layout_;
  Buffer vertices_, indices_;
  VkhMesh view_{};
};

/// Command buffers that may be submitted again and again.
class ApiCommands {
 public:
  ApiCommands();
  ~ApiCommands();
  ApiCommands(const ApiCommands&) = delete;
  ApiCommands& operator=(const ApiCommands&) = delete;

  VkCommandBuffer record(const std::function<void(VkCommandBuffer)>& record);
  void submit_and_wait(VkCommandBuffer commands);

 private:
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
};

/// h(a, b): memory filled with garbage, a problem, reports.
class ApiPair {
 public:
  /// Null selects the context that all such pairs share.
  ApiPair(ApiMesh& a, ApiMesh& b, float cull_tolerance, VkhContext context = nullptr);

  void build(VkCommandBuffer commands);
  void refit(VkCommandBuffer commands);
  void begin(VkCommandBuffer commands, bool warm = false);
  /// A cold begin with a's vertices, as many as before, at another place.
  void begin_at(VkCommandBuffer commands, VkBuffer vertices, VkDeviceSize offset);
  void advance(VkCommandBuffer commands, uint32_t waves);
  /// Writes report `slot` (0..3) and its statistics, and makes them visible to the host.
  void report(VkCommandBuffer commands, uint32_t slot = 0);
  VkhReport read(uint32_t slot = 0) const;
  /// The statistics that were written with it.
  VkhStatistics statistics(uint32_t slot = 0) const;
  /// Fills it with garbage, as at first, and clears the counts.
  void spoil_report();
  void spoil_hierarchy();
  /// Build, begin, `waves` and report 0, to be changed as a test likes; refers to this pair.
  VkhTask task(uint32_t waves);
  VkBuffer report_buffer() const { return reports_.handle(); }
  static VkDeviceSize report_offset(uint32_t slot);

  /// Records with `record`, submits, waits, gives report 0.
  VkhReport run(const std::function<void(VkCommandBuffer)>& record);
  /// The workspace, mapped.
  std::byte* workspace() const { return workspace_.mapped(); }
  VkDeviceSize workspace_size() const { return problem_.workspace.size; }
  ApiCommands& commands() { return commands_; }
  VkhProblem& problem() { return problem_; }
  VkhContext context() const { return context_; }

 private:
  VkhContext context_;
  ApiCommands commands_;
  ApiMesh& b_;
  std::vector<Buffer> hierarchy_;  // its ranges
  Buffer scratch_, workspace_, reports_;
  VkhMemory scratch_view_{};
  VkhProblem problem_{};
};

/// Pairs, with the meshes that they refer to: a of pair i is meshes[2 i], b the next one.
struct ApiPairs {
  std::vector<std::unique_ptr<ApiMesh>> meshes;
  std::vector<std::unique_ptr<ApiPair>> pairs;

  void add(const Mesh& a, const Mesh& b, float cull_tolerance);
  ApiPair& operator[](size_t i) { return *pairs[i]; }
  size_t size() const { return pairs.size(); }
};

/// Compares byte by byte.
bool is_same(const VkhReport& a, const VkhReport& b);

/// Makes writes of compute shaders visible to the host.
void record_host_barrier(VkCommandBuffer commands);

Interval interval(const VkhReport& report);
/// lower <= h(a, b) <= upper, as far as the reference encloses h.
void check_true(const VkhReport& report, const Interval& exact);
void check_true(const VkhReport& report, const ApiMesh& a, const ApiMesh& b);

}  // namespace vkh::test
