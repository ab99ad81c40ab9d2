// The record of a page: what was measured, on which device, and how.
#include "host/answer/json_text.h"
#include "host/base/decimal.h"
#include "host/show/page_view.h"
#include "host/show/page_words.h"

namespace vkh {
namespace {

std::string text_or(const std::string& text, const char* otherwise) {
  return text.empty() ? otherwise : in_utf8(text);
}

std::string count_text(const Input& input, uint64_t count) {
  return input.is_read ? grouped(count) : "not known";
}

/// A row for both inputs; nothing if both texts are empty.
template <class Text>
void add_input_row(const Answer& answer, Json& rows, const char* name, const Text& text,
                   bool is_code = false) {
  const std::string a = text(answer.inputs[0]), b = text(answer.inputs[1]);
  if (a.empty() && b.empty()) return;
  rows.push_back({{"name", name},
                  {"a", a.empty() ? "0" : a},
                  {"b", b.empty() ? "0" : b},
                  {"is_code", is_code}});
}

/// A row for a count, where an input has some.
template <class Count>
void add_if_any(const Answer& answer, Json& rows, const char* name, const Count& count) {
  add_input_row(answer, rows, name, [&](const Input& input) {
    const uint64_t number = input.is_read ? count(input) : 0;
    return number > 0 ? grouped(number) : std::string();
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

std::string command_text(const Answer& answer) {
  std::string out = "vkhausdorff";
  for (const std::string& word : answer.words) out += " " + quoted(in_utf8(word));
  return out;
}

std::string duration_text(double ms) {
  const bool is_short = ms < 1000;
  return number_text(is_short ? ms : ms / 1e3, std::chars_format::general, 3) +
         (is_short ? "\u00a0ms" : "\u00a0s");
}

std::string times_text(const Answer& answer) {
  const Waits& waits = answer.waits;
  std::string out = duration_text(waits.total) + " in all: reading " + duration_text(waits.read) +
                    ", starting " + duration_text(waits.start);
  out += ", A to B " + duration_text(answer.a_to_b.times.wall_ms);
  if (answer.b_to_a) out += ", B to A " + duration_text(answer.b_to_a->times.wall_ms);
  return out;
}

// Writes the JSON's own digits, outward.
std::string every_digit(const Answer& answer) {
  const CertifiedInterval whole = interval_of(answer);
  const std::string lower = decimal(whole.lower, kJsonDigits, Rounding::kDown);
  if (!is_upper_sought(answer, whole.lower, whole.upper)) return "at least " + lower;
  return "[" + lower + ", " + decimal(whole.upper, kJsonDigits, Rounding::kUp) + "]";
}

std::string device_text(const DeviceDescription& device) {
  if (device.name.empty()) return "none was opened";
  if (device.type == kNative) return in_utf8(device.name) + ", without Vulkan";
  return in_utf8(device.name) + " (" + text_or(device.type, "other") + "), Vulkan " +
         text_or(device.api_version, "not known");
}

/// The other files that were read of an input, each with its hash.
std::string files_beneath_text(const Input& input) {
  std::string text;
  if (input.sha256.empty()) return text;
  for (const FileHash& file : input.files)
    text += (text.empty() ? "" : ", ") + text_or(file.path, "no name") + " " +
            text_or(file.sha256, "not known");
  return text;
}

// The unit of a file: its own, or the one that the answer is in.
std::string unit_of_input(const Answer& answer, const Input& input) {
  const std::string& own = input.place.unit;
  return own.empty() ? unit_text(answer) : own + ", by the file";
}

Json input_rows(const Answer& answer) {
  Json rows = Json::array();
  add_input_row(
      answer, rows, "file", [](const Input& input) { return text_or(input.path, "no file"); },
      true);
  add_input_row(
      answer, rows, "SHA-256",
      [](const Input& input) { return text_or(input.sha256, "not known"); }, true);
  add_input_row(answer, rows, "other files read", files_beneath_text, true);
  for (const bool are_points : {false, true}) {
    add_input_row(answer, rows, are_points ? "points" : "faces", [&](const Input& input) {
      return input.are_points == are_points ? count_text(input, input.counts.faces) : "";
    });
  }
  add_input_row(answer, rows, "vertices",
                [](const Input& input) { return count_text(input, input.counts.vertices); });
  add_if_any(answer, rows, "faces without area",
             [](const Input& input) { return input.are_points ? 0 : input.counts.degenerate; });
  add_if_any(answer, rows, "faces that are twice",
             [](const Input& input) { return input.counts.duplicate; });
  add_if_any(answer, rows, "polygons split",
             [](const Input& input) { return input.counts.polygons; });
  add_if_any(answer, rows, "unused vertices",
             [](const Input& input) { return input.counts.unreferenced; });
  add_input_row(answer, rows, "unit",
                [&](const Input& input) { return unit_of_input(answer, input); });
  add_input_row(answer, rows, "rounding in the file", [](const Input& input) {
    const double delta = input.place.delta;
    return delta > 0 ? "up to " + decimal(delta, 3, Rounding::kUp) : std::string();
  });
  return rows;
}

Json run_rows(const Answer& answer) {
  Json rows = Json::array();
  const auto add = [&](const char* name, const std::string& text, bool is_code = false) {
    rows.push_back({{"name", name}, {"text", text}, {"is_code", is_code}});
  };
  const Report& r = answer.a_to_b;
  add("command", command_text(answer), true);
  add("largest deviation, all digits", every_digit(answer), true);
  add("program", "vkhausdorff " + answer.version + ", preset " + text_or(r.preset, "default"));
  add("device", device_text(r.device));
  if (r.device.type != kNative) add("driver", text_or(r.device.driver, "not known"));
  add("measured", text_or(answer.started, "not known") + " on " +
                      text_or(answer.host, "a machine without a name"));
  add("time taken", times_text(answer));
  return rows;
}

// The note on one direction is a warning above.
Json note_texts(const Answer& answer) {
  Json texts = Json::array();
  const auto add = [&](const char* of, const std::vector<Note>& notes) {
    for (const Note& note : notes) {
      if (note.code != NoteCode::kOneWay) texts.push_back(of + in_utf8(note.text));
    }
  };
  add("", answer.notes);
  add("A: ", answer.inputs[0].notes);
  add("B: ", answer.inputs[1].notes);
  if (const auto& max = answer.max; max && (max->faces_a || max->faces_b))
    texts.push_back(
        "Faces have limits of their own, and the verdict is by those. The tolerance that is "
        "dragged here is one for all of them.");
  return texts;
}

}  // namespace

Json record_view(const Answer& answer) {
  Json notes = note_texts(answer);
  return {{"inputs", input_rows(answer)},
          {"run", run_rows(answer)},
          {"has_notes", !notes.empty()},
          {"has_more_notes", notes.size() > 3},  // as many as style.css prints
          {"notes", std::move(notes)},
          {"program", "vkhausdorff " + answer.version}};
}

}  // namespace vkh
