#include "host/answer/json_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "host/answer/json_text.h"
#include "host/base/from_chars.h"

namespace vkh {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse_kind(const char* key, const char* expected) {
  throw InputError(std::string(key) + " is no " + expected);
}

const std::string& text_in(const Json& json, const char* key) {
  if (!json.is_string()) refuse_kind(key, "text");
  return json.get_ref<const std::string&>();
}

double number_in(const Json& json, const char* key) {
  if (!json.is_number()) refuse_kind(key, "number");
  return json.get<double>();
}

// Names an array or object by its kind alone: it may be deep.
std::string as_written(const Json& value) {
  if (value.is_structured()) return value.is_array() ? "array" : "object";
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Reads the text of hex_float() with from_chars, which no locale changes.
double double_of_hex(const std::string& key, std::string_view text, bool is_signed) {
  if (text == "inf") return kInfinity;
  if (is_signed && text.starts_with('-')) {
    if (text == "-inf") return -kInfinity;
    return -double_of_hex(key, text.substr(1), false);
  }
  const std::string_view digits = text.starts_with("0x") ? text.substr(2) : "";
  const char* end = digits.data() + digits.size();
  double value = 0;
  const auto result = number_from_chars(digits.data(), end, value, std::chars_format::hex);
  if (result.ec != std::errc() || result.ptr != end || !(value >= 0))
    throw InputError(key + " '" + std::string(text) + "' is no bound");
  return value;
}

// Compares exactly: the decimal has enough digits to be read back as the same double.
bool is_double(const Json& decimal, double bound) {
  if (decimal.is_null()) return std::isinf(bound);
  return decimal.is_number() && decimal.get<double>() == bound;
}

/// Versions are numbers between points. A text of another form counts as later than any version.
bool is_before(const std::string& version, const char* other) {
  const auto numbers = [](std::string_view text) {
    std::array<int, 3> all{std::numeric_limits<int>::max(), 0, 0};
    const char *at = text.data(), *end = at + text.size();
    for (int& number : all) {
      const auto [next, error] = std::from_chars(at, end, number);
      if (error != std::errc()) break;
      at = next == end ? end : next + 1;
    }
    return all;
  };
  return numbers(version) < numbers(other);
}

/// An array of kCount numbers.
template <size_t kCount>
std::array<double, kCount> numbers_in(const Json& json, const char* key, const char* expected) {
  std::array<double, kCount> numbers{};
  if (!json.is_array() || json.size() != kCount) refuse_kind(key, expected);
  for (size_t i = 0; i < kCount; ++i) {
    if (!json[i].is_number()) refuse_kind(key, expected);
    numbers[i] = json[i].get<double>();
  }
  return numbers;
}

}  // namespace

const Json* JsonReader::find(std::string_view key) {
  const auto& object = at_->get_ref<const Json::object_t&>();
  const auto* members = object.data();
  const size_t count = object.size();
  for (size_t i = 0, at = next_; i < count; ++i, ++at) {
    if (at >= count) at = 0;
    if (members[at].first != key) continue;
    next_ = at;
    return &members[at].second;
  }
  return nullptr;
}

const Json& JsonReader::needed(const char* key) {
  const Json* json = find(key);
  if (json == nullptr) throw InputError(std::string("no ") + key);
  return *json;
}

std::string JsonReader::needed_text(const char* key) { return text_in(needed(key), key); }

const Json* JsonReader::member(const char* key) {
  if (missing_ == Missing::kRefused) return &needed(key);
  const Json* json = find(key);
  if (json == nullptr && !compares_) lacking_.emplace_back(key);
  return json;
}

void JsonReader::enter(const Json& json, const char* key) {
  if (!json.is_object()) refuse_kind(key, "object");
  at_ = &json;
  next_ = 0;
}

const Json& JsonReader::array_in(const Json& json, const char* key) {
  if (!json.is_array()) refuse_kind(key, "array");
  return json;
}

const Json* JsonReader::array(const char* key) {
  const Json* json = member(key);
  return json == nullptr ? nullptr : &array_in(*json, key);
}

uint64_t JsonReader::count_in(const Json& json, const char* key) {
  const bool is_count =
      json.is_number_unsigned() || (json.is_number_integer() && json.get<int64_t>() >= 0);
  if (!is_count)
    throw InputError(std::string(key) + " " + as_written(json) +
                     " is no whole number of 0 or more");
  return json.get<uint64_t>();
}

void JsonReader::text(const char* key, std::string& text) {
  if (const Json* json = unread(key)) text = text_in(*json, key);
}

void JsonReader::text_or_null(const char* key, std::string& text) {
  const Json* json = unread(key);
  if (json != nullptr) text = json->is_null() ? "" : text_in(*json, key);
}

void JsonReader::number(const char* key, double& number) {
  if (const Json* json = unread(key)) number = number_in(*json, key);
}

// JSON has no infinity: the writer makes it null.
void JsonReader::number_or_null(const char* key, double& number) {
  const Json* json = unread(key);
  if (json != nullptr) number = json->is_null() ? kInfinity : number_in(*json, key);
}

void JsonReader::number_or_none(const char* key, std::optional<double>& number) {
  const Json* json = unread(key);
  if (json != nullptr && !json->is_null()) number = number_in(*json, key);
}

void JsonReader::number_if_known(const char* key, double& number, bool) {
  const Json* json = unread(key);
  if (json != nullptr) number = json->is_null() ? 0 : number_in(*json, key);
}

void JsonReader::number_since(const char* version, const char* key, double& number, bool is_known) {
  const bool may_lack_it = missing_ == Missing::kRefused && is_before(*version_, version);
  if (!may_lack_it || find(key) != nullptr) number_if_known(key, number, is_known);
}

void JsonReader::said(const char* key, std::string& kept, const Answer& answer) {
  text(key, kept);
  const bool is_compared = compares_ && is_of_this_version();
  const std::optional<std::string> implied = is_compared ? implied_words(answer) : std::nullopt;
  if (implied && kept != *implied && kept != in_utf8(*implied))
    throw InputError(std::string(key) + " are not those of the answer");
}

void JsonReader::count_or_none(const char* key, std::optional<uint64_t>& count) {
  const Json* json = unread(key);
  if (json != nullptr && !json->is_null()) count = count_in(*json, key);
}

void JsonReader::count_if_any(const char* key, uint64_t& count) {
  if (const Json* json = find(key)) count = count_in(*json, key);
}

void JsonReader::truth(const char* key, bool& truth) {
  const Json* json = unread(key);
  if (json == nullptr) return;
  if (!json->is_boolean()) refuse_kind(key, "truth value");
  truth = json->get<bool>();
}

void JsonReader::mark(const char* key, bool& is_there) {
  if (find(key) != nullptr) truth(key, is_there);
}

void JsonReader::exit_code(const char* key, ExitCode& code) {
  if (compares_) return;
  const uint64_t number = count_in(needed(key), key);
  if (number > kExitNotWritten && number != kExitInternal)
    throw InputError("a result with the code " + std::to_string(number));
  code = static_cast<ExitCode>(number);
}

void JsonReader::note_code(const char* key, NoteCode& code) {
  const Json* json = unread(key);
  const auto known = json == nullptr ? std::nullopt : code_named(text_in(*json, key));
  if (known) code = *known;
}

// The text is what was typed; the number in it is not written apart.
void JsonReader::length(const char* key, Length& length) {
  const Json* json = unread(key);
  if (json == nullptr) return;
  const std::string& text = text_in(*json, key);
  const Json* of = find("diagonal_of");
  const bool is_share = of != nullptr && !of->is_null();
  length = {.requested = text, .of = is_share ? Length::Of::kDiagonal : Length::Of::kFiles};
  if (text.empty()) return;
  try {
    length = parse_length(key, text, PlainNumber::kFraction);
  } catch (const UsageError&) {
    throw InputError(std::string(key) + " '" + text + "' is no length");
  }
}

void JsonReader::face(const char* key, SurfacePoint& point) {
  count(key, point.file_face);
  point.face = point.file_face;
}

double JsonReader::bound_at(const char* key, bool is_signed) {
  const std::string hex_key = std::string(key) + "_hex";
  const Json *decimal = find(key), *hex = find(hex_key);
  if (decimal == nullptr || hex == nullptr || !hex->is_string())
    throw InputError(std::string("no ") + key + " with its " + hex_key);
  const auto& text = hex->get_ref<const std::string&>();
  const double value = double_of_hex(hex_key, text, is_signed);
  if (!is_double(*decimal, value))
    throw InputError(hex_key + " '" + text + "' is another number than " + key + " " +
                     as_written(*decimal));
  return value;
}

Enclosure JsonReader::ends_at(bool is_signed) {
  const Enclosure e{bound_at("lower", is_signed), bound_at("upper", is_signed)};
  if (e.lower > e.upper || e.lower == kInfinity)
    throw InputError("an interval whose lower end is above its upper");
  return e;
}

void JsonReader::read_ends(double& lower, double& upper, bool is_signed) {
  if (compares_) return;
  const Enclosure e = ends_at(is_signed);
  lower = e.lower;
  upper = e.upper;
}

void JsonReader::enclosure(Enclosure& e) {
  if (compares_) return;
  e = ends_at(false);
  const Json* estimate = find("estimate");
  if (estimate == nullptr) return;
  e.estimate = number_in(*estimate, "estimate");
  if (!(*e.estimate >= e.lower && *e.estimate <= e.upper))
    throw InputError("an estimate that is not in its interval");
}

void JsonReader::compare_ends(const CertifiedInterval& implied, const char* refusal) {
  const Enclosure e = ends_at(false);
  if (e.lower != implied.lower || e.upper != implied.upper) throw InputError(refusal);
}

void JsonReader::beside(const char* key, const std::string& text) {
  const Json* json = compares_ ? find(key) : nullptr;
  if (json != nullptr && !is_same(*json, TextOrNull{text}))
    throw InputError(std::string(key) + " is not that of the answer");
}

bool JsonReader::is_same(const Json& json, const TextOrNull& text) {
  return text.text.empty() ? json.is_null() : json.is_string() && json == text.text;
}

bool JsonReader::is_same(const Json& json, double number) {
  if (json.is_null()) return !std::isfinite(number);
  return json.is_number() && json.get<double>() == number;
}

bool JsonReader::is_some(const char* key, bool& is_there) {
  const Json* json = member(key);
  if (!compares_) is_there = json != nullptr && !json->is_null();
  return json != nullptr && !json->is_null();
}

void fill_in_reverse(const Json& json, Answer& answer) {
  if (!answer.b_to_a) return;
  Report& back = *answer.b_to_a;
  back.tolerance = answer.a_to_b.tolerance;
  if (json.contains("tolerance") && json["tolerance"].contains("diagonal_b")) return;
  const std::optional<Box>& box = answer.inputs[1].box;
  back.diagonal_a = box ? diagonal(*box) : answer.a_to_b.diagonal_a;
  const Json& interval = json["directions"][1]["interval"];
  const Json gap = interval.contains("gap") ? interval["gap"] : Json();
  if (back.gap() != (gap.is_number() ? gap.get<double>() : kInfinity))
    back.diagonal_a = answer.a_to_b.diagonal_a;
}

std::optional<Note> JsonReader::note_in(const Json& json) {
  if (json.is_string()) {  // "code: text", before 0.3.0
    const auto& line = json.get_ref<const std::string&>();
    const size_t end = std::min(line.find(": "), line.size());
    const std::optional<NoteCode> code = code_named(line.substr(0, end));
    if (!code) return std::nullopt;
    return note_of(*code, line.substr(std::min(end + 2, line.size())));
  }
  const auto code = json.is_object() ? json.find("code") : json.end();
  if (code == json.end() || !code->is_string() || !code_named(code->get<std::string>()))
    return std::nullopt;
  Note note{.code = NoteCode::kPolygons, .text = {}};
  JsonReader reader(json, Detail::kFull, Missing::kRefused);
  visit(reader, note);
  return note;
}

bool JsonReader::has_files(const char* key) {
  const Json* json = find(key);
  if (json != nullptr) return !json->is_null();
  if (missing_ == Missing::kRefused)
    throw InputError(
        "no word on files that were read besides A and B, as answers have since 0.2.0");
  if (!compares_) lacking_.emplace_back(key);
  return false;
}

void JsonReader::texts(const char* key, std::vector<std::string>& texts) {
  const Json* rows = compares_ ? nullptr : array(key);
  if (rows == nullptr) return;
  for (const Json& row : *rows) {
    if (!row.is_string()) refuse_kind(key, "array of texts");
    texts.push_back(row.get<std::string>());
  }
}

void JsonReader::vector(const char* key, DVec3& v) {
  const Json* json = unread(key);
  if (json == nullptr) return;
  const auto [x, y, z] = numbers_in<3>(*json, key, "array of three numbers");
  v = {x, y, z};
}

void JsonReader::two_numbers(const char* key, double& x, double& y) {
  const Json* json = unread(key);
  if (json == nullptr) return;
  const auto numbers = numbers_in<2>(*json, key, "array of two numbers");
  x = numbers[0];
  y = numbers[1];
}

void JsonReader::matrix(const char* key, std::optional<MatrixRows>& matrix) {
  constexpr const char* kExpected = "array of four rows of four numbers";
  const Json* json = unread(key);
  if (json == nullptr || json->is_null()) return;
  if (array_in(*json, key).size() != 4) refuse_kind(key, "array of four rows");
  matrix.emplace();
  for (size_t i = 0; i < matrix->size(); ++i)
    (*matrix)[i] = numbers_in<4>((*json)[i], key, kExpected);
  if (numbers_in<4>((*json)[3], key, kExpected) != std::array{0.0, 0.0, 0.0, 1.0})
    refuse_kind(key, "map of points");
}

void JsonReader::named_counts(const char* key, std::vector<CullCount>& counts) {
  object(key, [&] {
    if (compares_) return;
    for (const auto& [name, count] : at_->items())
      counts.push_back({name, count_in(count, name.c_str())});
  });
}

void JsonReader::counts(const char* of, bool& are_known, std::initializer_list<NamedCount> counts) {
  if (compares_) return;
  for (const NamedCount& one : counts) {
    const Json* json = member(one.key);
    if (json == nullptr) continue;
    if (&one == counts.begin()) are_known = !json->is_null();
    if (are_known) one.count = count_in(*json, one.key);
    if (!are_known && !json->is_null()) throw InputError(std::string(one.key) + " " + of);
  }
}

}  // namespace vkh
