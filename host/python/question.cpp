#include "host/python/question.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/answer/quantities.h"
#include "host/base/decimal.h"
#include "host/base/float_environment.h"
#include "host/base/system.h"
#include "host/python/mesh.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/length.h"
#include "vkhausdorff/place.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

constexpr double kGateTolerance = 1e-7;  // of the diagonal, as for vkhausdorff gate

/// Reads a string such as '0.1%' or '0.01abs'. Arrays have no known unit: '0.1mm' is refused.
Length length_from_text(const char* name, const char* expected, py::handle given,
                        PlainNumber plain) {
  Length length;
  try {
    length = parse_length(name, text_from(name, expected, given), plain);
  } catch (const UsageError&) {
    refuse_value(name, expected, given);
  }
  if (length.of == Length::Of::kUnit) refuse_value(name, expected, given);
  return length;
}

/// Reads a number, which is `of` that, or such a string.
Length length_from(const char* name, const char* expected, py::handle given, Length::Of of) {
  if (py::isinstance<py::str>(given)) {
    const bool is_fraction = of == Length::Of::kDiagonal;
    return length_from_text(name, expected, given,
                            is_fraction ? PlainNumber::kFraction : PlainNumber::kRefused);
  }
  const double number = number_from(name, expected, given);
  if (!(number > 0) || std::isinf(number)) refuse_value(name, expected, given);
  return {.requested = shortest_decimal(number), .number = number, .of = of, .is_double = true};
}

void read_tolerance(const Arguments& given, Question& question) {
  constexpr const char* kExpected =
      "a positive number, a fraction of A's diagonal, or a string such as '0.1%' or '0.01abs'";
  if (const py::object* tol = given.find("tol"))
    question.tolerance = length_from("tol", kExpected, *tol, Length::Of::kDiagonal);
}

void read_budget(const Arguments& given, SolveOptions& options) {
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

void read_engine(const Arguments& given, SolveOptions& options) {
  read_budget(given, options);
  options.memory_bytes = size_of(given, "memory").value_or(0);
  options.preset = given.text("preset", "'default', 'paper' or 'baseline-gpu'");
  options.enabled = given.texts("enable");
  options.disabled = given.texts("disable");
}

bool is_row(const py::object& given) {
  if (py::isinstance<py::str>(given)) return false;
  const auto array = py::array::ensure(given);
  if (!array) PyErr_Clear();
  return array && array.ndim() == 1;
}

/// Reads the limits of A's faces. Of the whole, the largest is its limit.
void read_face_limits(const py::object& max, const char* expected, Question& question) {
  refuse_masked("max", max);
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(max);
  if (!numbers) PyErr_Clear();
  if (!numbers) refuse_type("max", expected, max);
  double largest = 0;
  question.face_limits_a.emplace();
  for (py::ssize_t i = 0; i < numbers.shape(0); ++i) {
    question.face_limits_a->push_back({numbers.at(i), numbers.at(i)});
    largest = std::max(largest, numbers.at(i));
  }
  question.max = Length{.requested = "limits of A's faces",
                        .number = largest,
                        .of = Length::Of::kFiles,
                        .is_double = true};
}

void read_max(const Arguments& given, Question& question) {
  constexpr const char* kOne =
      "a positive number, in the coordinates' unit, a string such as '0.1%' or '0.01abs'";
  const bool by_face = given.knows("area");  // gate()
  const std::string expected =
      std::string(kOne) + (by_face ? ", or a number for each face of A" : ", or None");
  const py::object* max = given.find("max");
  if (max == nullptr || (max->is_none() && !by_face)) return;
  if (py::isinstance<py::str>(*max))
    question.max_sides = parse_sided("max", text_from("max", expected.c_str(), *max));
  if (question.max_sides) {
    question.max = question.max_sides->over;
  } else if (by_face && is_row(*max)) {
    read_face_limits(*max, expected.c_str(), question);
  } else {
    question.max = length_from("max", expected.c_str(), *max, Length::Of::kFiles);
  }
  if (given.find("tol") == nullptr)
    question.tolerance = {.requested = shortest_decimal(kGateTolerance), .number = kGateTolerance};
}

/// Reads a number, or "99.5%".
double share_from(py::handle given) {
  constexpr const char* kExpected =
      "a share of the area above 0 and at most 1, such as 0.995 or '99.5%', or None";
  if (!py::isinstance<py::str>(given)) {
    const double share = number_from("area", kExpected, given);
    if (!(share > 0 && share <= 1)) refuse_value("area", kExpected, given);
    return share;
  }
  const std::string text = text_from("area", kExpected, given);
  if (!text.ends_with('%')) refuse_value("area", kExpected, given);
  try {
    return parse_share("area", text);
  } catch (const UsageError&) {
    refuse_value("area", kExpected, given);
  }
}

void read_area(const Arguments& given, Question& question) {
  const py::object* area = given.find("area");
  if (area == nullptr || area->is_none()) return;
  question.area = share_from(*area);
  question.area_requested = py::cast<std::string>(py::str(*area));
}

void read_field(const Arguments& given, Question& question) {
  constexpr const char* kExpected =
      "True or False, or how narrow each face's bounds are to be: a positive number, a fraction of "
      "A's diagonal, or a string such as '0.1%' or '0.01abs'";
  const py::object* field = given.find("field");
  if (field == nullptr) return;
  question.faces = !is_bool(*field) || given.flag("field");
  if (!is_bool(*field))
    question.face_tolerance = length_from("field", kExpected, *field, Length::Of::kDiagonal);
}

void read_bands(const Arguments& given, Question& question) {
  constexpr const char* kList = "a list of distances";
  constexpr const char* kExpected =
      "a list of positive numbers, in the coordinates' unit, or of strings such as '0.1%' or "
      "'0.01abs'";
  const py::object* bands = given.find("bands");
  if (bands == nullptr) return;
  const bool is_list = py::isinstance<py::list>(*bands) || py::isinstance<py::tuple>(*bands);
  if (!is_list && !(py::isinstance<py::array>(*bands) && is_row(*bands)))
    refuse_type("bands", kList, *bands);
  for (const py::handle band : *bands)
    question.bands.push_back(length_from("bands", kExpected, band, Length::Of::kFiles));
}

void read_survey(const Arguments& given, Question& question) {
  constexpr const char* kTime = "a number of seconds, 0 or more, or None";
  constexpr const char* kEffort = "a whole number of cells, 0 or more, or None";
  constexpr const char* kDistance =
      "a positive number, in the coordinates' unit, a string such as '0.1%' or '0.01abs', or None";
  read_field(given, question);
  read_bands(given, question);
  question.statistics = given.flag("statistics") || !question.bands.empty();
  if (const py::object* most = given.find("max_distance"); most != nullptr && !most->is_none())
    question.max_distance = length_from("max_distance", kDistance, *most, Length::Of::kFiles);
  question.is_signed = given.flag("signed");
  question.effort = given.whole("effort", kEffort);
  question.survey_time_s =
      given.number("survey_time", kTime).value_or(std::numeric_limits<double>::infinity());
  if (*question.survey_time_s < 0) refuse_value("survey_time", kTime, given.at("survey_time"));
}

/// Reads a number of per cent, or "0.5%".
double percentile_from(const py::object& given) {
  constexpr const char* kExpected = "a number above 0 and at most 100, such as 95, or '0.5%'";
  if (py::isinstance<py::str>(given)) {
    const std::string text = text_from("percentile", kExpected, given);
    if (!text.ends_with('%')) refuse_type("percentile", kExpected, given);
    return parse_percentile("percentile", text);
  }
  const double percentile = number_from("percentile", kExpected, given);
  if (!(percentile > 0 && percentile <= 100)) refuse_value("percentile", kExpected, given);
  check_percentile("percentile", percentile);
  return percentile;
}

/// Reads what metrics() asks for: both directions, and no statistics beside them.
void read_metrics(const Arguments& given, Question& question) {
  if (!given.knows("percentile")) return;
  MetricsOptions& metrics = question.metrics.emplace();
  metrics.percentile = percentile_from(given.at("percentile"));
  metrics.figures = checked_figures("figures", given.texts("figures"), metrics.percentile);
  constexpr const char* kAngle = "an angle above 0 and at most 90 degrees, or None";
  metrics.normals = given.number("normals", kAngle);
  if (metrics.normals && !(*metrics.normals > 0 && *metrics.normals <= 90))
    refuse_value("normals", kAngle, given.at("normals"));
  question.symmetric = true;
  question.statistics = false;
}

std::string unit_from(const Arguments& given, const char* name) {
  constexpr const char* kExpected = "'um', 'mm', 'cm', 'm', 'in' or 'ft', or None";
  const py::object* unit = given.find(name);
  if (unit == nullptr || unit->is_none()) return "";
  std::string text = text_from(name, kExpected, *unit);
  try {
    check_unit(name, text);
  } catch (const UsageError&) {
    refuse_value(name, kExpected, *unit);
  }
  return text;
}

MatrixRows matrix_from(const py::object& given) {
  constexpr const char* kExpected =
      "an array of four rows of four numbers, the last 0 0 0 1, the path of such a file, or None";
  refuse_masked("transform", given);
  const auto numbers =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!numbers) PyErr_Clear();
  if (!numbers || numbers.ndim() != 2) refuse_type("transform", kExpected, given);
  const bool is_square = numbers.shape(0) == 4 && numbers.shape(1) == 4;
  if (!is_square) refuse_value("transform", kExpected, given);
  const double* entry = numbers.data();
  if (entry[12] != 0 || entry[13] != 0 || entry[14] != 0 || entry[15] != 1)
    refuse_value("transform", kExpected, given);
  MatrixRows rows;
  for (size_t i = 0; i < 12; ++i) rows[i / 4][i % 4] = entry[i];
  return rows;
}

/// Reads the units of each side, and the matrix by which A is placed.
void read_placement(const Arguments& given, Question& question) {
  question.unit_a = unit_from(given, "unit_a");
  question.unit_b = unit_from(given, "unit_b");
  question.may_stretch = given.flag("scale");
  question.align = given.flag("align");
  const py::object* transform = given.find("transform");
  if (transform == nullptr || transform->is_none()) return;
  if (const std::optional<std::string> file = path_from("transform", *transform)) {
    question.transform_file = *file;
    question.transform = read_matrix(path_of(*file));
  } else {
    question.transform = matrix_from(*transform);
  }
}

void check_together(const Question& question) {
  if (!question.face_limits_a) return;
  if (question.symmetric)
    throw UsageError("max: limits of A's faces say nothing of B's; ask for each direction apart");
  if (question.area) throw UsageError("area: faces with limits of their own are asked about whole");
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

Question question_of(const char* command, const Arguments& given) {
  constexpr double kTolerance = 1e-6;
  const FloatEnvironment ours;
  Question question;
  question.command = command;
  question.dashes = "";
  question.tolerance = {.requested = "1e-6", .number = kTolerance};
  read_tolerance(given, question);
  read_max(given, question);
  read_engine(given, question.options);
  question.symmetric = given.flag("symmetric");
  question.worst = given.flag("worst");
  read_area(given, question);
  read_survey(given, question);
  read_metrics(given, question);
  read_placement(given, question);
  check_together(question);
  return question;
}

}  // namespace vkh::python
