#include "host/python/keywords.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <type_traits>

#include "host/answer/option_values.h"
#include "host/answer/quantities.h"
#include "host/answer/rules.h"
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

constexpr double kTolerance = 1e-6,
                 kGateTolerance = 1e-7;  // of the diagonal, as the program has it

/// A keyword's value, with its name and what was expected, for messages.
struct Value {
  const char* name;
  const char* expected;
  const py::object& given;

  [[noreturn]] void refuse() const { refuse_value(name, expected, given); }
  bool is_text() const { return py::isinstance<py::str>(given); }
  std::string text() const { return text_from(name, expected, given); }
};

/// Whether None means that the keyword was not given.
bool takes_none(const Option& option, Functions function) {
  switch (option.kind) {
    case Kind::kFlag:
    case Kind::kTolerance:
    case Kind::kNames:
    case Kind::kLengths:
    case Kind::kPercentile:
      return false;
    case Kind::kChoice:
      return option.is_column;  // points
    case Kind::kLength:
      return (function & (kPyGate | kPySimplify)) == 0 || std::string_view(option.name) != "max";
    default:
      return true;
  }
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string quoted_choices(const Option& option) {
  std::vector<std::string> quoted;
  for (const std::string& choice : option.choices) quoted.push_back("'" + choice + "'");
  const std::string none = option.none;
  const bool is_known = none.size() <= 2 || is_among(quoted, none);
  if (none.starts_with("'") && !is_known) quoted.insert(quoted.begin(), none);
  return joined(quoted, " or ");
}

std::string expected_of_kind(const Option& option) {
  switch (option.kind) {
    case Kind::kFlag:
      return "True or False";
    case Kind::kTolerance:
      return "a positive number, a fraction of A's diagonal, or a string such as '0.1%' or "
             "'0.01abs'";
    case Kind::kLength:
      return "a positive number, in the coordinates' unit, a string such as '0.1%' or '0.01abs'";
    case Kind::kLengths:
      return "a list of positive numbers, in the coordinates' unit, or of strings such as '0.1%' "
             "or '0.01abs'";
    case Kind::kShare:
      return "a share of the area above 0 and at most 1, such as 0.995 or '99.5%'";
    case Kind::kPercentile:
      return "a number above 0 and at most 100, such as 95, or '0.5%'";
    case Kind::kAngle:
      return "an angle above 0 and at most 90 degrees";
    case Kind::kSize:
      return "a number of bytes above 0, a string such as '2GiB'";
    case Kind::kTime:
      return "a number of seconds, 0 or more";
    case Kind::kCount:
      return whole_number(option);
    case Kind::kFile:
      return "the path of a file that ends in .vhc";
    case Kind::kInput:
      return "an array of four rows of four numbers, the last 0 0 0 1, the path of such a file";
    default:
      return quoted_choices(option);
  }
}

/// A value as the table reads it.
struct Typed {
  std::string text;
  Outlet outlet;
};

/// A number is a share, or a percentage; a text says itself which it is: "99.5%".
void check_part(const Option& option, const Value& value, const std::string& text) {
  const bool is_part = option.kind == Kind::kShare || option.kind == Kind::kPercentile;
  if (!is_part || text.ends_with('%')) return;
  if (option.kind == Kind::kShare) value.refuse();
  refuse_type(value.name, value.expected, value.given);
}

Typed typed(const Option& option, const Value& value) {
  const Kind kind = option.kind;
  const bool is_number = kind == Kind::kTime || kind == Kind::kAngle;
  const bool is_text = kind == Kind::kUnit || kind == Kind::kChoice || kind == Kind::kSize;
  if (is_number || (!is_text && !value.is_text()))
    return {shortest_decimal(number_from(value.name, value.expected, value.given)),
            Outlet::kPythonNumber};
  Typed one{value.text(), Outlet::kPythonText};
  check_part(option, value, one.text);
  return one;
}

bool is_row(const py::object& given) {
  if (py::isinstance<py::str>(given)) return false;
  const auto array = py::array::ensure(given);
  if (!array) PyErr_Clear();
  return array && array.ndim() == 1;
}

std::vector<Length> lengths_from(const Option& option, const Value& value) {
  const bool is_list =
      py::isinstance<py::list>(value.given) || py::isinstance<py::tuple>(value.given);
  if (!is_list && !(py::isinstance<py::array>(value.given) && is_row(value.given)))
    refuse_type(value.name, "a list of distances", value.given);
  std::vector<Length> lengths;
  for (const py::handle one : value.given) {
    const auto given = py::reinterpret_borrow<py::object>(one);
    const Value item{value.name, value.expected, given};
    const auto [text, outlet] = typed(option, item);
    try {
      lengths.push_back(length_of(option.kind, {value.name, {}, outlet}, text));
    } catch (const UsageError&) {
      item.refuse();
    }
  }
  return lengths;
}

uint64_t whole_of(const Option& option, const Arguments& all, const Value& value) {
  const uint64_t number = all.whole(value.name, value.expected).value_or(0);
  const bool is_size = option.kind == Kind::kSize;
  const bool is_one = is_size ? number > 0 : is_within(option, static_cast<double>(number));
  if (!is_one) value.refuse();
  return number;
}

std::string path_of_certificate(const Value& value) {
  const std::optional<std::string> path = path_from(value.name, value.given);
  if (!path) refuse_type(value.name, value.expected, value.given);
  if (!path->ends_with(".vhc")) value.refuse();
  return *path;
}

/// Whether the table reads a value, as it reads what is typed.
bool is_as_typed(const Option& option, const Value& value) {
  switch (option.kind) {
    case Kind::kUnit:
    case Kind::kChoice:
    case Kind::kShare:
    case Kind::kPercentile:
    case Kind::kLength:
    case Kind::kTolerance:
    case Kind::kAngle:
    case Kind::kTime:
      return true;
    default:
      return option.kind == Kind::kSize && value.is_text();
  }
}

/// Whether the table's own message says more: about a percentile, 0.95 or 95; about limits of two
/// sides, which one is missing.
bool says_more(const Option& option, const Typed& one) {
  const bool is_sided = one.text.starts_with('+') || one.text.starts_with('-');
  return option.kind == Kind::kPercentile ||
         (is_sided && std::string_view(option.name) == "max" && one.outlet == Outlet::kPythonText);
}

/// A default, such as 'refuse', may be none of the command line's choices.
void read_as_typed(const Option& option, const Value& value, Request& asked) {
  const Typed one = typed(option, value);
  const bool is_default = one.text.empty() || "'" + one.text + "'" == option.none;
  if (option.kind == Kind::kChoice && is_default) return;
  try {
    put(option, {value.name, std::span(&one.text, 1), one.outlet}, asked);
  } catch (const UsageError&) {
    if (says_more(option, one)) throw;
    value.refuse();
  }
}

// Options that Python reads by special rules.

/// Reads the limits of A's faces. The limit of the whole is the largest of them.
void read_face_limits(const Value& max, Question& question) {
  refuse_masked("max", max.given);
  const auto numbers =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(max.given);
  if (!numbers) PyErr_Clear();
  if (!numbers) refuse_type("max", max.expected, max.given);
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

void read_max(const Value& max, Functions function, Request& asked) {
  if (function == kPyGate && !max.is_text() && is_row(max.given))
    read_face_limits(max, asked.question);
  else
    read_as_typed(*option_of("max"), max, asked);
}

void read_field(const Value& field, Request& asked) {
  asked.question.faces = !is_bool(field.given) || py::cast<bool>(field.given);
  if (!is_bool(field.given)) read_as_typed(*option_of("field-tol"), field, asked);
}

MatrixRows matrix_from(const Value& value) {
  refuse_masked("transform", value.given);
  const auto numbers =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value.given);
  if (!numbers) PyErr_Clear();
  if (!numbers || numbers.ndim() != 2) refuse_type(value.name, value.expected, value.given);
  const bool is_square = numbers.shape(0) == 4 && numbers.shape(1) == 4;
  if (!is_square) value.refuse();
  const double* entry = numbers.data();
  if (entry[12] != 0 || entry[13] != 0 || entry[14] != 0 || entry[15] != 1) value.refuse();
  MatrixRows rows;
  for (size_t i = 0; i < 12; ++i) rows[i / 4][i % 4] = entry[i];
  return rows;
}

void read_transform(const Value& value, Question& question) {
  if (const std::optional<std::string> file = path_from("transform", value.given)) {
    question.transform_file = *file;
    question.transform = read_matrix(path_of(*file));
  } else {
    question.transform = matrix_from(value);
  }
}

struct OwnRow {
  std::string_view name;
  const char* expected;
  void (*read)(const Value& value, Functions function, Request& asked);
};

const OwnRow* own_row(std::string_view name) {
  static const OwnRow rows[] = {
      {"max", "", read_max},
      {"field-tol",
       "True or False, or how narrow each face's bounds are to be: a positive number, a fraction "
       "of A's diagonal, or a string such as '0.1%' or '0.01abs'",
       [](const Value& value, Functions, Request& asked) { read_field(value, asked); }},
      {"points", "True for a, 'a', 'b' or 'both', or None",
       [](const Value& value, Functions, Request& asked) {
         const PointSides sides = point_sides(value.given);
         asked.question.points_a = sides.a;
         asked.question.points_b = sides.b;
       }},
      {"transform", "", [](const Value& value, Functions, Request& asked) {
         read_transform(value, asked.question);
       }}};
  const auto* const found = std::find_if(std::begin(rows), std::end(rows),
                                         [&](const OwnRow& row) { return row.name == name; });
  return found == std::end(rows) ? nullptr : found;
}

template <class T, class... Types>
constexpr bool is_one_of = (std::is_same_v<T, Types> || ...);

/// Reads a keyword's value, by the member's type and the option's kind.
struct ValueReader {
  const Option& option;
  const Arguments& all;
  const Value& given;

  template <class T>
  T value() const {
    if constexpr (std::is_same_v<T, bool>)
      return all.flag(given.name);
    else if constexpr (std::is_same_v<T, std::string>)
      return path_of_certificate(given);
    else if constexpr (is_one_of<T, Length, double, PartOf>)
      given.refuse();  // the table reads those, and no keyword is a part
    else if constexpr (std::is_same_v<T, std::vector<std::string>>)
      return all.texts(given.name);
    else if constexpr (std::is_same_v<T, std::vector<Length>>)
      return lengths_from(option, given);
    else
      return static_cast<T>(whole_of(option, all, given));
  }
};

/// The values that a keyword may have, as its messages say.
std::string expected_of(const Option& option, Functions function) {
  const OwnRow* own = own_row(option.name);
  if (own != nullptr && *own->expected != '\0') return own->expected;
  const bool is_max = std::string_view(option.name) == "max";
  if (is_max && function == kPyGate)
    return expected_of_kind(option) + ", or a number for each face of A";
  std::string expected = expected_of_kind(option);
  if (takes_none(option, function)) return expected + ", or None";
  const size_t last = expected.find(", a string");  // it is the last that it may be
  return last == std::string::npos ? expected : expected.insert(last + 2, "or ");
}

void read(const Option& option, Functions function, const Arguments& all, Request& asked) {
  const std::string name = keyword_name(option);
  const py::object* given = all.find(name.c_str());
  if (given == nullptr || (given->is_none() && takes_none(option, function))) return;
  const std::string expected = expected_of(option, function);
  const Value value{name.c_str(), expected.c_str(), *given};
  const OwnRow* own = own_row(option.name);
  if (own != nullptr) {
    own->read(value, function, asked);
  } else if (is_as_typed(option, value)) {
    read_as_typed(option, value, asked);
  } else {
    fill(option, asked, ValueReader{option, all, value});
  }
  const bool is_off = option.kind == Kind::kFlag && !py::cast<bool>(*given);
  if (!is_off) asked.given.insert(option.name);
}

std::string named(std::string_view option) {
  if (option == "face-max") return "limits of A's faces";
  const Option* row = option_of(option);
  return row == nullptr ? std::string(option) : keyword_name(*row);
}

template <class Add>
void for_each_keyword(Functions function, const std::vector<std::string>& own, const Add& add) {
  for (const Option& option : options()) {
    const bool is_one = (option.functions & function) != 0;
    if (is_one && !is_among(own, keyword_name(option))) add(option);
  }
}

}  // namespace

Signature signature_of(Functions function, const char* name, const std::vector<std::string>& own,
                       size_t required, size_t positional) {
  Signature signature{name, own, required, positional};
  for_each_keyword(function, own,
                   [&](const Option& option) { signature.names.push_back(keyword_name(option)); });
  return signature;
}

std::string keywords_text(Functions function, const std::vector<std::string>& own) {
  std::string text;
  for_each_keyword(function, own, [&](const Option& option) {
    text +=
        (text.empty() ? "" : ", ") + keyword_name(option) + "=" + keyword_default(option, function);
  });
  return text;
}

namespace {

bool has_word(const std::string& text, const std::string& word) {
  const auto is_inner = [&](size_t at) {
    return at < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
  };
  for (size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) {
    if (!(at > 0 && is_inner(at - 1)) && !is_inner(at + word.size())) return true;
  }
  return false;
}

}  // namespace

std::string more_text(Functions function, const std::string& text) {
  std::string more;
  for_each_keyword(function, {}, [&](const Option& option) {
    const std::string name = keyword_name(option);
    if (option.uses.empty() || has_word(text, name)) return;
    more += "\n\n" + name + ": " + option.uses.front().help;
  });
  return more;
}

Request request_of(Functions function, const char* command, const Arguments& given) {
  const FloatEnvironment ours;
  Request asked;
  asked.command = kPython;
  asked.metrics = function == kPyMetrics;
  Question& question = asked.question;
  question.command = command;
  question.budget.survey_time_s = std::numeric_limits<double>::infinity();
  for_each_keyword(function, {"device"},
                   [&](const Option& option) { read(option, function, given, asked); });
  if (!asked.has("tol")) question.tolerance = default_tolerance(question.max.has_value());
  check_together(asked, named);
  complete(asked, named);
  return asked;
}

std::string key_of_keywords(Functions function, const py::kwargs& given) {
  const Signature signature = signature_of(function, "_key", {}, 0, 0);
  return key_text(request_of(function, "distance", Arguments(signature, py::args(), given)));
}

}  // namespace vkh::python
