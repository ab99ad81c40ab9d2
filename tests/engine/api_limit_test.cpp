// VkhRunOptions::limit: within and beyond are proven, beyond ends the run, and a run is undecided
// if it is within the tolerance of the limit, or out of budget.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr float kTolerance = 1e-6f;

struct Pairs : ApiPairs {
  Pairs() {
    add(icosphere(1.0, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}), kTolerance);
    add(height_field(24, 1), height_field(24, 3), kTolerance);
    add(icosphere(0.25, 2), icosphere(0.2501, 2), kTolerance);
  }
};

VkhReport ask(ApiPair& pair, float limit, uint32_t waves = 24, float limit_up = 0) {
  pair.problem().options.limit = limit;
  pair.problem().options.limitUp = limit_up;
  const VkhReport report = pair.run([&](VkCommandBuffer c) {
    pair.build(c);
    pair.begin(c);
    pair.advance(c, waves);
    pair.report(c);
  });
  pair.problem().options.limit = pair.problem().options.limitUp = 0;
  return report;
}

double lower_of(const VkhReport& r) {
  return static_cast<double>(r.base) + static_cast<double>(r.lowerAbove);
}
double upper_of(const VkhReport& r) {
  return static_cast<double>(r.base) + static_cast<double>(r.upperAbove);
}

}  // namespace

TEST_CASE("a limit is decided as h is: within, beyond, undecided only near it") {
  Pairs all;
  for (const auto& pair : all.pairs) {
    const VkhReport whole = ask(*pair, 0);
    const uint32_t candidates = pair->statistics().candidateTotal;
    REQUIRE(whole.status == VKH_STATUS_DECIDED);
    const double h = upper_of(whole);
    for (const double factor : {0.01, 0.5, 0.9, 0.99, 0.999, 1.001, 1.01, 1.2, 2.0, 100.0}) {
      const auto limit = static_cast<float>(factor * h);
      const VkhReport r = ask(*pair, limit);
      CAPTURE(factor);
      CAPTURE(h);
      CHECK(lower_of(r) <= upper_of(whole));
      CHECK(upper_of(r) >= lower_of(whole));
      if (std::abs(factor - 1) * h <= 1e-5) continue;  // may be undecided, in plain floats
      CHECK(r.status == (factor < 1 ? VKH_STATUS_BEYOND : VKH_STATUS_WITHIN));
      if (r.status == VKH_STATUS_WITHIN) CHECK(upper_of(r) <= static_cast<double>(limit));
      if (r.status == VKH_STATUS_BEYOND) CHECK(lower_of(r) > static_cast<double>(limit));
      CHECK(pair->statistics().candidateTotal <= candidates);
    }
  }
}

TEST_CASE("a sample far beyond the limit ends the run before its first wave") {
  Pairs all;
  ApiPair& pair = all[0];
  const VkhReport whole = ask(pair, 0);
  const VkhReport r = ask(pair, whole.lower / 2, 20);
  CHECK(r.status == VKH_STATUS_BEYOND);
  CHECK(r.waves == 0);
  CHECK(pair.statistics().candidateTotal == 0);
  CHECK(r.upper > 1e38f);
  CHECK(r.remaining == pair.problem().a.faceCount);
}

TEST_CASE("at the limit itself no verdict is false") {
  Pairs all;
  for (const auto& pair : all.pairs) {
    const VkhReport whole = ask(*pair, 0);
    for (const int ulps : {-40, 0, 40}) {
      const float limit = whole.upper * (1 + static_cast<float>(ulps) * 0x1p-23f);
      const VkhReport r = ask(*pair, limit);
      CAPTURE(ulps);
      if (r.status == VKH_STATUS_WITHIN) {
        CHECK(upper_of(r) <= static_cast<double>(limit));
        CHECK(lower_of(whole) <= static_cast<double>(limit));
      } else if (r.status == VKH_STATUS_BEYOND) {
        CHECK(lower_of(r) > static_cast<double>(limit));
        CHECK(upper_of(whole) > static_cast<double>(limit));
      } else {
        CHECK(r.status != VKH_STATUS_RUNNING);
      }
    }
  }
}

TEST_CASE("between limit and limitUp nothing is proven") {
  Pairs all;
  ApiPair& pair = all[0];
  const auto h = static_cast<float>(upper_of(ask(pair, 0)));
  CHECK(ask(pair, 0.5f * h, 24, 0.6f * h).status == VKH_STATUS_BEYOND);
  CHECK(ask(pair, 1.5f * h, 24, 1.6f * h).status == VKH_STATUS_WITHIN);
  const VkhReport between = ask(pair, 0.9f * h, 24, 1.1f * h);
  CHECK(between.status != VKH_STATUS_BEYOND);
  CHECK(between.status != VKH_STATUS_WITHIN);
  CHECK(between.status != VKH_STATUS_RUNNING);
}

TEST_CASE("a budget that ends first leaves it undecided; the run goes on to its verdict") {
  Pairs all;
  ApiPair& pair = all[1];
  const double h = upper_of(ask(pair, 0));
  pair.problem().options.limit = static_cast<float>(1.001 * h);
  pair.problem().options.limitUp = 0;
  VkhReport r = pair.run([&](VkCommandBuffer c) {
    pair.build(c);
    pair.begin(c);
    pair.report(c);
  });
  uint32_t advances = 0;
  for (; r.status == VKH_STATUS_RUNNING && advances < 60; ++advances) {
    r = pair.run([&](VkCommandBuffer c) {
      pair.advance(c, 1);
      pair.report(c);
    });
  }
  CHECK(advances > 0);
  CHECK(r.status == VKH_STATUS_WITHIN);
  const VkhReport after = pair.run([&](VkCommandBuffer c) {
    pair.advance(c, 3);
    pair.report(c);
  });
  CHECK(after.status == VKH_STATUS_WITHIN);
}
