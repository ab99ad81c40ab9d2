#include "host/solve/device_cells.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "host/base/parallel.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

constexpr VkBufferUsageFlags kOfCells = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                        VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                        VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr BufferUse kWritten{VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Placement::kUpload};
constexpr BufferUse kBound{VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::kUpload};
constexpr BufferUse kRead{VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kReadback};

// Few surveys need more than a few cells a face, and a small one should not allocate twice.
constexpr uint32_t kCellsOfFace = 4, kFewCells = 1u << 15;

}  // namespace

DeviceCells::DeviceCells(const Device& device, VkhContext context, const VkhProblem& problem,
                         SurveyBuffers& buffers, Submit submit)
    : device_(device),
      context_(context),
      problem_(problem),
      buffers_(buffers),
      submit_(std::move(submit)) {}

// The buffer of an earlier survey may have room for more.
void DeviceCells::begin(std::span<const uint64_t> weights, float farthest) {
  const uint32_t faces = problem_.a.faceCount;
  const auto bytes_of = [&](uint32_t capacity) {
    return vkhGetSurveySize(context_, faces, capacity);
  };
  const auto bindable = static_cast<uint32_t>(most());
  if (faces > bindable) throw MemoryError("the device cannot bind a survey of this many faces");
  capacity_ = std::min(std::max(kCellsOfFace * faces, kFewCells), bindable);
  grow(buffers_.memory, device_, bytes_of(capacity_), {kOfCells, Placement::kDevice});
  while (capacity_ <= bindable / 2 && bytes_of(2 * capacity_) <= buffers_.memory.size())
    capacity_ *= 2;
  grow(buffers_.weights, device_, weights.size_bytes(), kWritten);
  grow(buffers_.plan, device_, sizeof(gpu::SurveyPlan), kWritten);
  grow(buffers_.histogram, device_, gpu::kScoreBins * sizeof(uint32_t), kRead);
  grow(buffers_.table, device_, sizeof(gpu::SurveyTable), kRead);
  std::memcpy(buffers_.weights.mapped(), weights.data(), weights.size_bytes());
  count_ = faces;
  waiting_.push_back([this, farthest](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    const VkhSurveyCells cells{buffers_.weights.handle(), 0, farthest};
    vkhCmdBeginSurveyCells(context_, commands, &problem_, &survey, &cells);
  });
}

// Submits what waits, in its order.
void DeviceCells::submit() {
  const std::vector<Record> waiting = std::exchange(waiting_, {});
  submit_([&](VkCommandBuffer commands) {
    for (const Record& record : waiting) record(commands);
  });
}

void DeviceCells::write_plan(const gpu::SurveyPlan& plan) {
  std::memcpy(buffers_.plan.mapped(), &plan, sizeof(plan));
}

std::span<const uint32_t> DeviceCells::score(const gpu::SurveyPlan& plan, const CellRange& some) {
  write_plan(plan);
  waiting_.push_back([this, some](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    const VkhSurveyScore score{
        some.first, some.count, buffers_.plan.handle(), 0, buffers_.histogram.handle(), 0};
    vkhCmdScoreSurvey(context_, commands, &problem_, &survey, &score);
  });
  submit();
  const auto* const counts = reinterpret_cast<const uint32_t*>(buffers_.histogram.mapped());
  return {counts, gpu::kScoreBins};
}

// The cells move at once, since their old memory goes.
bool DeviceCells::make_room(size_t cells) {
  if (cells <= capacity_) return true;
  const size_t wanted = std::min(std::max(cells, 2 * size_t{capacity_}), most());
  if (cells > wanted) return false;
  const auto capacity = static_cast<uint32_t>(wanted);
  Buffer larger;
  try {
    larger = Buffer(device_, vkhGetSurveySize(context_, problem_.a.faceCount, capacity), kOfCells,
                    Placement::kDevice);
  } catch (const MemoryError&) {
    return false;
  }
  const VkhSurvey from = view();
  const VkhSurvey to = view_of(larger, capacity);
  waiting_.push_back([&](VkCommandBuffer commands) {
    vkhCmdMoveSurvey(context_, commands, &problem_, &from, &to, count_);
  });
  submit();
  buffers_.memory = std::move(larger);
  capacity_ = capacity;
  return true;
}

bool DeviceCells::split(const SurveyChoice& choice) {
  const uint32_t more = (choice.parts - 1) * choice.count();
  if (!make_room(size_t{count_} + more)) return false;
  waiting_.push_back([this, choice, cells = count_](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    const VkhSurveySplit split{cells, choice.bin, choice.ties, choice.above, choice.parts};
    vkhCmdSplitSurvey(context_, commands, &problem_, &survey, &split);
  });
  count_ += more;
  return true;
}

void DeviceCells::bound(size_t first, size_t count, bool wait) {
  const VkhSurveyBound some{static_cast<uint32_t>(first), static_cast<uint32_t>(count)};
  waiting_.push_back([this, some](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    vkhCmdBoundSurvey(context_, commands, &problem_, &survey, &some, nullptr);
  });
  if (wait) submit();
}

const gpu::SurveyTable& DeviceCells::tally(const gpu::SurveyPlan& plan, int unit,
                                           const CellRange& some) {
  write_plan(plan);
  waiting_.push_back([this, unit, some](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    const VkhSurveyTally tally{
        some.first, some.count, unit, buffers_.plan.handle(), 0, buffers_.table.handle(), 0};
    vkhCmdTallySurvey(context_, commands, &problem_, &survey, &tally);
  });
  submit();
  return *reinterpret_cast<const gpu::SurveyTable*>(buffers_.table.mapped());
}

void DeviceCells::find_sides(const SideSearch& search, float above, const CellRange& some) {
  grow(buffers_.face_kinds, device_, search.face_kinds.size_bytes(), kBound);
  std::memcpy(buffers_.face_kinds.mapped(), search.face_kinds.data(),
              search.face_kinds.size_bytes());
  waiting_.push_back([this, search, above, some](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    const VkhSurveySides sides{some.first,
                               some.count,
                               above,
                               search.near,
                               search.moved,
                               search.is_solid ? VK_TRUE : VK_FALSE,
                               search.front,
                               buffers_.face_kinds.handle(),
                               0};
    vkhCmdFindSurveySides(context_, commands, &problem_, &survey, &sides);
  });
  submit();
}

void DeviceCells::begin_normals(const NormalSearch& search) {
  normals_ = search;
  grow(buffers_.normals, device_, search.normals.size_bytes(), kBound);
  copy_together(buffers_.normals.mapped(), search.normals.data(), search.normals.size_bytes());
}

void DeviceCells::find_normals(const CellRange& some) {
  waiting_.push_back([this, some](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    const VkhSurveyNormals normals{some.first,
                                   some.count,
                                   normals_.moved,
                                   normals_.limit_down,
                                   normals_.limit_up,
                                   buffers_.normals.handle(),
                                   0};
    vkhCmdFindSurveyNormals(context_, commands, &problem_, &survey, &normals);
  });
  submit();
}

std::vector<float> DeviceCells::faces(uint32_t reached_classes, uint32_t highest_classes) {
  std::vector<float> faces(2 * size_t{problem_.a.faceCount});
  grow(buffers_.faces, device_, faces.size() * sizeof(float), kRead);
  waiting_.push_back([&](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    const VkhSurveyFaces asked{count_, reached_classes, highest_classes, buffers_.faces.handle(),
                               0};
    vkhCmdFindSurveyFaces(context_, commands, &problem_, &survey, &asked);
  });
  submit();
  std::memcpy(faces.data(), buffers_.faces.mapped(), faces.size() * sizeof(float));
  return faces;
}

void DeviceCells::write(const CellRange& some, std::span<const gpu::CellBounds> bounds) {
  grow(buffers_.known, device_, bounds.size_bytes(), kWritten);
  std::memcpy(buffers_.known.mapped(), bounds.data(), bounds.size_bytes());
  waiting_.push_back([this, some](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    const VkhSurveyWrite write{some.first, some.count, buffers_.known.handle(), 0};
    vkhCmdNarrowSurvey(context_, commands, &problem_, &survey, &write);
  });
  submit();
}

CellsRead DeviceCells::read(const CellRange& some) {
  grow(buffers_.cells, device_, some.count * sizeof(gpu::Cell), kRead);
  grow(buffers_.bounds, device_, some.count * sizeof(gpu::CellBounds), kRead);
  grow(buffers_.classes, device_, some.count * sizeof(uint32_t), kRead);
  waiting_.push_back([&](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    const VkhSurveyRead read{some.first,
                             some.count,
                             buffers_.cells.handle(),
                             0,
                             buffers_.bounds.handle(),
                             0,
                             buffers_.classes.handle(),
                             0};
    vkhCmdReadSurvey(context_, commands, &problem_, &survey, &read);
  });
  submit();
  const auto read_from = [&]<class T>(std::span<const T>& values, const Buffer& buffer) {
    values = {reinterpret_cast<const T*>(buffer.mapped()), some.count};
  };
  CellsRead all;
  read_from(all.cells, buffers_.cells);
  read_from(all.bounds, buffers_.bounds);
  read_from(all.classes, buffers_.classes);
  return all;
}

}  // namespace vkh
