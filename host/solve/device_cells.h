// The cells of a survey on a Vulkan device.
#pragma once

#include <functional>
#include <vector>

#include "engine/vkhausdorff_experimental.h"
#include "host/gpu/memory.h"
#include "host/solve/cells.h"

namespace vkh {

/// Buffers of a survey, kept for the next one.
struct SurveyBuffers {
  Buffer memory;                   // the device's own
  Buffer weights, plan;            // written by the host
  Buffer histogram, table, faces;  // read by the host,
  Buffer cells, bounds, classes;   // and these if the host takes them over
  Buffer face_kinds, normals;      // of both meshes, written by the host,
  Buffer known;                    // and bounds that the host found
};

class DeviceCells : public SurveyCells {
 public:
  using Record = std::function<void(VkCommandBuffer)>;
  /// Submits what it records, and waits.
  using Submit = std::function<void(const Record&)>;

  /// All arguments outlive it. The problem's run has begun.
  DeviceCells(const Device& device, VkhContext context, const VkhProblem& problem,
              SurveyBuffers& buffers, Submit submit);

  void begin(std::span<const uint64_t> weights, float farthest) override;
  size_t count() const override { return count_; }
  size_t most() const override { return vkhGetSurveyCapacity(context_); }
  std::span<const uint32_t> score(const gpu::SurveyPlan& plan, const CellRange& some) override;
  bool split(const SurveyChoice& choice) override;
  void bound(size_t first, size_t count, bool wait) override;
  const gpu::SurveyTable& tally(const gpu::SurveyPlan& plan, int unit,
                                const CellRange& some) override;
  void find_sides(const SideSearch& search, float above, const CellRange& some) override;
  void begin_normals(const NormalSearch& search) override;
  void find_normals(const CellRange& some) override;
  std::vector<float> faces(uint32_t reached_classes, uint32_t highest_classes) override;
  CellsRead read(const CellRange& some) override;
  void write(const CellRange& some, std::span<const gpu::CellBounds> bounds) override;

 private:
  VkhSurvey view() const { return view_of(buffers_.memory, capacity_); }
  static VkhSurvey view_of(const Buffer& memory, uint32_t capacity) {
    return {sizeof(VkhSurvey), {memory.handle(), 0, memory.size()}, capacity, 0, 0};
  }
  bool make_room(size_t cells);
  void write_plan(const gpu::SurveyPlan& plan);
  void submit();

  const Device& device_;
  const VkhContext context_;
  const VkhProblem& problem_;
  SurveyBuffers& buffers_;
  const Submit submit_;
  std::vector<Record> waiting_;  // for the next submission
  uint32_t capacity_ = 0, count_ = 0;
  NormalSearch normals_;
};

}  // namespace vkh
