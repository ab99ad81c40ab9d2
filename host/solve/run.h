// Runs on the device: pipelines, submissions, timestamps. host/solve/solver.cpp gives each pair a
// frame and reads its report.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "host/base/serial_guard.h"
#include "host/solve/contexts.h"
#include "host/solve/device_cells.h"
#include "host/solve/pair_buffers.h"

namespace vkh {

/// A pair on the device.
struct HeldPair {
  VkhReport report;  ///< after one wave, or more
  BoundCells bound;
  std::unique_ptr<SurveyCells> cells;
};
using UseHeld = std::function<void(std::span<const HeldPair>)>;

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
  /// Uploads the pairs, builds what is not resident, makes the first wave of each run unless a
  /// usable run is there already, and calls `use` while the pairs are on the device. They have the
  /// same switches, including VKH_CONTEXT_CELLS. Does not call it if RunInput::advanced of a pair
  /// returns false.
  void hold(std::span<const RunInput> inputs, const UseHeld& use);
  /// Finds the faces of B that are closest to points; `mesh` is B.
  void find_closest(const Mesh& mesh, const ResidentMesh& b, const PointBatch& batch);

 private:
  struct Submission;
  VkhContext context_for(uint32_t switches, std::span<const RunInput> inputs,
                         ContextUse use = ContextUse::kRun);
  void arrange(std::span<const RunInput> inputs);
  void allocate_buffers(std::span<const RunInput> inputs, std::vector<RunOutput>& outputs);
  void with_buffers(size_t count, const std::function<void(MemoryPolicy)>& allocate);
  VkCommandBuffer begin();
  VkhProfile* profile() { return stage_times_ && device_.has_timestamps() ? &profile_ : nullptr; }
  void stamp(VkCommandBuffer commands, const char* name);
  void record_one(VkCommandBuffer commands, const Submission& submission);
  void record_together(VkCommandBuffer commands, const Submission& submission);
  VkCommandBuffer record(const Submission& submission, const std::vector<RunOutput>& outputs);
  VkCommandBuffer upload(std::span<const RunInput> inputs, const Submission& submission,
                         std::vector<RunOutput>& outputs);
  double submit(std::span<const RunInput> inputs, const Submission& submission,
                std::vector<RunOutput>& outputs);
  void submit_and_wait(VkCommandBuffer commands);
  bool build_first(std::span<const RunInput> inputs, Submission& submission,
                   std::vector<RunOutput>& outputs);
  HeldPair held(size_t i, const VkhReport& report);
  void bound_cells(PairBuffers& buffers, const CellBatch& batch);
  void read_stages(const Submission& submission, std::vector<RunOutput>& outputs);

  const Device& device_;
  SerialGuard guard_;
  std::shared_ptr<Contexts> contexts_;
  Submitter submitter_;
  MemoryPool pool_;  // of buffers_, where there are several
  std::vector<std::unique_ptr<PairBuffers>> buffers_;
  std::deque<SurveyBuffers> survey_buffers_;     // of those
  MemoryPolicy policy_ = MemoryPolicy::kDevice;  // the policy of buffers_
  VkhContext context_ = nullptr;
  VkhProfile profile_{};
  bool stage_times_ = true;
  std::vector<const char*> names_;
};

}  // namespace vkh
