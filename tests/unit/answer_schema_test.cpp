// The members of answers and result lines are those of docs/schema: each in both, or in neither.
#include <doctest/doctest.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "host/answer/json_object.h"
#include "host/answer/members.h"

namespace {

using namespace vkh;
using Paths = std::set<std::string>;

/// A visitor that collects the path of each member, as if every one were there, except `absent`.
class PathVisitor {
 public:
  static constexpr bool kReads = true;
  PathVisitor(Detail detail, Paths absent) : detail_(detail), absent_(std::move(absent)) {
    add("schema");
  }
  const Paths& paths() const { return paths_; }
  /// The words that a named member may be: "directions/status=closed".
  const Paths& words() const { return words_; }

  bool is_full() const { return detail_ == Detail::kFull; }
  void in_unit(const std::string&) {}
  void in_version(const std::string&) {}

  void text(const char* key, auto&) { add(key); }
  void text_or_null(const char* key, auto&) { add(key); }
  void number(const char* key, auto&) { add(key); }
  void number_or_null(const char* key, auto&) { add(key); }
  void number_or_none(const char* key, auto&) { add(key); }
  void number_if_known(const char* key, auto&, bool) { add(key); }
  void number_since(const char*, const char* key, auto&, bool) { add(key); }
  void count(const char* key, auto&) { add(key); }
  void count_or_none(const char* key, auto&) { add(key); }
  void count_if_any(const char* key, auto&) { add(key); }
  void truth(const char* key, auto&) { add(key); }
  void mark(const char* key, auto&) { add(key); }
  template <class Enum>
  void named(const char* key, auto&, const Words<Enum>& words) {
    add(key);
    for (int i = static_cast<int>(words.first); i <= static_cast<int>(words.last); ++i)
      words_.insert(at_ + key + "=" + words.word(static_cast<Enum>(i)));
  }
  void named_unless(auto, const char* key, auto& value, const auto& words) {
    named(key, value, words);
  }
  void exit_code(const char* key, auto&) { add(key); }
  void note_code(const char* key, auto&) { add(key); }
  void length(const char* key, auto&) { add(key); }
  void face(const char* key, auto&) { add(key); }
  void unit(int) { add("unit"); }
  void texts(const char* key, auto&) { add(key); }
  void texts_if_any(const char* key, auto&) { add(key); }
  void vector(const char* key, auto&) { add(key); }
  void two_numbers(const char* key, auto&, auto&) { add(key); }
  void matrix(const char* key, auto&) { add(key); }
  void named_counts(const char* key, auto&) { add(key); }

  void down(const char* key, auto&) {
    add(key);
    add(key + std::string("_hex"));
  }
  void up(const char* key, auto& bound) { down(key, bound); }
  void ends(double& lower, double& upper) {
    down("lower", lower);
    up("upper", upper);
  }
  void enclosure(Enclosure& e) {
    ends(e.lower, e.upper);
    add("estimate");
  }
  void signed_ends(double& lower, double& upper) { ends(lower, upper); }

  void implied(const char* key, const auto&, const auto&) { add(key); }
  void implied_if(bool, const char* key, const auto&, const Refusals&) { add(key); }
  void implied_ends(const auto&, const char*) {
    Enclosure any;
    ends(any.lower, any.upper);
  }
  void beside(const char* key, const std::string&) { add(key); }
  void told(const char* key, const auto&) { add(key); }
  void said(const char* key, auto&, const Answer&) { add(key); }

  template <class... T>
  bool has(const char* key, std::optional<T>&... members) {
    if (absent_.contains(key)) return false;
    add(key);
    (members.emplace(), ...);
    return true;
  }
  bool has(const char* key, bool& is_there) {
    add(key);
    return is_there = true;
  }
  bool is_some(const char* key, bool) {
    add(key);
    return true;
  }
  void object(const char* key, const auto& members) {
    add(key);
    const std::string outer = at_;
    at_ += key + std::string("/");
    members();
    at_ = outer;
  }
  void bounds(const char* key, const auto& members) { object(key, members); }
  void object_if_there(const char* key, const auto& members) { object(key, members); }
  void optional(const char* key, auto& value, const auto& members) {
    if (has(key, value)) object(key, [&] { members(*value); });
  }
  void nullable(const char* key, auto& value, const auto& members) {
    optional(key, value, members);
  }
  void made(const char* key, auto& value, const auto&, const auto& members) {
    optional(key, value, members);
  }
  void list(const char* key, auto& items, const auto& members) {
    items.resize(1);
    object(key, [&] { members(items[0]); });
  }
  void list_if_any(const char* key, auto& items, const auto& members) { list(key, items, members); }
  void files(const char* key, auto& files, bool, const auto& members) { list(key, files, members); }
  void notes(const char* key, auto&, const auto&, const auto&) {
    Note note{.code = NoteCode::kPolygons, .text = {}};
    object(key, [&] { visit(*this, note); });
  }
  void array_of_two(const char* key, const auto& members) {
    object(key, [&] { members(false); });
  }
  void one_or_two(const char* key, auto& first, auto& second, const auto& members) {
    second.emplace();
    object(key, [&] { members(first, false); });
  }
  struct NamedCount {
    const char* key;
    uint64_t& count;
  };
  void counts(const char*, bool&, std::initializer_list<NamedCount> counts) {
    for (const NamedCount& one : counts) add(one.key);
  }

 private:
  void add(const std::string& key) { paths_.insert(at_ + key); }

  Detail detail_;
  Paths absent_, paths_, words_;
  std::string at_;
};

Json schema_named(const std::string& name) {
  std::ifstream file(std::string(VKH_SOURCE_DIR) + "/docs/schema/" + name + ".schema.json");
  REQUIRE(file);
  return Json::parse(file);
}

/// Collects the paths of the properties of a schema's definition; elements have their array's.
class SchemaPaths {
 public:
  SchemaPaths(const std::string& schema, const std::string& definition)
      : answer_(schema_named("answer")), own_(schema_named(schema)) {
    add(own_, own_["$defs"][definition], "");
  }
  const Paths& paths() const { return paths_; }
  /// The texts that its members may be: "directions/status=closed".
  const Paths& words() const { return words_; }

 private:
  void add(const Json& document, const Json& schema, const std::string& at) {
    if (schema.contains("$ref")) follow(document, schema["$ref"], at);
    for (const Json& word : schema.value("enum", Json::array())) {
      if (word.is_string())
        words_.insert(at.substr(0, at.size() - 1) + "=" + word.get<std::string>());
    }
    for (const char* either : {"oneOf", "anyOf", "allOf"}) {
      for (const Json& one : schema.value(either, Json::array())) add(document, one, at);
    }
    if (schema.contains("items")) add(document, schema["items"], at);
    if (!schema.contains("properties")) return;
    for (const auto& [key, value] : schema["properties"].items()) {
      paths_.insert(at + key);
      add(document, value, at + key + "/");
    }
  }
  void follow(const Json& document, const std::string& to, const std::string& at) {
    const size_t mark = to.find('#');
    const Json& other = mark == 0 ? document : answer_;
    CHECK((mark == 0 || to.starts_with("../answer/2#")));
    add(other, other.at(Json::json_pointer(to.substr(mark + 1))), at);
  }

  Json answer_, own_;
  Paths paths_, words_;
};

Paths without(const Paths& all, const Paths& beginnings) {
  Paths rest;
  for (const std::string& path : all) {
    bool is_of_one = false;
    for (const std::string& one : beginnings)
      is_of_one = is_of_one || path == one || path.starts_with(one + "/");
    if (!is_of_one) rest.insert(path);
  }
  return rest;
}

std::string only_in_first(const Paths& first, const Paths& second) {
  std::string only;
  for (const std::string& path : first) {
    if (!second.contains(path)) only += path + " ";
  }
  return only;
}

void check_same(const Paths& members, const Paths& schema) {
  CHECK(only_in_first(members, schema) == "");
  CHECK(only_in_first(schema, members) == "");
}

/// Returns those of `words` whose members are in `named`, too.
Paths of_members(const Paths& words, const Paths& named) {
  const auto member = [](const std::string& word) { return word.substr(0, word.find('=')); };
  Paths members, found;
  for (const std::string& word : named) members.insert(member(word));
  for (const std::string& word : words) {
    if (members.contains(member(word))) found.insert(word);
  }
  return found;
}

TEST_CASE("the members of an answer are those of its schema") {
  PathVisitor visitor(Detail::kFull, {});
  Answer answer;
  visit(visitor, answer);
  const SchemaPaths schema("answer", "answer");
  check_same(visitor.paths(), schema.paths());
  CHECK(only_in_first(visitor.words(), schema.words()) == "");
  CHECK(only_in_first(of_members(schema.words(), visitor.words()), visitor.words()) == "");
}

TEST_CASE("the members of a result line are those of its schema") {
  PathVisitor visitor(Detail::kBrief, {"error"});
  Result result;
  visit(visitor, result);
  const Paths never_asked = {"part",
                             "parts",
                             "directions/verified",
                             "directions/field",
                             "directions/map",
                             "directions/certificate",
                             "run/more_devices"};
  check_same(without(visitor.paths(), never_asked), SchemaPaths("pair", "answer").paths());
}

TEST_CASE("the members of a failure are those of its schemas") {
  PathVisitor visitor(Detail::kBrief, {});
  Result result;
  visit(visitor, result);
  check_same(without(visitor.paths(), {"run/more_devices"}),
             SchemaPaths("pair", "failure").paths());
}

}  // namespace
