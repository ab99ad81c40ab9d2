// Numbers of an answer that a user may have changed since it was written.
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "host/answer/json_object.h"
#include "host/base/from_chars.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

constexpr std::string_view kHexEnd = "_hex";

/// Reads the text of hex_float() with from_chars, which no locale changes.
double double_of_hex(const std::string& key, const std::string& text, bool is_signed) {
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (is_signed && text.starts_with('-')) {
    if (text == "-inf") return -std::numeric_limits<double>::infinity();
    return -double_of_hex(key, text.substr(1), false);
  }
  const std::string digits = text.starts_with("0x") ? text.substr(2) : "";
  const char* end = digits.data() + digits.size();
  double value = 0;
  const auto result = number_from_chars(digits.data(), end, value, std::chars_format::hex);
  if (result.ec != std::errc() || result.ptr != end || !(value >= 0))
    throw InputError(key + " '" + text + "' is no bound");
  return value;
}

// Compares exactly: the decimal has so many digits that it is read back as the same double.
bool is_double(const Json& decimal, double bound) {
  if (decimal.is_null()) return std::isinf(bound);
  return decimal.is_number() && decimal.get<double>() == bound;
}

// Names an array or object by its kind alone: it may be deep.
std::string as_written(const Json& value) {
  if (value.is_structured()) return value.is_array() ? "array" : "object";
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

namespace {

double read_bound(const Json& interval, const std::string& key, bool is_signed) {
  const std::string hex_key = key + std::string(kHexEnd);
  const auto hex = interval.find(hex_key), decimal = interval.find(key);
  if (hex == interval.end() || decimal == interval.end() || !hex->is_string())
    throw InputError("no " + key + " with its " + hex_key);
  const auto& text = hex->get_ref<const std::string&>();
  const double value = double_of_hex(hex_key, text, is_signed);
  if (!is_double(*decimal, value))
    throw InputError(hex_key + " '" + text + "' is another number than " + key + " " +
                     as_written(*decimal));
  return value;
}

}  // namespace

double bound_in(const Json& interval, const std::string& key) {
  return read_bound(interval, key, false);
}
double signed_bound_in(const Json& interval, const std::string& key) {
  return read_bound(interval, key, true);
}

void check_bounds(const Json& answer) {
  struct Part {
    const Json* json;
    bool is_signed;
  };
  std::vector<Part> left{{&answer, false}};  // no recursion: a line may be nested deep
  while (!left.empty()) {
    const Part at = left.back();
    left.pop_back();
    for (const auto& [key, value] : at.json->items()) {
      if (value.is_structured()) left.push_back({&value, at.is_signed || key == "signed"});
      if (at.json->is_object() && key.ends_with(kHexEnd))
        (void)read_bound(*at.json, key.substr(0, key.size() - kHexEnd.size()), at.is_signed);
    }
  }
}

namespace {

template <class T>
T member_or(const Json& note, const char* key, T otherwise) {
  const auto found = note.find(key);
  return found == note.end() || found->is_null() ? otherwise : found->get<T>();
}

std::optional<Note> note_in(const Json& json) {
  if (json.is_string()) {
    const auto line = json.get<std::string>();
    const size_t end = std::min(line.find(": "), line.size());
    const std::optional<NoteCode> code = code_named(line.substr(0, end));
    if (!code) return std::nullopt;
    return note_of(*code, line.substr(std::min(end + 2, line.size())));
  }
  if (!json.is_object()) return std::nullopt;
  const std::optional<NoteCode> code = code_named(member_or<std::string>(json, "code", ""));
  if (!code) return std::nullopt;
  Note note = note_of(*code, member_or<std::string>(json, "text", ""));
  if (json.contains("value") && json["value"].is_number()) note.value = json["value"];
  note.unit = member_or<std::string>(json, "unit", "");
  note.file = member_or<std::string>(json, "file", "");
  if (json.contains("face") && json["face"].is_number_unsigned()) note.face = json["face"];
  return note;
}

}  // namespace

std::vector<Note> notes_in(const Json& object) {
  std::vector<Note> notes;
  const auto found = object.is_object() ? object.find("notes") : object.end();
  if (found == object.end() || !found->is_array()) return notes;
  try {
    for (const Json& json : *found) {
      if (std::optional<Note> note = note_in(json)) notes.push_back(std::move(*note));
    }
  } catch (const Json::exception&) {
    throw InputError("a note whose text, unit or file is no text");
  }
  return notes;
}

Json notes_json(std::span<const Note> notes, const std::string& file) {
  Json rows = Json::array();
  for (const Note& note : notes) {
    rows.push_back({{"code", code_name(note.code)},
                    {"text", note.text},
                    {"value", note.value ? Json(*note.value) : Json()},
                    {"unit", text_or_null(note.unit)},
                    {"file", text_or_null(note.file.empty() ? file : note.file)},
                    {"face", note.face ? Json(*note.face) : Json()}});
  }
  return rows;
}

uint64_t count_in(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  if (found == object.end()) throw InputError("no " + key);
  const bool is_count =
      found->is_number_unsigned() || (found->is_number_integer() && found->get<int64_t>() >= 0);
  if (!is_count)
    throw InputError(key + " " + as_written(*found) + " is no whole number of 0 or more");
  return found->get<uint64_t>();
}

}  // namespace vkh
