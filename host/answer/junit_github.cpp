// An answer in the formats of build servers. JUnit: the schema that Jenkins and GitLab read, one
// test case for the pair. GitHub: docs.github.com, "Workflow commands for GitHub Actions".

#include <cstdio>

#include "host/answer/quantities.h"
#include "host/base/decimal.h"
#include "vkhausdorff/answer.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace {

/// Escapes text for XML 1.0, which has no control characters but tab and the ends of lines, and no
/// bytes that are no UTF-8, which printable() leaves alone.
std::string xml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// Replaces by U+FFFD what is no UTF-8 in `text`.
std::string valid_utf8(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size();) {
    const auto byte = [&](size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned char c = byte(i);
    const size_t length = c < 0x80   ? 1
                          : c < 0xc2 ? 0
                          : c < 0xe0 ? 2
                          : c < 0xf0 ? 3
                          : c < 0xf5 ? 4
                                     : 0;
    bool is_whole = length > 0 && i + length <= text.size();
    for (size_t k = 1; is_whole && k < length; ++k) is_whole = (byte(i + k) & 0xc0) == 0x80;
    if (is_whole && length == 3) {
      const unsigned second = byte(i + 1);  // overlong; surrogates
      is_whole = !(c == 0xe0 && second < 0xa0) && !(c == 0xed && second >= 0xa0);
      // XML has no U+FFFE and U+FFFF.
      is_whole = is_whole && !(c == 0xef && second == 0xbf && byte(i + 2) >= 0xbe);
    } else if (is_whole && length == 4) {
      const unsigned second = byte(i + 1);  // overlong; past U+10FFFF
      is_whole = !(c == 0xf0 && second < 0x90) && !(c == 0xf4 && second >= 0x90);
    }
    if (is_whole) {
      out.append(text, i, length);
      i += length;
    } else {
      out += "\xef\xbf\xbd";
      ++i;
    }
  }
  return out;
}

std::string in_xml(const std::string& text) { return xml(valid_utf8(printable(text))); }

/// Escapes a value for GitHub: percent signs and line ends; in a property also colons and commas.
std::string github(const std::string& text, bool is_property) {
  std::string out;
  for (const char c : text) {
    const bool escapes =
        c == '%' || c == '\r' || c == '\n' || (is_property && (c == ':' || c == ','));
    if (!escapes) {
      out += c;
      continue;
    }
    char code[8];
    std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned>(c));
    out += code;
  }
  return out;
}

/// The words by which build servers show an outcome.
struct Shown {
  const char *element, *type;  ///< of JUnit; empty: the case passed
  const char *level, *mark;    ///< of GitHub
};

const Shown& shown(Outcome outcome) {
  static constexpr Shown kPassed{"", "", "notice", ":white_check_mark:"};
  static constexpr Shown kAll[] = {{"failure", "beyond the limit", "error", ":x:"},
                                   {"error", "no answer", "error", ":x:"},
                                   {"error", "undecided", "warning", ":grey_question:"},
                                   kPassed,
                                   kPassed};
  return kAll[static_cast<size_t>(outcome)];
}

std::string max_text(const Asked& max) {
  return max.sides ? sided_text(max.sides->over, max.sides->under) : max.length.requested;
}

std::string case_name(const Answer& answer) {
  return pair_name(answer.inputs[0].path, answer.inputs[1].path, answer.b_to_a.has_value(),
                   answer.max ? max_text(*answer.max) : "");
}

std::string seconds_text(double seconds) {
  return number_text(seconds, std::chars_format::fixed, 3);
}

std::string case_xml(const JunitCase& one) {
  const std::string words = in_xml(one.words);
  std::string text = "<testcase classname=\"vkhausdorff." + one.command + "\" name=\"" +
                     in_xml(one.name) + "\" time=\"" + seconds_text(one.seconds) + "\">\n";
  const auto& [element, type, level, mark] = shown(one.outcome);
  if (*element != '\0')
    text += std::string("<") + element + " type=\"" + type + "\" message=\"" + words + "\">" +
            words + "</" + element + ">\n";
  text += "<system-out>" + words;
  for (const std::string& note : one.notes) text += "\n" + in_xml(note);
  return text + "</system-out>\n</testcase>\n";
}

JunitCase case_of(const Answer& answer) {
  return {.command = answer.command,
          .name = case_name(answer),
          .words = in_words(answer),
          .outcome = outcome_of(answer),
          .seconds = answer.waits.total / 1000,
          .notes = server_notes(answer)};
}

}  // namespace

std::vector<std::string> server_notes(const Answer& answer) {
  std::vector<std::string> lines;
  const auto add = [&](std::span<const Note> notes, const char* of) {
    for (const Note& note : notes) {
      if (is_for_servers(note.code)) lines.push_back(of + line_of(note));
    }
  };
  add(notes_of(answer), "");
  add(answer.inputs[0].notes, "A: ");
  add(answer.inputs[1].notes, "B: ");
  return lines;
}

std::string to_junit(std::span<const JunitCase> cases, const std::string& host,
                     const std::string& started) {
  size_t failures = 0, errors = 0;
  double seconds = 0;
  for (const JunitCase& one : cases) {
    const std::string_view element = shown(one.outcome).element;
    failures += element == "failure" ? 1U : 0U;
    errors += element == "error" ? 1U : 0U;
    seconds += one.seconds;
  }
  const std::string counts = "tests=\"" + std::to_string(cases.size()) + "\" failures=\"" +
                             std::to_string(failures) + "\" errors=\"" + std::to_string(errors) +
                             "\" skipped=\"0\" time=\"" + seconds_text(seconds) + "\"";
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites " + counts +
                     ">\n<testsuite name=\"vkhausdorff\" " + counts;
  if (!started.empty())
    text += " timestamp=\"" + in_xml(started.substr(0, started.find('Z'))) + "\" hostname=\"" +
            in_xml(host) + "\"";
  text += ">\n";
  for (const JunitCase& one : cases) text += case_xml(one);
  return text + "</testsuite>\n</testsuites>\n";
}

std::string to_junit(const Answer& answer) {
  const JunitCase one = case_of(answer);
  return to_junit({&one, 1}, answer.host, answer.started);
}

std::string pair_name(const std::string& a, const std::string& b, bool both,
                      const std::string& max) {
  return a + (both ? " <-> " : " -> ") + b + (max.empty() ? "" : " within " + max);
}

std::string to_junit(const Failure& failure, const std::string& name) {
  const JunitCase one{
      .command = "gate", .name = name, .words = failure.message, .outcome = Outcome::kNoAnswer};
  return to_junit({&one, 1}, "", "");
}

std::string github_line(const GithubAnnotation& annotation) {
  const std::string& file = annotation.file;
  std::string words = annotation.words;
  for (const std::string& note : annotation.notes) words += "\n" + printable(note);
  return std::string("::") + shown(annotation.outcome).level + " " +
         (file.empty() ? "" : "file=" + github(printable(file), true) + ",") +
         "title=" + github(printable(annotation.title), true) + "::" + github(words, false) + "\n";
}

const char* github_mark(Outcome outcome) { return shown(outcome).mark; }

std::string github_code(const std::string& text) {
  std::string out = "`";
  for (const char c : printable(text)) {
    if (c == '|') out += '\\';
    out += c == '`' ? '\'' : c;
  }
  return out + "`";
}

std::string github_annotation(const Answer& answer) {
  return github_line({.outcome = outcome_of(answer),
                      .file = answer.inputs[0].path,
                      .title = "vkhausdorff " + answer.command,
                      .words = in_words(answer),
                      .notes = server_notes(answer)});
}

std::string github_annotation(const Failure& failure) {
  return github_line({.outcome = Outcome::kNoAnswer,
                      .file = failure.file,
                      .title = "vkhausdorff",
                      .words = printable(failure.message)});
}

std::string github_summary(const Answer& answer) {
  std::string text = std::string("### ") + github_mark(outcome_of(answer)) + " vkhausdorff " +
                     answer.command + "\n\n" + github_code(in_words(answer)) + "\n\n";
  text += "| | |\n|---|---|\n| A | " + github_code(answer.inputs[0].path) + " |\n| B | " +
          github_code(answer.inputs[1].path) + " |\n";
  if (answer.max) text += "| max | " + github_code(answer.max->length.requested) + " |\n";
  const CertifiedInterval whole = interval_of(answer);
  const double gap = gap_as_printed(answer, whole.lower, whole.upper);
  const std::string lower = length_down(answer, whole.lower, gap);
  text += is_upper_sought(answer, whole.lower, whole.upper)
              ? "| interval | " +
                    github_code("[" + lower + ", " + length_up(answer, whole.upper, gap) + "]")
              : "| distance | " + github_code("at least " + lower);
  text += " |\n";
  if (!answer.a_to_b.device.name.empty())
    text += "| device | " + github_code(answer.a_to_b.device.name) + " |\n";
  for (const std::string& note : server_notes(answer))
    text += "| note | " + github_code(note) + " |\n";
  return text + "\n";
}

}  // namespace vkh
