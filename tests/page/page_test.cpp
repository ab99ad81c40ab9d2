// A page as text: its contents are the answer's, no input can end an element in it, it fits.
#include "host/show/page.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "host/show/escape.h"
#include "host/show/page_words.h"
#include "host/show/template.h"
#include "tests/page/invented.h"
#include "tests/shapes/shapes.h"

namespace {

using nlohmann::json;
using vkh::test::Invented;

Invented small_pair() {
  return {vkh::test::torus(20, 6, 24, 12), vkh::test::uv_sphere(18, 10, 12)};
}

size_t count_of(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

std::string between(const std::string& text, const std::string& start, const std::string& end) {
  const size_t at = text.find(start);
  REQUIRE(at != std::string::npos);
  const size_t from = at + start.size();
  return text.substr(from, text.find(end, from) - from);
}

json script(const std::string& page, const std::string& id) {
  return json::parse(
      between(page, "<script type=\"application/json\" id=\"" + id + "\">", "</script>"));
}

TEST_CASE("texts cannot end what they stand in") {
  CHECK(vkh::html_text("a<b>&\"'") == "a&lt;b&gt;&amp;&quot;&#39;");
  CHECK(vkh::html_text("\x01\n\x7f") == "\\x01\\x0a\\x7f");
  CHECK(vkh::html_text("a\u2028b\u202ec") == "a\\u{2028}b\\u{202e}c");
  CHECK(vkh::html_text("\u00e4\u2192") == "\u00e4\u2192");
  const std::string odd = "</script><!--&\u2028\u2029\"\\\x01";
  const std::string safe = vkh::script_json(json(odd).dump());
  for (const char* part : {"<", ">", "&", "\u2028", "\u2029"})
    CHECK(safe.find(part) == std::string::npos);
  CHECK(json::parse(safe) == odd);
}

TEST_CASE("base64 by RFC 4648's examples") {
  const char* coded[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (size_t i = 0; i <= 6; ++i)
    CHECK(vkh::base64(std::string("foobar").substr(0, i)) == coded[i]);
  CHECK(vkh::base64(std::string("\xff\xfe\xfd")) == "//79");
}

TEST_CASE("a page carries its answer, its verdict and its names") {
  Invented pair = small_pair();
  for (const double share : {1.2, 0.5, Invented::middle(), 0.0}) {
    pair.ask(share);
    const std::string page = vkh::to_page(pair.contents());
    const std::string text = vkh::to_json(pair.answer);
    CHECK(script(page, "answer") == json::parse(text));
    const std::string word = between(page, "<span id=\"word\">", "</span>");
    CHECK(word == vkh::headline_of(pair.answer).word);
    CHECK(between(page, "<p class=\"words\" id=\"words\">", "</p>") ==
          vkh::html_text(vkh::headline_of(pair.answer).sentence));
    const std::string exact = between(text, "\"interval\":{\"lower\":", ",");
    CHECK(count_of(page, ">[" + exact + ", ") == 1);
    CHECK(between(page, "<h1>", "</h1>") == "bracket as scanned.ply against bracket.stl");
    CHECK(count_of(page, "<b>A</b> bracket as scanned.ply") == 1);
    CHECK(count_of(page, "Nothing was fitted: A and B were measured as they lie.") == 1);
    CHECK(page.find("{{") == std::string::npos);
  }
}

TEST_CASE("a page says which way outward is where B is inside out") {
  Invented pair = small_pair();
  const auto warns = [&] {
    const std::string page = vkh::to_page(pair.contents());
    return count_of(page,
                    "Check the two files: B is inside out, so that outward means into it, and "
                    "inward out of it.");
  };
  CHECK(warns() == 0);
  pair.answer.notes = {
      vkh::note_of(vkh::NoteCode::kInsideOut, "B is inside out, so that over means inside it: x")};
  CHECK(warns() == 1);
}

TEST_CASE("a page tells the shares of both areas, and first the one that decides") {
  Invented pair = small_pair();
  pair.ask(1.2);
  vkh::Answer& answer = pair.answer;
  answer.max->area = 0.99;
  answer.max->area_requested = "99%";
  const auto give = [&](std::optional<vkh::SurveyResult>& survey, double lower, double upper) {
    survey.emplace();
    survey->statistics.emplace();
    survey->statistics->bands = {{.distance = answer.max->limit.within, .share = {lower, upper}}};
  };
  give(answer.survey_a, 0.995, 0.996);
  give(answer.survey_b, 0.9, 0.95);
  const std::string sentence = vkh::headline_of(answer).sentence;
  INFO(sentence);
  CHECK(sentence.starts_with("89.99 to 95.01 % of the area of B is within "));
  CHECK(count_of(sentence, ". 99.49 to 99.61 % of the area of A is within ") == 1);
  CHECK(sentence.ends_with(". Asked for: 99%."));
}

TEST_CASE("a page has the title that was asked for") {
  const Invented pair = small_pair();
  vkh::PageContents contents = pair.contents();
  contents.title = "Lot 7 <of 9>";
  const std::string page = vkh::to_page(contents);
  CHECK(between(page, "<h1>", "</h1>") == "Lot 7 &lt;of 9&gt;");
  CHECK(between(page, "<title>", "</title>") == "DISTANCE: Lot 7 &lt;of 9&gt;");
  CHECK(count_of(page, "<b>A</b> bracket as scanned.ply") == 1);
}

TEST_CASE("a page has no words of the method, and no options to ask for") {
  Invented pair = small_pair();
  for (const double share : {1.2, 0.5, Invented::middle(), 0.0}) {
    pair.ask(share);
    const std::string page = vkh::to_page(pair.contents());
    const std::string text = between(page, "<body", "<section class=\"record\">");
    for (const char* word : {"h(A", "witness", " decided", "pruned", "upper bound", "certified",
                             "--symmetric", "--worst", "--time", "the file does not say"})
      CHECK_MESSAGE(count_of(text, word) == 0, word);
    CHECK(count_of(text, "<dd>mm, by --unit</dd>") == 1);
  }
}

TEST_CASE("a figure reads the same wherever it stands on a page") {
  Invented pair = small_pair();
  pair.ask(0.5);
  const std::string page = vkh::to_page(pair.contents());
  const std::string largest =
      vkh::length_text(pair.answer, vkh::deviation_of(pair.answer, pair.answer.a_to_b));
  CHECK(count_of(page, "<th scope=\"row\">largest deviation</th><td>" + largest + "</td>") == 1);
  CHECK(count_of(page, "<span class=\"length\">" + largest + "</span>") >= 1);
  // The share within the limit: the survey's, in the table and in what the viewer counts by.
  const vkh::AreaWithin& band = pair.statistics_a().bands[1];
  pair.answer.max->limit = {band.distance, band.distance};
  const std::string again = vkh::to_page(pair.contents());
  CHECK(count_of(again, "<td>" + vkh::share_text(band.share) + "</td>") == 1);
  const json side = script(again, "data")["sides"][0];
  CHECK(side["atLimit"] == json{band.share.lower, band.share.upper});
}

TEST_CASE("a page says that a measurement was cut short, and why") {
  Invented pair = small_pair();
  CHECK(count_of(vkh::to_page(pair.contents()), "Unfinished") == 0);
  CHECK(count_of(vkh::to_page(pair.contents()), "Cut short") == 0);
  pair.answer.survey_a = vkh::SurveyResult{};
  const std::string finer = "More effort makes ranges narrower";
  pair.answer.survey_a->ended = vkh::SurveyEnd::kEffort;
  CHECK(count_of(vkh::to_page(pair.contents()), finer) == 1);
  for (const auto& [end, why] : {std::pair{vkh::SurveyEnd::kTime, "the time that was set is over"},
                                 {vkh::SurveyEnd::kMemory, "no memory for more"},
                                 {vkh::SurveyEnd::kCancelled, "the measurement was stopped"}}) {
    pair.answer.survey_a->ended = end;
    const std::string page = vkh::to_page(pair.contents());
    CHECK(count_of(page, "Cut short: figures and colours of A could be finer") == 1);
    CHECK(count_of(page, why) == 1);
    CHECK(count_of(page, finer) == 0);
  }
  pair.answer.survey_b = pair.answer.survey_a;
  CHECK(count_of(vkh::to_page(pair.contents()), "Cut short: figures and colours of A and of B") ==
        1);
  pair.answer.survey_a->ended = pair.answer.survey_b->ended = vkh::SurveyEnd::kMet;
  pair.answer.a_to_b.status = vkh::Status::kTime;
  CHECK(count_of(vkh::to_page(pair.contents()), "Unfinished: the largest deviation of A from B") ==
        1);
  pair.ask(1.2);  // a verdict that is proven is not unfinished
  const std::string proven = vkh::to_page(pair.contents());
  CHECK(count_of(proven, "Unfinished") == 0);
  CHECK(count_of(proven, "The verdict is proven; the largest deviation of A from B") == 1);
}

TEST_CASE("a length is a number inside where both ends agree, and outward otherwise") {
  using vkh::figure_text;
  CHECK(figure_text({0.351904, 0.352241}) == "0.352");
  CHECK(figure_text({0.05726778, 0.05726925}) == "0.057268");
  CHECK(figure_text({0.0084000001, 0.01106}) == "0.0084 to 0.0111");
  CHECK(figure_text({0, 0}) == "0");
  CHECK(figure_text({0, 0.25}) == "at most 0.25");
  CHECK(figure_text({0.375, std::numeric_limits<double>::infinity()}) == "at least 0.375");
  CHECK(figure_text({0, std::numeric_limits<double>::infinity()}) == "not known");
  const vkh::Limit limit{std::nextafter(0.1, 0), std::nextafter(0.1, 1)};
  CHECK(figure_text({0.10000205, 0.10000225}, limit) == "0.1000021");
  CHECK(figure_text({0.0999991, 0.1000002}, limit) == "0.1");
  CHECK(figure_text({0.0565001, 0.0999992}, limit) == "0.0565 to 0.1");
  vkh::test::Random random(5);
  for (int i = 0; i < 2000; ++i) {  // what is written encloses it, or is inside
    const double lower = random.unit() * std::pow(10.0, 6 * random.unit() - 3);
    const double upper = lower * (1 + random.unit() * std::pow(10.0, -5 * random.unit()));
    const std::string text = figure_text({lower, upper});
    const size_t to = text.find(" to ");
    const double first = std::stod(text);
    if (to == std::string::npos) {
      CHECK(first >= lower);
      CHECK(first <= upper);
      const double estimate = lower + random.unit() * (upper - lower);
      const double told = std::stod(vkh::estimate_text(estimate, {lower, upper}));
      CHECK(told >= lower);
      CHECK(told <= upper);
      continue;
    }
    CHECK(first <= lower);
    CHECK(std::stod(text.substr(to + 4)) >= upper);
  }
}

TEST_CASE("a band is named by the number that was typed") {
  vkh::Answer answer;
  answer.unit = "mm";
  for (const double distance : {0.1, 0.3, 0.7, 1e-7, 12345.678})
    CHECK(std::stod(vkh::band_text(answer, distance)) == distance);
  CHECK(vkh::band_text(answer, 0.3) == "0.3 mm");
}

TEST_CASE("shares are rounded outward, and 0 and 100 percent are exact") {
  CHECK(vkh::share_text({0.988744, 0.98899}) == "98.87 to 98.90 %");
  CHECK(vkh::share_text({1, 1}) == "100 %");
  CHECK(vkh::share_text({0, 0}) == "0 %");
  CHECK(vkh::share_text({0.999999, 1}) == "99.99 to 100 %");
  CHECK(vkh::share_text({0, 1e-9}) == "0 to 0.01 %");
  CHECK(vkh::share_text({0.9949999, 0.9949999}, 0.995) == "99.49 to 99.499990 %");
}

TEST_CASE("a page names every file that was read, by its hash") {
  Invented pair = small_pair();
  CHECK(count_of(vkh::to_page(pair.contents()), "other files read") == 0);
  pair.answer.inputs[1].files = {{"in/x.bin", std::string(64, 'e')}, {"<y>.bin", ""}};
  const std::string row = between(vkh::to_page(pair.contents()), "other files read</th>", "</tr>");
  CHECK(row.find("in/x.bin") < row.find(std::string(64, 'e')));
  CHECK(row.find("&lt;y&gt;.bin") < row.find("not known"));
}

TEST_CASE("a page has no more elements when texts are odd, and needs no network") {
  Invented pair = small_pair();
  const std::string plain = vkh::to_page(pair.contents());
  pair.name_oddly();
  const std::string odd = vkh::to_page(pair.contents());
  for (const char* part : {"<script", "</script", "<b>", "<!--"})
    CHECK(count_of(odd, part) == count_of(plain, part));
  vkh::PageContents titled = pair.contents();
  titled.title = pair.answer.inputs[0].path;
  CHECK(count_of(vkh::to_page(titled), "<script") == count_of(plain, "<script"));
  CHECK(script(odd, "answer")["inputs"][0]["path"].get<std::string>().starts_with("</script>"));
  CHECK(odd.find("default-src 'none'") != std::string::npos);
  const std::string body = between(odd, "<body", "<script>");
  CHECK(body.find("src=\"http") == std::string::npos);
  CHECK(body.find("href=") == std::string::npos);
  CHECK(body.find(" style=") == std::string::npos);  // its policy would refuse them
}

TEST_CASE("a picture stands in, or a sentence says that there is none") {
  Invented pair = small_pair();
  CHECK(count_of(vkh::to_page(pair.contents()), "No picture was drawn for this page.") == 2);
  pair.picture = "not really a PNG";
  const std::string page = vkh::to_page(pair.contents());
  CHECK(count_of(page, "src=\"data:image/png;base64," + vkh::base64(pair.picture) + "\"") == 2);
  pair.picture.assign(3'000'000, 'x');
  CHECK(count_of(vkh::to_page(pair.contents()), "The picture was too large for this file.") == 2);
}

TEST_CASE("a page is no larger than it may be") {
  const Invented pair(vkh::test::torus(20, 6, 200, 100), vkh::test::uv_sphere(18, 100, 150));
  const size_t whole = vkh::to_page(pair.contents()).size();
  CHECK(whole < 5'000'000);
  const size_t bare = vkh::to_page(pair.contents(), {.bytes = 1}).size();
  for (const size_t bytes : {bare + 150'000, bare + 60'000}) {
    const std::string page = vkh::to_page(pair.contents(), {.bytes = bytes});
    CHECK(page.size() <= bytes);
    CHECK(page.size() > bare + (bytes - bare) / 3);
    const json data = script(page, "data");
    CHECK(count_of(data["sides"][0]["caption"], "Simplified for viewing to ") == 1);
    CHECK(data["sides"][0]["mesh"]["faces"] < pair.a.faces.size());
  }
  CHECK(script(vkh::to_page(pair.contents(), {.bytes = 1}), "data")["sides"][0].contains("mesh") ==
        false);
}

TEST_CASE("a page of a field that is nowhere bounded, of one that is 0") {
  Invented pair = small_pair();
  pair.set_upper(std::numeric_limits<double>::infinity());
  std::string page = vkh::to_page(pair.contents());
  CHECK(count_of(page, "<dd>not known</dd>") == 1);
  CHECK(script(page, "data")["top"] == 0);
  pair.set_upper(0);
  page = vkh::to_page(pair.contents());
  CHECK(count_of(page, "Every point of A lies on B.") == 1);
  CHECK(count_of(page, "There are none: nothing of A is known to be off B.") == 1);
}

TEST_CASE("one stray triangle does not set the colours of all others") {
  Invented pair = small_pair();
  pair.answer.b_to_a.reset();
  pair.has_maps = false;
  pair.field_a.upper[0] *= 1000;
  pair.answer.a_to_b.upper = pair.field_a.upper[0];
  const json data = script(vkh::to_page(pair.contents()), "data");
  CHECK(data["bar"] == pair.statistics_a().percentiles.back().distance.upper);
  CHECK(data["top"] == pair.field_a.upper[0]);
  pair.ask(0.5);
  CHECK(script(vkh::to_page(pair.contents()), "data")["bar"] ==
        doctest::Approx(1.5 * pair.answer.max->limit.beyond));
  pair.ask(20);  // a good part is in the colours of a small deviation
  CHECK(script(vkh::to_page(pair.contents()), "data")["bar"] ==
        doctest::Approx(1.5 * pair.answer.max->limit.beyond));
}

TEST_CASE("a page has the colours of the map that was asked for") {
  const Invented pair = small_pair();
  const vkh::PageContents contents = pair.contents({.map = vkh::ColourMap::kBatlow});
  const std::string colours =
      script(vkh::to_page(contents), "data")["sides"][0]["scale"]["colours"];
  CHECK(colours.size() == (6 + 16 + 6) * 6);
  CHECK(colours.substr(6 * 6, 6) == "011959");
  CHECK(colours.substr(21 * 6, 6) == "faccfa");
}

TEST_CASE("templates repeat, leave out and escape") {
  const nlohmann::ordered_json data = {
      {"name", "<&>"}, {"none", ""}, {"rows", {{{"x", 1}, {"name", "in"}}, {{"x", 2}}}}};
  CHECK(vkh::rendered("{{name}}{{{name}}}{{#none}}a{{/none}}{{^none}}b{{/none}}", data) ==
        "&lt;&amp;&gt;<&>b");
  CHECK(vkh::rendered("{{#rows}}{{x}}{{name}};{{/rows}}", data) == "1in;2&lt;&amp;&gt;;");
  CHECK_THROWS_AS(vkh::rendered("{{#rows}}", data), std::logic_error);
}

}  // namespace
