#include "host/python/survey.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <cmath>

#include "host/base/error.h"
#include "host/python/session.h"
#include "host/solve/cells.h"
#include "host/solve/frame.h"

namespace vkh::python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

void read_field(const Arguments& given, double diagonal_a, SurveyOptions& options) {
  constexpr const char* kExpected =
      "True or False, or how narrow each face's bounds are to be: a positive number, a fraction of "
      "A's diagonal, or a string such as '0.1%' or '0.01abs'";
  const py::object* field = given.find("field");
  if (field == nullptr) return;
  if (is_bool(*field)) {
    options.faces = given.flag("field");
    return;
  }
  Length width{.requested = {}, .number = 0, .of = Length::Of::kDiagonal};
  if (py::isinstance<py::str>(*field)) {
    width = length_from("field", kExpected, *field, PlainNumber::kFraction);
  } else {
    width.number = number_from("field", kExpected, *field);
    if (!(width.number > 0) || std::isinf(width.number)) refuse_value("field", kExpected, *field);
  }
  options.faces = true;
  options.field_tolerance = in_files(width, "field", "", diagonal_a).within;
}

void read_band(py::handle band, double diagonal_a, SurveyAsked& asked) {
  constexpr const char* kExpected =
      "a list of positive numbers, in the coordinates' unit, or of strings such as '0.1%' or "
      "'0.01abs'";
  std::vector<double>& bands = asked.options.bands;
  if (py::isinstance<py::str>(band)) {
    const Length length = length_from("bands", kExpected, band, PlainNumber::kRefused);
    const Limit limit = in_files(length, "bands", "", diagonal_a);
    asked.bands.push_back({length.requested, bands.size(), bands.size() + 1});
    bands.insert(bands.end(), {limit.within, limit.beyond});
    return;
  }
  const double number = number_from("bands", kExpected, band);
  if (!(number > 0) || std::isinf(number)) refuse_value("bands", kExpected, band);
  asked.bands.push_back({{}, bands.size(), bands.size()});
  bands.push_back(number);
}

void read_bands(const Arguments& given, double diagonal_a, SurveyAsked& asked) {
  constexpr const char* kExpected = "a list of distances";
  const py::object* bands = given.find("bands");
  if (bands == nullptr) return;
  const bool is_list = py::isinstance<py::list>(*bands) || py::isinstance<py::tuple>(*bands);
  const bool is_row =
      py::isinstance<py::array>(*bands) && py::reinterpret_borrow<py::array>(*bands).ndim() == 1;
  if (!is_list && !is_row) refuse_type("bands", kExpected, *bands);
  for (const py::handle band : *bands) read_band(band, diagonal_a, asked);
}

/// Reads a number, or "99.5%".
double share_from(py::handle given) {
  constexpr const char* kExpected =
      "a share of the area above 0 and at most 1, such as 0.995 or '99.5%', or None";
  double share = 0;
  if (!py::isinstance<py::str>(given)) {
    share = number_from("area", kExpected, given);
  } else {
    const std::string text = text_from("area", kExpected, given);
    if (!text.ends_with('%')) refuse_value("area", kExpected, given);
    try {
      share = parse_length("area", text, PlainNumber::kRefused).number;
    } catch (const UsageError&) {
      refuse_value("area", kExpected, given);
    }
  }
  if (!(share > 0 && share <= 1)) refuse_value("area", kExpected, given);
  return share;
}

}  // namespace

Length length_from(const char* name, const char* expected, py::handle given, PlainNumber plain) {
  Length length;
  try {
    length = parse_length(name, text_from(name, expected, given), plain);
  } catch (const UsageError&) {
    refuse_value(name, expected, given);
  }
  if (length.of == Length::Of::kUnit) refuse_value(name, expected, given);
  return length;
}

SurveyAsked read_survey(const Arguments& given, const Mesh& a) {
  constexpr const char* kTime = "a number of seconds, 0 or more, or None";
  constexpr const char* kEffort = "a whole number of cells, 0 or more, or None";
  const FloatEnvironment ours;
  const double diagonal_a = diagonal(bounding_box(a));
  SurveyAsked asked;
  read_field(given, diagonal_a, asked.options);
  read_bands(given, diagonal_a, asked);
  asked.options.statistics = given.flag("statistics") || !asked.bands.empty();
  if (const std::optional<double> seconds = given.number("survey_time", kTime)) {
    if (*seconds < 0) refuse_value("survey_time", kTime, given.at("survey_time"));
    asked.options.time_limit_s = *seconds;
  }
  asked.options.effort = given.whole("effort", kEffort);
  asked.is_any = asked.options.faces || asked.options.statistics;
  return asked;
}

void read_area(const Arguments& given, const Limit& limit, SurveyAsked& asked) {
  const FloatEnvironment ours;
  const py::object* area = given.find("area");
  if (area != nullptr && !area->is_none()) asked.area = share_from(*area);
  SurveyOptions& options = asked.options;
  options.limit = limit;
  options.enough = asked.area;
  if (!options.statistics) options.percentiles.clear();
  if (!options.statistics) options.mean_tolerance = 1;  // a share of area is all that is asked
  options.statistics = options.statistics || asked.area;
  asked.is_any = asked.is_any || options.statistics;
  if (!options.statistics || !(limit.within > 0)) return;
  const py::object& max = given.at("max");
  const std::string text = py::isinstance<py::str>(max) ? text_from("max", "", max) : "";
  asked.bands.push_back({text, options.bands.size(), options.bands.size() + 1});
  options.bands.insert(options.bands.end(), {limit.within, limit.beyond});
}

SurveyRun::SurveyRun(const SurveyAsked& asked, const SolveOptions& options, const Mesh& a,
                     Surveys& found, bool is_apart)
    : survey_(asked.options),
      options_(options),
      a_(a),
      found_(found),
      is_any_(asked.is_any),
      is_apart_(is_apart || options.limit.within > 0) {
  if (!is_any_) return;
  ours_.emplace();
  options_.progress = [this, listen = options.progress](const Progress& progress) {
    const bool goes_on = ours_->outside([&] { return listen(progress); });
    is_cancelled_ = is_cancelled_ || !goes_on;
    return goes_on;
  };
  survey_.goes_on = [this](size_t) {
    if (!is_cancelled_) ours_->outside(hear_signals);
    return !is_cancelled_;
  };
  if (!is_apart_) hook();
}

void SurveyRun::hook() {
  options_.survey = [this](const SurveyedPair& pair, const BoundCells& bound) {
    survey_with(survey_, (&pair.a == &a_ ? found_.a : found_.b).result)(pair, bound);
  };
}

void SurveyRun::beside(const std::function<void(const SolveOptions&)>& run) {
  if (!is_any_ || !is_apart_ || is_cancelled_) return;
  options_.limit = {};
  options_.wave_limit = 1;
  options_.progress = [this](const Progress&) { return survey_.goes_on(0); };
  hook();
  run(options_);
}

void narrow(const SurveyAsked& asked, Report& report, Surveyed& survey) {
  Field& field = survey.result.field;
  std::vector<double>& upper = field.upper;
  if (upper.empty()) {
    upper.assign(report.mesh_a.faces, report.upper);
    field.lower.assign(report.mesh_a.faces, 0);
    survey.result.faces = asked.options.faces;
  }
  if (!upper.empty())
    report.upper = std::min(report.upper, *std::max_element(upper.begin(), upper.end()));
  survey.upper = report.upper;
}

namespace {

py::array_t<double> array_of(const std::vector<double>& numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

/// Returns (key, (lower, upper)); _survey.py makes an Interval of the bounds.
py::tuple pair_of(const py::object& key, double lower, double upper) {
  return py::make_tuple(key, py::make_tuple(lower, upper));
}

py::dict statistics_of(const SurveyAsked& asked, const Statistics& s) {
  py::list bands, percentiles, curve;
  for (const Band& band : asked.bands) {
    const AreaWithin &first = s.bands[band.first], &last = s.bands[band.last];
    const py::object key =
        band.text.empty() ? py::object(py::float_(first.distance)) : py::object(py::str(band.text));
    bands.append(pair_of(key, first.share.lower, last.share.upper));
  }
  for (const Percentile& p : s.percentiles)
    percentiles.append(pair_of(py::float_(p.share), p.distance.lower, p.distance.upper));
  for (const AreaWithin& at : s.curve)
    curve.append(pair_of(py::float_(at.distance), at.share.lower, at.share.upper));
  return py::dict("area"_a = s.area, "mean"_a = py::make_tuple(s.mean.lower, s.mean.upper),
                  "rms"_a = py::make_tuple(s.rms.lower, s.rms.upper), "bands"_a = bands,
                  "percentiles"_a = percentiles, "curve"_a = curve);
}

py::object object_of(const SurveyAsked& asked, const Surveyed& found) {
  const SurveyResult& survey = found.result;
  py::object field = py::none(), statistics = py::none();
  if (survey.faces)
    field = py::make_tuple(array_of(survey.field.lower), array_of(survey.field.upper));
  if (survey.statistics) statistics = statistics_of(asked, *survey.statistics);
  const py::dict stats("cells"_a = survey.cells, "bounded"_a = survey.bounded,
                       "effort"_a = survey.effort, "wall_ms"_a = survey.ms);
  return py::module_::import("vkhausdorff._survey")
      .attr("made")(field, statistics, found.upper, survey_end_name(survey.ended), stats);
}

// The limit's band is the last. Its share from below is for the limit rounded down, its share from
// above for the limit rounded up.
Verdict verdict_on_area(const SurveyAsked& asked, const SurveyResult& survey) {
  if (!survey.statistics) return Verdict::kUndecided;
  const std::vector<AreaWithin>& bands = survey.statistics->bands;
  if (bands[asked.bands.back().first].share.lower >= *asked.area) return Verdict::kWithin;
  const bool is_beyond = bands[asked.bands.back().last].share.upper < *asked.area;
  return is_beyond ? Verdict::kBeyond : Verdict::kUndecided;
}

}  // namespace

void add_surveys(const SurveyAsked& asked, const Surveyed& a, const Surveyed* b, Answer& answer) {
  if (!asked.is_any) return;
  answer.survey = object_of(asked, a);
  if (b != nullptr) answer.survey_back = object_of(asked, *b);
  if (!asked.area) return;
  answer.stats["max"] = asked.options.limit.within;
  answer.stats["area"] = *asked.area;
  answer.verdict = verdict_on_area(asked, a.result);
  if (b == nullptr || answer.verdict == Verdict::kBeyond) return;
  const Verdict back = verdict_on_area(asked, b->result);
  if (back != Verdict::kWithin) answer.verdict = back;
}

}  // namespace vkh::python
