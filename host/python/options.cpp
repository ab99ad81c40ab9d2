#include "host/python/options.h"

#include <cmath>
#include <limits>

#include "host/answer/options.h"
#include "host/base/float_environment.h"
#include "host/python/survey.h"
#include "host/solve/frame.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

void read_tolerance(const Arguments& given, SolveOptions& options) {
  constexpr const char* kExpected =
      "a positive number, a fraction of A's diagonal, or a string such as '0.1%' or '0.01abs'";
  const py::object* tol = given.find("tol");
  if (tol == nullptr) return;
  if (py::isinstance<py::str>(*tol)) {
    const Length length = length_from("tol", kExpected, *tol, PlainNumber::kFraction);
    options.tolerance = length.number;
    options.tolerance_is_absolute = length.of == Length::Of::kFiles;
    return;
  }
  const std::optional<double> value = given.number("tol", kExpected);
  if (!value) refuse_type("tol", kExpected, *tol);
  if (!(*value > 0) || std::isinf(*value)) refuse_value("tol", kExpected, *tol);
  options.tolerance = *value;
}

void read_limits(const Arguments& given, SolveOptions& options) {
  constexpr const char* kTime = "a number of seconds, 0 or more, or None";
  constexpr const char* kWaves = "a whole number from 0 to 4294967295, or None";
  if (const std::optional<double> time = given.number("time", kTime)) {
    if (*time < 0) refuse_value("time", kTime, given.at("time"));
    options.time_limit_s = *time;
  }
  if (const std::optional<uint64_t> waves = given.whole("waves", kWaves)) {
    if (*waves > std::numeric_limits<uint32_t>::max())
      refuse_value("waves", kWaves, given.at("waves"));
    options.wave_limit = static_cast<uint32_t>(*waves);
  }
}

}  // namespace

std::optional<uint64_t> size_of(const Arguments& given, const char* name) {
  constexpr const char* kExpected = "a number of bytes above 0, a string such as '2GiB', or None";
  const FloatEnvironment ours;
  const py::object* size = given.find(name);
  if (size != nullptr && py::isinstance<py::str>(*size))
    return parse_size(name, text_from(name, kExpected, *size));
  const std::optional<uint64_t> bytes = given.whole(name, kExpected);
  if (bytes && *bytes == 0) refuse_value(name, kExpected, *size);
  return bytes;
}

SolveOptions options_of(const Arguments& given) {
  const FloatEnvironment ours;
  SolveOptions options;
  read_tolerance(given, options);
  read_limits(given, options);
  options.memory_bytes = size_of(given, "memory").value_or(0);
  options.preset = given.text("preset", "'default', 'paper' or 'baseline-gpu'");
  options.enabled = given.texts("enable");
  options.disabled = given.texts("disable");
  return options;
}

MaxAsked read_max(const Arguments& given, const char* expected) {
  const FloatEnvironment ours;
  const py::object& max = given.at("max");
  if (py::isinstance<py::str>(max)) return length_from("max", expected, max, PlainNumber::kRefused);
  const std::optional<double> value = given.number("max", expected);
  if (!value) refuse_type("max", expected, max);
  if (!(*value > 0) || std::isinf(*value)) refuse_value("max", expected, max);
  return Limit{*value, *value};
}

Limit limit_for(const MaxAsked& max, const Mesh& a) {
  const FloatEnvironment ours;
  if (const auto* limit = std::get_if<Limit>(&max)) return *limit;
  return limit_in_files(std::get<Length>(max), "max", "", diagonal(bounding_box(a)));
}

}  // namespace vkh::python
