// The text on a picture, and its colours.
#include "host/show/legend.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

#include "host/base/decimal.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using namespace vkh::drawing;

struct Sample {
  Mesh mesh = make_mesh("a", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  Field field{{0}, {1}};
  Picture picture{.mesh = mesh, .field = field, .interval = {}};
};

TEST_CASE("the maps begin and end as published, and rise in lightness") {
  CHECK(map_colour(ColourMap::kViridis, 0) == Rgb{0x44, 0x01, 0x54});
  CHECK(map_colour(ColourMap::kViridis, 1) == Rgb{0xfd, 0xe7, 0x25});
  CHECK(map_colour(ColourMap::kBatlow, 0) == Rgb{1, 25, 89});
  CHECK(map_colour(ColourMap::kBatlow, 1) == Rgb{250, 204, 250});
  CHECK(map_colour(ColourMap::kCividis, 0) == Rgb{0x00, 0x22, 0x4e});
  CHECK(map_colour(ColourMap::kCividis, 1) == Rgb{0xfe, 0xe8, 0x38});
  for (const ColourMap map : {ColourMap::kViridis, ColourMap::kBatlow, ColourMap::kCividis}) {
    double last = -1;
    for (int i = 0; i <= 16; ++i) {
      const Rgb c = map_colour(map, i / 16.0);
      const double light = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
      CHECK(light > last);
      last = light;
    }
  }
}

TEST_CASE("between two steps a length has the upper one's colour") {
  CHECK(map_colour(ColourMap::kViridis, 1e-9) == map_colour(ColourMap::kViridis, 1 / 255.0));
}

TEST_CASE("ticks are round numbers within the range") {
  struct Case {
    Enclosure range;
    std::vector<std::string> text;
    std::string power;
  };
  const std::vector<Case> cases = {
      {{0, 1}, {"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}, ""},
      {{0, 2.5e-9}, {"0.0", "0.5", "1.0", "1.5", "2.0", "2.5"}, "1e-9"},
      {{0, 4e6}, {"0", "1", "2", "3", "4"}, "1e6"},
      {{0, 500}, {"0", "100", "200", "300", "400", "500"}, ""},
      {{-1, 1}, {"\u22121.0", "\u22120.5", "0.0", "0.5", "1.0"}, ""},
      {{0, 0}, {"0"}, ""},
      {{3, 3}, {"3"}, ""}};
  for (const Case& c : cases) {
    CAPTURE(c.range.upper);
    const Ticks ticks = ticks_of(c.range, 5);
    CHECK(ticks.text == c.text);
    CHECK(ticks.power == c.power);
    for (const double at : ticks.at) {
      CHECK(at >= c.range.lower - 1e-9 * std::abs(c.range.lower));
      CHECK(at <= c.range.upper * (1 + 1e-9));
    }
  }
}

TEST_CASE("an interval is printed outward") {
  Sample s;
  for (const Enclosure h : {Enclosure{0.1, 0.1},
                            {1.0 / 3, 2.0 / 3},
                            {0.0443812345678, 0.0443812345679},
                            {1e-9, 1.1e-9},
                            {1e6 / 3, 1e6 / 3}}) {
    s.picture.interval = h;
    const PrintedInterval text = printed(s.picture);
    CHECK(std::strtod(text.lower.c_str(), nullptr) <= h.lower);
    CHECK(std::strtod(text.upper.c_str(), nullptr) >= h.upper);
    CHECK(text.lower.size() <= 15);
  }
  s.picture.interval.upper = std::numeric_limits<double>::infinity();
  CHECK(printed(s.picture).upper == "\u221e");
}

TEST_CASE("an end is not printed on the other side of the limit") {
  Sample s;
  s.picture.limit = Limit{0.1, 0.1};
  s.picture.interval = {0, std::nextafter(0.1, 0.0)};
  CHECK(std::strtod(printed(s.picture).upper.c_str(), nullptr) <= 0.1);
  s.picture.interval = {std::nextafter(0.1, 1.0), 1};
  CHECK(std::strtod(printed(s.picture).lower.c_str(), nullptr) >= 0.1);
  s.picture.unit = "mm";
  CHECK(limit_text(s.picture) == "0.1 mm");
}

TEST_CASE("a long text is shortened in the middle, and no character is cut") {
  CHECK(shortened("short.stl", 20, 400) == "short.stl");
  const std::string name =
      "parts/\u0434\u0435\u0442\u0430\u043b\u044c_" + std::string(200, 'x') + "_v12.stl";
  for (const double width : {60.0, 150.0, 300.0, 500.0}) {
    const std::string shown = shortened(name, 20, width);
    CHECK(text_width(shown, 20) <= width);
    CHECK(shown.find("\u2026") != std::string::npos);
    CHECK(shown.front() == 'p');
    CHECK(shown.back() == 'l');
  }
  const std::string russian =
      shortened("\u0434\u0435\u0442\u0430\u043b\u044c\u0434\u0435\u0442\u0430\u043b\u044c", 20, 80);
  CHECK(text_width(russian, 20) <= 80);
  CHECK(russian.substr(0, 2) == "\u0434");
}

TEST_CASE("any bytes are text") {
  CHECK(text_width("", 20) == 0);
  for (const char* bytes :
       {"\xff\xfe", "\xc3", "\x01", "\x7f", "\xf4\x8f\xbf\xbf", "\xed\xa0\x80", "\xe2\x82"}) {
    CHECK(text_width(bytes, 20) > 0);
    CHECK_NOTHROW(shortened(bytes, 20, 1));
  }
}

TEST_CASE("lines are wrapped between words") {
  const std::vector<std::string> lines = wrapped("one two three four five six seven", 20, 110, 3);
  CHECK(lines.size() == 3);
  for (const std::string& line : lines) CHECK(text_width(line, 20) <= 110);
  CHECK(lines[0].substr(0, 3) == "one");
  CHECK(wrapped("one", 20, 500, 3) == std::vector<std::string>{"one"});
}

TEST_CASE("counts are grouped by thousands") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(999) == "999");
  CHECK(grouped(34834) == "34,834");
  CHECK(grouped(1234567) == "1,234,567");
}

TEST_CASE("a view, a map and a size are what they say") {
  CHECK(parse_view("--view", "iso").kind == View::Kind::kIso);
  CHECK(parse_view("--view", "six").kind == View::Kind::kSix);
  const View view = parse_view("--view", "1,-0.5,2e1");
  CHECK(view.kind == View::Kind::kDirection);
  CHECK(view.direction == glm::dvec3(1, -0.5, 20));
  for (const char* wrong :
       {"", "top", "1,2", "1,2,3,4", "0,0,0", "1,,2", "nan,1,1", "inf,0,0", "1,2,3 "}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(parse_view("--view", wrong), UsageError);
  }
  CHECK(parse_colour_map("--map", "batlow") == ColourMap::kBatlow);
  CHECK_THROWS_WITH_AS(parse_colour_map("--map", "jet"),
                       "--map 'jet': expected viridis, batlow or cividis", UsageError);
  PictureOptions options;
  parse_picture_size("--size", "800x600", options);
  CHECK(options.width == 800);
  CHECK(options.height == 600);
  for (const char* wrong : {"", "800", "800x", "10x10", "9000x9000", "800x600x2", "-800x600"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(parse_picture_size("--size", wrong, options), UsageError);
  }
}

}  // namespace
