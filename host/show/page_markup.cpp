// Verdict, interval, places and statistics as HTML.
#include "host/show/page_markup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "host/base/decimal.h"
#include "host/show/escape.h"

namespace vkh {
namespace {

using Json = nlohmann::ordered_json;

// Signs are drawn, for fonts differ in their characters.
constexpr const char* kTick = "M5 13l5 5 9-11";
constexpr const char* kCross = "M6 6l12 12M18 6L6 18";
constexpr const char* kOpen = "M9 9a3 3 0 1 1 4.2 2.7c-.8.4-1.2 1-1.2 2.3M12 17.6v.4";
constexpr const char* kRuler = "M3 12h18M3 8v8M21 8v8";

constexpr size_t kPrintedRows = 12;  // for statistics, as style.css has it

struct Badge {
  const char* style;
  const char* word;
  const char* path;
};
Badge badge_of(const Json& json) {
  const std::string verdict = json.value("verdict", "");
  if (verdict == "pass") return {"pass", "PASS", kTick};
  if (verdict == "fail") return {"fail", "FAIL", kCross};
  if (verdict == "undecided") return {"undecided", "UNDECIDED", kOpen};
  return {"plain", "DISTANCE", kRuler};
}

std::string fact(const char* name, const std::string& text, const std::string& more = "") {
  std::string out = std::string("<div><dt>") + name + "</dt><dd>" + html_text(text);
  if (!more.empty()) out += "<small>" + html_text(more) + "</small>";
  return out + "</dd></div>";
}

// Rounds 100 times a share outward, unless it is 0 or 1.
std::string percent_of_gap(double share, double gap, Rounding rounding) {
  double percent = 100 * share;
  if (share > 0 && share < 1) {
    percent = std::nextafter(percent, rounding == Rounding::kUp ? 101.0 : 0.0);
  }
  return decimal(percent, std::min(digits_that_matter(percent, 100 * gap), 6), rounding);
}

std::string share_text(const Enclosure& share) {
  const double gap = share.upper - share.lower;
  const std::string low = percent_of_gap(share.lower, gap, Rounding::kDown);
  const std::string high = percent_of_gap(share.upper, gap, Rounding::kUp);
  return (low == high ? high : low + " to " + high) + " %";
}

constexpr const char* kNoBound = "no bound yet";

// Writes "0.0441 to 0.0443", each rounded outward to what matters beside `gap`.
std::string range_number(const Enclosure& length, double gap) {
  if (!std::isfinite(length.upper)) {
    return length.lower > 0 ? "at least " + decimal(length.lower, 6, Rounding::kDown) : kNoBound;
  }
  const int high_digits = digits_that_matter(length.upper, gap);
  const std::string high = decimal(length.upper, high_digits, Rounding::kUp);
  if (!(length.lower > 0)) return length.upper > 0 ? "at most " + high : high;
  const int low_digits = digits_that_matter(length.lower, gap);
  const std::string low = decimal(length.lower, low_digits, Rounding::kDown);
  return low == high ? high : low + " to " + high;
}
std::string range_number(const Enclosure& length) {
  return range_number(length, length.upper - length.lower);
}

std::string with_unit(const Answer& answer, const std::string& number) {
  return answer.unit.empty() || number == kNoBound ? number : number + " " + answer.unit;
}

std::string interval_words(const Answer& answer, double lower, double upper) {
  return with_unit(answer, range_number({lower, upper}, gap_as_printed(answer, lower, upper)));
}

std::string row(const std::string& name, const std::string& text) {
  return "<tr><th scope=\"row\">" + html_text(name) + "</th><td>" + html_text(text) + "</td></tr>";
}

std::string part_of_side(const char* tag, const char* style, bool back) {
  return std::string("<") + tag + " class=\"" + style + "\" data-side=\"" + (back ? "1" : "0") +
         "\">";
}

std::string array_text(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}).dump(); }

struct PlaceButton {
  std::string key, name, length, label;
  glm::dvec3 point, normal;
};
std::string place_html(const PlaceButton& place) {
  return "<li><button type=\"button\" aria-pressed=\"false\" data-point=\"" +
         array_text(place.point) + "\" data-normal=\"" + array_text(place.normal) +
         "\" data-label=\"" + html_text(place.label) + "\"><b>" + html_text(place.key) +
         "</b><span>" + html_text(place.name) + "</span><span>" + html_text(place.length) +
         "</span></button></li>";
}

std::string witness_html(const PageText& page, const Report& r) {
  if (!r.has_witness) return "";
  const std::string least =
      "at least " +
      length_down(page.answer, r.lower, gap_as_printed(page.answer, r.lower, r.upper));
  return place_html({"W", "witness, face " + std::to_string(r.witness_a.file_face), least,
                     "witness: " + least, r.witness_a.point, glm::dvec3(0)});
}

}  // namespace

std::string range_text(const Answer& answer, const Enclosure& length) {
  return with_unit(answer, range_number(length));
}

std::string title_text(const PageText& page) {
  const auto name = [&](size_t i) {
    const std::string path = page.json["inputs"][i]["path"];
    return path.substr(path.find_last_of("/\\") + 1);
  };
  return html_text(std::string(badge_of(page.json).word) + ": " + name(0) + " and " + name(1));
}

std::string verdict_html(const PageText& page) {
  const Badge badge = badge_of(page.json);
  const std::string start = std::string(badge.word) + "  ";
  std::string words = page.json["words"];
  if (words.starts_with(start)) words.erase(0, start.size());
  return std::string("<div class=\"verdict ") + badge.style +
         "\" id=\"verdict\"><div class=\"badge\"><svg viewBox=\"0 0 24 24\" fill=\"none\" "
         "stroke=\"currentColor\" stroke-width=\"2.6\" stroke-linecap=\"round\" "
         "stroke-linejoin=\"round\" aria-hidden=\"true\"><path d=\"" +
         badge.path + "\"/></svg><span id=\"word\">" + badge.word +
         "</span></div><p class=\"words\" id=\"words\">" + html_text(words) + "</p></div>";
}

std::string facts_html(const PageText& page) {
  const Answer& answer = page.answer;
  const CertifiedInterval whole = interval_of(answer);
  const char* what = answer.b_to_a ? "max(h(A,B), h(B,A)), certified" : "h(A,B), certified";
  std::string out = "<dl class=\"facts\">";
  const std::string status = page.json["status"];
  out += fact(what, interval_words(answer, whole.lower, whole.upper),
              (status == "limit" ? "decided" : status) + ": " +
                  page.json["stop_reason"].get<std::string>());
  if (answer.max) {
    const Asked& max = *answer.max;
    const std::string length =
        length_in_words(max.limit) + (answer.unit.empty() ? "" : " " + answer.unit);
    const bool says_more = max.length.of == Length::Of::kDiagonal || max.length.unit != answer.unit;
    out += fact("Limit", says_more ? max.length.requested : length, says_more ? length : "");
  }
  if (answer.b_to_a) {
    const auto direction = [&](const char* name, const Report& r) {
      out += fact(name, interval_words(answer, r.lower, r.upper), status_name(r.status));
    };
    direction("h(A,B)", answer.a_to_b);
    direction("h(B,A)", *answer.b_to_a);
  }
  return out + "</dl>";
}

std::string directions_html(const PageText& page) {
  if (!page.answer.b_to_a) return "";
  return "<div class=\"tabs\" role=\"group\" aria-label=\"Direction\">"
         "<button type=\"button\" data-direction=\"0\" aria-pressed=\"true\">A \u2192 B</button>"
         "<button type=\"button\" data-direction=\"1\" aria-pressed=\"false\">B \u2192 A</button>"
         "<p data-side=\"0\">A is shown, by its distances from B</p>"
         "<p data-side=\"1\" hidden>B is shown, by its distances from A</p></div>";
}

std::string places_html(const PageText& page, bool back, const std::vector<WorstPlace>& places) {
  const Report& r = back ? *page.answer.b_to_a : page.answer.a_to_b;
  std::string out =
      part_of_side("div", "places", back) + "<h2>Worst places of " + (back ? "B" : "A") + "</h2>";
  if (places.empty() && !r.has_witness) return out + "<p class=\"quiet\">There are none.</p></div>";
  out += "<ol class=\"places\">" + witness_html(page, r);
  for (size_t i = 0; i < places.size(); ++i) {
    const std::string length = range_text(page.answer, places[i].distance);
    const std::string key = std::to_string(i + 1);
    const std::string name = "face " + std::to_string(places[i].file_face);
    std::string label = key;
    label.append(": ").append(length);
    out += place_html({key, name, length, label, places[i].centre, places[i].normal});
  }
  return out +
         "</ol><p class=\"quiet\">Faces of the largest certified upper bound, each at least a "
         "twentieth of the diagonal from those above it. The range holds the largest distance on "
         "the face.</p></div>";
}

std::string statistics_html(const PageText& page, bool back, const Statistics& statistics) {
  const std::string unit = page.answer.unit.empty() ? "" : ", in " + page.answer.unit;
  std::string out = part_of_side("div", "numbers", back) + "<h2>Statistics of " +
                    (back ? "B" : "A") + ", by area" + html_text(unit) + "</h2>";
  const size_t rows = 2 + statistics.percentiles.size() + statistics.bands.size();
  if (rows > kPrintedRows) {
    out += "<p class=\"print-only quiet\">The first rows; all are in the file.</p>";
  }
  out += "<table><tbody>";
  out += row("mean", range_number(statistics.mean));
  out += row("RMS", range_number(statistics.rms));
  for (const Percentile& p : statistics.percentiles) {
    const std::string name =
        p.share == 0.5 ? "median" : shortest_decimal(100 * p.share) + "th percentile";
    out += row(name, range_number(p.distance));
  }
  for (const AreaWithin& band : statistics.bands) {
    out += row("within " + length_in_words({band.distance, band.distance}), share_text(band.share));
  }
  return out + "</tbody></table><p class=\"quiet\">Each is certified.</p></div>";
}

}  // namespace vkh
