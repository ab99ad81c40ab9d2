// An answer's first line, and the names of its parts.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "engine/vkhausdorff.h"
#include "host/answer/end_words.h"
#include "host/answer/members.h"
#include "host/answer/pair_notes.h"
#include "host/base/decimal.h"
#include "host/base/rounding.h"
#include "vkhausdorff/answer.h"

namespace vkh {
namespace {

/// Prints a point to a hundred-thousandth of A's diagonal, which is enough to find it; all digits
/// are in JSON.
std::string point_text(const Answer& answer, const SurfacePoint& p, bool of_b) {
  const double step = 1e-5 * answer.a_to_b.diagonal_a;
  const auto printed = [&](double x) {
    const double size = std::abs(x);
    const int digits = size > step && step > 0 ? 1 + static_cast<int>(std::log10(size / step)) : 1;
    return number_text(x, std::chars_format::general, std::min(digits, 17));
  };
  return "(" + printed(p.point.x) + ", " + printed(p.point.y) + ", " + printed(p.point.z) +
         (answer.inputs[of_b ? 1 : 0].are_points ? "), point " : ") on face ") +
         std::to_string(p.file_face);
}

// Returns upper as a share in percent.
std::string share_of_diagonal(const Answer& answer, double upper) {
  const double diagonal = diagonal_of_a(answer).least();
  if (!(diagonal > 0)) return "";
  const double share = multiply_up(100, divide_up(upper, diagonal));
  return " (" + decimal(share, 3, Rounding::kUp) + " % of A's diagonal)";
}

std::string part_name(const PartOf& part) {
  return "part " + std::to_string(part.index) + "/" + std::to_string(part.count);
}

std::string distance_in_words(const Answer& answer) {
  const CertifiedInterval whole = interval_of(answer);
  const bool both = answer.b_to_a.has_value();
  const std::string from = answer.part ? part_name(*answer.part) + " of A" : "A";
  const std::string all = both ? "every point of A and of B " : "every point of " + from + " ";
  const std::string other = both ? "the other" : "B";
  if (whole.upper == 0) return all + "lies on " + other;
  std::string text = std::isfinite(whole.upper)
                         ? all + "is within " +
                               length_up(answer, whole.upper, whole.upper - whole.lower) + " of " +
                               other
                         : "no bound " + (answer.part ? "of " + from + " " : "") + "was found yet";
  if (whole.lower > 0) {
    text +=
        (answer.part ? ", and one of its points is at least " : ", and one point is at least ") +
        length_down(answer, whole.lower, whole.upper - whole.lower) + " away";
  }
  return text + (std::isfinite(whole.upper) ? share_of_diagonal(answer, whole.upper) : "");
}

std::string hint(const Answer& answer, Status status) {
  const char* known = end_words(status).hint;
  if (known == nullptr) return "; ask for a smaller --tol than " + answer.tolerance.requested;
  const double delta = std::max(answer.inputs[0].place.delta, answer.inputs[1].place.delta);
  if (status != Status::kPrecision || !(delta > 0)) return known;
  return std::string(known) + ": a surface is known to within " + decimal(delta, 3, Rounding::kUp);
}

std::string interval_text(const Answer& answer, const CertifiedInterval& interval) {
  const double gap = gap_as_printed(answer, interval.lower, interval.upper);
  const auto printed = [&](double x, Rounding rounding) {
    return decimal(x, digits_that_matter(x, gap), rounding);
  };
  return with_unit("[" + printed(interval.lower, Rounding::kDown) + ", " +
                       printed(interval.upper, Rounding::kUp) + "]",
                   answer.unit);
}

std::string limit_text(const Answer& answer, const Length& length) {
  return typed_in_words(length, answer.unit);
}

std::string limits_in_words(const Answer& answer) {
  const AskedSides& sides = *answer.max->sides;
  return limit_text(answer, sides.over) + " over B and " + limit_text(answer, sides.under) +
         " under it";
}

/// A known length: four digits, or as many as it takes to lie in the enclosure.
std::string known_length(const Answer& answer, const Enclosure& e) {
  constexpr int kDigits = 4;
  return with_unit(decimal_inside(e.lower, e.lower, e.upper, kDigits), answer.unit);
}

/// A distance beyond a limit, which a FAIL begins with: the printed number is always larger than
/// the limit.
std::string beyond_in_words(const Answer& answer, const Enclosure& e, const Limit& limit) {
  if (is_farthest_known(e.lower, e.upper)) return "FAIL  " + known_length(answer, e);
  const double margin = std::min(e.lower - limit.beyond, e.upper - e.lower);
  return "FAIL  at least " + length_down(answer, e.lower, margin);
}

std::string failure_in_words(const Answer& answer, bool back) {
  const Report& r = back ? *answer.b_to_a : answer.a_to_b;
  const std::optional<FaceLimits>& faces = back ? answer.max->faces_b : answer.max->faces_a;
  const Limit& limit = faces ? faces->limit : answer.max->limit;
  const std::string from = back ? "B" : "A";
  std::string text = beyond_in_words(answer, {r.lower, r.upper}, limit);
  text += back ? " from B to A" : " from A to B";
  text += r.has_witness ? " at " + point_text(answer, r.witness_a, back) + " of " + from
                        : " at a point of " + from;
  if (answer.max->sides) return text + ", beyond both limits, " + limits_in_words(answer);
  if (!faces) return text + ", limit " + limit_text(answer, answer.max->length);
  return text + ", limit of its face " + with_unit(length_in_words(limit), answer.unit);
}

// Says whether faces or triangles are counted: a polygon has several triangles.
std::string faces_in_words(const FaceLimits& faces, const Input& of) {
  return std::to_string(faces.within) + " of " + std::to_string(faces.faces) +
         (of.counts.polygons > 0 ? " triangles" : " faces");
}

// Rounds a percentage outward, with enough digits not to be printed on the other side of `asked`.
std::string percent(double share, double asked, Rounding rounding) {
  double percent = 100 * share;
  if (share > 0 && share < 1)
    percent = std::nextafter(percent, rounding == Rounding::kUp ? 101.0 : 0.0);
  const double gap = 100 * std::max(std::abs(share - asked), 1e-4);
  const double fine = 100 * std::abs(share - asked);
  return decimal(percent, digits_that_matter(percent, fine > 0 ? std::min(gap, fine) : gap),
                 rounding) +
         " %";
}

/// Says what would decide a verdict that a survey left open: more of the budget that ended it.
std::string survey_hint(const Answer& answer, bool back) {
  const std::optional<SurveyResult>& survey = back ? answer.survey_b : answer.survey_a;
  if (!survey) return hint(answer, (back ? *answer.b_to_a : answer.a_to_b).status);
  return end_words(survey->ended).hint;
}

/// "at least 99.5 % of A's area is within 0.1 mm of B": no more than the verdict on that mesh says.
std::string share_in_words(const Answer& answer, bool back) {
  const double asked = *answer.max->area;
  const Enclosure share = share_within(answer, back);
  const Verdict verdict = verdict_of(answer, back);
  const std::string low = percent(share.lower, asked, Rounding::kDown);
  const std::string high = percent(share.upper, asked, Rounding::kUp);
  const bool are_points = answer.inputs[back ? 1 : 0].are_points;
  return (verdict == Verdict::kWithin   ? "at least " + low
          : verdict == Verdict::kBeyond ? "at most " + high
                                        : "from " + low + " to " + high) +
         " of " + (back ? "B" : "A") +
         (are_points ? "'s points are within " : "'s area is within ") +
         limit_text(answer, answer.max->length) + " of " + (back ? "A" : "B");
}

/// Describes the deciding mesh, and then the other one. If one of them is not within, that one
/// decides.
std::string area_in_words(const Answer& answer) {
  const Verdict verdict = verdict_of(answer);
  const bool back = verdict_of(answer, false) != verdict;
  std::string text = share_in_words(answer, back);
  if (answer.b_to_a) text += ", and " + share_in_words(answer, !back);
  const std::string asked = " (" + answer.max->area_requested + " asked)";
  if (verdict == Verdict::kWithin) return "PASS  " + text + ", proven" + asked;
  if (verdict == Verdict::kBeyond) return "FAIL  " + text + ", proven" + asked;
  return "UNDECIDED  " + text + asked + survey_hint(answer, back);
}

/// The largest deviation of a PASS, as far as it is known: the run ends once the limit is decided.
std::string deviation_in_words(const Answer& answer, const CertifiedInterval& whole) {
  if (whole.upper == 0) return "no deviation";
  const double gap = gap_as_printed(answer, whole.lower, whole.upper);
  if (is_farthest_known(whole.lower, whole.upper))
    return "largest deviation " + known_length(answer, {whole.lower, whole.upper});
  if (whole.upper <= 0.5 * answer.max->limit.within)
    return "largest deviation at most " + length_up(answer, whole.upper, gap);
  return "largest deviation in " + interval_text(answer, whole) +
         (answer.command == "gate" && !answer.max->worst ? "; --worst narrows it" : "");
}

/// One side of a verdict: "0.21 mm over B at (1, 2, 3) on face 12 of A, limit 0.2 mm".
std::string side_failure(const Answer& answer, bool is_over, const SignedFigures& found) {
  const AskedSides& sides = *answer.max->sides;
  Enclosure reached = is_over ? found.over : found.under;
  const Limit& limit = is_over ? sides.limits.over : sides.limits.under;
  const std::optional<SidedPoint>& witness = is_over ? found.over_witness : found.under_witness;
  const bool has_point = witness && witness->lower > limit.beyond;
  if (has_point) reached.lower = witness->lower;
  return beyond_in_words(answer, reached, limit) + (is_over ? " over B" : " under B") +
         (has_point ? " at " + point_text(answer, witness->at, false) + " of A" : std::string()) +
         ", limit " + limit_text(answer, is_over ? sides.over : sides.under);
}

std::string side_interval(const Answer& answer, const Enclosure& e) {
  return interval_text(answer, {.lower = e.lower, .upper = e.upper});
}

std::string sides_in_words(const Answer& answer) {
  const SidedLimits& limits = answer.max->sides->limits;
  const Verdict verdict = verdict_of(answer, false);
  const SignedFigures* found = sides_of(answer, false);
  if (verdict == Verdict::kWithin)
    return "PASS  every point of A is within " + limits_in_words(answer) + ", proven" +
           (found == nullptr ? ""
                             : " (over B: " + side_interval(answer, found->over) +
                                   ", under it: " + side_interval(answer, found->under) + ")");
  if (verdict == Verdict::kBeyond) {
    if (found != nullptr && found->over.lower > limits.over.beyond)
      return side_failure(answer, true, *found);
    if (found != nullptr && found->under.lower > limits.under.beyond)
      return side_failure(answer, false, *found);
    return failure_in_words(answer, false);
  }
  if (found == nullptr)
    return "UNDECIDED  sides are not known: the limits are " + limits_in_words(answer) +
           survey_hint(answer, false);
  return "UNDECIDED  the limits are " + limits_in_words(answer) +
         "; the farthest point over B is " + side_interval(answer, found->over) +
         " away, under it " + side_interval(answer, found->under) +
         ", where points without a side count as either" + survey_hint(answer, false);
}

/// Says what would decide a limit that lies in the interval. A limit that is a share of a diagonal
/// is only known as well as the diagonal: no tolerance decides what lies within its ends.
std::string limit_hint(const Answer& answer, const CertifiedInterval& whole) {
  const Limit& limit = answer.max->limit;
  const Diagonal of_a = diagonal_of_a(answer);
  const bool is_rounded =
      answer.max->length.of == Length::Of::kDiagonal && of_a.least() < of_a.most();
  if (!is_rounded || whole.lower < limit.within || whole.upper > limit.beyond)
    return hint(answer, whole.status);
  return "; A's coordinates were rounded, so that its diagonal is known to within " +
         with_unit(decimal(width_up(of_a.least(), of_a.most()), 3, Rounding::kUp), answer.unit) +
         ": give the limit as a length";
}

std::string gate_in_words(const Answer& answer) {
  const CertifiedInterval whole = interval_of(answer);
  const Asked& max = *answer.max;
  if (max.area) return area_in_words(answer);
  if (max.sides) return sides_in_words(answer);
  const std::string asked = limit_text(answer, max.length);
  const bool by_face = max.faces_a || max.faces_b;
  const Verdict verdict = verdict_of(answer);
  if (verdict == Verdict::kBeyond)
    return failure_in_words(answer, verdict_of(answer, false) != Verdict::kBeyond);
  if (by_face) {
    const FaceLimits& faces = max.faces_a ? *max.faces_a : *max.faces_b;
    const std::string proven = faces_in_words(faces, answer.inputs[max.faces_a ? 0 : 1]) + " of " +
                               (max.faces_a ? "A" : "B") +
                               " are proven to be within their own limits";
    return verdict == Verdict::kWithin ? "PASS  " + proven
                                       : "UNDECIDED  " + proven + hint(answer, whole.status);
  }
  if (verdict == Verdict::kUndecided)
    return "UNDECIDED  the limit " + asked + " lies in " + interval_text(answer, whole) +
           limit_hint(answer, whole);
  return std::string("PASS  every point of A") + (answer.b_to_a ? " and of B" : "") +
         " is within " + asked + " of " + (answer.b_to_a ? "the other" : "B") + ", proven (" +
         deviation_in_words(answer, whole) + ")";
}

/// A PASS in one direction, of all of A: half a part is within any limit of the whole.
bool is_one_way_pass(const Answer& answer) {
  return answer.max && !answer.b_to_a && !answer.part && verdict_of(answer) == Verdict::kWithin;
}

const char* one_way_text(const Answer& answer) {
  return answer.max->sides ? "A to B only: what A lacks of B is a question from B to A"
                           : "A to B only; --symmetric also finds what A lacks of B";
}

/// Whether the first line warns of it. A surface that is inside out matters to limits of sides.
bool is_in_first_line(const Answer& answer, NoteCode code) {
  return is_odd_pair(code) || (code == NoteCode::kInsideOut && answer.max && answer.max->sides);
}

/// Whether the note says that a part of a file was not read. Lines and points have no surface:
/// they matter to a verdict alone.
bool is_left_out(const Answer& answer, NoteCode code) {
  return code == NoteCode::kSurfaces || code == NoteCode::kCalls ||
         (code == NoteCode::kElements && answer.max);
}

/// Says in a few words why the pair is odd, or what was not read of it; empty: it is not.
std::string oddities(const Answer& answer) {
  std::string text;
  const auto add = [&](const std::string& clause) { text += (text.empty() ? "" : "; ") + clause; };
  for (const Note& note : answer.notes) {
    if (is_in_first_line(answer, note.code)) add(clause_of(note));
  }
  for (size_t i = 0; i < 2; ++i) {
    for (const Note& note : answer.inputs[i].notes) {
      if (is_left_out(answer, note.code)) add((i == 0 ? "A: " : "B: ") + clause_of(note));
    }
  }
  return text;
}

/// Puts the warning into the answer: a PASS begins with it if the pair is odd, since few people
/// read on.
std::string warned(const Answer& answer, std::string text) {
  const std::string odd = oddities(answer);
  if (odd.empty()) return text;
  constexpr std::string_view kPass = "PASS  ";
  if (text.starts_with(kPass))
    return text.insert(kPass.size(), "if the inputs are right (" + odd + "): ");
  return text + ". Check the inputs: " + odd;
}

/// Adds to a verdict or a distance that A was moved by a fit.
std::string after_fit(const Answer& answer, std::string text) {
  if (!answer.placed || !answer.placed->fit) return text;
  const size_t verdict = answer.max ? text.find("  ") : std::string::npos;
  return text.insert(verdict == std::string::npos ? 0 : verdict + 2, "after a fit (--align): ");
}

}  // namespace

const char* program_version() { return VKH_VERSION_STRING; }

CertifiedInterval interval_of(const Answer& answer) {
  const Report& r = answer.a_to_b;
  if (!answer.b_to_a) return {r.lower, r.upper, r.gap(), r.status};
  return symmetric_interval(r, *answer.b_to_a);
}

Diagonal diagonal_of_a(const Answer& answer) {
  return {answer.a_to_b.diagonal_a, answer.inputs[0].place.delta};
}

Enclosure share_within(const Answer& answer, bool back) {
  const std::optional<SurveyResult>& survey = back ? answer.survey_b : answer.survey_a;
  if (!survey || !survey->statistics || survey->statistics->bands.empty()) return {0, 1};
  return survey->statistics->bands[0].share;
}

const SignedFigures* sides_of(const Answer& answer, bool back) {
  const std::optional<SurveyResult>& survey = back ? answer.survey_b : answer.survey_a;
  return survey && survey->sides ? &*survey->sides : nullptr;
}

namespace {

// Where both limits agree, the interval alone decides, and sides do not matter.
Verdict verdict_of_sides(const Answer& answer, const Report& r, const SignedFigures* found) {
  const SidedLimits& limits = answer.max->sides->limits;
  if (r.upper <= limits.smaller().within) return Verdict::kWithin;
  if (r.lower > limits.larger().beyond) return Verdict::kBeyond;
  return found == nullptr ? Verdict::kUndecided : verdict_of(found->over, found->under, limits);
}

}  // namespace

Verdict verdict_of(const Answer& answer, bool back) {
  if (answer.max->area) {
    const Enclosure share = share_within(answer, back);
    // The typed number may be above the double nearest to it.
    if (share.lower >= std::nextafter(*answer.max->area, 1.0)) return Verdict::kWithin;
    return share.upper < *answer.max->area ? Verdict::kBeyond : Verdict::kUndecided;
  }
  const std::optional<FaceLimits>& faces = back ? answer.max->faces_b : answer.max->faces_a;
  if (faces) return faces->verdict;
  const Report& r = back ? *answer.b_to_a : answer.a_to_b;
  if (answer.max->sides) return verdict_of_sides(answer, r, sides_of(answer, back));
  return verdict_of(r.lower, r.upper, answer.max->limit);
}

Verdict verdict_of(const Answer& answer) {
  const Verdict there = verdict_of(answer, false);
  if (!answer.b_to_a || there == Verdict::kBeyond) return there;
  const Verdict back = verdict_of(answer, true);
  return back == Verdict::kWithin ? there : back;
}

FieldSummary summary_of(const Answer& answer, const SurveyResult& survey) {
  if (answer.max && answer.max->sides && survey.sides)
    return summary_of(survey.field, *survey.sides, answer.max->sides->limits);
  return summary_of(survey.field, answer.max ? answer.max->limit : Limit{});
}

const char* stop_reason(Status status) { return end_words(status).reason; }

const char* stop_reason(const Answer& answer, Status status) {
  if (status == Status::kLimit && answer.max && answer.max->worst)
    return "the verdict was certain, and the search went on to the farthest point";
  return stop_reason(status);
}

bool is_upper_sought(const Answer& answer, double lower, double upper) {
  return !answer.max || answer.max->area || verdict_of(answer) != Verdict::kBeyond ||
         is_farthest_known(lower, upper);
}

std::string length_down(const Answer& answer, double length, double gap) {
  return with_unit(decimal(length, digits_that_matter(length, gap), Rounding::kDown), answer.unit);
}
std::string length_up(const Answer& answer, double length, double gap) {
  return with_unit(decimal(length, digits_that_matter(length, gap), Rounding::kUp), answer.unit);
}

double gap_as_printed(const Answer& answer, double lower, double upper) {
  double gap = upper - lower;
  if (!answer.max) return gap;
  const Limit& limit = answer.max->limit;
  for (const double off : {limit.within - upper, lower - limit.beyond}) {
    if (off > 0) gap = std::min(gap, off);
  }
  return gap;
}

std::string printable(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    // Some terminals take the UTF-8 bytes of U+0080 to U+009F for control characters too.
    const bool is_c1 = c == 0xc2 && i + 1 < text.size() &&
                       static_cast<unsigned char>(text[i + 1]) >= 0x80 &&
                       static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (c >= 0x20 && c != 0x7f && !is_c1) {
      out += text[i];
      continue;
    }
    char escape[8];
    std::snprintf(escape, sizeof escape, "\\x%02x", c);
    out += escape;
    if (!is_c1) continue;
    std::snprintf(escape, sizeof escape, "\\x%02x", static_cast<unsigned char>(text[++i]));
    out += escape;
  }
  return out;
}

namespace {

std::string first_line_of(const Answer& answer) {
  if (answer.metrics) return warned(answer, after_fit(answer, metrics_in_words(answer)));
  if (!answer.max) return warned(answer, after_fit(answer, distance_in_words(answer)));
  return warned(answer, after_fit(answer, gate_in_words(answer))) +
         (is_one_way_pass(answer) ? std::string(". ") + one_way_text(answer) : "");
}

}  // namespace

std::string in_words(const Answer& answer) {
  return answer.first_line.empty() ? first_line_of(answer) : answer.first_line;
}

std::optional<std::string> implied_words(const Answer& answer) {
  const std::optional<Asked>& max = answer.max;
  if (max && (max->area || max->faces_a || max->faces_b)) return std::nullopt;
  return first_line_of(answer);
}

std::vector<Note> notes_of(const Answer& answer) {
  std::vector<Note> notes = answer.notes;
  if (is_one_way_pass(answer)) notes.push_back(note_of(NoteCode::kOneWay, one_way_text(answer)));
  return notes;
}

}  // namespace vkh
