// The record of a page: what was measured, on which device, and how.
#include <cmath>

#include "host/base/decimal.h"
#include "host/show/page_view.h"
#include "host/show/page_words.h"

namespace vkh {
namespace {

std::string count_text(const Json& number) {
  if (!number.is_number()) return "not known";
  return grouped(number.get<uint64_t>());
}

std::string text_or(const Json& text, const char* otherwise) {
  return text.is_string() && !text.get<std::string>().empty() ? text.get<std::string>() : otherwise;
}

/// A row for both inputs; nothing where both texts are empty.
template <class Text>
void add_row(const PageText& page, Json& rows, const char* name, const Text& text,
             bool is_code = false) {
  const Json& inputs = page.json["inputs"];
  const std::string a = text(inputs[0]), b = text(inputs[1]);
  if (a.empty() && b.empty()) return;
  rows.push_back({{"name", name},
                  {"a", a.empty() ? "0" : a},
                  {"b", b.empty() ? "0" : b},
                  {"is_code", is_code}});
}

void add_count(const PageText& page, Json& rows, const char* name, const char* key,
               bool even_if_none) {
  add_row(page, rows, name, [&](const Json& input) {
    const Json& number = input[key];
    if (!even_if_none && (!number.is_number() || number == 0)) return std::string();
    return count_text(number);
  });
}

// Quotes for a shell; control characters stay as they are and are made visible later.
std::string quoted(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

std::string command_text(const Json& json) {
  std::string out = "vkhausdorff";
  for (const Json& word : json["arguments"]) out += " " + quoted(word.get<std::string>());
  return out;
}

std::string duration_text(double ms) {
  const bool is_short = ms < 1000;
  return number_text(is_short ? ms : ms / 1e3, std::chars_format::general, 3) +
         (is_short ? "\u00a0ms" : "\u00a0s");
}

std::string times_text(const PageText& page) {
  const Json& times = page.json["times"];
  std::string out = duration_text(times["total_ms"].get<double>()) + " in all: reading " +
                    duration_text(times["read_ms"].get<double>()) + ", starting " +
                    duration_text(times["start_ms"].get<double>());
  out += ", A to B " + duration_text(page.answer.a_to_b.times.wall_ms);
  if (page.answer.b_to_a) out += ", B to A " + duration_text(page.answer.b_to_a->times.wall_ms);
  return out;
}

// Writes the JSON's own digits, outward.
std::string every_digit(const PageText& page) {
  const CertifiedInterval whole = interval_of(page.answer);
  const std::string lower = decimal(whole.lower, kJsonDigits, Rounding::kDown);
  if (!is_upper_sought(page.answer, whole.lower, whole.upper)) return "at least " + lower;
  return "[" + lower + ", " + decimal(whole.upper, kJsonDigits, Rounding::kUp) + "]";
}

std::string device_text(const Json& json) {
  const Json& device = json["device"];
  if (!device.is_object()) return "none was opened";
  return text_or(device["name"], "not known") + " (" + text_or(device["type"], "other") +
         "), Vulkan " + text_or(device["api_version"], "not known");
}

/// The other files that were read of an input, each with its hash.
std::string files_beneath_text(const Json& input) {
  std::string text;
  if (!input["files"].is_array()) return text;
  for (const Json& file : input["files"])
    text += (text.empty() ? "" : ", ") + text_or(file["path"], "no name") + " " +
            text_or(file["sha256"], "not known");
  return text;
}

// The unit of a file: its own, or the one that the answer is in.
std::string unit_of_input(const PageText& page, const Json& input) {
  const std::string own = text_or(input["unit"], "");
  return own.empty() ? unit_text(page.answer) : own + ", by the file";
}

Json input_rows(const PageText& page) {
  Json rows = Json::array();
  add_row(
      page, rows, "file", [](const Json& input) { return text_or(input["path"], "no file"); },
      true);
  add_row(
      page, rows, "SHA-256",
      [](const Json& input) { return text_or(input["sha256"], "not known"); }, true);
  add_row(page, rows, "other files read", files_beneath_text, true);
  for (const bool are_points : {false, true}) {
    add_row(page, rows, are_points ? "points" : "faces", [&](const Json& input) {
      return input.value("points", false) == are_points ? count_text(input["faces"]) : "";
    });
  }
  add_count(page, rows, "vertices", "vertices", true);
  add_row(page, rows, "faces without area", [](const Json& input) {
    const Json& number = input["degenerate"];
    const bool has_some = !input.value("points", false) && number.is_number() && number != 0;
    return has_some ? count_text(number) : std::string();
  });
  add_count(page, rows, "faces that are twice", "duplicate", false);
  add_count(page, rows, "polygons split", "polygons", false);
  add_count(page, rows, "unused vertices", "unreferenced", false);
  add_row(page, rows, "unit", [&](const Json& input) { return unit_of_input(page, input); });
  add_row(page, rows, "rounding in the file", [](const Json& input) {
    const double delta = input["delta"].get<double>();
    return delta > 0 ? "up to " + decimal(delta, 3, Rounding::kUp) : std::string();
  });
  return rows;
}

Json run_rows(const PageText& page) {
  const Json& json = page.json;
  Json rows = Json::array();
  const auto add = [&](const char* name, const std::string& text, bool is_code = false) {
    rows.push_back({{"name", name}, {"text", text}, {"is_code", is_code}});
  };
  add("command", command_text(json), true);
  add("largest deviation, all digits", every_digit(page), true);
  add("program", "vkhausdorff " + json["version"].get<std::string>() + ", preset " +
                     text_or(json["options"]["preset"], "default"));
  add("device", device_text(json));
  add("driver", text_or(json["driver"], "not known"));
  add("measured", text_or(json["started"], "not known") + " on " +
                      text_or(json["host"], "a machine without a name"));
  add("time taken", times_text(page));
  return rows;
}

// The note on one direction is a warning above.
Json note_texts(const PageText& page) {
  Json texts = Json::array();
  const auto add = [&](const std::string& of, const Json& note) {
    if (note["code"] != code_name(NoteCode::kOneWay))
      texts.push_back(of + note["text"].get<std::string>());
  };
  for (const Json& note : page.json["notes"]) add("", note);
  for (const Json& input : page.json["inputs"]) {
    for (const Json& note : input["notes"])
      add(text_or(input["name"], "") == "a" ? "A: " : "B: ", note);
  }
  if (const auto& max = page.answer.max; max && (max->faces_a || max->faces_b))
    texts.push_back(
        "Faces have limits of their own, and the verdict is by those. The tolerance that is "
        "dragged here is one for all of them.");
  return texts;
}

}  // namespace

Json record_view(const PageText& page) {
  Json notes = note_texts(page);
  return {{"inputs", input_rows(page)},
          {"run", run_rows(page)},
          {"has_notes", !notes.empty()},
          {"has_more_notes", notes.size() > 3},  // as many as style.css prints
          {"notes", std::move(notes)},
          {"program", "vkhausdorff " + page.json["version"].get<std::string>()}};
}

}  // namespace vkh
