#include "host/show/page_words.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "host/answer/end_words.h"
#include "host/answer/pair_notes.h"
#include "host/base/decimal.h"

namespace vkh {
namespace {

constexpr int kMostFigureDigits = 4;
constexpr int kAllDigits = 17;

// A deviation within the limit may be written as the limit itself; one beyond it must not.
bool is_on_its_side(double printed, double exact, const Limit& limit) {
  if (!(limit.beyond > 0)) return true;
  if (exact > limit.beyond) return printed > limit.beyond;
  return exact > limit.within || printed <= limit.beyond;
}

double number_of(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

std::string nearest(double value, int digits) {
  return number_text(value, std::chars_format::general, digits);
}

// Rounds one end outward, with more digits where the limit is near.
std::string end_of(double value, int digits, Rounding rounding, const Limit& limit) {
  std::string text = decimal(value, digits, rounding);
  for (int more = digits + 1; more <= kAllDigits; ++more) {
    if (is_on_its_side(number_of(text), value, limit)) break;
    text = decimal(value, more, rounding);
  }
  return text;
}

// One number between both ends, if they are the same to three digits.
std::string common_text(const Enclosure& length) {
  for (const int digits : {kMostFigureDigits, kMostFigureDigits - 1}) {
    if (nearest(length.lower, digits) == nearest(length.upper, digits))
      return decimal_inside(length.lower, length.lower, length.upper, digits);
  }
  return "";
}

// A decimal of a share in percent, rounded outward.
std::string percent_text(double share, int decimals, Rounding rounding) {
  if (share <= 0) return "0";
  if (share >= 1) return "100";
  const double scale = std::pow(10.0, decimals);
  const double exact = 100 * scale * share;
  const double whole =
      rounding == Rounding::kUp ? std::ceil(exact + 1e-9) : std::floor(exact - 1e-9);
  return number_text(std::clamp(whole / scale, 0.0, 100.0), std::chars_format::fixed, decimals);
}

bool is_other_side(const std::string& percent, double share, double asked) {
  const double printed = number_of(percent) / 100;
  return asked >= 0 && (share >= asked) != (printed >= asked - 1e-15);
}

std::string share_end(double share, double asked, Rounding rounding) {
  constexpr int kMostDecimals = 12;
  std::string text = percent_text(share, 2, rounding);
  for (int decimals = 3; decimals <= kMostDecimals && is_other_side(text, share, asked); ++decimals)
    text = percent_text(share, decimals, rounding);
  return text;
}

std::string other_of(bool back) { return back ? "A" : "B"; }
std::string from_of(bool back) { return back ? "B" : "A"; }

std::string all_points(const Answer& answer) {
  return std::string("Every point of A") + (answer.b_to_a ? " and of B" : "");
}
std::string the_other(const Answer& answer) { return answer.b_to_a ? "the other" : "B"; }

std::string failed_sentence(const Answer& answer, bool back) {
  const Report& r = back ? *answer.b_to_a : answer.a_to_b;
  std::string text = from_of(back) + " deviates from " + other_of(back) + " by " +
                     length_text(answer, deviation_of(answer, r));
  if (r.has_witness) text += " at " + point_text(r.witness_a.point, r.diagonal_a);
  const std::optional<FaceLimits>& faces = back ? answer.max->faces_b : answer.max->faces_a;
  if (!faces) return text + ". The limit is " + limit_text(answer) + ".";
  return text + ". The limit there is " + with_unit(nearest(faces->limit.within, 9), answer.unit) +
         ".";
}

std::string share_sentence(const Answer& answer, bool back) {
  const bool are_points = answer.inputs[back ? 1 : 0].are_points;
  return share_text(share_within(answer, back), *answer.max->area) +
         (are_points ? " of the points of " : " of the area of ") + from_of(back) + " is within " +
         limit_text(answer) + " of " + other_of(back) + ". ";
}

// The mesh that decides comes first.
std::string area_sentence(const Answer& answer, Verdict verdict) {
  const bool back = verdict_of(answer, false) != verdict;
  return share_sentence(answer, back) + (answer.b_to_a ? share_sentence(answer, !back) : "") +
         "Asked for: " + answer.max->area_requested + ".";
}

std::string sides_sentence(const Answer& answer, Verdict verdict) {
  const SignedFigures* found = sides_of(answer, false);
  if (verdict == Verdict::kWithin)
    return "Every point of A is within " + limit_text(answer) + " of B.";
  if (found == nullptr)
    return verdict == Verdict::kBeyond
               ? failed_sentence(answer, false)
               : "It is not known which side of B A lies on. The limits are " + limit_text(answer) +
                     ".";
  return "The largest deviation outward is " + length_text(answer, found->over) + ", inward " +
         length_text(answer, found->under) + ". The limits are " + limit_text(answer) + ".";
}

std::string faces_sentence(const Answer& answer) {
  const bool is_a = answer.max->faces_a.has_value();
  const FaceLimits& faces = is_a ? *answer.max->faces_a : *answer.max->faces_b;
  return grouped(faces.within) + " of " + grouped(faces.faces) + " faces of " + from_of(!is_a) +
         " are within limits of their own.";
}

std::string gate_sentence(const Answer& answer, Verdict verdict) {
  const Asked& max = *answer.max;
  if (max.area) return area_sentence(answer, verdict);
  if (max.sides) return sides_sentence(answer, verdict);
  if (verdict == Verdict::kBeyond)
    return failed_sentence(answer, verdict_of(answer, false) != Verdict::kBeyond);
  if (max.faces_a || max.faces_b) return faces_sentence(answer);
  const std::string deviation = length_text(answer, deviation_of(answer));
  if (verdict == Verdict::kUndecided)
    return "The largest deviation is " + deviation + ", so that it is not known whether " +
           limit_text(answer) + " is kept.";
  return all_points(answer) + " is within " + limit_text(answer) + " of " + the_other(answer) +
         ". The largest deviation is " + deviation + ".";
}

std::string distance_sentence(const Answer& answer) {
  const Enclosure deviation = deviation_of(answer);
  if (deviation.upper == 0) return all_points(answer) + " lies on " + the_other(answer) + ".";
  return "The largest deviation of A from B" +
         std::string(answer.b_to_a ? ", or of B from A, is " : " is ") +
         length_text(answer, deviation) + ".";
}

void add_search_end(const Answer& answer, const Report& r, bool back,
                    std::vector<std::string>& warnings) {
  const char* reason = end_words(r.status).on_page;
  if (reason == nullptr) return;
  const bool is_decided = answer.max && verdict_of(answer) != Verdict::kUndecided;
  const std::string what = "the largest deviation of " + from_of(back) + " from " + other_of(back) +
                           " is not known more closely, since " + reason + ".";
  warnings.push_back(is_decided ? "The verdict is proven; " + what : "Unfinished: " + what);
}

// Adds one sentence for both directions if both ended for the same reason.
void add_survey_ends(const Answer& answer, std::vector<std::string>& warnings) {
  const auto reason_of = [](const std::optional<SurveyResult>& survey) {
    return survey ? end_words(survey->ended).on_page : nullptr;
  };
  const char* const a = reason_of(answer.survey_a);
  const char* const b = reason_of(answer.survey_b);
  const auto add = [&](const std::string& which, const char* reason) {
    if (reason)
      warnings.push_back("Cut short: figures and colours of " + which + " could be finer, since " +
                         reason + ". They hold as they are.");
  };
  if (a && b && std::string(a) == b) return add("A and of B", a);
  add("A", a);
  add("B", b);
}

// A page says outward and inward instead of over and under.
std::string inside_out_warning(const Note& note) {
  const std::string which = note.text.substr(0, note.text.find(','));
  return "Check the two files: " + which + ", so that outward means into it, and inward out of it.";
}

}  // namespace

std::string figure_text(const Enclosure& length, const Limit& limit) {
  if (length.upper == 0) return "0";
  if (!std::isfinite(length.upper)) {
    if (!(length.lower > 0)) return "not known";
    return "at least " + end_of(length.lower, kMostFigureDigits, Rounding::kDown, limit);
  }
  if (length.lower > 0) {
    std::string common = common_text(length);
    if (!common.empty()) return common;
  }
  constexpr double kWide = 0.01;  // a share of the figure: a fourth digit means nothing there
  const double gap = length.upper - length.lower;
  const int most = kMostFigureDigits - (gap > kWide * length.upper ? 1 : 0);
  const auto end = [&](double value, Rounding rounding) {
    return end_of(value, std::min(digits_that_matter(value, gap), most), rounding, limit);
  };
  const std::string high = end(length.upper, Rounding::kUp);
  if (!(length.lower > 0)) return "at most " + high;
  const std::string low = end(length.lower, Rounding::kDown);
  return low + " to " + high;
}

std::string estimate_text(double length, const Enclosure& ends, const Limit& limit) {
  std::string text;
  for (int digits = kMostFigureDigits; digits <= kAllDigits; ++digits) {
    text = decimal_inside(length, ends.lower, ends.upper, digits);
    if (is_on_its_side(number_of(text), length, limit)) break;
  }
  return text;
}

std::string length_text(const Answer& answer, const Enclosure& length) {
  const std::string text = figure_text(length, answer.max ? answer.max->limit : Limit{});
  return text == "not known" ? text : with_unit(text, answer.unit);
}

std::string share_text(const Enclosure& share, double asked) {
  const std::string low = share_end(share.lower, asked, Rounding::kDown);
  const std::string high = share_end(share.upper, asked, Rounding::kUp);
  return (low == high ? high : low + " to " + high) + " %";
}

std::string point_text(const glm::dvec3& point, double size) {
  const double step = 1e-5 * size;
  const auto printed = [&](double x) {
    const double least = std::abs(x);
    const bool is_seen = least > step && step > 0;
    const int digits = is_seen ? 1 + static_cast<int>(std::log10(least / step)) : 1;
    return nearest(is_seen ? x : 0, std::min(digits, kAllDigits));
  };
  return "(" + printed(point.x) + ", " + printed(point.y) + ", " + printed(point.z) + ")";
}

std::string limit_text(const Answer& answer) {
  const Asked& max = *answer.max;
  if (!max.sides) return typed_in_words(max.length, answer.unit);
  return typed_in_words(max.sides->over, answer.unit) + " outward and " +
         typed_in_words(max.sides->under, answer.unit) + " inward";
}

bool is_limit(const Answer& answer, double distance) {
  return answer.max && distance >= answer.max->limit.within && distance <= answer.max->limit.beyond;
}

std::string band_text(const Answer& answer, double distance) {
  constexpr size_t kMostLetters = 12;  // more are of a share of a diagonal
  if (is_limit(answer, distance) && !answer.max->sides) return limit_text(answer);
  const std::string text = shortest_decimal(distance);
  return with_unit(text.size() <= kMostLetters ? text : nearest(distance, 6), answer.unit);
}

Headline headline_of(const Answer& answer) {
  if (!answer.max) return {"DISTANCE", "plain", distance_sentence(answer)};
  const Verdict verdict = verdict_of(answer);
  const std::string sentence = gate_sentence(answer, verdict);
  if (verdict == Verdict::kWithin) return {"PASS", "pass", sentence};
  if (verdict == Verdict::kBeyond) return {"FAIL", "fail", sentence};
  return {"UNDECIDED", "undecided", sentence};
}

std::vector<std::string> warnings_of(const Answer& answer) {
  std::vector<std::string> warnings;
  for (const Note& note : answer.notes) {
    if (is_odd_pair(note.code)) warnings.push_back("Check the two files: " + clause_of(note) + ".");
    if (note.code == NoteCode::kInsideOut) warnings.push_back(inside_out_warning(note));
  }
  add_search_end(answer, answer.a_to_b, false, warnings);
  if (answer.b_to_a) add_search_end(answer, *answer.b_to_a, true, warnings);
  add_survey_ends(answer, warnings);
  if (!answer.b_to_a)
    warnings.emplace_back("Only A was measured: a part of B that A lacks is not found this way.");
  return warnings;
}

std::string unit_text(const Answer& answer) {
  if (answer.unit.empty()) return "not known: lengths are in the files' own unit";
  const bool is_of_files =
      !answer.inputs[0].place.unit.empty() || !answer.inputs[1].place.unit.empty();
  const bool is_typed =
      std::any_of(answer.words.begin(), answer.words.end(),
                  [](const std::string& word) { return word.starts_with("--unit"); });
  return answer.unit + (is_typed ? ", by --unit" : is_of_files ? ", by the files" : "");
}

}  // namespace vkh
