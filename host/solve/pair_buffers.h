// The place of one pair on the device: buffers that grow with the pairs that they have held, and
// their description for the library.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "engine/vkhausdorff.h"
#include "host/gpu/memory.h"
#include "host/solve/cells.h"
#include "vkhausdorff/frame.h"

namespace vkh {

/// A mesh to be uploaded.
struct MeshData {
  const Mesh* mesh = nullptr;
  const StoragePlan* stored = nullptr;
};

/// The memory that a run may use: only the device's own, or the host's as well, which the device
/// reads much more slowly.
enum class MemoryPolicy { kDevice, kHost };

/// The memory that a run may use, and how much of the device's it may take at first if it may use
/// the host's.
struct MemoryBudget {
  MemoryPolicy policy;
  VkDeviceSize share;  // bytes
};

/// The ranges of memory of a BVH, each a buffer of its own.
class HierarchyMemory {
 public:
  /// Allocates exactly the bytes that are needed.
  void allocate(const Device& device, const VkhHierarchyRequirements& needed, MemoryPolicy policy);
  /// Makes each range at least as large as needed, with room for the next BVH; frees the ranges
  /// that are not needed.
  void grow(const Device& device, const VkhHierarchyRequirements& needed, MemoryPolicy policy,
            MemoryPool* pool);
  VkhHierarchy view() const;
  VkDeviceSize host_bytes() const;  ///< bytes in the host's memory

 private:
  std::array<Buffer, VKH_MAX_RANGES> ranges_;
};

/// Mesh B on the device.
struct ResidentMesh {
  HierarchyMemory memory;
  uint32_t vertex_count = 0, face_count = 0;
  VkhHierarchy view() const;  ///< with the counts
};

struct RunInput {
  MeshData a, b;
  const ResidentMesh* resident = nullptr;  ///< instead of uploading and building b
  uint32_t switches = 0;                   ///< switches_of, without the host's own
  uint64_t memory_bytes = 0;               ///< workspace; 0: start_memory_bytes, and more if the
                                           ///< run wants it
  uint64_t start_memory_bytes = 0;         ///< 0: the recommended size
  uint32_t wave_limit = UINT32_MAX;
  bool multiwave = true;    ///< false: the host reads the report after every wave
  VkhRunOptions options{};  ///< the run sets pauseWhenFull and the members about buffers itself
  bool stage_times = true;  ///< false: only the stages "hierarchy" and "solve"
  bool coverage = false;    ///< record what was closed; `switches` has VKH_CONTEXT_COVERAGE too
  /// Called after each submission with the report so far; false ends the run.
  std::function<bool(const VkhReport&)> advanced;
  /// Called before each submission except the first, which is then short. Returns the value of
  /// `options.knownLower` from there on, if it is larger. Empty: the value stays.
  std::function<float()> known_since;
  /// The pair, if later runs may be of it; null: the next pair may overwrite its buffers.
  std::shared_ptr<const FramedPair> kept;
  bool takes_begun = false;  ///< an earlier run of the pair that is still there may be used, no
                             ///< matter how it ended
};

struct StageTime {
  const char* name;
  double ms;
};

struct RunOutput {
  VkhReport report{};
  VkhStatistics statistics{};
  std::vector<StageTime> stages;  ///< one per timestamp interval, in order
  uint64_t workspace_bytes = 0;
  uint64_t host_memory_bytes = 0;  ///< bytes in the host's memory, since the device had no room
  /// If asked for: the closed part of each face of A, then the open part of each; 2^40 is a whole
  /// face.
  std::vector<uint64_t> areas;
  double upload_ms = 0;  ///< on the host, for all runs of a submission: allocating buffers, copying
                         ///< into them, and recording beside that
};

class PairBuffers {
 public:
  /// Takes memory from the pool, if there is one, which then outlives it.
  PairBuffers(const Device& device, MemoryPool* pool) : device_(device), pool_(pool) {}

  /// Takes the pair: allocates its buffers. Throws MemoryError if there is no room for it,
  /// DeviceError if the device does not support it.
  void take(VkhContext context, const RunInput& input, RunOutput& output, MemoryBudget budget);
  /// Writes the meshes of the pair that was taken, unless they are on the device already.
  void write(const RunInput& input);
  /// Allocates and fills B's buffers, without A, and scratch for the build; returns the memory that
  /// its BVH will be built in.
  ResidentMesh allocate_resident(VkhContext context, const MeshData& b, MemoryPolicy policy);

  /// The problem as the library gets it. `mesh_b` and `scratch` are for building B's BVH; null if B
  /// is there.
  VkhProblem& problem() { return problem_; }
  const VkhMesh* mesh_b() const { return has_b_ ? nullptr : &mesh_b_; }
  const VkhMemory* scratch() const { return &scratch_; }
  VkBuffer report() const { return report_.handle(); }
  /// The statistics' place behind the report, in the same buffer.
  static constexpr VkDeviceSize kStatisticsOffset = 128;
  static_assert(sizeof(VkhReport) <= kStatisticsOffset);
  /// Whether the run that is there is of the pair that was taken, and was read.
  bool has_run() const { return laid_.context != nullptr; }
  bool has(const RunInput& input) const {
    return input.kept != nullptr && input.kept == laid_.pair && input.resident == laid_.resident;
  }
  /// Whether some caller keeps the pair that is there.
  bool is_kept() const { return laid_.pair.use_count() > 1; }

  /// Copies the meshes to where the device reads them, unless they are there; the caller
  /// records a barrier to compute shaders.
  void record_upload(VkCommandBuffer commands) const;
  /// Handles a run that pauses because its workspace is full: allocates a larger one, or lets the
  /// run go on in the present one, from the next record_move() on.
  void make_room(VkhContext context, RunOutput& output);
  /// Raises the run's known lower bound from the next record_move() on.
  void raise_known(float known_lower);
  void record_move(VkhContext context, VkCommandBuffer commands, VkhProfile* profile);
  /// Copies the report, and the areas if there are any, back; the caller records barriers around
  /// it.
  void record_readback(VkCommandBuffer commands, const RunOutput& output) const;
  /// Makes room for a batch of cells and copies them to it. After the submission, read_bounds()
  /// reads the cells' bounds.
  VkhCells place_cells(const CellBatch& batch);
  void read_bounds(const CellBatch& batch) const;
  /// The same for points and their closest faces.
  VkhClosestQuery place_points(const PointBatch& batch);
  void read_closest(const PointBatch& batch) const;
  /// Reads the results of the last submission.
  void read(RunOutput& output);

 private:
  void allocate_meshes(VkDeviceSize bytes, MemoryPolicy policy);
  void place_meshes(const MeshData& a, const MeshData& b, MemoryPolicy policy);
  void write_meshes(const MeshData& a, const MeshData& b);
  void place_b(const VkhHierarchyRequirements& needed, const RunInput& input, MemoryPolicy policy);
  VkDeviceSize allocate_scarce_workspace(VkDeviceSize bytes, VkDeviceSize least, VkDeviceSize share,
                                         bool given);
  VkDeviceSize allocate_workspace(const VkhWorkspaceRequirements& needed, VkDeviceSize scratch,
                                  const RunInput& input, MemoryBudget budget);
  VkDeviceSize host_bytes(const RunInput& input) const;
  void set_problem(const RunInput& input, VkDeviceSize bytes, bool may_grow);
  void place_areas(const RunInput& input, RunOutput& output, MemoryPolicy policy);
  VkhMemory allocate_room(VkDeviceSize bytes);

  const Device& device_;
  MemoryPool* pool_;
  HierarchyMemory hierarchy_;
  Buffer staging_, meshes_, workspace_, report_, readback_, areas_, areas_readback_;
  Buffer cells_, bounds_;  // for a survey, and for points and their closest faces
  Buffer building_;        // scratch, unless it is the workspace
  // A run that paused goes on in `larger_`, if there was memory for it. If it pauses again and gets
  // more, `left_` is the `larger_` that it leaves, kept until that has been copied.
  Buffer larger_, left_;
  // The memory in which the run goes on after the next record_move(), which may be the present one;
  // empty: no move is recorded.
  std::optional<VkhMemory> next_;
  VkDeviceSize uploaded_bytes_ = 0;
  struct Laid {
    std::shared_ptr<const FramedPair> pair;
    const ResidentMesh* resident = nullptr;  // B, unless it lies there, too
    VkhContext context = nullptr;            // whose run it is
  };
  Laid taken_, laid_;  // `taken_` lies there once its run was read
  bool is_laid_ = false, has_b_ = false;
  VkhMesh mesh_b_{};
  VkhProblem problem_{};
  VkhMemory scratch_{};
};

/// Returns whether the context's device can bind the pair, or the one mesh of it that is given.
bool fits_bindings(VkhContext context, const RunInput& input);

/// Throws DeviceError that names `what` unless it is VKH_SUCCESS.
void check_engine(VkhResult result, const char* what);

}  // namespace vkh
