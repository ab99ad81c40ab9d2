// One pair's place on the device: buffers that grow with the pairs that they have held, and what
// the library is told of them.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "engine/vkhausdorff.h"
#include "host/gpu/memory.h"
#include "host/solve/cells.h"
#include "host/solve/frame.h"

namespace vkh {

/// A mesh as it is uploaded.
struct MeshData {
  const Mesh* mesh = nullptr;
  const StoredMesh* stored = nullptr;
};

/// Whose memory a run may use: the device's own, or the host's besides, which the device reads much
/// more slowly.
enum class MemoryPolicy { kDevice, kHost };

/// And how much of the device's a run may take at first, where it may use the host's.
struct MemoryBudget {
  MemoryPolicy policy;
  VkDeviceSize share;  // bytes
};

/// A hierarchy's ranges of memory, each a buffer of its own.
class HierarchyMemory {
 public:
  /// Makes each as large as is needed, and no larger.
  void take(const Device& device, const VkhHierarchyRequirements& needed, MemoryPolicy policy);
  /// Makes each at least as large, with room for the next hierarchy; frees those that are not
  /// needed.
  void grow(const Device& device, const VkhHierarchyRequirements& needed, MemoryPolicy policy);
  VkhHierarchy view() const;
  VkDeviceSize host_bytes() const;  ///< of the host's memory

 private:
  std::array<Buffer, VKH_MAX_RANGES> ranges_;
};

/// Mesh B on the device.
struct ResidentMesh {
  HierarchyMemory memory;
  uint32_t vertex_count = 0, face_count = 0;
};

struct RunInput {
  MeshData a, b;
  const ResidentMesh* resident = nullptr;  ///< instead of uploading and building b
  uint32_t switches = 0;                   ///< VkhSwitchBits and kSwitchWide
  uint64_t memory_bytes = 0;               ///< workspace; 0: that, and more where the run wants it:
  uint64_t start_memory_bytes = 0;         ///< 0: what is recommended
  uint32_t wave_limit = UINT32_MAX;
  bool multiwave = true;   ///< false: the host looks at the report after every wave
  uint32_t sort_from = 0;  ///< VkhProblem::sortFrom
  float cull_tolerance = 0, known_lower = 0, limit = 0, limit_up = 0;
  bool two_float = false;
  bool stage_times = true;  ///< false: "hierarchy" and "solve" in their place
  bool coverage = false;    ///< record what was closed; `switches` has VKH_SWITCH_COVERAGE too
  /// Called at the end, with the report and what bounds cells; `switches` has VKH_SWITCH_FIELD too.
  std::function<void(const VkhReport&, const BoundCells&)> survey;
  /// Called after each submission with the report so far; false ends the run.
  std::function<bool(const VkhReport&)> advanced;
  /// Asked before each submission but the first, which is then short: `known_lower` from there on,
  /// where it is larger. Empty: it stays.
  std::function<float()> known_since;
};

struct StageTime {
  const char* name;
  double ms;
};

struct RunOutput {
  VkhReport report{};
  std::vector<StageTime> stages;  ///< one per timestamp interval, in order
  uint64_t workspace_bytes = 0;
  uint64_t host_memory_bytes = 0;  ///< what the device had no room for, in the host's memory
  /// Asked for: of each face of A the closed part, then of each the open one; 2^40 is a whole face.
  std::vector<uint64_t> areas;
  double upload_ms = 0;  ///< host: buffers and copying into them; of all that were run at once
};

class PairBuffers {
 public:
  explicit PairBuffers(const Device& device) : device_(device) {}

  /// Takes the pair: its buffers and, mapped, its meshes. Throws MemoryError if there is no room
  /// for it, DeviceError if the device cannot have it.
  void take(VkhContext context, const RunInput& input, RunOutput& output, MemoryBudget budget);
  /// Takes B alone, and gives the memory for its hierarchy.
  ResidentMesh take_resident(VkhContext context, const MeshData& b, MemoryPolicy policy);

  /// What the library works on. `mesh_b` and `scratch` are for building B's hierarchy; null where
  /// it is resident.
  VkhProblem& problem() { return problem_; }
  const VkhMesh* mesh_b() const { return is_resident_ ? nullptr : &mesh_b_; }
  const VkhMemory* scratch() const { return &scratch_; }
  VkBuffer report() const { return report_.handle(); }

  /// Copies the meshes to where the device reads them, unless they were written there; a barrier
  /// to compute shaders is the caller's.
  void record_upload(VkCommandBuffer commands) const;
  /// Where the run pauses for want of room: takes the memory for it, or has it go on with what
  /// there is, from the next record_move() on.
  void make_room(VkhContext context, RunOutput& output);
  /// What is known has become more: so it is for the run, from the next record_move() on.
  void raise_known(float known_lower);
  void record_move(VkhContext context, VkCommandBuffer commands, VkhProfile* profile);
  /// Copies the report, and the areas if there are any, back; barriers around it are the caller's.
  void record_readback(VkCommandBuffer commands, const RunOutput& output) const;
  /// Has room for a batch, and copies its cells there. What they are bounded with is read with
  /// read_bounds() after the submission.
  VkhCells take_cells(const CellBatch& batch);
  void read_bounds(const CellBatch& batch) const;
  /// What the last submission left.
  void read(RunOutput& output) const;

 private:
  void take_meshes(VkDeviceSize bytes, MemoryPolicy policy);
  void place_meshes(const MeshData& a, const MeshData& b, MemoryPolicy policy);
  void write_meshes(const MeshData& a, const MeshData& b);
  void place_b(const VkhHierarchyRequirements& needed, const RunInput& input, MemoryPolicy policy);
  VkDeviceSize take_scarce_workspace(VkDeviceSize bytes, VkDeviceSize least, VkDeviceSize share,
                                     bool given);
  VkDeviceSize take_workspace(const VkhWorkspaceRequirements& needed, VkDeviceSize scratch,
                              const RunInput& input, MemoryBudget budget);
  VkDeviceSize host_bytes(const RunInput& input) const;
  void set_problem(const RunInput& input, VkDeviceSize bytes, bool may_grow);
  void place_areas(const RunInput& input, RunOutput& output, MemoryPolicy policy);
  VkhMemory take_room(VkDeviceSize bytes);

  const Device& device_;
  HierarchyMemory hierarchy_;
  Buffer staging_, meshes_, workspace_, report_, readback_, areas_, areas_readback_;
  Buffer cells_, bounds_;          // of a survey
  Buffer building_;                // scratch, where it is not the workspace
  Buffer larger_, left_;           // where a run that paused went on, and before that
  std::optional<VkhMemory> next_;  // where it goes on now
  VkDeviceSize uploaded_bytes_ = 0;
  bool is_resident_ = false;
  VkhMesh mesh_b_{};
  VkhProblem problem_{};
  VkhMemory scratch_{};
};

/// Whether the context takes the pair, or what there is of it.
bool fits_bindings(VkhContext context, const RunInput& input);

/// Throws DeviceError that names `what` unless it is VKH_SUCCESS.
void check_engine(VkhResult result, const char* what);

}  // namespace vkh
