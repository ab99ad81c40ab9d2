// One run on the device: buffers, submissions, timestamps. host/solver.cpp gives it a frame and
// reads its report.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "engine/vkhausdorff.h"
#include "host/frame.h"
#include "host/memory.h"
#include "host/pipeline_cache.h"

namespace vkh {

/// Pipelines for one set of switches; destroyed with the handle.
using ContextHandle = std::unique_ptr<VkhContext_T, void (*)(VkhContext)>;

/// A mesh as it is uploaded.
struct MeshData {
  const Mesh* mesh = nullptr;
  const StoredMesh* stored = nullptr;
};

/// Mesh B on the device: its hierarchy, in a buffer of its own.
struct ResidentMesh {
  Buffer hierarchy;
  uint32_t vertex_count = 0, face_count = 0;
};

struct RunInput {
  MeshData a, b;
  const ResidentMesh* resident = nullptr;  ///< instead of uploading and building b
  uint32_t switches = VKH_SWITCH_DEFAULT;
  uint64_t memory_bytes = 0;  ///< 0: recommended
  uint32_t wave_limit = UINT32_MAX;
  bool multiwave = true;   ///< false: the host looks at the report after every wave
  uint32_t sort_from = 0;  ///< VkhProblem::sortFrom
  float cull_tolerance = 0, known_lower = 0;
  bool two_float = false;
  bool stage_times = true;  ///< false: "hierarchy" and "solve" in their place
  bool coverage = false;    ///< record what was closed; `switches` has VKH_SWITCH_COVERAGE too
  /// Called after each submission with the report so far; false ends the run.
  std::function<bool(const VkhReport&)> advanced;
};

/// What is on unless somebody asks for something else; what pays depends on the kind of device.
uint32_t default_switches(const Device& device);

struct StageTime {
  const char* name;
  double ms;
};

struct RunOutput {
  VkhReport report{};
  std::vector<StageTime> stages;  ///< one per timestamp interval, in order
  uint64_t workspace_bytes = 0;
  /// Asked for: of each face of A the closed part, then of each the open one; 2^40 is a whole face.
  std::vector<uint64_t> areas;
  double upload_ms = 0;  ///< host: buffers and copying into them
};

/// Keeps contexts and buffers between runs.
class Runner {
 public:
  Runner(const Device& device, const std::filesystem::path& cache_folder);
  void make_ready(uint32_t switches) { context_for(switches); }
  ResidentMesh build(const MeshData& b);
  RunOutput run(const RunInput& input);

 private:
  VkhContext context_for(uint32_t switches);
  VkhHierarchyRequirements hierarchy_requirements() const;
  void upload(const MeshData& a, const MeshData& b);
  void place(const RunInput& input, RunOutput& output);
  VkDeviceSize place_b(const RunInput& input);
  VkCommandBuffer begin();
  VkhProfile* profile() { return stage_times_ && device_.has_timestamps() ? &profile_ : nullptr; }
  void stamp(VkCommandBuffer commands, const char* name);
  void record_upload(VkCommandBuffer commands);
  void place_areas(const RunInput& input, RunOutput& output);
  void record_start(VkCommandBuffer commands, const RunInput& input);
  void submit(RunOutput& output);

  const Device& device_;
  PipelineCache cache_;
  std::map<uint32_t, ContextHandle> contexts_;
  Submitter submitter_;
  Buffer staging_, meshes_, hierarchy_, workspace_, report_, readback_, areas_, areas_readback_;
  VkhContext context_ = nullptr;
  VkDeviceSize uploaded_bytes_ = 0;
  VkhMesh mesh_b_{};
  VkhProblem problem_{};
  VkhMemory scratch_{};
  VkhProfile profile_{};
  bool stage_times_ = true;
  std::vector<const char*> names_;
};

}  // namespace vkh
