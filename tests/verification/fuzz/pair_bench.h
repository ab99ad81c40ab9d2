// A fuzzed pair's buffers on the device: they are kept from one input to the next, with the last
// one's data in them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/vkhausdorff_experimental.h"
#include "host/gpu/memory.h"
#include "tests/verification/fuzz/random_pair.h"

namespace vkh::test {

/// Device, contexts and one command buffer, made once.
class FuzzDevice {
 public:
  static constexpr size_t kMostContexts = 5, kSurveying = 2;

  explicit FuzzDevice(size_t context_count);
  ~FuzzDevice();
  FuzzDevice(const FuzzDevice&) = delete;
  FuzzDevice& operator=(const FuzzDevice&) = delete;

  const Device& device() const { return device_; }
  size_t context_count() const { return contexts_.size(); }
  VkhContext context(size_t i) const { return contexts_[i]; }
  bool covers(size_t i) const { return i == kMostContexts - 1; }
  bool surveys(size_t i) const { return i < kSurveying; }
  /// Records, submits and waits; the host then sees the writes of compute shaders.
  void run(const std::function<void(VkCommandBuffer)>& record);

 private:
  Device device_;
  std::vector<VkhContext> contexts_;
  Submitter submitter_;
};

/// One pair's buffers. They have no byte more than the contract requires; the bytes around them are
/// watched.
class PairBench {
 public:
  explicit PairBench(const FuzzDevice& device);

  /// Throws std::runtime_error if the engine refuses the sizes.
  void take(const FuzzPair& pair, VkhContext context, bool covers);
  /// The pair's second frame.
  void move();
  /// Room for a survey of A, to be called after take().
  void reserve_survey(VkhContext context, uint32_t cells_a_face, float face_width);
  /// Read what lies at survey_offset(slot): the report, and the faces' errors behind it.
  VkhSurveyReport survey_report(uint32_t slot) const;
  std::vector<float> face_errors(uint32_t slot) const;
  VkhReport report(uint32_t slot) const;
  /// The closed and the open part of each face, after take() with `covers`.
  std::vector<uint64_t> coverage() const;
  /// Whether nothing was written around the buffers.
  bool is_untouched_around() const;

  /// The arguments of VkhTask and of the functions of the API.
  VkhProblem problem{};
  VkhMesh b{};
  VkhMemory scratch{};
  VkhSurvey survey{};
  VkBuffer report_buffer() const { return working_.handle(); }
  VkDeviceSize report_offset(uint32_t slot) const { return reports_at_ + slot * report_stride(); }
  VkDeviceSize survey_offset(uint32_t slot) const { return surveys_at_[slot]; }

 private:
  static VkDeviceSize report_stride();
  VkhMesh put(const FuzzMesh& mesh, VkDeviceSize vertices_at, VkDeviceSize indices_at);
  VkhMemory reserve(VkDeviceSize size);
  void guard(VkDeviceSize begin, VkDeviceSize end);

  const FuzzPair* pair_ = nullptr;
  Buffer meshes_, working_;
  VkDeviceSize used_ = 0, reports_at_ = 0, coverage_at_ = 0;
  std::array<VkDeviceSize, 2> surveys_at_{};
  std::vector<std::pair<VkDeviceSize, VkDeviceSize>> guards_;
};

}  // namespace vkh::test
