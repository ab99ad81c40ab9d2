#include "host/run/seat.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/run/mesh_sizes.h"

namespace vkh {
namespace {

constexpr VkBufferUsageFlags kWorking =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

// Room for the next, somewhat larger mesh: a driver takes tenths of milliseconds to allocate.
VkDeviceSize roomy(VkDeviceSize bytes) {
  constexpr VkDeviceSize kLargest = VkDeviceSize{64} << 20;
  return bytes > kLargest ? bytes : std::bit_ceil(bytes);
}

VkDeviceSize aligned(VkDeviceSize bytes) { return (bytes + 255) / 256 * 256; }

// High parts, low parts if there are any, faces, one after the other.
struct MeshBytes {
  VkDeviceSize high, low, faces;
  explicit MeshBytes(const MeshData& m)
      : high(aligned(m.mesh->vertices.size() * 12)),
        low(m.stored->has_low ? high : 0),
        faces(aligned(m.mesh->faces.size() * 12)) {}
  VkDeviceSize total() const { return high + low + faces; }
};

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

// Of the device's memory, or of the host's, where `reach` lets it and the device has no more.
void take_buffer(Buffer& buffer, const Device& device, VkDeviceSize bytes, Reach reach) {
  try {
    grow(buffer, device, bytes, kWorking, Placement::kDevice);
  } catch (const DeviceError&) {
    if (reach == Reach::kDevice) throw;
    buffer = Buffer(device, bytes, kWorking, Placement::kUpload);
  }
}

VkDeviceSize host_bytes(const Buffer& buffer) {
  return buffer.placement() == Placement::kUpload ? buffer.size() : 0;
}

void write(std::byte* to, const MeshData& m) {
  const MeshBytes bytes(m);
  write_vertices(*m.stored, *m.mesh, reinterpret_cast<float*>(to),
                 reinterpret_cast<float*>(to + bytes.high));
  const std::vector<glm::uvec3>& faces = m.mesh->faces;
  copy_together(to + bytes.high + bytes.low, faces.data(), faces.size() * sizeof(faces[0]));
}

}  // namespace

void HierarchyMemory::take(const Device& device, const VkhHierarchyRequirements& needed,
                           Reach reach) {
  for (uint32_t i = 0; i < needed.rangeCount; ++i)
    take_buffer(ranges_[i], device, needed.ranges[i], reach);
}

void HierarchyMemory::grow(const Device& device, const VkhHierarchyRequirements& needed,
                           Reach reach) {
  for (uint32_t i = 0; i < needed.rangeCount; ++i)
    take_buffer(ranges_[i], device, roomy(needed.ranges[i]), reach);
  for (uint32_t i = needed.rangeCount; i < ranges_.size(); ++i) ranges_[i] = Buffer();
}

VkDeviceSize HierarchyMemory::host_bytes() const {
  VkDeviceSize bytes = 0;
  for (const Buffer& range : ranges_) bytes += vkh::host_bytes(range);
  return bytes;
}

VkhHierarchy HierarchyMemory::view() const {
  VkhHierarchy hierarchy{};
  hierarchy.memory = {ranges_[0].handle(), 0, ranges_[0].size()};
  for (uint32_t i = 1; i < ranges_.size(); ++i)
    hierarchy.more[i - 1] = {ranges_[i].handle(), 0, ranges_[i].size()};
  return hierarchy;
}

bool fits_bindings(VkhContext context, const RunInput& in) {
  return (in.a.mesh == nullptr || takes_as_a(context, counts_of(*in.a.mesh))) &&
         (in.b.mesh == nullptr || takes_as_b(context, counts_of(*in.b.mesh)));
}

void check_engine(VkhResult result, const char* what) {
  if (result == VKH_SUCCESS) return;
  const char* reason = result == VKH_ERROR_UNSUPPORTED ? "the device is not supported"
                       : result == VKH_ERROR_MEMORY    ? "no memory for descriptor sets"
                                                       : "the driver refused a pipeline";
  throw DeviceError(std::string(what) + ": " + reason);
}

// Where the host writes the meshes: straight into where the device reads them, or into memory of
// the host, to be copied there. An H200 takes 0.3 s to give out a GB of the latter. What of its
// memory the host sees may be small, and taken.
std::byte* Seat::take_meshes(Reach reach) {
  const VkDeviceSize bytes = roomy(uploaded_bytes_);
  if (reach == Reach::kHost) {  // they are read once
    grow(meshes_, device_, bytes, kWorking, Placement::kUpload);
    return meshes_.mapped();
  }
  if (meshes_.size() < bytes && is_mappable(device_, bytes)) {
    try {
      grow(meshes_, device_, bytes, kWorking, Placement::kMapped);
    } catch (const DeviceError&) {
    }
  }
  grow(meshes_, device_, bytes, kWorking, Placement::kDevice);
  if (meshes_.mapped() != nullptr) return meshes_.mapped();
  grow(staging_, device_, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Placement::kUpload);
  return staging_.mapped();
}

// Either may be missing.
void Seat::upload(const MeshData& a, const MeshData& b, Reach reach) {
  const VkDeviceSize bytes_a = a.mesh != nullptr ? MeshBytes(a).total() : 0;
  const VkDeviceSize bytes_b = b.mesh != nullptr ? MeshBytes(b).total() : 0;
  uploaded_bytes_ = bytes_a + bytes_b;
  std::byte* const to = take_meshes(reach);
  if (bytes_a > 0) write(to, a);
  if (bytes_a > 0) problem_.a = view(meshes_.handle(), 0, a);
  if (bytes_b > 0) write(to + bytes_a, b);
  if (bytes_b > 0) mesh_b_ = view(meshes_.handle(), bytes_a, b);
}

// Where B's hierarchy is or will be built.
void Seat::place_b(const VkhHierarchyRequirements& needed, const RunInput& in, Reach reach) {
  if (in.resident != nullptr) {
    problem_.b = in.resident->memory.view();
    problem_.b.faceCount = in.resident->face_count;
    problem_.b.vertexCount = in.resident->vertex_count;
    return;
  }
  hierarchy_.grow(device_, needed, reach);
  problem_.b = hierarchy_.view();
  problem_.b.faceCount = mesh_b_.faceCount;
  problem_.b.vertexCount = mesh_b_.vertexCount;
}

// Before B's hierarchy, which is read less often. The run gets `bytes`, or, where the device has
// not so many, half as many, and so on, from `least` on; building B needs `scratch`, before.
// Returns what the run gets.
VkDeviceSize Seat::take_workspace(VkDeviceSize bytes, VkDeviceSize least, VkDeviceSize scratch,
                                  Reach reach) {
  for (VkDeviceSize run = bytes;; run = std::max(run / 2, least)) {
    try {
      take_buffer(workspace_, device_, std::max(run, scratch), Reach::kDevice);
      return run;
    } catch (const DeviceError&) {
      if (reach == Reach::kDevice) throw;
    }
    if (run == least) break;
  }
  take_buffer(workspace_, device_, std::max(bytes, scratch), reach);
  return bytes;
}

void Seat::take(VkhContext context, const RunInput& in, RunOutput& out, Reach reach) {
  is_resident_ = in.resident != nullptr;
  const VkhWorkspaceRequirements workspace = workspace_for(context, counts_of(*in.a.mesh));
  VkhHierarchyRequirements hierarchy{};
  if (!is_resident_) hierarchy = hierarchy_for(context, counts_of(*in.b.mesh));
  upload(in.a, is_resident_ ? MeshData{} : in.b, reach);
  const VkDeviceSize start =
      in.start_memory_bytes == 0 ? workspace.recommended : in.start_memory_bytes;
  const VkDeviceSize wanted = std::clamp(in.memory_bytes == 0 ? start : in.memory_bytes,
                                         workspace.minimum, workspace.maximum);
  // B's hierarchy, which every query reads, is to have most of a memory that is too small.
  const VkDeviceSize share = device_.description().memory_bytes / 4;
  const bool is_cut = reach == Reach::kHost && in.memory_bytes == 0 && wanted > share;
  const VkDeviceSize bytes = take_workspace(is_cut ? std::max(share, workspace.minimum) : wanted,
                                            workspace.minimum, hierarchy.scratchSize, reach);
  place_b(hierarchy, in, reach);
  out.workspace_bytes = bytes;
  out.host_memory_bytes = host_bytes(workspace_) +
                          (in.resident != nullptr ? in.resident->memory : hierarchy_).host_bytes();
  grow(report_, device_, sizeof(VkhReport), kWorking, Placement::kDevice);
  grow(readback_, device_, sizeof(VkhReport), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
       Placement::kReadback);
  problem_.workspace = {workspace_.handle(), 0, bytes};
  problem_.cullTolerance = in.cull_tolerance;
  problem_.knownLower = in.known_lower;
  problem_.sortFrom = in.sort_from;
  problem_.twoFloat = in.two_float ? VK_TRUE : VK_FALSE;
  const bool grows = in.memory_bytes == 0 && bytes < workspace.maximum;
  problem_.pauseWhenFull = grows ? VK_TRUE : VK_FALSE;
  next_.reset();
  left_ = Buffer();
  place_areas(in, out);
  scratch_ = {workspace_.handle(), 0, workspace_.size()};
}

// The kept one, where it is large enough and not the run's own; else a new one, before which the
// kept one goes unless it is.
VkhMemory Seat::take_room(VkDeviceSize bytes) {
  const bool is_own = problem_.workspace.buffer == larger_.handle();
  if (is_own || larger_.size() < bytes) {
    if (!is_own) larger_ = Buffer();
    Buffer made(device_, bytes, kWorking, Placement::kDevice);
    std::swap(larger_, made);
    if (is_own) left_ = std::move(made);  // until what it holds has been copied
  }
  return {larger_.handle(), 0, bytes};
}

// Twice what is wanted, so that a frontier that still grows is moved seldom; at most half of the
// device's memory.
void Seat::make_room(VkhContext context, RunOutput& out) {
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
    if (bytes > problem_.workspace.size) next_ = take_room(bytes);
  } catch (const DeviceError&) {  // what has no room can wait
  }
  problem_.pauseWhenFull = next_->size >= bytes_for(wanted) ? VK_TRUE : VK_FALSE;
  out.workspace_bytes = next_->size;
}

void Seat::record_move(VkhContext context, VkCommandBuffer commands, VkhProfile* profile) {
  if (!next_) return;
  vkhCmdMoveRun(context, commands, &problem_, &*next_, profile);
  next_.reset();
}

ResidentMesh Seat::take_resident(VkhContext context, const MeshData& b, Reach reach) {
  const VkhHierarchyRequirements needed = hierarchy_for(context, counts_of(*b.mesh));
  upload({}, b, reach);
  ResidentMesh resident{{}, mesh_b_.vertexCount, mesh_b_.faceCount};
  take_buffer(workspace_, device_, needed.scratchSize, reach);
  resident.memory.take(device_, needed, reach);
  scratch_ = {workspace_.handle(), 0, workspace_.size()};
  is_resident_ = false;
  return resident;
}

void Seat::place_areas(const RunInput& in, RunOutput& out) {
  problem_.coverageBuffer = VK_NULL_HANDLE;
  if (!in.coverage) return;
  out.areas.resize(2 * in.a.mesh->faces.size());
  const VkDeviceSize bytes = out.areas.size() * sizeof(uint64_t);
  grow(areas_, device_, bytes, kWorking, Placement::kDevice);
  grow(areas_readback_, device_, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kReadback);
  problem_.coverageBuffer = areas_.handle();
}

void Seat::record_upload(VkCommandBuffer commands) const {
  if (meshes_.mapped() != nullptr) return;
  const VkBufferCopy copy{0, 0, uploaded_bytes_};
  device_.vk().CmdCopyBuffer(commands, staging_.handle(), meshes_.handle(), 1, &copy);
}

void Seat::record_readback(VkCommandBuffer commands, const RunOutput& out) const {
  const VkBufferCopy copy{0, 0, sizeof(VkhReport)};
  device_.vk().CmdCopyBuffer(commands, report_.handle(), readback_.handle(), 1, &copy);
  if (out.areas.empty()) return;
  const VkBufferCopy areas{0, 0, out.areas.size() * sizeof(uint64_t)};
  device_.vk().CmdCopyBuffer(commands, areas_.handle(), areas_readback_.handle(), 1, &areas);
}

void Seat::read(RunOutput& out) const {
  std::memcpy(&out.report, readback_.mapped(), sizeof(out.report));
  if (!out.areas.empty())
    std::memcpy(out.areas.data(), areas_readback_.mapped(), out.areas.size() * sizeof(uint64_t));
}

}  // namespace vkh
