// The record of a page as HTML: what was measured, on which device, and how.
#include <array>
#include <cmath>
#include <cstdio>

#include "host/base/decimal.h"
#include "host/show/escape.h"
#include "host/show/page_markup.h"

namespace vkh {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kPrintedNotes = 3;  // as style.css has it

std::string head(const std::string& name) {
  return "<tr><th scope=\"row\">" + html_text(name) + "</th>";
}
std::string table_cell(const std::string& text) {
  return "<td><span class=\"clip\">" + html_text(text) + "</span></td>";
}
std::string code_cell(const std::string& text) {
  return "<td><code class=\"clip\">" + html_text(text) + "</code></td>";
}

std::string count_text(const Json& number) {
  if (!number.is_number()) return "not known";
  return grouped(number.get<uint64_t>());
}

std::string text_or(const Json& text, const char* otherwise) {
  return text.is_string() && !text.get<std::string>().empty() ? text.get<std::string>() : otherwise;
}

/// Writes a row for both inputs, left out if `is_worth` returns false for both.
template <class Text>
std::string input_row(const PageText& page, const char* name, const Text& text) {
  const Json& inputs = page.json["inputs"];
  const std::string a = text(inputs[0]), b = text(inputs[1]);
  if (a.empty() && b.empty()) return "";
  return head(name) + table_cell(a.empty() ? "0" : a) + table_cell(b.empty() ? "0" : b) + "</tr>";
}

std::string count_row(const PageText& page, const char* name, const char* key, bool even_if_none) {
  return input_row(page, name, [&](const Json& input) {
    const Json& number = input[key];
    if (!even_if_none && (!number.is_number() || number == 0)) return std::string();
    return count_text(number);
  });
}

std::string line_of_json(const Json& note) {
  return note["code"].get<std::string>() + ": " + note["text"].get<std::string>();
}

std::string input_notes(const Json& input) {
  std::string out;
  for (const Json& note : input["notes"]) {
    out += "<li>" + html_text(text_or(input["name"], "") == "a" ? "A: " : "B: ") +
           html_text(line_of_json(note)) + "</li>";
  }
  return out;
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
  return "[" + decimal(whole.lower, kJsonDigits, Rounding::kDown) + ", " +
         decimal(whole.upper, kJsonDigits, Rounding::kUp) + "]";
}

std::string tolerance_text(const PageText& page) {
  const double gap = interval_of(page.answer).gap;
  std::string asked = text_or(page.json["tolerance"]["requested"], "none");
  if (!std::isfinite(gap)) return asked;
  return asked + "; the interval is " + decimal(gap, 2, Rounding::kUp) + " of A's diagonal wide";
}

std::string device_text(const Json& json) {
  const Json& device = json["device"];
  if (!device.is_object()) return "none was opened";
  return text_or(device["name"], "not known") + " (" + text_or(device["type"], "other") +
         "), Vulkan " + text_or(device["api_version"], "not known");
}

/// The files that were read besides A and B, each with its hash; left out if there are none.
std::string beneath_row(const Json& inputs) {
  std::string cells;
  bool is_any = false;
  for (const Json& input : inputs) {
    cells += "<td>";
    if (input["files"].is_array()) {
      for (const Json& file : input["files"]) {
        is_any = true;
        cells += "<code class=\"clip\">" + html_text(text_or(file["path"], "no name")) +
                 "</code> <code>" + html_text(text_or(file["sha256"], "not known")) + "</code> ";
      }
    }
    cells += "</td>";
  }
  return is_any ? head("SHA-256 of files beneath") + cells + "</tr>" : "";
}

}  // namespace

std::string grouped(uint64_t count) {
  std::string digits = std::to_string(count);
  for (size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

std::string inputs_html(const PageText& page) {
  const auto path = [](const Json& input) { return code_cell(text_or(input["path"], "no file")); };
  const auto hash = [](const Json& input) {  // printed whole
    return "<td><code>" + html_text(text_or(input["sha256"], "not known")) + "</code></td>";
  };
  const Json& inputs = page.json["inputs"];
  std::string out =
      "<div class=\"pair\"><h2>Meshes</h2><table><thead><tr><th></th><th scope=\"col\">A</th>"
      "<th scope=\"col\">B</th></tr></thead><tbody>";
  out += head("file") + path(inputs[0]) + path(inputs[1]) + "</tr>";
  out += head("SHA-256") + hash(inputs[0]) + hash(inputs[1]) + "</tr>" + beneath_row(inputs);
  out += count_row(page, "faces", "faces", true) + count_row(page, "vertices", "vertices", true);
  out += count_row(page, "degenerate", "degenerate", false) +
         count_row(page, "duplicate", "duplicate", false) +
         count_row(page, "polygons", "polygons", false) +
         count_row(page, "unreferenced", "unreferenced", false);
  out += input_row(page, "unit", [](const Json& input) {
    return text_or(input["unit"], "the file does not say");
  });
  out += input_row(page, "displacement", [](const Json& input) {
    const double delta = input["delta"].get<double>();
    return delta > 0 ? decimal(delta, 3, Rounding::kUp) : std::string();
  });
  return out + "</tbody></table></div>";
}

std::string run_html(const PageText& page) {
  const Json& json = page.json;
  std::string out = "<div class=\"run\"><h2>Run</h2><table><tbody>";
  out += head("command") + code_cell(command_text(json)) + "</tr>";
  out += head("interval") + "<td><code id=\"digits\">" + every_digit(page) + "</code></td></tr>";
  out += head("tolerance") + table_cell(tolerance_text(page)) + "</tr>";
  out += head("device") + table_cell(device_text(json)) + "</tr>";
  out += head("driver") + table_cell(text_or(json["driver"], "not known")) + "</tr>";
  out += head("program") +
         table_cell("vkhausdorff " + json["version"].get<std::string>() + ", preset " +
                    text_or(json["options"]["preset"], "default")) +
         "</tr>";
  out += head("started") +
         table_cell(text_or(json["started"], "not known") + " on " +
                    text_or(json["host"], "a machine without a name")) +
         "</tr>";
  out += head("wall time") + table_cell(times_text(page)) + "</tr>";
  return out + "</tbody></table></div>";
}

std::string notes_html(const PageText& page) {
  size_t count = page.json["notes"].size();
  for (const Json& input : page.json["inputs"]) count += input["notes"].size();
  std::string items;
  for (const Json& note : page.json["notes"]) {
    items += "<li>" + html_text(line_of_json(note)) + "</li>";
  }
  for (const Json& input : page.json["inputs"]) items += input_notes(input);
  if (const auto& max = page.answer.max; max && (max->faces_a || max->faces_b)) {
    items +=
        "<li>Faces have limits of their own, and the verdict is by those. The tolerance that is "
        "dragged here is one for all of them.</li>";
  }
  if (items.empty()) return "";
  std::string out = "<div class=\"notes\"><h2>Notes</h2><ul>" + items + "</ul>";
  if (count > kPrintedNotes) out += "<p class=\"print-only quiet\">More notes are in the file.</p>";
  return out + "</div>";
}

}  // namespace vkh
