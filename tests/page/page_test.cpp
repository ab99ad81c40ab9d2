// A page as text: its contents are the answer's, no input can end an element in it, it fits.
#include "host/show/page.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "host/show/escape.h"
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

TEST_CASE("a page carries its answer and says what it says") {
  Invented pair = small_pair();
  for (const double share : {1.2, 0.5, Invented::middle(), 0.0}) {
    pair.ask(share);
    const std::string page = vkh::to_page(pair.contents());
    const std::string text = vkh::to_json(pair.answer);
    CHECK(script(page, "answer") == json::parse(text));
    const json answer = json::parse(text);
    const std::string word = between(page, "<span id=\"word\">", "</span>");
    const std::string words = between(page, "<p class=\"words\" id=\"words\">", "</p>");
    const std::string said = vkh::html_text(answer["words"].get<std::string>());
    const std::string start = share == 0 ? "" : word + "  ";
    CHECK(said == start + words);
    const std::string digits = between(page, "id=\"digits\">", "</code>");
    const std::string exact = between(text, "\"interval\":{\"lower\":", ",");
    CHECK(digits.starts_with("[" + exact + ", "));
    CHECK(count_of(page, "No alignment was done: the meshes were measured as they lie.") == 1);
    CHECK(page.find("{{") == std::string::npos);
  }
}

TEST_CASE("a page names every file that was read, by its hash") {
  Invented pair = small_pair();
  CHECK(count_of(vkh::to_page(pair.contents()), "files beneath") == 0);
  pair.answer.inputs[1].files = {{"in/x.bin", std::string(64, 'e')}, {"<y>.bin", ""}};
  const std::string row =
      between(vkh::to_page(pair.contents()), "SHA-256 of files beneath</th>", "</tr>");
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
  CHECK(script(odd, "answer")["inputs"][0]["path"].get<std::string>().starts_with("</script>"));
  CHECK(odd.find("default-src 'none'") != std::string::npos);
  const std::string body = between(odd, "<body>", "<script>");
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
  const Invented pair(vkh::test::torus(20, 6, 400, 200), vkh::test::uv_sphere(18, 200, 300));
  const size_t whole = vkh::to_page(pair.contents()).size();
  CHECK(whole < 5'000'000);
  const size_t bare = vkh::to_page(pair.contents(), {.bytes = 1}).size();
  for (const size_t bytes : {bare + 400'000, bare + 60'000}) {
    const std::string page = vkh::to_page(pair.contents(), {.bytes = bytes});
    CHECK(page.size() <= bytes);
    CHECK(page.size() > bare + (bytes - bare) / 3);
    const json data = script(page, "data");
    CHECK(data["sides"][0]["caption"].get<std::string>().starts_with("A decimated view of "));
    CHECK(data["sides"][0]["faces"] == pair.a.faces.size());  // counts are of the whole mesh
  }
  CHECK(script(vkh::to_page(pair.contents(), {.bytes = 1}), "data")["sides"][0].contains("mesh") ==
        false);
}

TEST_CASE("a page of a field that is nowhere bounded, of one that is 0, of faces without an area") {
  Invented pair = small_pair();
  const double infinity = std::numeric_limits<double>::infinity();
  pair.set_upper(infinity);
  json side = script(vkh::to_page(pair.contents()), "data")["sides"][0];
  for (const json& faces : side["within"]) CHECK(faces == 0);
  pair.set_upper(0);
  side = script(vkh::to_page(pair.contents()), "data")["sides"][0];
  CHECK(side["within"][0] == pair.a.faces.size());
  for (glm::dvec3& v : pair.a.vertices) v = {1, 2, 3};
  side = script(vkh::to_page(pair.contents()), "data")["sides"][0];
  CHECK(side["hasArea"] == false);
}

}  // namespace
