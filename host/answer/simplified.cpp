#include "host/answer/simplified.h"

#include <cmath>
#include <ostream>

#include "host/answer/json_object.h"
#include "host/answer/json_text.h"
#include "host/answer/member_writer.h"
#include "host/base/decimal.h"

namespace vkh {
namespace {

/// The limit and the place that it is counted from; a share of A's diagonal names A itself.
std::string near_words(const SimplifyAnswer& answer) {
  const bool names_a = answer.max.of == Length::Of::kDiagonal;
  return typed_in_words(answer.max, answer.unit) + (names_a ? "" : " of A");
}

std::string largest_words(const Deviation& deviation, const std::string& unit) {
  return with_unit(decimal(deviation.interval.upper, 4, Rounding::kUp), unit);
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
         with_unit(decimal_inside(found.upper, found.lower, found.upper, 4), answer.unit) + ")";
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
  return json_object([&](JsonText& json) {
    MemberWriter writer(json, Detail::kFull);
    writer.text("schema", kSimplifySchema);
    visit(writer, answer);
  });
}

std::string to_simplify_json(const Failure& failure) {
  return failure_json(failure, kSimplifySchema);
}

}  // namespace vkh
