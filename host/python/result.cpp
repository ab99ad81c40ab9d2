// The class Result of the package.
#include "host/python/result.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "host/base/decimal.h"
#include "host/base/float_environment.h"
#include "host/python/interpreter.h"

namespace vkh::python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

std::string text_of(const Result& r) {
  if (!r.error.is_none())
    return std::string("<vkhausdorff.Result without an answer: ") +
           Py_TYPE(r.error.ptr())->tp_name + ": " + py::cast<std::string>(py::str(r.error)) + ">";
  const FloatEnvironment ours;
  const std::string lower = decimal(r.lower, 9, Rounding::kDown);
  std::string text = "<vkhausdorff.Result ";
  text += r.is_upper_sought() ? "[" + lower + ", " + decimal(r.upper, 9, Rounding::kUp) + "]"
                              : "at least " + lower;
  return text + " " + status_name(r.status) + ">";
}

py::tuple point_of(const SurfacePoint& p) {
  return py::make_tuple(p.point.x, p.point.y, p.point.z);
}

py::tuple barycentric_of(const SurfacePoint& p) {
  return py::make_tuple(p.barycentric.x, p.barycentric.y, p.barycentric.z);
}

// Packs a point for pickles.
py::tuple state_of(const SurfacePoint& p) {
  const auto xyz = [](const glm::dvec3& v) { return py::make_tuple(v.x, v.y, v.z); };
  return py::make_tuple(p.face, xyz(p.barycentric), xyz(p.point));
}

SurfacePoint point_from(const py::handle& state) {
  const auto xyz = [](const py::object& v) {
    return glm::dvec3(py::cast<double>(v[py::int_(0)]), py::cast<double>(v[py::int_(1)]),
                      py::cast<double>(v[py::int_(2)]));
  };
  return {.face = py::cast<uint64_t>(state[py::int_(0)]),
          .barycentric = xyz(state[py::int_(1)]),
          .point = xyz(state[py::int_(2)])};
}

// Finds an enumerator by its name: numbers of enumerators may change.
template <class Enum>
Enum named(const std::string& name, const char* (*name_of)(Enum), Enum last) {
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    if (name == name_of(static_cast<Enum>(i))) return static_cast<Enum>(i);
  }
  throw py::value_error("'" + name + "' is not known here");
}

Result result_in(const py::tuple& state) {
  Result r;
  r.lower = py::cast<double>(state[0]);
  r.upper = py::cast<double>(state[1]);
  r.status = named(py::cast<std::string>(state[2]), status_name, Status::kLimit);
  if (!state[3].is_none())
    r.verdict = named(py::cast<std::string>(state[3]), verdict_name, Verdict::kUndecided);
  r.witness_a = point_from(state[4]);
  r.witness_b = point_from(state[5]);
  r.survey = state[6];
  r.survey_back = state[7];
  r.stats = py::cast<py::dict>(state[8]);
  if (!state[9].is_none()) r.index = py::cast<size_t>(state[9]);
  r.id = state[10];
  r.error = state[11];
  r.notes = py::cast<py::list>(state[12]);
  return r;
}

Result result_from_state(const py::tuple& state) {
  constexpr const char* kStranger = "this pickle is not of a vkhausdorff.Result";
  try {
    return result_in(state);
  } catch (const py::cast_error&) {  // values of other types
    throw py::value_error(kStranger);
  } catch (const py::error_already_set&) {  // fewer values
    throw py::value_error(kStranger);
  }
}

// Reads a member whether there is an answer or not.
template <class Get>
auto of_any_result(Get get) {
  return [get](const py::object& self) { return get(made<Result>(self, "Result")); };
}

/// Raises the exception that stands instead of an answer.
const Result& answered(const py::object& self) {
  const auto& r = made<Result>(self, "Result");
  if (r.error.is_none()) return r;
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(r.error.ptr())), r.error.ptr());
  throw py::error_already_set();
}

template <class Get>
auto of_result(Get get) {
  return [get](const py::object& self) { return get(answered(self)); };
}

// Reads a member of A's survey; None without one.
auto of_survey(const char* name) {
  return of_result([name](const Result& r) {
    return r.survey.is_none() ? py::object(py::none()) : py::object(r.survey.attr(name));
  });
}

py::object area_within(const py::object& self, const py::object& distance) {
  const Call call;
  const Result& r = answered(self);
  if (r.survey.is_none())
    throw py::value_error("area_within(): ask for it with statistics=True or bands=(...)");
  return r.survey.attr("area_within")(distance);
}

py::object survey_met(const Result& r) {
  if (r.survey.is_none()) return py::none();
  const auto met = [](const py::object& survey) {
    return survey.is_none() || py::cast<bool>(survey.attr("met"));
  };
  return py::bool_(met(r.survey) && met(r.survey_back));
}

// The proven values of the pair; not the cost of the run.
py::tuple proven(const Result& r) {
  return py::make_tuple(r.lower, r.upper, status_name(r.status), r.verdict_name(),
                        state_of(r.witness_a), state_of(r.witness_b), r.survey, r.survey_back);
}

// Compares two exceptions by their texts, since each is equal to itself alone.
bool same_errors(const py::object& x, const py::object& y) {
  if (x.is_none() || y.is_none()) return x.is(y);
  return py::type::of(x).is(py::type::of(y)) && py::str(x).equal(py::str(y));
}

py::object equal(const py::object& self, const py::object& other) {
  if (!py::isinstance<Result>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
  const Call call;
  const auto &x = made<Result>(self, "Result"), &y = made<Result>(other, "Result");
  return py::bool_(proven(x).equal(proven(y)) && same_errors(x.error, y.error));
}

py::dict dict_of_result(const Result& r) {
  const auto plain = [](const py::object& survey) {
    return survey.is_none() ? py::object(survey) : py::object(survey.attr("to_dict")());
  };
  return py::dict("lower"_a = r.lower, "upper"_a = r.upper, "closed"_a = r.closed(),
                  "status"_a = status_name(r.status), "verdict"_a = r.verdict_name(),
                  "witness_a"_a = point_of(r.witness_a), "witness_b"_a = point_of(r.witness_b),
                  "face_a"_a = r.witness_a.face, "face_b"_a = r.witness_b.face,
                  "survey"_a = plain(r.survey), "survey_back"_a = plain(r.survey_back),
                  "notes"_a = r.notes, "stats"_a = r.stats);
}

py::dict dict_of(const py::object& self) {
  const Call call;
  const Result& r = made<Result>(self, "Result");
  py::dict values;
  if (r.index) values = py::dict("index"_a = *r.index, "id"_a = r.id);
  if (!r.error.is_none()) {
    values["error"] =
        py::dict("type"_a = Py_TYPE(r.error.ptr())->tp_name, "message"_a = py::str(r.error));
    return values;
  }
  values.attr("update")(dict_of_result(r));
  return values;
}

void define_surveys(py::class_<Result>& result) {
  result
      .def_property_readonly(
          "field", of_survey("field"),
          "with field: .lower and .upper, float64 arrays of shape (faces of A,), in the\n"
          "coordinates' unit: the largest distance of a point of the face lies between; else None")
      .def_property_readonly(
          "mean", of_survey("mean"),
          "with statistics: the Interval of the mean distance over A's area; else None")
      .def_property_readonly("rms", of_survey("rms"), "likewise of the root mean square")
      .def_property_readonly("figures", of_survey("figures"),
                             "with statistics or signed: {name: Interval} of all figures of A, "
                             "such as 'mean', 'p95',\n"
                             "'within_0.5', 'over' and 'signed_mean'; else None, and in the pickle "
                             "of a version without them")
      .def_property_readonly(
          "percentiles", of_survey("percentiles"),
          "with statistics: {share: Interval} of the least distance that so much of A's area is\n"
          "within, for 0.5, 0.9, 0.95 and 0.99; else None")
      .def_property_readonly(
          "signed", of_survey("signed"),
          "with signed, or limits of two sides: the Signed of A, which says where it is over B,\n"
          "in front of its faces, and where under it; else None")
      .def(
          "area_within", area_within, "distance"_a,
          "area_within(self, distance)\n--\n\n"
          "The Interval of the share of A's area, from 0 to 1, that is within this distance of B.\n"
          "A number, in the coordinates' unit: narrow at one of bands, true at any. Or a string\n"
          "that was one of bands. ValueError without statistics or bands.")
      .def_property_readonly("survey_met", of_result(survey_met),
                             "whether all became as narrow as was asked, before survey_time "
                             "ended;\nNone if nothing was")
      .def_property_readonly("survey", of_result([](const Result& r) { return r.survey; }),
                             "the Survey of A, which has all of these; None if nothing was asked")
      .def_property_readonly("survey_back",
                             of_result([](const Result& r) { return r.survey_back; }),
                             "the Survey of B, in a symmetric run")
      .def_property_readonly("field_back", of_result([](const Result& r) {
                               return r.survey_back.is_none()
                                          ? py::object(py::none())
                                          : py::object(r.survey_back.attr("field"));
                             }),
                             "as field, for the faces of B and their distances from A, in a "
                             "symmetric run");
}

// Results are equal if the same is proven, whatever it cost.
void define_values(py::class_<Result>& result) {
  result
      .def("to_dict", dict_of,
           "to_dict(self)\n--\n\n"
           "All of it as plain values, which json.dumps takes.")
      .def("__repr__", of_any_result(text_of))
      .def("__eq__", equal)
      .def("__hash__", of_any_result([](const Result& r) {
             return py::hash(py::make_tuple(r.lower, r.upper));
           }))
      .def(py::pickle(
          [](const py::object& self) {
            const Result& r = made<Result>(self, "Result");
            return py::tuple(proven(r) + py::make_tuple(r.stats, r.index, r.id, r.error, r.notes));
          },
          [](const py::tuple& state) { return result_from_state(state); }));
}

// Defines what distances() adds about a pair.
void define_place(py::class_<Result>& result) {
  result
      .def_property_readonly("index", of_any_result([](const Result& r) { return r.index; }),
                             "of distances(): the pair's place in the iterable, from 0; else None")
      .def_property_readonly("id", of_any_result([](const Result& r) { return r.id; }),
                             "of distances(): what the pair was called, as it was given; else None")
      .def_property_readonly(
          "error", of_any_result([](const Result& r) { return r.error; }),
          "of distances(): the exception that the pair ended with, else None. Where it is one,\n"
          "whatever else is asked of the result raises it");
}

}  // namespace

void define_result(py::module_& m) {
  py::class_<Result> result(m, "Result", "A certified interval and what proves its lower end.");
  result
      .def_property_readonly("lower", of_result([](const Result& r) { return r.lower; }),
                             "lower <= distance, in exact arithmetic")
      .def_property_readonly("upper", of_result([](const Result& r) { return r.upper; }),
                             "distance <= upper, in exact arithmetic")
      .def_property_readonly("closed", of_result([](const Result& r) { return r.closed(); }),
                             "whether upper - lower met the tolerance")
      .def_property_readonly(
          "status", of_result([](const Result& r) { return status_name(r.status); }),
          "why the run ended: closed, precision, time, waves, memory, cancelled, or limit where\n"
          "the limit of gate() was decided")
      .def_property_readonly(
          "verdict", of_result([](const Result& r) { return r.verdict_name(); }),
          "of gate(): 'pass', 'fail' or 'undecided', the first two proven; else None")
      .def_property_readonly(
          "witness_a", of_result([](const Result& r) { return point_of(r.witness_a); }),
          "the point of A (x, y, z) that is farthest from B as far as found, proving lower; in a "
          "symmetric run the one that is closest to it if B has the farthest point")
      .def_property_readonly("witness_b",
                             of_result([](const Result& r) { return point_of(r.witness_b); }),
                             "the closest point of B to it (x, y, z); in a symmetric run likewise")
      .def_property_readonly("face_a", of_result([](const Result& r) { return r.witness_a.face; }),
                             "row of fa with the witness")
      .def_property_readonly("face_b", of_result([](const Result& r) { return r.witness_b.face; }),
                             "row of fb with its partner")
      .def_property_readonly("_barycentric_a",
                             of_result([](const Result& r) { return barycentric_of(r.witness_a); }))
      .def_property_readonly("_is_upper_sought",
                             of_result([](const Result& r) { return r.is_upper_sought(); }))
      .def_property_readonly("_barycentric_b",
                             of_result([](const Result& r) { return barycentric_of(r.witness_b); }))
      .def_property_readonly(
          "notes", of_result([](const Result& r) { return r.notes; }),
          "what is odd about the pair or its files: a list of dicts of code, text,\n"
          "value, unit, file and face")
      .def_property_readonly("stats", of_result([](const Result& r) { return r.stats; }),
                             "what the run was asked, did and cost");
  define_place(result);
  define_surveys(result);
  define_values(result);
}

}  // namespace vkh::python
