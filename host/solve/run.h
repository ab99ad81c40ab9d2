// Runs on the device: pipelines, submissions, timestamps. host/solve/solver.cpp gives each pair a
// frame and reads its report.
#pragma once

#include <memory>
#include <span>

#include "host/base/serial_guard.h"
#include "host/solve/contexts.h"
#include "host/solve/device_cells.h"
#include "host/solve/pair_buffers.h"

namespace vkh {

/// Keeps buffers between runs. Calls from several threads run one after the other.
class Runner {
 public:
  /// Runners of one device may share its contexts.
  Runner(const Device& device, std::shared_ptr<Contexts> contexts);
  ResidentMesh build(const MeshData& b);
  /// Runs all of them side by side (vkhCmdRunTasks), each until it is done. They have the same
  /// switches, `multiwave` and `stage_times`. Several runs have one stage, "solve", for all of them
  /// and their BVHs.
  std::vector<RunOutput> run(std::span<const RunInput> inputs);
  /// Finds the faces of B that are closest to points; `mesh` is B.
  void find_closest(const Mesh& mesh, const ResidentMesh& b, const PointBatch& batch);

 private:
  struct Submission;
  VkhContext context_for(uint32_t switches, std::span<const RunInput> inputs,
                         ContextUse use = ContextUse::kRun);
  void take_buffers(std::span<const RunInput> inputs, std::vector<RunOutput>& outputs);
  void buffers(size_t count, const std::function<void(MemoryPolicy)>& take);
  VkCommandBuffer begin();
  VkhProfile* profile() { return stage_times_ && device_.has_timestamps() ? &profile_ : nullptr; }
  void stamp(VkCommandBuffer commands, const char* name);
  void record_one(VkCommandBuffer commands, const Submission& submission);
  void record_together(VkCommandBuffer commands, const Submission& submission);
  VkCommandBuffer record(const Submission& submission, const std::vector<RunOutput>& outputs);
  double submit(const Submission& submission, std::vector<RunOutput>& outputs);
  void submit_and_wait(VkCommandBuffer commands);
  void bound_cells(PairBuffers& buffers, const CellBatch& batch);
  void survey(const RunInput& input, PairBuffers& buffers, const VkhReport& report);
  void read_stages(const Submission& submission, std::vector<RunOutput>& outputs);

  const Device& device_;
  SerialGuard guard_;
  std::shared_ptr<Contexts> contexts_;
  Submitter submitter_;
  MemoryPool pool_;  // of buffers_, where there are several
  std::vector<std::unique_ptr<PairBuffers>> buffers_;
  SurveyBuffers survey_buffers_;
  MemoryPolicy policy_ = MemoryPolicy::kDevice;  // the policy of buffers_
  VkhContext context_ = nullptr;
  VkhProfile profile_{};
  bool stage_times_ = true;
  std::vector<const char*> names_;
};

}  // namespace vkh
