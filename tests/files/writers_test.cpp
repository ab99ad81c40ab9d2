// The places where writers of a format differ, each with what they write there: every two of them
// together, and random choices of all, are read as the plain file is, or refused by a message that
// names one of them. Whole and by blocks alike.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "host/read/readers.h"
#include "tests/files/gltf_document.h"
#include "tests/files/stored_zip.h"
#include "tests/shapes/shapes.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using test::Random;

/// What a writer may write at a place, and a part of the message if it is refused for that; one of
/// several, between bars.
struct Choice {
  std::string text;
  std::string refused = {};
};

/// The first choice is the plain one.
struct Place {
  std::string name;
  std::vector<Choice> choices;
};

/// The number of the choice at each place.
using Picked = std::vector<size_t>;

/// The texts that were picked, by the names of their places.
class Texts {
 public:
  Texts(const std::vector<Place>& places, const Picked& picked)
      : places_(places), picked_(picked) {}

  const std::string& operator[](const std::string& name) const { return choice_of(name).text; }
  const Choice& choice_of(const std::string& name) const {
    for (size_t i = 0; i < places_.size(); ++i)
      if (places_[i].name == name) return places_[i].choices[picked_[i]];
    FAIL("no place ", name);
    return places_[0].choices[0];
  }

 private:
  const std::vector<Place>& places_;
  const Picked& picked_;
};

struct Format {
  std::string file;
  std::vector<Place> places;
  std::string (*write)(const Texts& texts);
  /// Whether the choices together are read, though one of them alone is refused; or the reverse:
  /// then with a part of the message.
  bool (*is_read_together)(const Texts& texts) = [](const Texts&) { return false; };
};

/// The corners of the faces, in order, or the message.
struct Outcome {
  std::vector<glm::dvec3> corners;
  std::string refused;

  bool operator==(const Outcome&) const = default;
};

Outcome outcome_of(const std::string& file, const std::string& bytes, size_t block_bytes) {
  Outcome outcome;
  try {
    const Mesh mesh = parse_mesh(
        {.name = file, .bytes = bytes, .limits = {.threads = 1, .block_bytes = block_bytes}});
    for (const UVec3& face : mesh.faces)
      for (int k = 0; k < 3; ++k) outcome.corners.push_back(mesh.vertices[face[k]]);
  } catch (const InputError& error) {
    outcome.refused = error.what();
  }
  return outcome;
}

struct Counts {
  uint64_t read = 0, refused = 0, wrong = 0;
};

class Crossing {
 public:
  explicit Crossing(const Format& format) : format_(format) {
    plain_ = outcome_of(format.file, written(Picked(format.places.size())), SIZE_MAX);
    CAPTURE(plain_.refused);
    REQUIRE(!plain_.corners.empty());
  }

  Counts run(uint32_t random_count) {
    const size_t count = format_.places.size();
    for (size_t a = 0; a < count; ++a) {
      for (size_t b = a + 1; b < count; ++b) {
        for (size_t i = 0; i < format_.places[a].choices.size(); ++i) {
          for (size_t j = 0; j < format_.places[b].choices.size(); ++j) {
            Picked picked(count);
            picked[a] = i;
            picked[b] = j;
            check(picked);
          }
        }
      }
    }
    Random random(55);
    for (uint32_t i = 0; i < random_count; ++i) {
      Picked picked(count);
      for (size_t p = 0; p < count; ++p) {  // refused ones are rare, or all would be refused
        const auto& choices = format_.places[p].choices;
        picked[p] = random.below(static_cast<uint32_t>(choices.size()));
        if (!choices[picked[p]].refused.empty() && random.below(8) != 0) picked[p] = 0;
      }
      check(picked);
    }
    MESSAGE(format_.file, ": ", counts_.read, " read, ", counts_.refused, " refused, ",
            counts_.wrong, " wrong");
    return counts_;
  }

 private:
  std::string written(const Picked& picked) const {
    return format_.write(Texts(format_.places, picked));
  }

  std::string description_of(const Picked& picked) const {
    std::string text;
    for (size_t p = 0; p < picked.size(); ++p)
      if (picked[p] != 0)
        text += format_.places[p].name + " '" + format_.places[p].choices[picked[p]].text + "'; ";
    return text;
  }

  static bool says_one_of(const std::string& message, const std::string& parts) {
    std::istringstream list(parts);
    for (std::string part; std::getline(list, part, '|');)
      if (message.find(part) != std::string::npos) return true;
    return false;
  }

  bool is_right(const Picked& picked, const Outcome& outcome) const {
    bool may_refuse = false;
    for (size_t p = 0; p < picked.size(); ++p) {
      const Choice& choice = format_.places[p].choices[picked[p]];
      if (choice.refused.empty()) continue;
      may_refuse = true;
      if (says_one_of(outcome.refused, choice.refused)) return true;
    }
    if (may_refuse && !format_.is_read_together(Texts(format_.places, picked))) return false;
    return outcome == plain_;
  }

  void check(const Picked& picked) {
    const std::string bytes = written(picked);
    const Outcome outcome = outcome_of(format_.file, bytes, SIZE_MAX);
    ++(outcome.refused.empty() ? counts_.read : counts_.refused);
    const bool is_right_whole = is_right(picked, outcome);
    const bool is_same = outcome == outcome_of(format_.file, bytes, 50);
    if (is_right_whole && is_same) return;
    if (counts_.wrong++ > 5) return;
    CAPTURE(description_of(picked));
    CAPTURE(outcome.refused);
    CAPTURE(outcome.corners.size());
    CHECK(is_right_whole);
    CHECK(is_same);
  }

  const Format& format_;
  Outcome plain_;
  Counts counts_;
};

// Every two places are crossed in both; the random choices repeat the same paths with more of them
// together.
#ifdef VKH_SANITIZED
constexpr uint32_t kRandomCount = 1000;
#else
constexpr uint32_t kRandomCount = 4000;
#endif

void check_format(const Format& format, uint32_t random_count = kRandomCount) {
  const Counts counts = Crossing(format).run(random_count);
  CHECK(counts.wrong == 0);
  CHECK(counts.read > 100);
  CHECK(counts.refused > 10);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// The text as `encoding` and `line end` say.
std::string encoded(const std::string& text, const Texts& texts) {
  const std::string lines = replaced(text, "\n", texts["line end"]);
  if (texts["encoding"] != "UTF-16") return texts["encoding"] + lines;
  std::string wide = "\xff\xfe";
  for (const char c : lines) wide += {c, '\0'};
  return wide;
}

const Place kEncoding = {"encoding", {{""}, {"\xef\xbb\xbf"}, {"UTF-16", "UTF-16 text"}}};
const Place kLineEnd = {"line end", {{"\n"}, {"\r\n"}, {"\r"}}};

const std::vector<glm::dvec3> kCorners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
const std::vector<UVec3> kFaces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

std::string number_text(double x) { return std::to_string(static_cast<int>(x)); }

std::string position_text(const glm::dvec3& p, const std::string& blank = " ") {
  return number_text(p.x) + blank + number_text(p.y) + blank + number_text(p.z);
}

template <class T>
std::string raw(T value, bool is_big = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (is_big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string binary_stl(const std::string& header, uint32_t count, const std::string& attribute) {
  std::string bytes = header + raw(count);
  for (const UVec3& face : kFaces) {
    for (int i = 0; i < 3; ++i) bytes += raw(0.0f);
    for (int k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        bytes += raw(static_cast<float>(kCorners[face[k]][axis]));
    bytes += attribute;
  }
  return bytes;
}

std::string header_of(const std::string& text, char fill = ' ') {
  std::string header = text;
  header.resize(80, fill);
  return header;
}

const std::string kSecondBinary = binary_stl(header_of("another", '\0'), 4, std::string(2, '\0'));
const std::string kSecondText =
    "solid b\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid b\n";

std::string stl_text(const Texts& t) {
  std::string text = t["before"] + (t["solid"].empty() ? "" : t["solid"] + "\n");
  for (const UVec3& face : kFaces) {
    text += t["facet"] + " 0 0 1\n" + t["outer"] + "\n";
    for (int k = 0; k < 3; ++k) {
      text += t["vertex"] + t["blank"] +
              replaced(position_text(kCorners[face[k]], t["blank"]), "2", t["two"]) + "\n";
    }
    text += t["endloop"] + "\n" + t["endfacet"] + "\n" + t["between"];
  }
  text += t["endsolid"].empty() ? "" : t["endsolid"] + "\n";
  return encoded(text + t["behind"], t);
}

}  // namespace

TEST_CASE("text STL as it is written") {
  check_format(
      {"a.stl",
       {kEncoding,
        kLineEnd,
        {"before",
         {{""},
          {"\n \n"},
          {"# made by x\n"},
          {"// made by x\n\n"},
          {"; x\n! y\n"},
          {"made by x\n", "'made'"}}},
        {"solid",
         {{"solid a"},
          {"SOLID"},
          {"Solid a b c"},
          {" \tsolid"},
          {"solid # 1"},
          {"solid facet"},
          {""},
          {"solida", "'solida'"}}},
        {"facet", {{"facet normal"}, {"FACET NORMAL"}, {"  facet\t normal"}, {"facet", "'0'"}}},
        {"outer", {{"outer loop"}, {"Outer Loop"}, {" outer  loop"}, {"outerloop", "'outerloop'"}}},
        {"vertex", {{"vertex"}, {"VERTEX"}, {"v", "'v'"}}},
        {"blank", {{" "}, {"\t"}, {"   "}, {", ", ",'"}}},
        {"two",
         {{"2"}, {"+2.0E+000"}, {"0.2e1"}, {"2."}, {"2,0", "as coordinate"}, {"nan", "nan"}}},
        {"endloop", {{"endloop"}, {"end loop"}, {"ENDLOOP"}, {"End Loop"}, {"loop", "'loop'"}}},
        {"endfacet", {{"endfacet"}, {"end facet"}, {"EndFacet"}, {"facetend", "'facetend'"}}},
        {"between", {{""}, {"\n"}, {"color 1 0 0\n"}, {"# facet\n"}, {"part 2\n", "'part'"}}},
        {"endsolid",
         {{"endsolid a"},
          {"end solid a"},
          {"endsolid"},
          {"ENDSOLID"},
          {"endsolida"},
          {"End Solid\nendsolid"},
          {"", "the file ends"}}},
        {"behind",
         {{""},
          {"\n\n"},
          {std::string(3, '\0')},
          {"\x1a"},
          {kSecondBinary, "a zero byte in text"}}}},
       stl_text,
       [](const Texts& t) { return t["solid"].empty() && t["endsolid"].empty(); }});
}

TEST_CASE("binary STL as it is written") {
  check_format(
      {"a.stl",
       {{"header",
         {{header_of("", '\0')},
          {header_of("")},
          {header_of("solid a")},
          {header_of("solid a facet", '\0')},
          {header_of("# made by x", '\0')},
          {header_of("facet")}}},
        {"count",
         {{"4"}, {"3", "triangle"}, {"5", "triangle"}, {"70000000", "triangles announced"}}},
        {"attribute", {{std::string(2, '\0')}, {"\xff\x7f"}}},
        {"behind",
         {{""},
          {std::string(2, '\0')},
          {"made by x, 2026-11-28\n"},
          {std::string(40, '\0')},
          {kSecondText, "a text solid after the last binary triangle"},
          {"\n" + kSecondText, "a text solid after the last binary triangle"},
          {kSecondBinary, "a second binary STL after the last triangle"},
          {kSecondBinary + kSecondText, "solid after the last"},
          {kSecondBinary + kSecondBinary, "a second binary STL after the last triangle"}}}},
       [](const Texts& t) {
         return binary_stl(t["header"], static_cast<uint32_t>(std::stoul(t["count"])),
                           t["attribute"]) +
                t["behind"];
       }});
}

namespace {

/// The header; the vertices' count is off by what `vertices` says.
std::string ply_header(const Texts& t, const std::string& encoding) {
  const size_t rows = kCorners.size() + (t["unused"].empty() ? 0 : 1);
  std::string text = t["magic"] + "\n" + t["program"] + t["format"] + " " + encoding + " 1.0\n" +
                     t["comment"] + "element vertex " +
                     std::to_string(static_cast<int>(rows) + std::stoi(t["vertices"])) + "\n";
  for (const char* axis : {"x", "y", "z"}) text += "property " + t["type"] + " " + axis + "\n";
  text += t["colour"].empty() ? "" : "property " + t["colour"] + " red\n";
  text +=
      t["faces are"] == "strips" ? "element tristrips 1\n" : "element face " + t["faces"] + "\n";
  text += "property list " + t["list"] + " " + t["corners"] + "\n" + t["extra"];
  return text + t["end"] + "\n";
}

std::string ply_text(const Texts& t) {
  std::string text = ply_header(t, "ascii");
  for (const glm::dvec3& p : kCorners) {
    text += replaced(position_text(p, t["blank"]), "2", t["two"]) +
            (t["colour"].empty() ? "" : " 7") + t["behind vertex"] + "\n" + t["between"];
  }
  if (!t["unused"].empty()) {
    text += t["unused"] + " 0 " + t["unused"] + (t["colour"].empty() ? "" : " 7") +
            t["behind vertex"] + "\n";
  }
  if (t["faces are"] == "strips") {
    std::string row;
    for (const UVec3& face : kFaces) {
      for (int k = 0; k < 3; ++k) row += " " + std::to_string(face[k]);
      row += " -1";
    }
    text += std::to_string(4 * kFaces.size()) + row + "\n";
  } else {
    for (const UVec3& face : kFaces) {
      text += "3";
      for (int k = 0; k < 3; ++k) text += " " + std::to_string(face[k]);
      text += t["behind face"] + "\n" + t["between"];
    }
  }
  if (!t["extra"].empty()) text += "0.5\n";
  return encoded(text + t["behind"], t);
}

const std::vector<Place> kPlyHeader = {
    {"magic", {{"ply"}, {"ply "}, {"PLY", "'PLY'"}, {"ply x", "'x'"}}},
    {"program",
     {{""},
      {"comment x\n"},
      {"obj_info x\n"},
      {"made by x\n"},
      {"x 1.0\n\ny\n"},
      {"\n"},
      {"Format x\n", "'Format'"},
      {"elements 3\n", "'elements'"}}},
    {"format", {{"format"}, {" format "}, {"formatted", "'formatted'"}}},
    {"comment", {{""}, {"comment\n"}, {"obj_info n 1\n"}, {"\n"}, {"made by x\n", "'made'"}}},
    {"colour", {{""}, {"uchar"}, {"uint8"}, {"int"}}},
    {"list",
     {{"uchar int"},
      {"uint8 int32"},
      {"int int"},
      {"char short"},
      {"float int", "counted in floats"}}},
    {"corners", {{"vertex_indices"}, {"vertex_index"}, {"vertices", "has no such property"}}},
    {"extra", {{""}, {"element material 1\nproperty float shine\n"}}},
    {"end", {{"end_header"}, {"end_header "}, {"endheader", "'endheader'"}}}};

std::vector<Place> with(std::vector<Place> places, const std::vector<Place>& more) {
  places.insert(places.end(), more.begin(), more.end());
  return places;
}

}  // namespace

TEST_CASE("text PLY as it is written") {
  check_format(
      {"a.ply",
       with(kPlyHeader,
            {kEncoding,
             kLineEnd,
             {"type", {{"float"}, {"double"}, {"float32"}, {"real", "'real' as a type"}}},
             {"vertices", {{"0"}, {"-1", "line"}, {"1", "line"}, {"4000", "announced"}}},
             {"faces", {{"4"}, {"2", "line"}, {"5", "line"}}},
             {"faces are", {{"faces"}, {"strips"}}},
             {"blank", {{" "}, {"\t"}, {"  "}, {",", "line"}}},
             {"two", {{"2"}, {"2e0"}, {"2.0"}, {"-inf", "inf"}}},
             {"behind vertex", {{""}, {" 255"}, {" 1 0.5"}, {" x"}}},
             {"behind face", {{""}, {" 255 0 0"}, {" 1 7"}}},
             {"between", {{""}, {"\n"}, {"comment x\n"}, {"# x\n", "line"}}},
             {"unused", {{""}, {"nan"}, {"-nan(ind)"}, {"1.#INF"}}},
             {"behind", {{""}, {"\n\n"}, {"made by x\n"}, {"3 0 1 2\n3 0 1 2\n", "a row more"}}}}),
       ply_text,
       // One row of strips, which the count of faces does not count.
       [](const Texts& t) { return t["faces are"] == "strips"; }});
}

namespace {

std::string index_bytes(int64_t index, const std::string& list, bool is_big) {
  if (list == "char short") return raw(static_cast<int16_t>(index), is_big);
  return raw(static_cast<int32_t>(index), is_big);
}

std::string list_bytes(const std::vector<int64_t>& indices, const std::string& list, bool is_big) {
  const auto count = static_cast<uint32_t>(indices.size());
  std::string bytes =
      list == "int int" ? raw(count, is_big) : std::string(1, static_cast<char>(count));
  for (const int64_t index : indices) bytes += index_bytes(index, list, is_big);
  return bytes;
}

std::string ply_bytes(const Texts& t) {
  const bool is_big = t["order"] == "binary_big_endian";
  std::string bytes = encoded(ply_header(t, t["order"]), t);
  const auto coordinate = [&](double x) {
    return t["type"] == "double" ? raw(x, is_big) : raw(static_cast<float>(x), is_big);
  };
  const std::string colour = t["colour"] == "int"  ? std::string(4, '\7')
                             : t["colour"].empty() ? ""
                                                   : "\7";
  for (const glm::dvec3& p : kCorners)
    bytes += coordinate(p.x) + coordinate(p.y) + coordinate(p.z) + colour;
  if (!t["unused"].empty()) bytes += coordinate(NAN) + coordinate(0) + coordinate(NAN) + colour;
  std::vector<int64_t> strips;
  for (const UVec3& face : kFaces) {
    if (t["faces are"] != "strips")
      bytes += list_bytes({face.x, face.y, face.z}, t["list"], is_big);
    for (const int64_t index : {int64_t{face.x}, int64_t{face.y}, int64_t{face.z}, int64_t{-1}})
      strips.push_back(index);
  }
  if (t["faces are"] == "strips") bytes += list_bytes(strips, t["list"], is_big);
  if (!t["extra"].empty()) bytes += raw(0.5f, is_big);
  return bytes + t["behind"];
}

}  // namespace

TEST_CASE("binary PLY as it is written") {
  check_format(
      {"a.ply",
       with(kPlyHeader,
            {kEncoding,
             {"line end", {{"\n"}, {"\r\n"}}},
             {"order", {{"binary_little_endian"}, {"binary_big_endian"}}},
             {"type", {{"float"}, {"double"}, {"float32"}, {"real", "'real' as a type"}}},
             {"vertices", {{"0"}, {"-1", "expected"}, {"1", "expected"}, {"4000", "announced"}}},
             {"faces", {{"4"}, {"3", "after the last element"}, {"5", "expected"}}},
             {"faces are", {{"faces"}, {"strips"}}},
             {"unused", {{""}, {"nan"}}},
             {"behind", {{""}, {"\n"}, {std::string(60, '\0')}, {"x"}}}}),
       ply_bytes, [](const Texts& t) { return t["faces are"] == "strips"; }});
}

TEST_CASE("OBJ as it is written") {
  check_format(
      {"a.obj",
       {kEncoding,
        kLineEnd,
        {"before",
         {{""}, {"\n"}, {"# made by x\n"}, {"// x\n"}, {"$ x\n"}, {"made by x\n", "'made'"}}},
        {"v", {{"v"}, {"  v"}, {"V", "'V'"}, {"vertex", "'vertex'"}}},
        {"blank", {{" "}, {"\t"}, {"  "}, {",", "line"}, {" \\\n "}}},
        {"two", {{"2"}, {"2e0"}, {"+2.0"}, {"2.f", "as coordinate"}, {"nan", "not finite"}}},
        {"behind vertex",
         {{""}, {" 1"}, {" 0.5 0.5 0.5"}, {" nan nan nan 1"}, {" # x"}, {" x", "'x'"}}},
        {"unused", {{""}, {"v nan nan nan\n"}, {"v 0 -inf 0\n"}, {"v 1 1 1\n"}}},
        {"between",
         {{""},
          {"o part\ng a b\ns off\nusemtl C:\\red\\\n"},
          {"l 1 2\np 1\n"},
          {"cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nend\n"},
          {"call other.obj\n"},
          {"newmtl red\nKd 1 0 0\nmap_Kd red.png\n"},
          {"vn 0 0 1\nvt 0 0\n"},
          {"faces 3\n", "'faces'"}}},
        {"f", {{"f"}, {"fo"}, {"\tf"}, {"F", "'F'"}, {"f:", "'f:'"}}},
        {"index",
         {{"#"},
          {"#/#"},
          {"#//#"},
          {"#/#/#"},
          {"#/"},
          {"+#"},
          {"#.0", "in a face"},
          {"#,", "in a face"}}},
        {"behind",
         {{""},
          {"\n\n"},
          {"\x1a"},
          {"# end"},
          {"end\n"},
          {"f 1 2 99\n", "index 99"},
          {"f 1 2", ""}}}},
       [](const Texts& t) {
         std::string text = t["before"];
         for (const glm::dvec3& p : kCorners) {
           const std::string row = position_text(p, "\x1");
           text += t["v"] + t["blank"] + replaced(replaced(row, "2", t["two"]), "\x1", t["blank"]) +
                   t["behind vertex"] + "\n";
         }
         text += t["unused"] + t["between"];
         for (const UVec3& face : kFaces) {
           text += t["f"];
           for (int k = 0; k < 3; ++k)
             text += " " + replaced(t["index"], "#", std::to_string(face[k] + 1));
           text += "\n" + t["between"];
         }
         return encoded(text + t["behind"], t);
       }});
}

TEST_CASE("OFF as it is written") {
  check_format(
      {"a.off",
       {kEncoding,
        kLineEnd,
        {"before", {{""}, {"\n"}, {"# made by x\n"}, {"made by x\n", "'made'"}}},
        {"keyword",
         {{"OFF\n"},
          {"OFF "},
          {"OFF"},
          {"COFF\n"},
          {""},
          {"OFF # x\n"},
          {"off\n", "'off'"},
          {"OFF BINARY\n", "binary OFF"}}},
        {"vertices", {{"4"}, {"3", "line"}, {"5", "line"}, {"4000", "announced"}}},
        {"faces",
         {{" 4"}, {" 3", "a row more"}, {" 5", "the file ends|as corner count"}, {"", "expected"}}},
        {"edges", {{" 6"}, {" 0"}, {""}, {" 6 1", "after the counts"}}},
        {"blank", {{" "}, {"\t"}, {"\n"}, {",", "line"}}},
        {"two", {{"2"}, {"2.0e0"}, {"2d0", "as coordinate"}, {"nan", "not finite"}}},
        {"between", {{""}, {"\n"}, {"# x\n"}}},
        {"colour", {{""}, {" 255 0 0"}, {" 0.5"}}},
        {"behind",
         {{""},
          {"\n\n"},
          {"# end"},
          {"made by x\n"},
          {"3 0 1 2\n3 0 1 2\n3 0 1 2\n", "a row more"}}}},
       [](const Texts& t) {
         std::string text =
             t["before"] + t["keyword"] + t["vertices"] + t["faces"] + t["edges"] + "\n";
         for (const glm::dvec3& p : kCorners) {
           const std::string row = position_text(p, "\x1");
           text += replaced(replaced(row, "2", t["two"]), "\x1", t["blank"]) + "\n" + t["between"];
         }
         for (const UVec3& face : kFaces) {
           text += "3";
           for (int k = 0; k < 3; ++k) text += " " + std::to_string(face[k]);
           text += t["colour"] + "\n" + t["between"];
         }
         return encoded(text + t["behind"], t);
       }});
}

namespace {

std::string gltf_bytes(const Texts& t) {
  test::Document document;
  std::vector<float> xyz;
  std::vector<uint16_t> corners;
  for (const glm::dvec3& p : kCorners)
    for (int axis = 0; axis < 3; ++axis) xyz.push_back(static_cast<float>(p[axis]));
  for (const UVec3& face : kFaces)
    for (int k = 0; k < 3; ++k) corners.push_back(static_cast<uint16_t>(face[k]));
  const size_t positions = document.add_positions(xyz);
  document.add_mesh(positions, {{"indices", document.add_indices(corners)}});
  document.json["asset"]["version"] = t["version"];
  for (const char* key : {"required", "also required"}) {
    if (t[key].empty()) continue;
    document.json["extensionsRequired"].push_back(t[key]);
    document.json["extensionsUsed"].push_back(t[key]);
  }
  if (!t["weights"].empty()) {
    document.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", positions}}};
    document.json["meshes"][0]["weights"] = {
        t["weights"] == "mesh" || t["weights"] == "node overrides" ? 1 : 0};
    if (t["weights"] == "node" || t["weights"] == "node overrides")
      document.json["nodes"][0]["weights"] = {t["weights"] == "node" ? 1 : 0};
  }
  if (!t["node"].empty()) document.json["nodes"][0].update(test::Json::parse(t["node"]));
  if (!t["more"].empty()) document.json.update(test::Json::parse(t["more"]));
  if (t["container"] == "glTF") return t["mark"] + document.text() + t["behind"];
  return document.glb() + t["behind"];
}

/// By the registry: extensions that leave the triangles where they are, and some that do not.
Place required_extensions() {
  Place place = {"required", {{""}}};
  for (const char* known :
       {"KHR_materials_unlit",     "KHR_materials_variants",   "EXT_materials_bump",
        "KHR_texture_basisu",      "EXT_texture_webp",         "MSFT_texture_dds",
        "KHR_texture_transform",   "KHR_lights_punctual",      "EXT_lights_image_based",
        "KHR_xmp_json_ld",         "KHR_mesh_quantization",    "EXT_meshopt_compression",
        "KHR_meshopt_compression", "KHR_node_visibility",      "EXT_structural_metadata",
        "EXT_mesh_features",       "EXT_instance_features",    "EXT_feature_metadata",
        "EXT_mesh_manifold",       "CESIUM_primitive_outline", "MSFT_lod",
        "FB_geometry_metadata",    "FB_ngon_encoding",         "AGI_stk_metadata",
        "GODOT_single_root",       "KHR_animation_pointer",    "KHR_audio_emitter",
        "KHR_interactivity"})
    place.choices.push_back({known});
  for (const char* moves :
       {"KHR_draco_mesh_compression", "MESHOPT_compression", "EXT_mesh_gpu_instancing",
        "KHR_gaussian_splatting", "EXT_mesh_primitive_restart", "BENTLEY_primitive_restart",
        "EXT_mesh_polygon", "EXT_primitive_voxels", "EXT_geopose", "CESIUM_RTC",
        "AGI_articulations", "KHR_billboard", "KHR_materials_displacement", "KHR_accessor_float64",
        "KHR_techniques_webgl", "VENDOR_unheard_of", "khr_materials_unlit", "KHR_node_visibilit"})
    place.choices.push_back({moves, "'" + std::string(moves) + "' is required"});
  return place;
}

}  // namespace

TEST_CASE("glTF as it is written") {
  check_format(
      {"a.gltf",
       {{"container", {{"glTF"}, {"GLB"}}},
        {"mark", {{""}, {"\xef\xbb\xbf"}, {" \n"}}},
        {"version", {{"2.0"}, {"2.1"}, {"1.0", "asset.version"}, {"3.0", "asset.version"}}},
        required_extensions(),
        {"also required",
         {{""},
          {"KHR_materials_unlit"},
          {"EXT_meshopt_compression"},
          {"VENDOR_unheard_of", "'VENDOR_unheard_of' is required"}}},
        {"weights",
         {{""},
          {"none"},
          {"node overrides"},
          {"mesh", "morph targets"},
          {"node", "morph targets"}}},
        {"node",
         {{""},
          {R"({"rotation": [0, 0, 0, 1]})"},
          {R"({"scale": [1, 1, 1], "extras": {"matrix": 1}})"},
          {R"({"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})"},
          {R"({"skin": 0})", "a skin"},
          {R"({"extensions": {"EXT_mesh_gpu_instancing": {}}})", "EXT_mesh_gpu_instancing"}}},
        {"more",
         {{""},
          {R"({"animations": [{"channels": []}]})"},
          {R"({"extensions": {"KHR_materials_variants": {"variants": []}}})"},
          {R"({"extras": [[[[{"meshes": 3}]]]]})"}}},
        {"behind", {{""}, {std::string(4, ' ')}, {"\n"}}}},
       gltf_bytes});
}

TEST_CASE("bytes behind a GLB's own length") {
  const std::string glb = test::triangle_document().glb();
  for (const std::string& behind :
       {std::string(4, '\0'), std::string("made by x"), std::string(1, ' ')}) {
    const ReadMesh mesh = parse_mesh({.name = "a.glb", .bytes = glb + behind});
    CHECK(mesh.faces.size() == 1);
    REQUIRE(mesh.notes.size() == 1);
    CHECK(mesh.notes[0].text == std::to_string(behind.size()) +
                                    (behind.size() == 1 ? " byte" : " bytes") +
                                    " behind the GLB's own length ignored");
  }
  CHECK(outcome_of("a.glb", glb + glb, SIZE_MAX).refused.find("another GLB behind the first") !=
        std::string::npos);
  CHECK(outcome_of("a.glb", glb.substr(0, glb.size() - 1), SIZE_MAX)
            .refused.find("as many bytes as its header says") != std::string::npos);
}

#ifdef VKH_HAS_3MF
TEST_CASE("3MF as it is written") {
  check_format(
      {"a.3mf",
       {{"slash", {{"/"}, {"\\"}}},
        {"target",
         {{"/3D/3dmodel.model"},
          {"3D/3dmodel.model"},
          {"./3D/3dmodel.model"},
          {"/3D/3DModel.model"},
          {"\\3D\\3dmodel.model"},
          {"/3D/other.model", "is not in the archive"}}},
        {"xml",
         {{""},
          {"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"},
          {"\xef\xbb\xbf<?xml version=\"1.0\"?>\r\n<!-- x -->"},
          {"<!DOCTYPE model>", "document type"}}},
        {"prefix", {{""}, {"c:"}}},
        {"year", {{"2015/02"}, {"2013/01", "the root is 'core/2013/01|model'"}}},
        {"needs",
         {{""},
          {"m http://schemas.microsoft.com/3dmanufacturing/material/2015/02"},
          {"p http://schemas.microsoft.com/3dmanufacturing/production/2015/06"},
          {"b http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02",
           "'beamlattice/2017/02' is required"},
          {"v http://x.y/z", "'http://x.y/z' is required"}}},
        {"transform",
         {{""},
          {"1 0 0 0 1 0 0 0 1 0 0 0"},
          {" 1 0 0  0 1 0\n0 0 1.0 0 0 0 "},
          {"1 0 0", "twelve"}}},
        {"two", {{"2"}, {" 2.0 "}, {"2e0"}, {"2,0", "'2,0'"}}}},
       [](const Texts& t) {
         const std::string& c = t["prefix"];
         const std::string xmlns = c.empty() ? "xmlns" : "xmlns:c";
         std::string model = t["xml"] + "<" + c + "model " + xmlns +
                             "=\"http://schemas.microsoft.com/3dmanufacturing/core/" + t["year"] +
                             "\"";
         if (!t["needs"].empty()) {
           const std::string prefix = t["needs"].substr(0, 1);
           model += " xmlns:" + prefix + "=\"" + t["needs"].substr(2) + "\" requiredextensions=\"" +
                    prefix + "\"";
         }
         model +=
             "><" + c + "resources><" + c + "object id=\"1\"><" + c + "mesh><" + c + "vertices>";
         for (const glm::dvec3& p : kCorners) {
           const auto number = [&](double x) { return replaced(number_text(x), "2", t["two"]); };
           model += "<" + c + "vertex x=\"" + number(p.x) + "\" y=\"" + number(p.y) + "\" z=\"" +
                    number(p.z) + "\"/>";
         }
         model += "</" + c + "vertices><" + c + "triangles>";
         for (const UVec3& face : kFaces) {
           model += "<" + c + "triangle v1=\"" + std::to_string(face.x) + "\" v2=\"" +
                    std::to_string(face.y) + "\" v3=\"" + std::to_string(face.z) + "\"/>";
         }
         model += "</" + c + "triangles></" + c + "mesh></" + c + "object></" + c + "resources><" +
                  c + "build><" + c + "item objectid=\"1\"" +
                  (t["transform"].empty() ? "" : " transform=\"" + t["transform"] + "\"") + "/></" +
                  c + "build></" + c + "model>";
         const std::string relations = replaced(test::kRelations, "/3D/3dmodel.model", t["target"]);
         return test::stored_zip({{"_rels" + t["slash"] + ".rels", relations},
                                  {"3D" + t["slash"] + "3dmodel.model", model}});
       }},
      1000);
}
#endif
