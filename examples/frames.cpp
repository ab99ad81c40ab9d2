// vkh_frames: measures the cost of a frame that certifies a deforming mesh against its LOD. Each
// frame moves both meshes on the device and runs four ways on the same shape:
//   warm     refit B's BVH, start from the last frame's run
//   cold     refit, start from nothing
//   rebuild  build the BVH again, start from nothing
//   faces    as warm, and then the error of each face: a survey, with --survey-waves waves
// Prints CSV to stdout and a summary to stderr. gpu_ms is the device's time from the BVH to the
// report, wall_ms the host's, recording included.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <string>

#include "examples/scene.h"

namespace {

using example::Pair;

struct Options {
  uint32_t frames = 300;
  uint32_t cells_u = 250, cells_v = 200;  // 100,000 faces against 25,000
  uint32_t waves = 8, survey_waves = 1;
  float tolerance = 4e-6f;  // about 1e-6 of the diagonal
  bool reverse = false;     // h(LOD, mesh) in place of h(mesh, LOD)
  bool validation = false;
};

struct Mode {
  const char* name;
  Pair::Hierarchy hierarchy;
  bool warm, faces;
};
constexpr std::array<Mode, 4> kModes = {{{"warm", Pair::Hierarchy::kRefit, true, false},
                                         {"cold", Pair::Hierarchy::kRefit, false, false},
                                         {"rebuild", Pair::Hierarchy::kBuild, false, false},
                                         {"faces", Pair::Hierarchy::kRefit, true, true}}};

struct Sample {
  double gpu_ms, wall_ms;
};

double now_ms() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const auto value = [&] {
      if (i + 1 == argc) throw std::runtime_error(name + " needs a value");
      return std::strtod(argv[++i], nullptr);
    };
    if (name == "--frames") {
      o.frames = static_cast<uint32_t>(value());
    } else if (name == "--cells") {
      o.cells_u = static_cast<uint32_t>(value());
      o.cells_v = static_cast<uint32_t>(value());
    } else if (name == "--waves") {
      o.waves = static_cast<uint32_t>(value());
    } else if (name == "--survey-waves") {
      o.survey_waves = static_cast<uint32_t>(value());
    } else if (name == "--tolerance") {
      o.tolerance = static_cast<float>(value());
    } else if (name == "--reverse") {
      o.reverse = true;
    } else if (name == "--validation") {
      o.validation = true;
    } else {
      throw std::runtime_error(
          "usage: vkh_frames [--frames N] [--cells U V] [--waves N] [--survey-waves N] "
          "[--tolerance T] [--reverse] [--validation]");
    }
  }
  if (o.frames == 0 || o.waves == 0 || o.cells_u < 6 || o.cells_v < 6 || o.cells_u % 2 != 0 ||
      o.cells_v % 2 != 0)
    throw std::runtime_error("at least one frame and one wave; cells are even and at least 6");
  return o;
}

class Bench {
 public:
  explicit Bench(const Options& o)
      : options_(o),
        gpu_({.validation = o.validation, .flags = VKH_CONTEXT_CELLS}),
        scene_(gpu_, o.cells_u, o.cells_v, 2),
        pairs_{{make_pair(), make_pair(), make_pair(), make_pair()}},
        survey_(make_survey()),
        errors_(gpu_.buffer(2 * sizeof(float) * faces(), example::Memory::kDevice)),
        report_(gpu_.buffer(sizeof(VkhReport), example::Memory::kHost)),
        survey_report_(gpu_.buffer(sizeof(VkhSurveyReport), example::Memory::kHost)) {
    deform(0);
    for (Pair& pair : pairs_) run(pair, kModes[2]);  // every pair has a BVH and a run
  }

  void frame(uint32_t number) {
    deform(number);
    for (size_t m = 0; m < kModes.size(); ++m) {
      const Sample s = run(pairs_[m], kModes[m]);
      samples_[m].push_back(s);
      VkhReport r;
      std::memcpy(&r, report_.mapped, sizeof(r));
      const bool closed = r.status == VKH_STATUS_DECIDED;
      not_closed_ += !closed;
      std::printf("%u,%s,%.4f,%.4f,%.9g,%.9g,%d,%u\n", number, kModes[m].name, s.gpu_ms, s.wall_ms,
                  static_cast<double>(r.lower), static_cast<double>(r.upper), closed ? 1 : 0,
                  r.waves);
    }
  }

  void summarize() {
    std::fprintf(stderr, "%s: h of %u faces against %u, %u frames, tolerance %g, %u not closed\n",
                 gpu_.name().c_str(), faces(),
                 scene_.levels()[options_.reverse ? 0 : 1].face_count(), options_.frames,
                 static_cast<double>(options_.tolerance), not_closed_);
    for (size_t m = 0; m < kModes.size(); ++m) {
      std::fprintf(stderr, "%-8s gpu_ms median %.3f p99 %.3f   wall_ms median %.3f p99 %.3f\n",
                   kModes[m].name, quantile(m, &Sample::gpu_ms, 0.5),
                   quantile(m, &Sample::gpu_ms, 0.99), quantile(m, &Sample::wall_ms, 0.5),
                   quantile(m, &Sample::wall_ms, 0.99));
    }
    VkhSurveyReport last;
    std::memcpy(&last, survey_report_.mapped, sizeof(last));
    std::fprintf(stderr, "faces: %u cells in the last frame, %u of them wider than %g\n",
                 last.cells, last.open, static_cast<double>(survey_.faceWidth));
  }

  bool clean() const { return gpu_.validation_messages() == 0; }

 private:
  Pair make_pair() {
    return {gpu_, scene_, options_.reverse ? 1u : 0u, options_.reverse ? 0u : 1u};
  }

  uint32_t faces() const { return scene_.levels()[options_.reverse ? 1 : 0].face_count(); }

  VkhSurvey make_survey() {
    const uint32_t cells = std::min(4 * faces(), vkhGetSurveyCapacity(gpu_.context()));
    const VkDeviceSize size = vkhGetSurveySize(gpu_.context(), faces(), cells);
    return {.size = sizeof(VkhSurvey),
            .memory = {gpu_.buffer(size, example::Memory::kDevice).handle, 0, size},
            .capacity = cells,
            .faceWidth = 1000 * options_.tolerance,
            .faceLimit = 0};
  }

  void deform(uint32_t number) {
    // A period of the deformation is 2 pi: three of them in 300 frames.
    const float time = static_cast<float>(number) * static_cast<float>(std::numbers::pi) / 50;
    gpu_.run([&](VkCommandBuffer c) { scene_.deform(c, time); });
  }

  Sample run(Pair& pair, const Mode& mode) {
    const double start = now_ms();
    const double gpu_ms = gpu_.run([&](VkCommandBuffer c) {
      pair.certify(c, mode.hierarchy, mode.warm, options_.waves, options_.tolerance);
      pair.write_report(c, report_, 0);
      if (mode.faces) {
        pair.write_face_errors(c, survey_, options_.survey_waves, errors_, 0);
        pair.write_survey_report(c, survey_, survey_report_);
      }
      example::barrier(c, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                       VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
    });
    return {gpu_ms, now_ms() - start};
  }

  double quantile(size_t mode, double Sample::*member, double q) const {
    std::vector<double> sorted;
    sorted.reserve(samples_[mode].size());
    for (const Sample& s : samples_[mode]) sorted.push_back(s.*member);
    std::sort(sorted.begin(), sorted.end());
    const auto last = static_cast<double>(sorted.size() - 1);
    return sorted[static_cast<size_t>(std::lround(q * last))];
  }

  Options options_;
  example::Gpu gpu_;
  example::Scene scene_;
  std::array<Pair, 4> pairs_;
  VkhSurvey survey_;
  example::Buffer errors_, report_, survey_report_;
  std::array<std::vector<Sample>, 4> samples_;
  uint32_t not_closed_ = 0;
};

}  // namespace

int main(int argc, char** argv) try {
  const Options options = parse(argc, argv);
  // A GPU's seconds are minutes on a CPU device, and nothing else would show progress.
  std::fprintf(
      stderr,
      "vkh_frames: %u frames of %u faces, four times each; on a CPU device that takes minutes, ",
      options.frames, 2 * options.cells_u * options.cells_v);
  std::fprintf(stderr, "and --frames 3 --cells 32 24 seconds\n");
  Bench bench(options);
  std::puts("frame,mode,gpu_ms,wall_ms,lower,upper,closed,waves");
  for (uint32_t frame = 1; frame <= options.frames; ++frame) bench.frame(frame);
  bench.summarize();
  return bench.clean() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "vkh_frames: %s\n", error.what());
  return 1;
}
