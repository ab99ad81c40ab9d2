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

// A buffer that is there may have room for more.
void DeviceCells::begin(std::span<const uint64_t> weights, float farthest) {
  const uint32_t faces = problem_.a.faceCount;
  const auto bytes_of = [&](uint32_t capacity) {
    return vkhGetSurveySize(context_, faces, capacity);
  };
  const auto bindable = static_cast<uint32_t>(most());
  if (faces > bindable) throw MemoryError("the device binds no survey of so many faces");
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
  fresh_ = {.first = 0, .count = faces, .parts = 1, .live = 0};
  waiting_.push_back([this, farthest](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    const VkhSurveyBegin begin{buffers_.weights.handle(), 0, farthest};
    vkhCmdBeginSurvey(context_, commands, &problem_, &survey, &begin);
  });
}

// Together with what waits, in its order.
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
  const VkhSurvey to{{larger.handle(), 0, larger.size()}, capacity};
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
  fresh_ = {.first = 0, .count = more + choice.count(), .parts = choice.parts, .live = count_};
  count_ += more;
  return true;
}

void DeviceCells::bound(size_t first, size_t count, bool wait) {
  VkhSurveyBound some = fresh_;
  some.first = static_cast<uint32_t>(first);
  some.count = static_cast<uint32_t>(count);
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

std::vector<float> DeviceCells::faces() {
  std::vector<float> faces(2 * size_t{problem_.a.faceCount});
  grow(buffers_.faces, device_, faces.size() * sizeof(float), kRead);
  waiting_.push_back([this](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    VkhSurveyRead read{};
    read.cells = count_;
    read.faceBuffer = buffers_.faces.handle();
    vkhCmdReadSurvey(context_, commands, &problem_, &survey, &read);
  });
  submit();
  std::memcpy(faces.data(), buffers_.faces.mapped(), faces.size() * sizeof(float));
  return faces;
}

void DeviceCells::read(std::vector<gpu::Cell>& cells, std::vector<gpu::CellBounds>& bounds) {
  cells.resize(count_);
  bounds.resize(count_);
  grow(buffers_.cells, device_, cells.size() * sizeof(cells[0]), kRead);
  grow(buffers_.bounds, device_, bounds.size() * sizeof(bounds[0]), kRead);
  waiting_.push_back([this](VkCommandBuffer commands) {
    const VkhSurvey survey = view();
    VkhSurveyRead read{};
    read.cells = count_;
    read.cellBuffer = buffers_.cells.handle();
    read.boundsBuffer = buffers_.bounds.handle();
    vkhCmdReadSurvey(context_, commands, &problem_, &survey, &read);
  });
  submit();
  copy_together(cells.data(), buffers_.cells.mapped(), cells.size() * sizeof(cells[0]));
  copy_together(bounds.data(), buffers_.bounds.mapped(), bounds.size() * sizeof(bounds[0]));
}

}  // namespace vkh
