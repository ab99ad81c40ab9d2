// Tests without a running program: quantities as typed, the interval of two directions, odd
// reports.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/answer/quantities.h"
#include "vkhausdorff/answer.h"
#include "vkhausdorff/error.h"

namespace {

using nlohmann::json;

TEST_CASE("quantities") {
  CHECK(vkh::parse_size("--memory", "4096") == 4096);
  CHECK(vkh::parse_size("--memory", "2GiB") == 2ull << 30);
  CHECK(vkh::parse_size("--memory", "1.5kb") == 1500);
  CHECK(vkh::parse_size("--memory", "0.5 MiB") == 1u << 19);
  CHECK(vkh::parse_time("--time", "250ms") == 0.25);
  CHECK(vkh::parse_time("--time", "2min") == 120);
  CHECK(vkh::parse_time("--time", "1h") == 3600);
  CHECK(vkh::parse_time("--time", "10") == 10);
  CHECK_THROWS_AS(vkh::parse_size("--memory", "0x10"), vkh::UsageError);
  CHECK_THROWS_AS(vkh::parse_time("--time", "1 fortnight"), vkh::UsageError);
}

vkh::Report directed(vkh::Status status, double lower, double upper) {
  vkh::Report r;
  r.status = status;
  r.lower = lower;
  r.upper = upper;
  r.tolerance = 0.01;
  r.diagonal_a = 10;
  return r;
}

vkh::CertifiedInterval both(const vkh::Report& there, const vkh::Report& back) {
  vkh::Answer answer;
  answer.a_to_b = there;
  answer.b_to_a = back;
  return interval_of(answer);
}

TEST_CASE("a symmetric interval is closed by what decides it") {
  using vkh::Status;
  const vkh::Report closed = directed(Status::kClosed, 1, 1.005);
  CHECK(both(closed, directed(Status::kClosed, 0.2, 0.21)).status == Status::kClosed);
  CHECK(both(closed, directed(Status::kTime, 0, 0.9)).status == Status::kClosed);
  CHECK(both(directed(Status::kTime, 0, 0.9), closed).status == Status::kClosed);
  const vkh::CertifiedInterval open = both(closed, directed(Status::kTime, 0, 2));
  CHECK(open.status == Status::kTime);
  CHECK(open.lower == 1);
  CHECK(open.upper == 2);
  CHECK(open.gap == 0.1);
  CHECK(both(directed(Status::kWaves, 0, 3), directed(Status::kTime, 0, 2)).status ==
        Status::kWaves);
  CHECK(both(directed(Status::kWaves, 0, 2), directed(Status::kTime, 0, 3)).status ==
        Status::kTime);
}

TEST_CASE("a pruned way back decides nothing, unless something else pruned it") {
  using vkh::Status;
  const vkh::Report closed = directed(Status::kClosed, 1, 1.0099);
  const vkh::Report pruned = directed(Status::kPruned, 0, 1.00999);
  CHECK(both(closed, pruned).status == Status::kClosed);
  CHECK(both(closed, pruned).lower == 1);
  CHECK(both(closed, pruned).upper == 1.00999);
  CHECK(both(directed(Status::kTime, 1, 3), pruned).status == Status::kTime);
  CHECK(both(closed, directed(Status::kPruned, 0, 1.5)).status == Status::kPruned);
}

TEST_CASE("closed is a matter of exact arithmetic") {
  using vkh::Status;
  // The difference, rounded to nearest, is the tolerance; exactly, it is more.
  vkh::Report r = directed(Status::kClosed, 0x1.84c946e07fefep-6, 0x1.190ddea00000ap-1);
  r.tolerance = 0x1.0ce79468fc012p-1;
  CHECK(r.upper - r.lower == r.tolerance);
  CHECK(both(r, r).status == Status::kPrecision);
  r.diagonal_a = 0x1.0ce79468fc012p-1;
  CHECK(r.gap() > 1);
  CHECK(both(r, r).gap > 1);
  r.tolerance = std::nextafter(r.tolerance, 1);
  CHECK(both(r, r).status == Status::kClosed);
  // The forward direction prunes it within one rounding of the tolerance: it is not closed either.
  vkh::Report back = r;
  back.status = Status::kPruned;
  back.tolerance = r.tolerance = 0x1.0ce79468fc012p-1;
  CHECK(both(r, back).status != Status::kClosed);
}

TEST_CASE("two closed directions of different tolerances close to the smaller one alone") {
  using vkh::Status;
  vkh::Report wide = directed(Status::kClosed, 1, 1.5);
  wide.tolerance = 0.5;
  CHECK(both(wide, directed(Status::kClosed, 0, 0.005)).status == Status::kPrecision);
  CHECK(both(directed(Status::kClosed, 0, 0.005), wide).status == Status::kPrecision);
}

TEST_CASE("an interval that is a point, as it is printed") {
  vkh::Answer answer;
  answer.a_to_b = directed(vkh::Status::kClosed, 0, 0);
  std::ostringstream table;
  print_table(table, answer, false);
  CHECK(table.str().find("[0, 0]  closed") != std::string::npos);
  CHECK(table.str().starts_with("every point of A lies on B\n"));
  CHECK(json::parse(to_json(answer))["interval"]["upper"] == 0);
}

TEST_CASE("an upper bound that is still infinite is null in JSON and inf in hex") {
  vkh::Answer answer;
  answer.a_to_b = directed(vkh::Status::kCancelled, 0.5, std::numeric_limits<double>::infinity());
  const json r = json::parse(to_json(answer));
  CHECK(r["interval"]["upper"].is_null());
  CHECK(r["interval"]["upper_hex"] == "inf");
  CHECK(r["interval"]["gap"].is_null());
  CHECK(r["status"] == "cancelled");
  std::ostringstream table;
  print_table(table, answer, true);
  CHECK(table.str().find(", inf]") != std::string::npos);
}

}  // namespace
