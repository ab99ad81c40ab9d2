#include "host/solve/pair_buffers.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <utility>

#include "host/base/parallel.h"
#include "host/gpu/vulkan_api.h"
#include "host/solve/mesh_sizes.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// Bytes of a report and of the statistics behind it.
constexpr VkDeviceSize kReportBytes = PairBuffers::kStatisticsOffset + sizeof(VkhStatistics);

constexpr VkBufferUsageFlags kWorking =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

// Adds room for the next, somewhat larger mesh: a driver takes tenths of milliseconds to allocate.
VkDeviceSize roomy(VkDeviceSize bytes) {
  constexpr VkDeviceSize kLargest = VkDeviceSize{64} << 20;
  return bytes > kLargest ? bytes : std::bit_ceil(bytes);
}

VkDeviceSize aligned(VkDeviceSize bytes) { return (bytes + 255) / 256 * 256; }

// The high parts, low parts if there are any, and faces, one after the other.
struct MeshBytes {
  VkDeviceSize high, low, faces;
  explicit MeshBytes(const MeshData& m)
      : high(aligned(m.mesh->vertices.size() * 12)),
        low(m.stored->has_low ? high : 0),
        faces(aligned(m.mesh->faces.size() * 12)) {}
  VkDeviceSize total() const { return high + low + faces; }
};

VkDeviceSize bytes_of(const MeshData& m) { return m.mesh != nullptr ? MeshBytes(m).total() : 0; }

MeshSize counts_of(const Mesh& m) {
  return {static_cast<uint32_t>(m.vertices.size()), static_cast<uint32_t>(m.faces.size())};
}

VkhMesh view(VkBuffer buffer, VkDeviceSize offset, const MeshData& m) {
  const MeshBytes bytes(m);
  return {.vertexBuffer = buffer,
          .vertexOffset = offset,
          .vertexStride = 12,
          .vertexCount = static_cast<uint32_t>(m.mesh->vertices.size()),
          .indexBuffer = buffer,
          .indexOffset = offset + bytes.high + bytes.low,
          .indexType = VK_INDEX_TYPE_UINT32,
          .faceCount = static_cast<uint32_t>(m.mesh->faces.size()),
          .vertexLowBuffer = m.stored->has_low ? buffer : VK_NULL_HANDLE,
          .vertexLowOffset = offset + bytes.high};
}

// Allocates in the device's memory, or in the host's if `policy` allows it and the device has no
// more.
void allocate_buffer(Buffer& buffer, const Device& device, VkDeviceSize bytes, MemoryPolicy policy,
                     MemoryPool* pool = nullptr) {
  try {
    grow(buffer, device, bytes, {kWorking, Placement::kDevice, pool});
  } catch (const MemoryError&) {
    if (policy == MemoryPolicy::kDevice) throw;
    buffer = Buffer(device, bytes, kWorking, Placement::kUpload);
  }
}

VkDeviceSize bytes_in_host(const Buffer& buffer) { return buffer.is_in_host() ? buffer.size() : 0; }

// Writes A and B, or one of them, at once.
void write_both(std::byte* to, const std::array<MeshData, 2>& meshes) {
  struct Place {
    const MeshData* data;
    std::byte* to;
  };
  std::vector<Place> places;
  for (const MeshData& m : meshes) {
    if (m.mesh != nullptr) places.push_back({&m, to});
    to += bytes_of(m);
  }
  const auto write_half = [&](size_t i) {
    const auto [data, at] = places[i / 2];
    const MeshBytes bytes(*data);
    const std::vector<glm::uvec3>& faces = data->mesh->faces;
    if (i % 2 == 0)
      return write_vertices(*data->stored, *data->mesh, reinterpret_cast<float*>(at),
                            reinterpret_cast<float*>(at + bytes.high));
    copy_together(at + bytes.high + bytes.low, faces.data(), faces.size() * sizeof(faces[0]));
  };
  for_each_index(2 * places.size(), write_half,
                 threads_for(bytes_of(meshes[0]) + bytes_of(meshes[1])));
}

}  // namespace

void HierarchyMemory::allocate(const Device& device, const VkhHierarchyRequirements& needed,
                               MemoryPolicy policy) {
  for (uint32_t i = 0; i < needed.rangeCount; ++i)
    allocate_buffer(ranges_[i], device, needed.ranges[i], policy);
}

void HierarchyMemory::grow(const Device& device, const VkhHierarchyRequirements& needed,
                           MemoryPolicy policy, MemoryPool* pool) {
  for (uint32_t i = 0; i < needed.rangeCount; ++i)
    allocate_buffer(ranges_[i], device,
                    policy == MemoryPolicy::kDevice ? roomy(needed.ranges[i]) : needed.ranges[i],
                    policy, pool);
  for (uint32_t i = needed.rangeCount; i < ranges_.size(); ++i) ranges_[i] = Buffer();
}

VkDeviceSize HierarchyMemory::host_bytes() const {
  VkDeviceSize bytes = 0;
  for (const Buffer& range : ranges_) bytes += bytes_in_host(range);
  return bytes;
}

VkhHierarchy HierarchyMemory::view() const {
  VkhHierarchy hierarchy{};
  hierarchy.memory = {ranges_[0].handle(), 0, ranges_[0].size()};
  for (uint32_t i = 1; i < ranges_.size(); ++i)
    hierarchy.more[i - 1] = {ranges_[i].handle(), 0, ranges_[i].size()};
  return hierarchy;
}

VkhHierarchy ResidentMesh::view() const {
  VkhHierarchy hierarchy = memory.view();
  hierarchy.faceCount = face_count;
  hierarchy.vertexCount = vertex_count;
  return hierarchy;
}

bool fits_bindings(VkhContext context, const RunInput& in) {
  return (in.a.mesh == nullptr || takes_as_a(context, counts_of(*in.a.mesh))) &&
         (in.b.mesh == nullptr || takes_as_b(context, counts_of(*in.b.mesh)));
}

void check_engine(VkhResult result, const char* what) {
  if (result == VKH_SUCCESS) return;
  const char* reason = result == VKH_ERROR_UNSUPPORTED   ? "the device is not supported"
                       : result == VKH_ERROR_NOT_ENABLED ? "the device lacks an extension"
                       : result == VKH_ERROR_MEMORY      ? "no memory for descriptor sets"
                                                         : "the driver refused a pipeline";
  throw DeviceError(std::string(what) + ": " + reason);
}

// Chooses where the host writes the meshes: directly to where the device reads them, or into memory
// of the host, to be copied there. An H200 takes 0.3 s to give out a GB of the latter. The part of
// its memory that the host sees may be small, and in use already.
void PairBuffers::allocate_meshes(VkDeviceSize bytes, MemoryPolicy policy) {
  uploaded_bytes_ = bytes;
  bytes = roomy(bytes);
  if (policy == MemoryPolicy::kHost)  // they are read once
    return grow(meshes_, device_, bytes, {kWorking, Placement::kUpload});
  if (meshes_.size() < bytes && is_mappable(device_, bytes)) {
    try {
      grow(meshes_, device_, bytes, {kWorking, Placement::kMapped, pool_});
    } catch (const MemoryError&) {
    }
  }
  grow(meshes_, device_, bytes, {kWorking, Placement::kDevice, pool_});
  if (meshes_.mapped() == nullptr)
    grow(staging_, device_, bytes, {VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Placement::kUpload, pool_});
}

// Either mesh may be missing.
void PairBuffers::place_meshes(const MeshData& a, const MeshData& b, MemoryPolicy policy) {
  const VkDeviceSize bytes_a = bytes_of(a), bytes_b = bytes_of(b);
  allocate_meshes(bytes_a + bytes_b, policy);
  if (bytes_a > 0) problem_.a = view(meshes_.handle(), 0, a);
  if (bytes_b > 0) mesh_b_ = view(meshes_.handle(), bytes_a, b);
}

void PairBuffers::write_meshes(const MeshData& a, const MeshData& b) {
  std::byte* const to = meshes_.mapped() != nullptr ? meshes_.mapped() : staging_.mapped();
  write_both(to, {a, b});
}

// Chooses where B's BVH is or will be built.
void PairBuffers::place_b(const VkhHierarchyRequirements& needed, const RunInput& in,
                          MemoryPolicy policy) {
  if (in.resident != nullptr) {
    problem_.b = in.resident->view();
    return;
  }
  hierarchy_.grow(device_, needed, policy, pool_);
  problem_.b = hierarchy_.view();
  problem_.b.faceCount = mesh_b_.faceCount;
  problem_.b.vertexCount = mesh_b_.vertexCount;
}

// If memory is too small, the run gets `share` at most, half of that if there is not so much, and
// so on, and B's BVH gets what is left: all queries read it. If the caller asked for a size,
// `given`, the run gets the whole of it.
VkDeviceSize PairBuffers::allocate_scarce_workspace(VkDeviceSize bytes, VkDeviceSize least,
                                                    VkDeviceSize share, bool given) {
  const VkDeviceSize most = given ? bytes : std::clamp(share, least, std::max(bytes, least));
  for (VkDeviceSize run = most;; run = std::max(run / 2, least)) {
    try {
      allocate_buffer(workspace_, device_, run, MemoryPolicy::kDevice);
      return run;
    } catch (const MemoryError&) {
    }
    if (given || run == least) break;
  }
  allocate_buffer(workspace_, device_, bytes, MemoryPolicy::kHost);
  return bytes;
}

// On the device one buffer serves twice: as scratch while B's BVH is built, then as the run's
// workspace. If memory is scarce, the scratch is a buffer of its own in the host's memory.
VkDeviceSize PairBuffers::allocate_workspace(const VkhWorkspaceRequirements& needed,
                                             VkDeviceSize scratch, const RunInput& in,
                                             MemoryBudget budget) {
  const VkDeviceSize start =
      in.start_memory_bytes == 0 ? needed.recommended : in.start_memory_bytes;
  const VkDeviceSize bytes =
      std::clamp(in.memory_bytes == 0 ? start : in.memory_bytes, needed.minimum, needed.maximum);
  if (budget.policy == MemoryPolicy::kDevice) {
    allocate_buffer(workspace_, device_, std::max(bytes, scratch), MemoryPolicy::kDevice, pool_);
    scratch_ = {workspace_.handle(), 0, workspace_.size()};
    return bytes;
  }
  const VkDeviceSize taken =
      allocate_scarce_workspace(bytes, needed.minimum, budget.share, in.memory_bytes != 0);
  if (scratch > 0) allocate_buffer(building_, device_, scratch, MemoryPolicy::kHost);
  scratch_ = {building_.handle(), 0, building_.size()};
  return taken;
}

VkDeviceSize PairBuffers::host_bytes(const RunInput& in) const {
  return bytes_in_host(meshes_) + bytes_in_host(areas_) + bytes_in_host(building_) +
         bytes_in_host(workspace_) +
         (in.resident != nullptr ? in.resident->memory : hierarchy_).host_bytes();
}

void PairBuffers::set_problem(const RunInput& in, VkDeviceSize bytes, bool may_grow) {
  problem_.workspace = {workspace_.handle(), 0, bytes};
  problem_.options = in.options;
  problem_.options.size = sizeof(problem_.options);
  problem_.options.coverageBuffer = in.coverage ? areas_.handle() : VK_NULL_HANDLE;
  problem_.options.pauseWhenFull = may_grow && in.memory_bytes == 0 ? VK_TRUE : VK_FALSE;
  next_.reset();
  left_ = Buffer();
}

void PairBuffers::take(VkhContext context, const RunInput& in, RunOutput& out,
                       MemoryBudget budget) {
  is_laid_ = has(in) && laid_.context == context;
  if (is_laid_ && in.takes_begun) return;
  laid_ = {};
  taken_ = {in.kept, in.resident, context};
  has_b_ = is_laid_ || in.resident != nullptr;
  const MeshData b = in.resident != nullptr ? MeshData{} : in.b;
  const VkhWorkspaceRequirements workspace = workspace_for(context, counts_of(*in.a.mesh));
  VkhHierarchyRequirements hierarchy{};
  if (in.resident == nullptr) hierarchy = hierarchy_for(context, counts_of(*in.b.mesh));
  place_meshes(in.a, b, budget.policy);
  allocate_buffer(report_, device_, kReportBytes, budget.policy, pool_);
  grow(readback_, device_, kReportBytes,
       {VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kReadback, pool_});
  place_areas(in, out, budget.policy);
  const VkDeviceSize bytes = allocate_workspace(workspace, hierarchy.scratchSize, in, budget);
  place_b(hierarchy, in, budget.policy);
  set_problem(in, bytes, bytes < workspace.maximum);
  out.workspace_bytes = bytes;
  out.host_memory_bytes = host_bytes(in);
}

void PairBuffers::write(const RunInput& in) {
  if (!is_laid_) write_meshes(in.a, in.resident != nullptr ? MeshData{} : in.b);
}

// Returns the kept memory if it is large enough and not the run's own; otherwise new memory. The
// kept one is freed before that unless it is the run's own.
VkhMemory PairBuffers::allocate_room(VkDeviceSize bytes) {
  const bool is_own = problem_.workspace.buffer == larger_.handle();
  if (is_own || larger_.size() < bytes) {
    if (!is_own) larger_ = Buffer();
    Buffer made(device_, bytes, kWorking, Placement::kDevice, pool_);
    std::swap(larger_, made);
    if (is_own) left_ = std::move(made);  // until its contents have been copied
  }
  return {larger_.handle(), 0, bytes};
}

// Takes twice what is wanted, so that a frontier that still grows is moved seldom; at most half of
// the device's memory.
void PairBuffers::make_room(VkhContext context, RunOutput& out) {
  left_ = Buffer();
  const uint64_t wanted = out.report.wanted;
  if (wanted == 0) return;
  const auto bytes_for = [&](uint64_t candidates) {
    return vkhGetWorkspaceSize(context, problem_.a.vertexCount, problem_.a.faceCount,
                               static_cast<uint32_t>(std::min<uint64_t>(candidates, UINT32_MAX)));
  };
  const VkDeviceSize most = device_.description().memory_bytes / 2;
  const VkDeviceSize bytes = std::min(bytes_for(2 * wanted), most);
  next_ = problem_.workspace;
  try {
    if (bytes > problem_.workspace.size) next_ = allocate_room(bytes);
  } catch (const MemoryError&) {  // candidates without room can wait
  }
  problem_.options.pauseWhenFull = next_->size >= bytes_for(wanted) ? VK_TRUE : VK_FALSE;
  out.workspace_bytes = next_->size;
  const bool leaves = problem_.workspace.buffer == workspace_.handle() &&
                      next_->buffer != problem_.workspace.buffer;
  if (leaves) out.host_memory_bytes -= bytes_in_host(workspace_);
}

void PairBuffers::raise_known(float known_lower) {
  if (!(known_lower > problem_.options.knownLower)) return;
  problem_.options.knownLower = known_lower;
  if (!next_) next_ = problem_.workspace;
}

void PairBuffers::record_move(VkhContext context, VkCommandBuffer commands, VkhProfile* profile) {
  if (!next_) return;
  vkhCmdMoveRun(context, commands, &problem_, &*next_, profile);
  next_.reset();
}

ResidentMesh PairBuffers::allocate_resident(VkhContext context, const MeshData& b,
                                            MemoryPolicy policy) {
  const VkhHierarchyRequirements needed = hierarchy_for(context, counts_of(*b.mesh));
  place_meshes({}, b, policy);
  ResidentMesh resident{{}, mesh_b_.vertexCount, mesh_b_.faceCount};
  resident.memory.allocate(device_, needed, policy);
  allocate_buffer(workspace_, device_, needed.scratchSize, policy);
  write_meshes({}, b);
  scratch_ = {workspace_.handle(), 0, workspace_.size()};
  taken_ = laid_ = {};
  is_laid_ = has_b_ = false;
  return resident;
}

void PairBuffers::place_areas(const RunInput& in, RunOutput& out, MemoryPolicy policy) {
  if (!in.coverage) return;
  out.areas.resize(2 * in.a.mesh->faces.size());
  const VkDeviceSize bytes = out.areas.size() * sizeof(uint64_t);
  allocate_buffer(areas_, device_, bytes, policy);
  grow(areas_readback_, device_, bytes, {VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kReadback});
}

void PairBuffers::record_upload(VkCommandBuffer commands) const {
  if (is_laid_ || meshes_.mapped() != nullptr) return;
  const VkBufferCopy copy{0, 0, uploaded_bytes_};
  device_.vk().CmdCopyBuffer(commands, staging_.handle(), meshes_.handle(), 1, &copy);
}

void PairBuffers::record_readback(VkCommandBuffer commands, const RunOutput& out) const {
  const VkBufferCopy copy{0, 0, kReportBytes};
  device_.vk().CmdCopyBuffer(commands, report_.handle(), readback_.handle(), 1, &copy);
  if (out.areas.empty()) return;
  const VkBufferCopy areas{0, 0, out.areas.size() * sizeof(uint64_t)};
  device_.vk().CmdCopyBuffer(commands, areas_.handle(), areas_readback_.handle(), 1, &areas);
}

void PairBuffers::read(RunOutput& out) {
  if (taken_.context != nullptr) laid_ = std::exchange(taken_, {});
  std::memcpy(&out.report, readback_.mapped(), sizeof(out.report));
  std::memcpy(&out.statistics, readback_.mapped() + kStatisticsOffset, sizeof(out.statistics));
  if (!out.areas.empty())
    std::memcpy(out.areas.data(), areas_readback_.mapped(), out.areas.size() * sizeof(uint64_t));
}

// The host writes the cells and reads the bounds once, so they need not be in the device's own
// memory.
VkhCells PairBuffers::place_cells(const CellBatch& batch) {
  const auto count = static_cast<uint32_t>(batch.bounds.size());
  const VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  grow(bounds_, device_, roomy(batch.bounds.size_bytes()), {usage, Placement::kReadback});
  if (!batch.cells.empty()) {
    grow(cells_, device_, roomy(batch.cells.size_bytes()), {usage, Placement::kUpload});
    std::memcpy(cells_.mapped(), batch.cells.data(), batch.cells.size_bytes());
  }
  return {.cellBuffer = batch.cells.empty() ? VK_NULL_HANDLE : cells_.handle(),
          .cellOffset = 0,
          .first = batch.first,
          .count = count,
          .boundsBuffer = bounds_.handle(),
          .boundsOffset = 0};
}

void PairBuffers::read_bounds(const CellBatch& batch) const {
  std::memcpy(batch.bounds.data(), bounds_.mapped(), batch.bounds.size_bytes());
}

VkhClosestQuery PairBuffers::place_points(const PointBatch& batch) {
  const VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  grow(bounds_, device_, roomy(batch.found.size_bytes()), {usage, Placement::kReadback});
  grow(cells_, device_, roomy(batch.points.size_bytes()), {usage, Placement::kUpload});
  std::memcpy(cells_.mapped(), batch.points.data(), batch.points.size_bytes());
  return {.pointBuffer = cells_.handle(),
          .pointOffset = 0,
          .count = static_cast<uint32_t>(batch.points.size()),
          .twoFloat = batch.has_low ? VK_TRUE : VK_FALSE,
          .closestBuffer = bounds_.handle(),
          .closestOffset = 0};
}

void PairBuffers::read_closest(const PointBatch& batch) const {
  std::memcpy(batch.found.data(), bounds_.mapped(), batch.found.size_bytes());
}

}  // namespace vkh
