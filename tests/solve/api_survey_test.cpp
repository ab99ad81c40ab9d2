// Surveys by plans, through the C API alone: cells tile their faces, bounds are true, the table has
// A's area, and calls that break a rule are told and record nothing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "engine/vkhausdorff_experimental.h"
#include "host/solve/cell_corners.h"
#include "host/solve/run.h"
#include "shaders/survey/tally.h"
#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

struct Told {
  std::vector<std::string> rules;
  static void tell(void* user, VkCommandBuffer, const char* rule) {
    static_cast<Told*>(user)->rules.emplace_back(rule);
  }
};

ContextHandle make_context(VkhDeviceKind kind, Told* told = nullptr) {
  const uint32_t defaults = kind == VKH_DEVICE_KIND_WIDE ? uint32_t{VKH_SWITCH_DEFAULT_WIDE}
                                                         : uint32_t{VKH_SWITCH_DEFAULT_NARROW};
  VkhContextCreateInfo info = create_info(defaults | VKH_CONTEXT_CELLS, kind, VK_FALSE);
  if (told != nullptr) {
    info.flags |= VKH_CONTEXT_CHECK_CALLS;
    info.onMisuse = Told::tell;
    info.misuseUser = told;
  }
  VkhContext context = nullptr;
  REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
  return {context, vkhDestroyContext};
}

constexpr VkBufferUsageFlags kOfCells = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                        VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                        VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr uint64_t kWeight = uint64_t{1} << 40;

/// A survey's memory and what the caller gives and gets.
struct SurveyBench {
  SurveyBench(VkhContext context, uint32_t faces, uint32_t capacity)
      : memory(test_device(), vkhGetSurveySize(context, faces, capacity), kOfCells,
               Placement::kDevice),
        given(test_device(), 65536 + 8 * faces, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
              Placement::kUpload),
        found(test_device(), 4'000'000, VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kReadback),
        survey{sizeof(VkhSurvey), {memory.handle(), 0, memory.size()}, capacity, 0, 0} {
    const std::vector<uint64_t> weights(faces, kWeight);
    std::memcpy(given.mapped() + 65536, weights.data(), 8 * faces);
  }
  VkhSurveyCells begin(float farthest) const { return {given.handle(), 65536, farthest}; }
  void plan(const gpu::SurveyPlan& plan) { std::memcpy(given.mapped(), &plan, sizeof(plan)); }
  VkhSurveyScore score(uint32_t cells) const {
    return {0, cells, given.handle(), 0, found.handle(), 0};
  }
  VkhSurveyTally tally(uint32_t cells, int unit) const {
    return {0, cells, unit, given.handle(), 0, found.handle(), 16384};
  }
  template <class T>
  std::vector<T> read(size_t offset, size_t count) const {
    std::vector<T> all(count);
    std::memcpy(all.data(), found.mapped() + offset, count * sizeof(T));
    return all;
  }

  Buffer memory, given, found;
  VkhSurvey survey;
};

uint64_t whole_of(const gpu::Wide& x) { return uint64_t{x.high} << 32 | x.low; }

TEST_CASE("cells are split where they score, tile their faces and have true bounds") {
  for (const VkhDeviceKind kind : {VKH_DEVICE_KIND_NARROW, VKH_DEVICE_KIND_WIDE}) {
    const ContextHandle context = make_context(kind);
    ApiMesh a(icosphere(1.0, 2)), b(translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}));
    ApiPair pair(a, b, 1e-5f, context.get());
    const auto faces = static_cast<uint32_t>(a.mesh().faces.size());
    SurveyBench bench(context.get(), faces, 8 * faces);
    gpu::SurveyPlan plan{};
    plan.of_whole = 1.0f / (static_cast<float>(kWeight) * static_cast<float>(faces));
    plan.mean = 1;
    plan.classes = plan.mean_classes = gpu::kAllClasses;
    plan.most = {8, 8};
    plan.edge_count = 2;
    plan.edges[0] = {0, 0};
    plan.edges[1] = {8, 8};
    bench.plan(plan);
    pair.run([&](VkCommandBuffer c) {
      pair.build(c);
      pair.begin(c);
      const VkhSurveyCells begin = bench.begin(4);
      const VkhSurveyBound bound{0, faces};
      const VkhSurveyScore score = bench.score(faces);
      vkhCmdBeginSurveyCells(context.get(), c, &pair.problem(), &bench.survey, &begin);
      vkhCmdBoundSurvey(context.get(), c, &pair.problem(), &bench.survey, &bound, nullptr);
      vkhCmdScoreSurvey(context.get(), c, &pair.problem(), &bench.survey, &score);
      record_host_barrier(c);
    });
    const auto counts = bench.read<uint32_t>(0, gpu::kScoreBins);
    uint32_t bin = gpu::kScoreBins - 1, above = 0;
    while (above + counts[bin] < faces / 3) above += counts[bin--];
    const VkhSurveySplit split{faces, bin, faces / 3 - above, above, 4};
    const uint32_t parents = split.ties + split.above, cells = faces + 3 * parents;
    pair.run([&](VkCommandBuffer c) {
      const VkhSurveyBound first{0, parents};  // in two parts
      const VkhSurveyBound rest{parents, 3 * parents};
      const VkhSurveyTally tally = bench.tally(cells, 127 + 3);
      const VkBuffer found = bench.found.handle();
      const VkhSurveyFaces told{cells, gpu::kAllClasses, gpu::kAllClasses, found, 65536};
      const VkhSurveyRead read{0, cells, found, 131072, found, 1048576, found, 3145728};
      vkhCmdSplitSurvey(context.get(), c, &pair.problem(), &bench.survey, &split);
      vkhCmdBoundSurvey(context.get(), c, &pair.problem(), &bench.survey, &first, nullptr);
      vkhCmdBoundSurvey(context.get(), c, &pair.problem(), &bench.survey, &rest, nullptr);
      vkhCmdTallySurvey(context.get(), c, &pair.problem(), &bench.survey, &tally);
      const VkhSurveyFaces same{cells, UINT32_MAX, UINT32_MAX, found, 98304};
      vkhCmdFindSurveyFaces(context.get(), c, &pair.problem(), &bench.survey, &told);
      vkhCmdFindSurveyFaces(context.get(), c, &pair.problem(), &bench.survey, &same);
      vkhCmdReadSurvey(context.get(), c, &pair.problem(), &bench.survey, &read);
      record_host_barrier(c);
    });
    const auto table = bench.read<gpu::SurveyTable>(16384, 1)[0];
    const uint64_t whole = kWeight * faces;
    CHECK(whole_of(table.sums[gpu::kSurelyWhole]) == 0);
    CHECK(whole_of(table.sums[gpu::kSurelyWhole + 1]) == whole);  // no bit is lost here
    CHECK(whole_of(table.sums[gpu::kPerhapsWhole]) + whole_of(table.sums[gpu::kPerhapsWhole + 1]) ==
          whole + cells);
    const auto found = bench.read<gpu::Cell>(131072, cells);
    const auto bounds = bench.read<VkhCellBounds>(1048576, cells);
    const auto of_faces = bench.read<float>(65536, 2 * size_t{faces});
    CHECK(of_faces == bench.read<float>(98304, of_faces.size()));
    std::vector<double> area(faces, 0);
    for (uint32_t i = 0; i < cells; ++i) {
      const lib::Bary3 t = corners_of(found[i]);
      area[found[i].face] += std::ldexp(1.0, -static_cast<int>(lib::halvings_of(t)));
      const glm::uvec3 f = a.mesh().faces[found[i].face];
      const glm::dvec3 p = a.mesh().vertices[f.x], u = glm::dvec3(a.mesh().vertices[f.y]) - p,
                       v = glm::dvec3(a.mesh().vertices[f.z]) - p;
      const glm::dvec2 w = glm::dvec2(t.b) / static_cast<double>(gpu::kBaryOne);
      const double d = point_mesh_distance(p + w.x * u + w.y * v, b.mesh());
      CHECK(static_cast<double>(bounds[i].lower[1]) <= d + 1e-12);
      CHECK(static_cast<double>(bounds[i].upper[1]) >= d - 1e-12);
      CHECK(bounds[i].highest <= of_faces[faces + found[i].face]);
      CHECK(of_faces[found[i].face] <= of_faces[faces + found[i].face]);
    }
    CHECK(std::all_of(area.begin(), area.end(), [](double x) { return x == 1; }));
  }
}

TEST_CASE("a survey's rules are told, and what breaks them records nothing") {
  Told told;
  const ContextHandle context = make_context(VKH_DEVICE_KIND_NARROW, &told);
  ApiMesh a(icosphere(1.0, 1)), b(icosphere(1.1, 1));
  ApiPair pair(a, b, 1e-3f, context.get());
  const auto faces = static_cast<uint32_t>(a.mesh().faces.size());
  SurveyBench bench(context.get(), faces, 2 * faces);
  pair.run([&](VkCommandBuffer c) {
    pair.build(c);
    pair.begin(c);
  });
  const auto check = [&](const std::string& rule, const VkhSurvey& survey, uint32_t cells) {
    told.rules.clear();
    pair.run([&](VkCommandBuffer c) {
      const VkhSurveyTally tally = bench.tally(cells, 130);
      vkhCmdTallySurvey(context.get(), c, &pair.problem(), &survey, &tally);
      vkhReleaseCommandBuffer(context.get(), c);
    });
    REQUIRE(told.rules.size() == 1);
    CHECK(told.rules[0].find(rule) != std::string::npos);
  };
  VkhSurvey small = bench.survey;
  small.capacity = faces - 1;
  check("VkhSurvey::capacity", small, faces);
  VkhSurvey large = bench.survey;
  large.capacity = 4 * faces;
  check("VkhSurvey::memory: at least vkhGetSurveySize bytes", large, faces);
  VkhSurvey none = bench.survey;
  none.memory.buffer = VK_NULL_HANDLE;
  check("VkhMemory::buffer", none, faces);
  VkhSurvey unknown = bench.survey;
  unknown.size += 4;
  check("VkhSurvey::size", unknown, faces);
  VkhSurvey endless = bench.survey;
  endless.faceWidth = -1;
  check("VkhSurvey::faceWidth, faceLimit", endless, faces);
  VkhSurvey below = bench.survey;
  below.faceLimit = -1;
  check("VkhSurvey::faceWidth, faceLimit", below, faces);
  check("a survey: room for all cells", bench.survey, 2 * faces + 1);
}

}  // namespace
