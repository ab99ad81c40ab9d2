#include "host/run/run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <utility>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/run/switches.h"

namespace vkh {
namespace {

// Waves of the first submission, the begin's among them: enough for most pairs on a GPU; on a CPU
// one wave can take seconds, and so can the hierarchy, which is then a submission of its own. Who
// shares what is known has something to tell after one wave.
constexpr uint32_t kFirstWaves = 8;
constexpr uint32_t kFewFirstWaves = 1;
// Later submissions aim at this long, so that budgets and Ctrl-C are heard. An empty wave costs an
// H200 some 8 us (reckoned), another report 22: so the second submission is short, and long runs
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

// Makes what one stage wrote visible to the next: copies before and after the engine's commands.
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

// Of a run that has not begun.
VkhReport nothing_known() {
  VkhReport report{};
  report.upper = report.upperAbove = std::numeric_limits<float>::max();
  report.certified = 1;
  report.witnessFaceA = report.witnessFaceB = UINT32_MAX;
  return report;
}

}  // namespace

// One submission.
struct Runner::Round {
  std::vector<size_t> running;  // seats
  bool uploads, builds, begins;
  uint32_t waves;
};

Runner::Runner(const Device& device, const std::filesystem::path& cache_folder)
    : device_(device),
      cache_(device, cache_folder),
      submitter_(device),
      names_(Submitter::kTimestamps) {}

void Runner::make_ready(uint32_t switches) {
  const Turns::Turn turn(turns_);
  context_for(switches);
}

VkhContext Runner::context_for(uint32_t switches) {
  const auto known = contexts_.find(switches);
  if (known != contexts_.end()) return known->second.get();
  const bool wide = (switches & kSwitchWide) != 0;
  const VkhContextCreateInfo info{device_.engine_info(),
                                  cache_.handle(),
                                  (switches & ~(kSwitchWide | kSwitchByAddress)) | VKH_SWITCH_NONE,
                                  wide ? VKH_DEVICE_KIND_WIDE : VKH_DEVICE_KIND_NARROW,
                                  (switches & kSwitchByAddress) != 0 ? VK_TRUE : VK_FALSE,
                                  VK_FALSE};
  VkhContext context = nullptr;
  check_engine(vkhCreateContext(&info, &context), "creating the pipelines");
  ContextHandle kept(context, vkhDestroyContext);
  cache_.save();
  contexts_.emplace(switches, std::move(kept));
  return context;
}

// Where a mesh is too large to be bound, it is given by address, which gives the same bits.
VkhContext Runner::context_for(uint32_t switches, std::span<const RunInput> inputs) {
  const VkhContext context = context_for(switches);
  const bool fits = std::all_of(inputs.begin(), inputs.end(), [&](const RunInput& input) {
    return fits_bindings(context, input);
  });
  return fits || !device_.has_addresses() ? context : context_for(switches | kSwitchByAddress);
}

// Seats are kept, for their buffers, unless there is no memory beside those of an earlier run, or
// they lie in the host's.
void Runner::seat(size_t count, const std::function<void(Reach)>& take) {
  if (reach_ == Reach::kHost) seats_.clear();
  const bool has_kept = !seats_.empty();
  const auto try_with = [&](Reach reach) {
    reach_ = reach;
    while (seats_.size() < count) seats_.push_back(std::make_unique<Seat>(device_));
    take(reach);
  };
  try {
    return try_with(Reach::kDevice);
  } catch (const MemoryError&) {
    seats_.clear();
  }
  if (has_kept) {
    try {
      return try_with(Reach::kDevice);
    } catch (const MemoryError&) {
      seats_.clear();
    }
  }
  try_with(Reach::kHost);
}

VkCommandBuffer Runner::begin() {
  const VkCommandBuffer commands = submitter_.begin();
  vkhReleaseCommandBuffer(context_, commands);
  profile_ = {submitter_.timestamps(), Submitter::kTimestamps, 0, names_.data()};
  return commands;
}

// A timestamp, where the library writes none.
void Runner::stamp(VkCommandBuffer commands, const char* name) {
  if (stage_times_ || !device_.has_timestamps()) return;
  device_.vk().CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, profile_.pool,
                                 profile_.count);
  names_[profile_.count++] = name;
}

ResidentMesh Runner::build(const MeshData& b) {
  const Turns::Turn turn(turns_);
  // A hierarchy is the same whatever the switches: it is built with pipelines that runs need too.
  std::array<RunInput, 1> alone;
  alone[0].b = b;
  context_ = context_for(default_switches(device_), alone);
  ResidentMesh resident;
  seat(1, [&](Reach reach) { resident = seats_[0]->take_resident(context_, b, reach); });
  VkhHierarchy hierarchy = resident.memory.view();
  const VkCommandBuffer commands = begin();
  seats_[0]->record_upload(commands);
  full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
  vkhCmdBuildHierarchy(context_, commands, seats_[0]->mesh_b(), &hierarchy, seats_[0]->scratch(),
                       nullptr);
  submit_and_wait(commands);
  return resident;
}

void Runner::submit_and_wait(VkCommandBuffer commands) {
  check_engine(vkhGetRecordingResult(context_, commands), "recording");
  submitter_.submit_and_wait({});
}

// With its hierarchy timed apart.
void Runner::record_one(VkCommandBuffer commands, const Round& round) {
  Seat& seat = *seats_[round.running[0]];
  VkhProblem& problem = seat.problem();
  stamp(commands, nullptr);
  seat.record_move(context_, commands, profile());
  if (round.builds && seat.mesh_b() != nullptr) {
    vkhCmdBuildHierarchy(context_, commands, seat.mesh_b(), &problem.b, seat.scratch(), profile());
    stamp(commands, "hierarchy");
  }
  if (round.waves == 0) return;
  if (round.begins) vkhCmdBegin(context_, commands, &problem, profile());
  const uint32_t waves = round.begins ? round.waves - 1 : round.waves;  // the begin has one
  vkhCmdAdvance(context_, commands, &problem, waves, profile());
  vkhCmdWriteReport(context_, commands, &problem, seat.report(), 0, profile());
  stamp(commands, "solve");
}

void Runner::record_together(VkCommandBuffer commands, const Round& round) {
  std::vector<VkhTask> tasks;
  stamp(commands, nullptr);
  for (const size_t i : round.running) {
    Seat& seat = *seats_[i];
    seat.record_move(context_, commands, nullptr);
    tasks.push_back({.mesh = round.builds ? seat.mesh_b() : nullptr,
                     .scratch = seat.scratch(),
                     .problem = &seat.problem(),
                     .begin = round.begins ? VK_TRUE : VK_FALSE,
                     .waves = round.begins ? round.waves - 1 : round.waves,
                     .reportBuffer = seat.report(),
                     .reportOffset = 0});
  }
  vkhCmdRunTasks(context_, commands, static_cast<uint32_t>(tasks.size()), tasks.data(), nullptr);
  stamp(commands, "solve");
}

VkCommandBuffer Runner::record(const Round& round, const std::vector<RunOutput>& outputs) {
  const VkCommandBuffer commands = begin();
  if (round.uploads) {
    for (const size_t i : round.running) seats_[i]->record_upload(commands);
    full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
  }
  if (outputs.size() == 1) {
    record_one(commands, round);
  } else {
    record_together(commands, round);
  }
  if (round.waves == 0) return commands;  // there is no report yet
  full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_TRANSFER_BIT);
  for (const size_t i : round.running) seats_[i]->record_readback(commands, outputs[i]);
  full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_HOST_BIT);
  return commands;
}

void Runner::read_stages(const Round& round, std::vector<RunOutput>& outputs) {
  const std::vector<double> ms = submitter_.read_timestamps(profile_.count);
  for (uint32_t stage = 1; stage < profile_.count; ++stage) {
    if (names_[stage] == nullptr) continue;
    for (const size_t i : round.running)
      outputs[i].stages.push_back({names_[stage], ms[stage] - ms[stage - 1]});
  }
}

// Where memory is scarce, in order: who gets what must not depend on threads.
void Runner::take_seats(std::span<const RunInput> inputs, std::vector<RunOutput>& outputs) {
  const VkDeviceSize share = device_.description().memory_bytes / 4 / inputs.size();
  seat(inputs.size(), [&](Reach reach) {
    const auto take = [&](size_t i) {
      seats_[i]->take(context_, inputs[i], outputs[i], {reach, share});
    };
    if (reach == Reach::kDevice)
      return for_each_index(inputs.size(), take, threads_for(bytes_of(inputs)));
    for (size_t i = 0; i < inputs.size(); ++i) take(i);
  });
}

// Submits, and takes what came of it. Returns how long that took, in milliseconds.
double Runner::submit(const Round& round, std::vector<RunOutput>& outputs) {
  const double submitted = now_ms();
  submit_and_wait(record(round, outputs));
  if (round.waves > 0) {
    for (const size_t i : round.running) seats_[i]->read(outputs[i]);
  }
  read_stages(round, outputs);
  return now_ms() - submitted;
}

void Runner::bound_cells(Seat& seat, const CellBatch& batch) {
  if (batch.bounds.empty()) return;
  const VkhCells cells = seat.take_cells(batch);
  const VkCommandBuffer commands = begin();
  vkhCmdBoundCells(context_, commands, &seat.problem(), &cells, nullptr);
  full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_HOST_BIT);
  submit_and_wait(commands);
  seat.read_bounds(batch);
}

std::vector<RunOutput> Runner::run(std::span<const RunInput> inputs) {
  std::vector<RunOutput> outputs(inputs.size());
  if (inputs.empty()) return outputs;
  const Turns::Turn turn(turns_);
  context_ = context_for(inputs[0].switches, inputs);
  stage_times_ = inputs[0].stage_times && inputs.size() == 1;
  const double start = now_ms();
  take_seats(inputs, outputs);
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
  Round round{.running = {},
              .uploads = true,
              .builds = true,
              .begins = true,
              .waves = on_cpu || inputs[0].known_since ? kFewFirstWaves : kFirstWaves};
  for (size_t i = 0; i < inputs.size(); ++i) round.running.push_back(i);
  if (on_cpu && inputs.size() == 1 && seats_[0]->mesh_b() != nullptr) {
    const uint32_t waves = std::exchange(round.waves, 0);
    submit(round, outputs);
    round.waves = waves;
    round.uploads = round.builds = false;
    if (!inputs[0].advanced(outputs[0].report)) return outputs;
  }
  uint32_t submissions = 0;
  while (!round.running.empty()) {
    if (!inputs[0].multiwave) round.waves = 1;
    // Exactly the budget: how they are grouped depends on the clock, the result must not.
    for (const size_t i : round.running)
      round.waves =
          std::min(round.waves, std::max(inputs[i].wave_limit, 1u) - outputs[i].report.waves);
    const double ms = submit(round, outputs);
    round.waves = next_waves(++submissions, round.waves, ms);
    round.uploads = round.builds = round.begins = false;
    std::erase_if(round.running, is_over);
    for (const size_t i : round.running) {
      seats_[i]->make_room(context_, outputs[i]);
      if (inputs[i].known_since) seats_[i]->raise_known(inputs[i].known_since());
    }
  }
  for (size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].survey)
      inputs[i].survey(outputs[i].report,
                       [&](const CellBatch& batch) { bound_cells(*seats_[i], batch); });
  }
  return outputs;
}

}  // namespace vkh
