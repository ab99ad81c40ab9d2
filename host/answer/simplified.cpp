#include "host/answer/simplified.h"

#include <cmath>
#include <ostream>

#include "host/answer/json_object.h"
#include "host/base/decimal.h"

namespace vkh {
namespace {

std::string length_words(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

/// The limit as it was typed: "0.1 mm", "0.1 % of A's diagonal".
std::string asked_words(const SimplifyAnswer& answer) {
  const std::string& text = answer.max.requested;
  const std::string digits = text.substr(0, text.find_first_not_of("0123456789.eE+-"));
  if (answer.max.of == Length::Of::kUnit) return digits + " " + answer.max.unit;
  if (answer.max.of == Length::Of::kFiles) return length_words(digits, answer.unit);
  return text.ends_with('%') ? digits + " % of A's diagonal" : digits + " of A's diagonal";
}

/// The limit and the place that it is counted from; a share of A's diagonal names A itself.
std::string near_words(const SimplifyAnswer& answer) {
  const bool names_a = answer.max.of == Length::Of::kDiagonal;
  return asked_words(answer) + (names_a ? "" : " of A");
}

std::string largest_words(const Deviation& deviation, const std::string& unit) {
  return length_words(decimal(deviation.interval.upper, 4, Rounding::kUp), unit);
}

const char* ways_words(const SimplifyAnswer& answer) {
  return answer.one_way ? "A to it alone" : "both ways";
}

std::string nothing_words(const SimplifyAnswer& answer) {
  const std::string why =
      !answer.complete  ? "the search was ended first: ask for more --time"
      : answer.is_chain ? "the first level is farther, or A has no faces to give"
                        : "A itself, rounded to what the format holds, is farther: write .ply";
  return "nothing written: no mesh within " + near_words(answer) + " was found; " + why;
}

/// Says why a chain has fewer levels than were asked for.
std::string fewer_words(const SimplifyAnswer& answer) {
  const std::string next = "level " + std::to_string(answer.files.size() + 1) + " ";
  switch (answer.chain_end) {
    case ChainEnd::kAll:
      break;
    case ChainEnd::kNoFewer:
      return next + "would have no fewer faces";
    case ChainEnd::kFarther:
      return next + "is beyond the limit";
    case ChainEnd::kUndecided:
      return next + "is not proven to be within the limit";
    case ChainEnd::kEnded:
      return "the search was ended before " + next + "was made";
  }
  return "";
}

/// "3 levels", or "2 of 5 levels".
std::string levels_words(const SimplifyAnswer& answer) {
  const size_t count = answer.files.size();
  std::string text = std::to_string(count);
  if (count < answer.levels) text += " of " + std::to_string(answer.levels);
  return text + (answer.levels == 1 ? " level" : " levels");
}

void print_file(std::ostream& out, const SimplifyAnswer& answer, const SimplifiedFile& file) {
  print_row(out, "written",
            printable(file.path) + ": " + grouped(file.counts.faces) + " faces, " +
                grouped(file.counts.vertices) + " vertices, within " +
                largest_words(file.deviation, answer.unit) + "; read back and measured");
}

void add_ends(JsonObject& json, double lower, double upper) {
  json.add_bound("lower", lower, Rounding::kDown);
  json.add_bound("upper", upper, Rounding::kUp);
}

std::string side_json(const Report& report) {
  JsonObject json;
  add_ends(json, report.lower, report.upper);
  json.add("status", status_name(report.status));
  return json.text();
}

std::string file_json(const SimplifiedFile& file) {
  const Deviation& deviation = file.deviation;
  JsonObject json;
  json.add("path", file.path);
  json.add("format", file.format);
  json.add("sha256", text_or_null(file.sha256));
  json.add("faces", file.counts.faces);
  json.add("vertices", file.counts.vertices);
  add_ends(json, deviation.interval.lower, deviation.interval.upper);
  json.add("verdict", verdict_name(deviation.verdict));
  json.add_text("a_to_b", side_json(deviation.a_to_b));
  json.add_text("b_to_a", deviation.b_to_a ? side_json(*deviation.b_to_a) : "null");
  return json.text();
}

std::string files_json(const SimplifyAnswer& answer) {
  std::string rows;
  for (const SimplifiedFile& file : answer.files)
    rows += (rows.empty() ? "" : ",") + file_json(file);
  return "[" + rows + "]";
}

Json source_json(const SimplifyAnswer& answer) {
  Json json = {{"path", answer.input.path}};
  add_hashes(json, answer.input);
  json["faces"] = answer.input.counts.faces;
  json["vertices"] = answer.input.counts.vertices;
  json["delta"] = answer.input.place.delta;
  json["notes"] = notes_json(answer.input.notes, answer.input.path);
  return json;
}

std::string limit_json(const SimplifyAnswer& answer) {
  JsonObject json;
  json.add("requested", answer.max.requested);
  json.add_bound("within", answer.limit.within, Rounding::kDown);
  json.add_bound("beyond", answer.limit.beyond, Rounding::kUp);
  return json.text();
}

}  // namespace

std::string in_words(const SimplifyAnswer& answer) {
  if (answer.files.empty()) return nothing_words(answer);
  const std::string all = grouped(answer.input.counts.faces) + " faces, proven within " +
                          near_words(answer) + ", " + ways_words(answer);
  if (answer.is_chain)
    return levels_words(answer) + ", " + grouped(answer.files[0].counts.faces) + " to " +
           grouped(answer.files.back().counts.faces) + " of " + all +
           (answer.files.size() < answer.levels ? "; " + fewer_words(answer) : "");
  const SimplifiedFile& file = answer.files[0];
  const CertifiedInterval& found = file.deviation.interval;
  return grouped(file.counts.faces) + " of " + all + " (largest deviation " +
         length_words(decimal_inside(found.upper, found.lower, found.upper, 4), answer.unit) + ")";
}

void print_table(std::ostream& out, const SimplifyAnswer& answer) {
  out << in_words(answer) << '\n';
  for (const SimplifiedFile& file : answer.files) print_file(out, answer, file);
  for (const std::string& file : answer.removed)
    print_row(out, "removed",
              printable(file) + ": a level of an earlier chain, which this one has not");
  if (!answer.certificate.empty()) print_row(out, "proof", printable(answer.certificate));
  if (!answer.files.empty()) {
    print_row(out, "promise",
              "the distance alone: the result may be open, or turned, where A is not");
    print_row(out, "dropped", "UVs, normals and colours, if A has any");
  }
  print_row(out, "search",
            std::to_string(answer.tried) + (answer.tried == 1 ? " mesh" : " meshes") +
                " judged in " +
                number_text(answer.waits.total / 1000, std::chars_format::fixed, 1) + " s" +
                (answer.complete ? "" : "; ended before it was done"));
  for (const Note& note : answer.input.notes)
    print_row(out, "note", "A: " + printable(line_of(note)));
  print_row(out, "device", answer.device.name + ", driver " + answer.device.driver);
}

std::string to_json(const SimplifyAnswer& answer) {
  JsonObject json;
  json.add("schema", kSimplifySchema);
  json.add("version", program_version());
  json.add("words", in_words(answer));
  json.add("input", source_json(answer));
  json.add("unit", text_or_null(answer.unit));
  json.add_text("max", limit_json(answer));
  json.add("one_way", answer.one_way);
  json.add("lock_borders", answer.lock_borders);
  json.add("found", !answer.files.empty());
  json.add("complete", answer.complete);
  json.add("tried", answer.tried);
  json.add_text("files", files_json(answer));
  json.add("removed", Json(answer.removed));
  json.add("certificate", text_or_null(answer.certificate));
  json.add("device", text_or_null(answer.device.name));
  json.add("driver", text_or_null(answer.device.driver));
  add_waits(json, answer.waits);
  json.add("command", "simplify");
  json.add("arguments", answer.words);
  return json.text();
}

std::string to_simplify_json(const Failure& failure) {
  return failure_json(failure, kSimplifySchema);
}

}  // namespace vkh
