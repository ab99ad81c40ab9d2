// Texts of points as writers vary them, each way crossed with the others: read right, to the last
// point and by blocks, or refused by a message that names the cause.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "host/read/readers.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/note.h"

namespace {

using vkh::DVec3;
using vkh::Mesh;

using Words = std::vector<std::string>;

std::string joined(const Words& words, const std::string& separator) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : separator) + words[i];
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// What a read gives: points, or the words of its refusal.
struct Outcome {
  std::vector<DVec3> points;
  std::string refusal;

  bool operator==(const Outcome&) const = default;
};

Outcome read(const std::string& bytes, const std::string& name, size_t block) {
  try {
    const Mesh mesh =
        vkh::parse_mesh({.name = name,
                         .bytes = bytes,
                         .limits = {.points = true, .threads = 1, .block_bytes = block}});
    return {mesh.vertices, ""};
  } catch (const vkh::InputError& error) {
    return {{}, error.what()};
  }
}

const std::vector<DVec3> kPoints = {{3, -1, 2}, {-2, 4, 8}, {7, 7, -5},
                                    {0, 2, 1},  {-6, 5, 0}, {1, 1, 9}};

/// How numbers are written.
struct Numbers {
  const char* kind;
  bool has_points, has_commas;
  std::string (*text)(int);
};

const std::array<Numbers, 5> kNumbers = {
    {{"integers", false, false, [](int n) { return std::to_string(n); }},
     {"fractions", true, false, [](int n) { return std::to_string(n) + ".000"; }},
     {"exponents", true, false,
      [](int n) { return (n < 0 ? "" : "+") + std::to_string(n) + ".0E+00"; }},
     {"quoted", false, false, [](int n) { return '"' + std::to_string(n) + '"'; }},
     {"decimal commas", false, true, [](int n) { return std::to_string(n) + ",0"; }}}};

/// The columns of each row by their names.
const std::vector<Words> kOrders = {{"x", "y", "z"},
                                    {"x", "y", "z", "intensity"},
                                    {"id", "x", "y", "z"},
                                    {"y", "x", "z"},
                                    {"z", "y", "x", "label"},
                                    {"id", "y", "x", "z", "r"},
                                    {"red", "green", "x", "y", "blue", "z"}};

bool is_plain(const Words& order) { return order[0] == "x" && order[1] == "y" && order[2] == "z"; }

/// How a line before the rows names the columns; nothing where there is none.
struct Naming {
  const char* kind;
  bool needs_cells;  ///< its names hold blanks
  std::string (*line)(const Words&, const std::string& separator);
};

Words each(const Words& names, const std::function<std::string(const std::string&)>& change) {
  Words changed;
  for (const std::string& name : names) changed.push_back(change(name));
  return changed;
}

std::string upper(std::string name) {
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

const std::array<Naming, 13> kNamings = {
    {{"none", false, [](const Words&, const std::string&) { return std::string(); }},
     {"names", false, [](const Words& n, const std::string& s) { return joined(n, s); }},
     {"upper", false,
      [](const Words& n, const std::string& s) { return joined(each(n, upper), s); }},
     {"quoted", false,
      [](const Words& n, const std::string& s) {
        return joined(each(n, [](const std::string& name) { return '"' + name + '"'; }), s);
      }},
     {"units", true,
      [](const Words& n, const std::string& s) {
        return joined(each(n, [](const std::string& name) { return name + " [mm]"; }), s);
      }},
     {"brackets", false,
      [](const Words& n, const std::string& s) {
        return joined(each(n, [](const std::string& name) { return name + "(m)"; }), s);
      }},
     {"coordinates", true,
      [](const Words& n, const std::string& s) {
        return joined(each(n,
                           [](const std::string& name) {
                             return name.size() > 1 ? "A " + name : "Coord. " + upper(name);
                           }),
                      s);
      }},
     {"GIS", false,
      [](const Words& n, const std::string& s) {
        return joined(each(n,
                           [](const std::string& name) {
                             return name.size() > 1 ? upper(name) : "POINT_" + upper(name);
                           }),
                      s);
      }},
     {"# names", false, [](const Words& n, const std::string& s) { return "# " + joined(n, s); }},
     {"#names", false, [](const Words& n, const std::string& s) { return "#" + joined(n, s); }},
     {"//names", false,
      [](const Words& n, const std::string& s) { return "//" + joined(each(n, upper), s); }},
     {"; names", false, [](const Words& n, const std::string& s) { return "; " + joined(n, s); }},
     {"# columns: names", false,
      [](const Words& n, const std::string& s) { return "# columns: " + joined(n, s); }}}};

const std::array<std::string, 9> kSeparators = {" ",   "   ", "\t", ",",   ", ",
                                                " , ", ";",   "; ", " \t "};

enum class Count { kNone, kRight, kFewer, kMore };
enum class Extra { kNone, kComments, kBlankLines, kNoLastEnd, kTrailing, kTwoScans };
enum class Encoding { kPlain, kMark, kUtf16 };

/// One way to write the points.
struct Way {
  const Words* order;
  const Naming* naming;
  std::string separator;
  const Numbers* numbers;
  std::string line_end;
  Count count;
  Extra extra;
  Encoding encoding;

  bool has_cells() const { return separator.find_first_of(",;") != std::string::npos; }
  bool are_commas() const { return separator.find(',') != std::string::npos; }
  bool is_named() const { return naming != kNamings.data(); }
};

std::string row_of(const Way& way, size_t point) {
  Words cells;
  for (const std::string& name : *way.order) {
    const size_t axis = name.size() == 1 ? std::string("xyz").find(name) : std::string::npos;
    const int value = axis != std::string::npos
                          ? static_cast<int>(kPoints[point][static_cast<int>(axis)])
                          : static_cast<int>(point) + 100;
    cells.push_back(name == "label" ? "ground" : way.numbers->text(value));
  }
  const bool ends_in_separator = way.extra == Extra::kTrailing;
  return joined(cells, way.separator) + (ends_in_separator ? way.separator : "") + "\n";
}

size_t announced(const Way& way, size_t count) {
  return way.count == Count::kFewer ? count - 1 : count + (way.count == Count::kMore ? 1 : 0);
}

std::string text_of(const Way& way) {
  std::string text = way.naming->line(*way.order, way.separator);
  if (!text.empty()) text += "\n";
  if (way.extra == Extra::kBlankLines) text += "\n  \n";
  const size_t first_scan = way.extra == Extra::kTwoScans ? 2 : kPoints.size();
  if (way.count != Count::kNone) text += std::to_string(announced(way, first_scan)) + "\n";
  for (size_t i = 0; i < kPoints.size(); ++i) {
    if (i == first_scan) text += std::to_string(kPoints.size() - first_scan) + "\n";
    if (i == 2 && way.extra == Extra::kComments) text += "# station 2 of 3\n";
    if (i == 2 && way.extra == Extra::kBlankLines) text += "\n";
    text += row_of(way, i);
  }
  if (way.extra == Extra::kComments) text += "// end\n";
  if (way.extra == Extra::kNoLastEnd) text.pop_back();
  text = replaced(text, "\n", way.line_end);
  if (way.encoding == Encoding::kMark) return "\xef\xbb\xbf" + text;
  if (way.encoding == Encoding::kPlain) return text;
  std::string wide = "\xff\xfe";
  for (const char c : text) wide += {c, '\0'};
  return wide;
}

// Returns words of which one is in the refusal; nothing where the points are read.
Words refusal_of(const Way& way) {
  const Words& order = *way.order;
  if (way.encoding == Encoding::kUtf16) return {"UTF-16"};
  if (way.numbers->has_commas) return {"comma"};
  const bool is_unclear = way.are_commas() && order.size() > 3 && !way.numbers->has_points;
  if (!way.is_named() && is_unclear) return {"commas that may be decimal ones"};
  if (way.extra == Extra::kTwoScans && way.count != Count::kRight)
    return {"announces", "as coordinate", "no coordinate", "column"};
  if (!way.is_named() && order[0] == "id")
    return {"first column of increasing integers", "announces"};
  if (way.count == Count::kFewer || way.count == Count::kMore) return {"announces"};
  return {};
}

// Rows in another order without names cannot be recognised, unless they have points' numbers.
bool is_way(const Way& way) {
  const bool tells = way.is_named() || is_plain(*way.order) || (*way.order)[0] == "id";
  const bool has_room = !way.naming->needs_cells || way.has_cells();
  return tells && has_room;
}

template <class F>
void for_each_way(const F& visit) {
  const std::array<std::string, 3> ends = {"\n", "\r\n", "\r"};
  for (const Words& order : kOrders)
    for (const Naming& naming : kNamings)
      for (const std::string& separator : kSeparators)
        for (const Numbers& numbers : kNumbers)
          for (const std::string& end : ends)
            for (int count = 0; count < 4; ++count)
              for (int extra = 0; extra < 6; ++extra)
                for (int encoding = 0; encoding < 3; ++encoding)
                  visit(Way{&order, &naming, separator, &numbers, end, static_cast<Count>(count),
                            static_cast<Extra>(extra), static_cast<Encoding>(encoding)});
}

bool is_as_expected(const Outcome& outcome, const Words& refusal) {
  if (refusal.empty()) return outcome.points == kPoints;
  return std::any_of(refusal.begin(), refusal.end(), [&](const std::string& words) {
    return outcome.refusal.find(words) != std::string::npos;
  });
}

// Every so manieth way is tried: a prime that divides the length of none of the inner loops, so
// that each choice meets each other one.
#ifdef VKH_SANITIZED
constexpr size_t kStep = 31;
#else
constexpr size_t kStep = 7;
#endif

}  // namespace

TEST_CASE("text points of all ways are read right, or refused by their cause") {
  size_t ways = 0, read_right = 0, refused = 0, wrong = 0;
  for_each_way([&](const Way& way) {
    if (!is_way(way) || ++ways % kStep != 0) return;
    const std::string text = text_of(way);
    const Words refusal = refusal_of(way);
    const Outcome outcome = read(text, "a.txt", 0);
    const bool is_right = is_as_expected(outcome, refusal);
    const bool is_same = outcome == read(text, "a.txt", 16);
    ++(refusal.empty() ? read_right : refused);
    if ((is_right && is_same) || ++wrong > 20) return;
    CAPTURE(text);
    CAPTURE(outcome.refusal);
    CAPTURE(joined(refusal, " | "));
    CHECK(is_right);
    CHECK(is_same);
  });
  MESSAGE(read_right << " read, " << refused << " refused, " << wrong << " wrong");
  CHECK(wrong == 0);
  CHECK(read_right > 30'000 / kStep * 5);
  CHECK(refused > 100'000 / kStep * 5);
}
