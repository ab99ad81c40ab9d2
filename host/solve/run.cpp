#include "host/solve/run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <utility>

#include "engine/vkhausdorff_experimental.h"
#include "host/base/parallel.h"
#include "host/gpu/vulkan_api.h"
#include "host/solve/switches.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// Waves of the first submission, the begin's among them: enough for most pairs on a GPU; on a CPU
// one wave can take seconds, and so can the BVH, which is then a submission of its own. A run that
// shares its known bound makes one wave first, since it then has something to report.
constexpr uint32_t kFirstWaves = 8;
constexpr uint32_t kFewFirstWaves = 1;
// Later submissions aim at this long, so that budgets and Ctrl-C take effect. An empty wave costs
// an H200 some 8 us (reckoned), another report 22: so the second submission is short, and long runs
// get longer ones.
constexpr double kSubmissionMs = 100;
constexpr uint32_t kSecondWaves = 2;
constexpr uint32_t kMostWaves = 8;

uint32_t next_waves(uint32_t submissions, uint32_t last, double last_ms) {
  const double per_wave = std::max(last_ms / last, 1e-3);
  const uint32_t most = std::min(kSecondWaves << std::min(submissions - 1, 2u), kMostWaves);
  return static_cast<uint32_t>(
      std::clamp(kSubmissionMs / per_wave, 1.0, static_cast<double>(most)));
}

double now_ms() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

// Makes the writes of one stage visible to the next: of copies before and after the engine's
// commands.
void full_barrier(const VulkanApi& vk, VkCommandBuffer commands, VkPipelineStageFlags to) {
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  vk.CmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, to, 0, 1, &barrier, 0,
                        nullptr, 0, nullptr);
}

uint64_t bytes_of(std::span<const RunInput> inputs) {
  uint64_t bytes = 0;
  for (const RunInput& input : inputs) {
    for (const MeshData& data : {input.a, input.b})
      bytes += data.mesh != nullptr ? mesh_bytes(*data.mesh) : 0;
  }
  return bytes;
}

// The report of a run that has not begun.
VkhReport nothing_known() {
  VkhReport report{};
  report.upper = report.upperAbove = std::numeric_limits<float>::max();
  report.witnessFaceA = report.witnessFaceB = UINT32_MAX;
  return report;
}

}  // namespace

// One submission.
struct Runner::Submission {
  std::vector<size_t> running;  // indices into buffers_
  bool is_alone;                // of one pair, with its BVH timed apart
  bool uploads, builds, begins;
  uint32_t waves;
};

Runner::Runner(const Device& device, std::shared_ptr<Contexts> contexts)
    : device_(device),
      contexts_(std::move(contexts)),
      submitter_(device),
      pool_(device),
      names_(Submitter::kTimestamps) {}

// If a mesh is too large to be bound, it is given by address, which gives the same bits.
VkhContext Runner::context_for(uint32_t switches, std::span<const RunInput> inputs,
                               ContextUse use) {
  const VkhContext context = contexts_->get(switches, use);
  const bool fits = std::all_of(inputs.begin(), inputs.end(), [&](const RunInput& input) {
    return fits_bindings(context, input);
  });
  return fits || !device_.has_addresses() ? context
                                          : contexts_->get(switches | kSwitchByAddress, use);
}

// Calls `allocate` with as many pair buffers as are asked for. They are kept for reuse, unless the
// buffers of an earlier run leave too little memory, or are in the host's memory.
void Runner::with_buffers(size_t count, const std::function<void(MemoryPolicy)>& allocate) {
  if (policy_ == MemoryPolicy::kHost) buffers_.clear();
  std::vector<MemoryPolicy> policies{MemoryPolicy::kDevice, MemoryPolicy::kHost};
  if (!buffers_.empty()) policies.insert(policies.begin(), MemoryPolicy::kDevice);
  for (const MemoryPolicy policy : policies) {
    policy_ = policy;
    MemoryPool* const pool = count > 1 && policy == MemoryPolicy::kDevice ? &pool_ : nullptr;
    while (buffers_.size() < count)
      buffers_.push_back(std::make_unique<PairBuffers>(device_, pool));
    try {
      return allocate(policy);
    } catch (const MemoryError&) {
      if (policy == MemoryPolicy::kHost) throw;
      buffers_.clear();
    }
  }
}

VkCommandBuffer Runner::begin() {
  const VkCommandBuffer commands = submitter_.begin();
  vkhReleaseCommandBuffer(context_, commands);
  profile_ = {submitter_.timestamps(), Submitter::kTimestamps, 0, names_.data()};
  return commands;
}

// Writes a timestamp, unless the library times its own stages in this run or the device has no
// timestamps.
void Runner::stamp(VkCommandBuffer commands, const char* name) {
  if (stage_times_ || !device_.has_timestamps()) return;
  device_.vk().CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, profile_.pool,
                                 profile_.count);
  names_[profile_.count++] = name;
}

ResidentMesh Runner::build(const MeshData& b) {
  const SerialGuard::Hold hold(guard_);
  std::array<RunInput, 1> alone;
  alone[0].b = b;
  context_ = context_for(default_switches(device_), alone, ContextUse::kHierarchy);
  ResidentMesh resident;
  with_buffers(1, [&](MemoryPolicy policy) {
    resident = buffers_[0]->allocate_resident(context_, b, policy);
  });
  VkhHierarchy hierarchy = resident.memory.view();
  const VkCommandBuffer commands = begin();
  buffers_[0]->record_upload(commands);
  full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
  vkhCmdBuildHierarchy(context_, commands, buffers_[0]->mesh_b(), &hierarchy,
                       buffers_[0]->scratch(), nullptr);
  submit_and_wait(commands);
  return resident;
}

void Runner::submit_and_wait(VkCommandBuffer commands) {
  check_engine(vkhGetRecordingResult(context_, commands), "recording");
  submitter_.submit_and_wait({});
}

void Runner::record_one(VkCommandBuffer commands, const Submission& submission) {
  PairBuffers& buffers = *buffers_[submission.running[0]];
  VkhProblem& problem = buffers.problem();
  stamp(commands, nullptr);
  buffers.record_move(context_, commands, profile());
  if (submission.builds && buffers.mesh_b() != nullptr) {
    vkhCmdBuildHierarchy(context_, commands, buffers.mesh_b(), &problem.b, buffers.scratch(),
                         profile());
    stamp(commands, "hierarchy");
  }
  if (submission.waves == 0) return;
  if (submission.begins) vkhCmdBegin(context_, commands, &problem, profile());
  const uint32_t waves =
      submission.begins ? submission.waves - 1 : submission.waves;  // the begin makes one wave
  vkhCmdAdvance(context_, commands, &problem, waves, profile());
  // A task's statistics wait for its waves alone, and are copied beside the report's dispatch.
  VkhTask output{};
  output.size = sizeof(output);
  output.problem = &problem;
  output.reportBuffer = output.statisticsBuffer = buffers.report();
  output.statisticsOffset = PairBuffers::kStatisticsOffset;
  vkhCmdRunTasks(context_, commands, 1, &output, profile());
  stamp(commands, "solve");
}

void Runner::record_together(VkCommandBuffer commands, const Submission& submission) {
  std::vector<VkhTask> tasks;
  stamp(commands, nullptr);
  for (const size_t i : submission.running) {
    PairBuffers& buffers = *buffers_[i];
    buffers.record_move(context_, commands, nullptr);
    tasks.push_back({.size = sizeof(VkhTask),
                     .mesh = submission.builds ? buffers.mesh_b() : nullptr,
                     .scratch = buffers.scratch(),
                     .problem = &buffers.problem(),
                     .begin = submission.begins ? VK_TRUE : VK_FALSE,
                     .waves = submission.begins ? submission.waves - 1 : submission.waves,
                     .reportBuffer = buffers.report(),
                     .reportOffset = 0,
                     .statisticsBuffer = buffers.report(),
                     .statisticsOffset = PairBuffers::kStatisticsOffset});
  }
  vkhCmdRunTasks(context_, commands, static_cast<uint32_t>(tasks.size()), tasks.data(), nullptr);
  stamp(commands, "solve");
}

VkCommandBuffer Runner::record(const Submission& submission,
                               const std::vector<RunOutput>& outputs) {
  const VkCommandBuffer commands = begin();
  if (submission.uploads) {
    for (const size_t i : submission.running) buffers_[i]->record_upload(commands);
    full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
  }
  if (submission.is_alone) {
    record_one(commands, submission);
  } else {
    record_together(commands, submission);
  }
  if (submission.waves == 0) return commands;  // there is no report yet
  full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_TRANSFER_BIT);
  for (const size_t i : submission.running) buffers_[i]->record_readback(commands, outputs[i]);
  full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_HOST_BIT);
  return commands;
}

void Runner::read_stages(const Submission& submission, std::vector<RunOutput>& outputs) {
  const std::vector<double> ms = submitter_.read_timestamps(profile_.count);
  for (uint32_t stage = 1; stage < profile_.count; ++stage) {
    if (names_[stage] == nullptr) continue;
    for (const size_t i : submission.running)
      outputs[i].stages.push_back({names_[stage], ms[stage] - ms[stage - 1]});
  }
}

// Finds buffers for each pair. If the pair is on the device already, it gets the buffers that it is
// in. Otherwise it gets buffers without a kept pair, as long as two suffice: the two directions of
// a pair each have their own.
void Runner::arrange(std::span<const RunInput> inputs) {
  constexpr size_t kDirections = 2;
  for (size_t i = 0; i < inputs.size() && inputs[i].kept != nullptr; ++i) {
    if (i > buffers_.size()) return;
    const auto first = buffers_.begin() + static_cast<std::ptrdiff_t>(i);
    auto own = std::find_if(first, buffers_.end(),
                            [&](const auto& buffers) { return buffers->has(inputs[i]); });
    if (own == buffers_.end())
      own = std::find_if(first, buffers_.end(),
                         [](const auto& buffers) { return !buffers->is_kept(); });
    if (own != buffers_.end()) {
      std::swap(*first, *own);
    } else if (buffers_.size() < kDirections) {
      buffers_.insert(first, std::make_unique<PairBuffers>(device_, nullptr));
    }
  }
}

// Allocates several at once, since a driver takes tenths of milliseconds for each; in the order of
// the pairs if memory is scarce: which pair gets what must not depend on threads.
void Runner::allocate_buffers(std::span<const RunInput> inputs, std::vector<RunOutput>& outputs) {
  const VkDeviceSize share = device_.description().memory_bytes / 4 / inputs.size();
  with_buffers(inputs.size(), [&](MemoryPolicy policy) {
    arrange(inputs);
    const auto allocate = [&](size_t i) {
      buffers_[i]->take(context_, inputs[i], outputs[i], {policy, share});
    };
    if (policy == MemoryPolicy::kDevice)
      return for_each_index(inputs.size(), allocate, threads_for(bytes_of(inputs)));
    for (size_t i = 0; i < inputs.size(); ++i) allocate(i);
  });
}

// Records on one thread while others write the meshes, if these are large: each takes an H200's
// host 0.1 ms a pair.
VkCommandBuffer Runner::upload(std::span<const RunInput> inputs, const Submission& submission,
                               std::vector<RunOutput>& outputs) {
  const double start = now_ms();
  VkCommandBuffer commands = VK_NULL_HANDLE;
  const auto step = [&](size_t i) {
    if (i == 0) {
      commands = record(submission, outputs);
    } else {
      const size_t pair = submission.running[i - 1];
      buffers_[pair]->write(inputs[pair]);
    }
  };
  for_each_index(1 + submission.running.size(), step, threads_for(bytes_of(inputs)));
  for (const size_t i : submission.running) outputs[i].upload_ms += now_ms() - start;
  return commands;
}

// Submits, and reads the results. Returns how long that took, in milliseconds.
double Runner::submit(std::span<const RunInput> inputs, const Submission& submission,
                      std::vector<RunOutput>& outputs) {
  const VkCommandBuffer commands =
      submission.uploads ? upload(inputs, submission, outputs) : record(submission, outputs);
  const double submitted = now_ms();
  submit_and_wait(commands);
  if (submission.waves > 0) {
    for (const size_t i : submission.running) buffers_[i]->read(outputs[i]);
  }
  read_stages(submission, outputs);
  return now_ms() - submitted;
}

void Runner::bound_cells(PairBuffers& buffers, const CellBatch& batch) {
  if (batch.bounds.empty()) return;
  const VkhCells cells = buffers.place_cells(batch);
  const VkCommandBuffer commands = begin();
  vkhCmdBoundCells(context_, commands, &buffers.problem(), &cells, nullptr);
  full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_HOST_BIT);
  submit_and_wait(commands);
  buffers.read_bounds(batch);
}

HeldPair Runner::held(size_t i, const VkhReport& report) {
  PairBuffers& buffers = *buffers_[i];
  const auto submit = [this](const DeviceCells::Record& record) {
    const VkCommandBuffer commands = begin();
    record(commands);
    full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_HOST_BIT);
    submit_and_wait(commands);
  };
  return {.report = report,
          .bound = [this, &buffers](const CellBatch& batch) { bound_cells(buffers, batch); },
          .cells = std::make_unique<DeviceCells>(device_, context_, buffers.problem(),
                                                 survey_buffers_[i], submit)};
}

void Runner::hold(std::span<const RunInput> inputs, const UseHeld& use) {
  const SerialGuard::Hold hold(guard_);
  context_ = context_for(inputs[0].switches, inputs);
  stage_times_ = false;
  std::vector<RunOutput> outputs(inputs.size());
  allocate_buffers(inputs, outputs);
  survey_buffers_.resize(std::max(survey_buffers_.size(), inputs.size()));
  std::vector<HeldPair> pairs;
  for (size_t i = 0; i < inputs.size(); ++i) {
    Submission first{.running = {i},
                     .is_alone = true,
                     .uploads = true,
                     .builds = true,
                     .begins = true,
                     .waves = 1};
    if (buffers_[i]->has_run()) {
      buffers_[i]->read(outputs[i]);
    } else {
      if (!build_first(inputs, first, outputs)) return;
      submit(inputs, first, outputs);
    }
    pairs.push_back(held(i, outputs[i].report));
  }
  use(pairs);
}

void Runner::find_closest(const Mesh& mesh, const ResidentMesh& b, const PointBatch& batch) {
  const SerialGuard::Hold hold(guard_);
  std::array<RunInput, 1> alone;
  alone[0].b.mesh = &mesh;
  context_ =
      context_for(default_switches(device_) | VKH_CONTEXT_CLOSEST, alone, ContextUse::kHierarchy);
  VkhClosestQuery query{};
  with_buffers(1, [&](MemoryPolicy) { query = buffers_[0]->place_points(batch); });
  const VkhHierarchy hierarchy = b.view();
  const VkCommandBuffer commands = begin();
  vkhCmdFindClosest(context_, commands, &hierarchy, &query, nullptr);
  full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_HOST_BIT);
  submit_and_wait(commands);
  buffers_[0]->read_closest(batch);
}

// On a CPU the BVH of B can take seconds. It is a submission of its own, without waves, so that the
// caller may end the run between it and the first wave: then this returns false.
bool Runner::build_first(std::span<const RunInput> inputs, Submission& submission,
                         std::vector<RunOutput>& outputs) {
  const size_t i = submission.running[0];
  const bool on_cpu = device_.description().type == "cpu";
  if (!on_cpu || !submission.is_alone || buffers_[i]->mesh_b() == nullptr) return true;
  const uint32_t waves = std::exchange(submission.waves, 0);
  submit(inputs, submission, outputs);
  submission.waves = waves;
  submission.uploads = submission.builds = false;
  return inputs[i].advanced(outputs[i].report);
}

std::vector<RunOutput> Runner::run(std::span<const RunInput> inputs) {
  std::vector<RunOutput> outputs(inputs.size());
  if (inputs.empty()) return outputs;
  const SerialGuard::Hold hold(guard_);
  context_ = context_for(inputs[0].switches, inputs);
  stage_times_ = inputs[0].stage_times && inputs.size() == 1;
  const double start = now_ms();
  allocate_buffers(inputs, outputs);
  for (RunOutput& output : outputs) {
    output.upload_ms = now_ms() - start;
    output.report = nothing_known();
  }
  const auto is_over = [&](size_t i) {
    const VkhReport& r = outputs[i].report;
    const bool is_wanted = inputs[i].advanced(r);
    return !is_wanted || r.waves >= inputs[i].wave_limit || r.status != VKH_STATUS_RUNNING;
  };
  const bool on_cpu = device_.description().type == "cpu";
  Submission submission{.running = {},
                        .is_alone = inputs.size() == 1,
                        .uploads = true,
                        .builds = true,
                        .begins = true,
                        .waves = on_cpu || inputs[0].known_since ? kFewFirstWaves : kFirstWaves};
  for (size_t i = 0; i < inputs.size(); ++i) submission.running.push_back(i);
  if (!build_first(inputs, submission, outputs)) return outputs;
  uint32_t submissions = 0;
  while (!submission.running.empty()) {
    if (!inputs[0].multiwave) submission.waves = 1;
    // The budget of waves is met exactly: how waves are grouped depends on the clock, but the
    // result must not.
    for (const size_t i : submission.running)
      submission.waves =
          std::min(submission.waves, std::max(inputs[i].wave_limit, 1u) - outputs[i].report.waves);
    const double ms = submit(inputs, submission, outputs);
    submission.waves = next_waves(++submissions, submission.waves, ms);
    submission.uploads = submission.builds = submission.begins = false;
    std::erase_if(submission.running, is_over);
    for (const size_t i : submission.running) {
      buffers_[i]->make_room(context_, outputs[i]);
      if (inputs[i].known_since) buffers_[i]->raise_known(inputs[i].known_since());
    }
  }
  return outputs;
}

}  // namespace vkh
