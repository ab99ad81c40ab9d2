// Lists of pairs, shards, and lines of results.
#include "host/batch/list.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>

#include "host/answer/csv.h"
#include "host/answer/json_object.h"
#include "host/answer/quantities.h"
#include "host/answer/result.h"
#include "host/answer/tables.h"
#include "host/base/byte_order_mark.h"
#include "tests/support/files.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using namespace vkh::test;

/// The text that an entry's row has for an option; empty: the batch decides.
std::string asked(const Entry& entry, const std::string& column) {
  for (const auto& [option, text] : entry.options) {
    if (column_name(*option) == column) return text;
  }
  return "";
}

PairList read_text(const std::string& name, const std::string& text) {
  const std::string path = folder() / name;
  std::ofstream(path, std::ios::binary) << text;
  return read_list(path);
}

std::string error_of(const std::string& name, const std::string& text) {
  try {
    read_text(name, text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::vector<std::string>> rows_of(const std::string& text) {
  std::istringstream in(text);
  CsvReader reader(in);
  std::vector<std::vector<std::string>> rows;
  while (const auto row = reader.next()) rows.push_back(*row);
  return rows;
}

}  // namespace

TEST_CASE("a byte order mark is skipped whole, and nothing that begins like one") {
  for (const auto& [text, rest] : {std::pair<std::string, std::string>{"\xef\xbb\xbf"
                                                                       "id",
                                                                       "id"},
                                   {"\xef\x80\x80"
                                    "id",
                                    "\xef\x80\x80"
                                    "id"},
                                   {"\xef\xbb", "\xef\xbb"},
                                   {"id", "id"},
                                   {"", ""}}) {
    std::istringstream in(text);
    skip_byte_order_mark(in, "list");
    CHECK(std::string(std::istreambuf_iterator<char>(in), {}) == rest);
  }
}

TEST_CASE("CSV as spreadsheets write it") {
  using Rows = std::vector<std::vector<std::string>>;
  CHECK(rows_of("a,b\r\n1,2\r\n") == Rows{{"a", "b"}, {"1", "2"}});
  CHECK(rows_of("a\n\n\nb") == Rows{{"a"}, {"b"}});
  CHECK(rows_of("\"x,\"\"y\"\"\nz\",2\n,\n") == Rows{{"x,\"y\"\nz", "2"}});
  CHECK(rows_of("a,b\n, \"1\"\n") == Rows{{"a", "b"}, {"", "1"}});
  CHECK(rows_of("a;b\r\n1;2,5\r\n") == Rows{{"a", "b"}, {"1", "2,5"}});
  CHECK(rows_of("\"a,b\";\"c;\"\n1;2") == Rows{{"a,b", "c;"}, {"1", "2"}});
  CHECK(rows_of("a,b;c\n1;2,3") == Rows{{"a", "b;c"}, {"1;2", "3"}});
  CHECK(rows_of("\n\na\n1;2\n3,4") == Rows{{"a"}, {"1;2"}, {"3", "4"}});
  CHECK(rows_of("") == Rows{});
  CHECK_THROWS_AS(rows_of("a,\"b\n"), InputError);
}

TEST_CASE("a list is the same as JSONL and as CSV") {
  const PairList csv = read_text("l.CSV",
                                 "\xef\xbb\xbfid,a,b,tol,max,unit,symmetric,note\r\n"
                                 "\"x, y\",m/a.obj,/b.obj,1e-3,0.1mm,mm,true,good\r\n"
                                 "z,a.obj,b.obj,,,,,\r\n");
  const PairList jsonl = read_text(
      "l.jsonl",
      R"({"id":"x, y","a":"m/a.obj","b":"/b.obj","tol":1e-3,"max":"0.1mm","unit":"mm","symmetric":true,"note":"good"})"
      "\n\n"
      R"({"id":"z","a":"a.obj","b":"b.obj"})");
  for (const PairList* list : {&csv, &jsonl}) {
    REQUIRE(list->entries.size() == 2);
    const Entry& first = list->entries[0];
    CHECK(first.id == "x, y");
    CHECK(first.a == "m/a.obj");
    CHECK(first.file_a == folder() / "m/a.obj");
    CHECK(first.file_b == "/b.obj");
    CHECK((asked(first, "tol") == "1e-3" || asked(first, "tol") == "0.001"));
    CHECK(asked(first, "max") == "0.1mm");
    CHECK(asked(first, "unit") == "mm");
    CHECK(asked(first, "symmetric") == "true");
    CHECK(list->entries[1].options.empty());
    REQUIRE(list->notes.size() == 1);
    CHECK(list->notes[0].find("'note'") != std::string::npos);
  }
}

TEST_CASE("a list of semicolons is the same, and has no decimal comma") {
  const std::string heading = "\xef\xbb\xbfid;a;b;max\r\n";
  const PairList list = read_text("s.csv", heading + "\"x;y\";a, b.obj;b.obj;0.1mm\r\n");
  REQUIRE(list.entries.size() == 1);
  CHECK(list.entries[0].id == "x;y");
  CHECK(list.entries[0].a == "a, b.obj");
  CHECK(asked(list.entries[0], "max") == "0.1mm");
  CHECK(error_of("s.csv", heading + "x;a.obj;b.obj;0,1mm\n")
            .ends_with("line 2: max '0,1mm': did you mean 0.1mm? expected a decimal point"));
  CHECK(error_of("s.csv", heading + "x;a.obj;b.obj;1,000mm\n")
            .find("did you mean 1.000mm or 1000mm?") != std::string::npos);
  CHECK(error_of("s.csv", "id;a;b;tol\nx;a.obj;b.obj;0,001\n")
            .ends_with("line 2: tol '0,001': expected a decimal point"));
  CHECK(error_of("s.csv", heading + "x;a.obj;b.obj\n").find("line 2: 3 cells; expected 4") !=
        std::string::npos);
}

TEST_CASE("a list of all ways to write it") {
  size_t ways = 0;
  for (const std::string mark : {"", "\xef\xbb\xbf"})
    for (const std::string separator : {",", ";"})
      for (const std::string end : {"\n", "\r\n", "\n\n", "\n,,,\n"})
        for (const bool is_quoted : {false, true})
          for (const std::string columns : {"id,a,b,max", "max,b,a,id", "a,max,id,b"})
            for (const std::string limit : {"0.1mm", "+0.2mm,-0.1mm", "+0.2mm, -0.1mm"})
              for (const bool has_last_end : {false, true}) {
                std::string heading, row;
                std::istringstream names(columns);
                for (std::string name; std::getline(names, name, ',');) {
                  const std::string cell = name == "max"  ? limit
                                           : name == "id" ? "x"
                                                          : name + ".obj";
                  const bool has_comma = cell.find(',') != std::string::npos;
                  const std::string quote =
                      is_quoted || (has_comma && separator == ",") ? "\"" : "";
                  heading += (heading.empty() ? "" : separator) + quote + name + quote;
                  row += (row.empty() ? "" : separator) + quote + cell + quote;
                }
                std::string cut = end;
                std::replace(cut.begin(), cut.end(), ',', separator[0]);
                const std::string text = mark + heading + cut + row + (has_last_end ? cut : "");
                ++ways;
                CAPTURE(text);
                const PairList list = read_text("ways.csv", text);
                REQUIRE(list.entries.size() == 1);
                CHECK(list.entries[0].id == "x");
                CHECK(list.entries[0].a == "a.obj");
                CHECK(list.entries[0].b == "b.obj");
                CHECK(asked(list.entries[0], "max") == limit);
              }
  CHECK(ways == 576);
  for (const char* name : {"wide.csv", "wide.jsonl"})
    CHECK(error_of(name, std::string("\xff\xfei\0d\0", 6)).find("UTF-16 text; expected ASCII") !=
          std::string::npos);
}

TEST_CASE("what is wrong with a list is said with its line") {
  CHECK(error_of("e.csv", "id,a,b\nx,a.obj\n").find("line 2: 2 cells") != std::string::npos);
  CHECK(error_of("e.csv", "id,a,b\nx,a.obj,\n").find("line 2: no b") != std::string::npos);
  CHECK(error_of("e.csv", "id,a,b\n").find("no pair") != std::string::npos);
  CHECK(error_of("e.csv", "id,a,b,symmetric\nx,a,b,perhaps\n").find("line 2: 'perhaps'") !=
        std::string::npos);
  CHECK(error_of("e.jsonl", "{}\n").find("line 1: no id") != std::string::npos);
  CHECK(error_of("e.jsonl", "\n[1]\n").find("line 2: no JSON object") != std::string::npos);
  CHECK(error_of("e.jsonl", R"({"id":"x","a":"a","b":"b"})"
                            "\n"
                            R"({"id":"x","a":"c","b":"d"})")
            .find("line 2: the id 'x' is that of line 1") != std::string::npos);
  CHECK_THROWS_AS(read_list("/no/such/list.csv"), InputError);
}

TEST_CASE("a name that nearly is a column's is refused, and one that is like none is noted") {
  const std::vector<std::pair<std::string, std::string>> meant = {{"Max", "max"},
                                                                  {" max ", "max"},
                                                                  {"maxx", "max"},
                                                                  {"MAX (mm)", "max"},
                                                                  {"tol_um", "tol"},
                                                                  {"limit", "max"},
                                                                  {"Limit", "max"},
                                                                  {"Tolerance", "max or tol"},
                                                                  {"units", "unit"},
                                                                  {"unit-a", "unit_a"},
                                                                  {"Unit B", "unit_b"},
                                                                  {"symetric", "symmetric"},
                                                                  {"point", "points"},
                                                                  {"Align", "align"},
                                                                  {"Signed", "signed"},
                                                                  {"matrix", "transform"},
                                                                  {"Transform", "transform"},
                                                                  {"B", "b"}};
  for (const auto& [name, column] : meant) {
    const std::string hint = "'" + name + "': did you mean " + column + "? expected id, a, b and";
    CHECK_MESSAGE(
        error_of("n.csv", "id,a,b," + name + "\n1,a.obj,b.obj,0.1mm\n").find("line 1: " + hint) !=
            std::string::npos,
        name);
    for (const char* value : {"\"0.1mm\"", "[1]"}) {
      const std::string line =
          R"({"id":"1","a":"a.obj","b":"b.obj",")" + name + "\":" + value + "}";
      CHECK_MESSAGE(error_of("n.jsonl", line).find("line 1: " + hint) != std::string::npos, name);
    }
  }
  CHECK(error_of("n.csv", "ID,a,b\n1,a.obj,b.obj\n").find("did you mean id?") != std::string::npos);
  for (const char* name : {"note", "c", "xy", "min", "mat", "map", "vol", "tool", "mass",
                           "max_stress", "volume", "author", ""}) {
    const PairList list =
        read_text("n.csv", std::string("id,a,b,") + name + "\n1,a.obj,b.obj,0.1mm\n");
    CHECK_MESSAGE(list.notes.size() == 1, name);
  }
}

TEST_CASE("shards: each id in one, about as many in each, whatever else there is") {
  for (const uint64_t count : {1u, 2u, 7u, 64u}) {
    std::map<uint64_t, int> sizes;
    for (int i = 0; i < 6400; ++i) {
      const std::string id = "pair_" + std::to_string(i);
      int in = 0;
      for (uint64_t index = 0; index < count; ++index) {
        if (!is_in({index, count}, id)) continue;
        ++in;
        ++sizes[index];
      }
      CHECK(in == 1);
    }
    const int even = 6400 / static_cast<int>(count);
    for (const auto& [index, size] : sizes) CHECK(std::abs(size - even) < even / 2 + 30);
  }
  // The hash is the same on every machine and in every version: a results file outlives them.
  CHECK(is_in({3, 64}, "pair_41") == is_in({3, 64}, "pair_41"));
  const PartOf shard = parse_part("--shard", "3/64");
  CHECK((shard.index == 3 && shard.count == 64));
  for (const char* text : {"", "3", "/", "3/", "/4", "4/4", "-1/4", "1/0", "a/b", "1/4x"})
    CHECK_THROWS_AS(parse_part("--shard", text), UsageError);
}

TEST_CASE("a result's line is read back as what it says") {
  Answer answer;
  answer.command = "batch";
  answer.inputs[0].path = "a,\"run\":{.obj";
  answer.inputs[0].sha256 = "aa";
  answer.inputs[1].path = "b\n.obj";
  answer.inputs[1].sha256 = "bb";
  for (Input& input : answer.inputs) input.is_read = true;
  answer.a_to_b.lower = 0x1.3333333333333p-3;
  answer.a_to_b.upper = 0x1.3333333333335p-3;
  answer.a_to_b.diagonal_a = 2;
  answer.unit = "mm";
  const std::string line = to_line(result_of({"an id, \"quoted\"", "key"}, answer));
  CHECK(line.find('\n') == std::string::npos);
  const Result result = read_result(line);
  CHECK(result.name.id == "an id, \"quoted\"");
  CHECK(result.answer.a_to_b.lower == answer.a_to_b.lower);
  CHECK(result.answer.a_to_b.upper == answer.a_to_b.upper);
  CHECK(result.answer.inputs[1].path == "b\n.obj");
  CHECK(result.is_final());
  CHECK(to_line(result) == line);
  const std::string common = without_run(line);
  CHECK(read_result(common).answer.a_to_b.upper == answer.a_to_b.upper);
  CHECK(common.find("\"started\"") == std::string::npos);
  CHECK(without_run(common) == common);
  const Result failed = read_result(to_line(result_of(
      {"x", ""}, Failure{.code = 4, .message = "a: bad", .file = "a", .place = ""}, Answer{})));
  CHECK(failed.code == kExitBadInput);
  CHECK(failed.words() == "a: bad");
  CHECK(!failed.is_final());
  for (const char* text : {"", "{", "[]", "{}", R"({"schema":"vkhausdorff.pair/2"})"})
    CHECK_THROWS_AS(read_result(text), InputError);
}

TEST_CASE("every kind of result line is read back byte for byte") {
  Answer answer;
  answer.inputs[0] = {.path = "a.obj",
                      .is_read = true,
                      .counts = {.faces = 7},
                      .sha256 = "aa",
                      .notes = {note_of(NoteCode::kUnread, "so")}};
  answer.inputs[1] = {.path = "b.obj", .is_read = true, .counts = {.faces = 9}};
  answer.a_to_b.lower = 0.1;
  answer.a_to_b.upper = 0.3;
  answer.a_to_b.diagonal_a = 1.0 / 3;
  answer.a_to_b.times = {.hierarchy_ms = 0.1, .solve_ms = 0.2};
  answer.notes = {note_of(NoteCode::kMemory, "less")};
  answer.unit = "mm";
  answer.host = "here";
  answer.started = "now";
  answer.waits.total = 0.7;
  const ResultName name{"an id", "key"};
  const auto reread = [](const Result& written) {
    const std::string line = to_line(written);
    const Result result = read_result(line);
    CHECK(to_line(result) == line);
    CHECK(result.lacking.empty());
    CHECK(result.words() == written.words());
    CHECK(result.is_final() == written.is_final());
    return result;
  };
  const auto check = [&] {
    const Answer read = reread(result_of(name, answer)).answer;
    CHECK(notes_of(read) == notes_of(answer));
    CHECK(read.a_to_b.diagonal_a == answer.a_to_b.diagonal_a);
    CHECK(read.inputs[0].notes == answer.inputs[0].notes);
  };
  check();
  answer.b_to_a = answer.a_to_b;
  answer.b_to_a->upper = std::numeric_limits<double>::infinity();
  check();
  answer.b_to_a.reset();
  answer.max = Asked{.length = parse_length("max", "0.5mm", PlainNumber::kRefused),
                     .limit = {.within = 0.5, .beyond = 0.5}};
  check();  // and the note that it is one way
  const Failure failure{.code = 4, .message = "a.obj: bad", .file = "a.obj", .place = ""};
  const Result failed = reread(result_of(name, failure, answer));
  CHECK(failed.failure->file == "a.obj");
  CHECK(failed.answer.inputs[0].sha256 == "aa");
}

TEST_CASE("a PASS proposes --worst where there is such an option") {
  Answer answer;
  answer.a_to_b.lower = 0.1;
  answer.a_to_b.upper = 0.4;
  answer.a_to_b.diagonal_a = 1;
  answer.max = Asked{.length = parse_length("max", "0.5abs", PlainNumber::kRefused),
                     .limit = {.within = 0.5, .beyond = 0.5}};
  for (const char* command : {"gate", "batch"}) {
    answer.command = command;
    const std::string words = in_words(answer);
    CHECK_MESSAGE(words.find("(largest deviation in [") != std::string::npos, words);
    CHECK((words.find("--worst") != std::string::npos) == (answer.command == "gate"));
  }
}

TEST_CASE("a line that was changed is refused") {
  Answer answer;
  answer.a_to_b.lower = 0.1;
  answer.a_to_b.upper = 0.25;
  answer.b_to_a = answer.a_to_b;
  answer.inputs[0].is_read = true;
  const std::string line = to_line(result_of({"x", "key"}, answer));
  CHECK(read_result(line).answer.b_to_a->upper == 0.25);
  const auto refusal = [&](const std::string& pointer, const Json& value) {
    Json json = Json::parse(line);
    json[Json::json_pointer(pointer)] = value;
    try {
      read_result(json.dump());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("it was read");
  };
  CHECK(refusal("/interval/lower", 0.1) == "it was read");
  CHECK(refusal("/interval/lower_hex", "0x1p-4").find("lower_hex '0x1p-4' is another number") == 0);
  CHECK(refusal("/interval/upper", 0.2500000001).find("upper_hex") == 0);
  CHECK(refusal("/interval/upper", nullptr).find("upper_hex") == 0);
  CHECK(refusal("/interval/upper_hex", "inf").find("upper_hex") == 0);
  CHECK(refusal("/interval/upper_hex", nullptr).find("no upper with its upper_hex") == 0);
  CHECK(refusal("/directions/1/interval/upper_hex", "0x1p-9").find("upper_hex") == 0);
  CHECK(refusal("/interval",
                {{"lower", 0.5}, {"lower_hex", "0x1p-1"}, {"upper", 0.25}, {"upper_hex", "0x1p-2"}})
            .find("lower end is above") != std::string::npos);
  CHECK(refusal("/inputs/0/faces", 1.5).find("faces 1.5 is no whole number") == 0);
  CHECK(refusal("/inputs/0/faces", -1).find("faces -1") == 0);
  CHECK(refusal("/status", "time") == "a status that is not that of its directions");
}

TEST_CASE("a line that lacks members is read, and is to be done again") {
  Answer answer;
  answer.a_to_b.upper = 1;
  for (Input& input : answer.inputs) input.sha256 = "aa";
  const Json whole = Json::parse(to_line(result_of({"x", "key"}, answer)));
  CHECK(read_result(whole.dump()).is_final());
  for (const char* pointer :
       {"/inputs/0/files", "/inputs/1/delta", "/directions/0/counts", "/options/preset",
        "/tolerance", "/run/host", "/directions/0/known_lower"}) {
    Json less = whole;
    const Json::json_pointer at(pointer);
    less[at.parent_pointer()].erase(at.back());
    const Result result = read_result(less.dump());
    CHECK_FALSE(result.is_final());
    CHECK(result.lacking == std::vector<std::string>{at.back()});
    CHECK(result.answer.a_to_b.upper == 1);
  }
  for (const char* pointer : {"/interval", "/directions", "/directions/0/interval",
                              "/directions/0/interval/upper", "/directions/0/status"}) {
    Json less = whole;
    const Json::json_pointer at(pointer);
    less[at.parent_pointer()].erase(at.back());
    CHECK_THROWS_AS(read_result(less.dump()), InputError);
  }
}

TEST_CASE("codes: the worst of a batch") {
  CHECK(worse(kExitBeyond, kExitNotClosed) == kExitBeyond);
  CHECK(worse(kExitClosed, kExitNotClosed) == kExitNotClosed);
  CHECK(worse(kExitDevice, kExitBadInput) == kExitDevice);
  CHECK(worse(kExitNotWritten, kExitBeyond) == kExitNotWritten);
  CHECK(worse(kExitBadInput, kExitNotWritten) == kExitBadInput);
}
