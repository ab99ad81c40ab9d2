// The visitor of members.h that writes them: the kinds, in terms of a tree that is built in order.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/answer/members.h"
#include "host/base/decimal.h"

namespace vkh {

/// `Tree`: key(name) before each member; null(), truth(), count(), number(), text(), face(point)
/// and estimate(enclosure) are values; bound(name, value, rounding) is a member; open_object(),
/// open_array() and close() enclose them.
template <class Tree>
class MemberWriter {
 public:
  static constexpr bool kReads = false;

  MemberWriter(Tree& tree, Detail detail) : tree_(tree), detail_(detail) {}

  bool is_full() const { return detail_ == Detail::kFull; }
  void in_unit(const std::string& unit) { unit_ = &unit; }
  void in_version(const std::string&) {}

  // Values.
  void text(const char* key, const std::string& text) { put(key, text); }
  void text_or_null(const char* key, const std::string& text) { put(key, TextOrNull{text}); }
  void number(const char* key, double number) { put(key, number); }
  void number_or_null(const char* key, double number) { put(key, number); }
  void number_or_none(const char* key, const std::optional<double>& number) { put(key, number); }
  void number_if_known(const char* key, double number, bool is_known) {
    put(key, is_known ? std::optional(number) : std::nullopt);
  }
  void number_since(const char*, const char* key, double number, bool is_known) {
    number_if_known(key, number, is_known);
  }
  void count(const char* key, std::integral auto count) { put(key, static_cast<uint64_t>(count)); }
  void count_or_none(const char* key, const std::optional<uint64_t>& count) { put(key, count); }
  void count_if_any(const char* key, uint64_t count) {
    if (count > 0) put(key, count);
  }
  void truth(const char* key, bool truth) { put(key, truth); }
  void mark(const char* key, bool truth) {
    if (truth) put(key, truth);
  }
  template <class Enum>
  void named(const char* key, Enum value, const Words<Enum>& words) {
    put(key, words.word(value));
  }
  template <class Enum>
  void named_unless(Enum none, const char* key, Enum value, const Words<Enum>& words) {
    if (value != none) named(key, value, words);
  }
  void exit_code(const char* key, ExitCode code) { count(key, static_cast<int>(code)); }
  void note_code(const char* key, NoteCode code) { put(key, code_name(code)); }
  void length(const char* key, const Length& length) { put(key, length.requested); }
  void face(const char* key, const SurfacePoint& point) {
    tree_.key(key);
    tree_.face(point);
  }
  void unit(int power) { beside("unit", unit_of(*unit_, power)); }

  // Bounds.
  void down(const char* key, double bound) { tree_.bound(key, bound, Rounding::kDown); }
  void up(const char* key, double bound) { tree_.bound(key, bound, Rounding::kUp); }
  void ends(double lower, double upper) {
    down("lower", lower);
    up("upper", upper);
  }
  void signed_ends(double lower, double upper) { ends(lower, upper); }
  void enclosure(const Enclosure& e) {
    ends(e.lower, e.upper);
    if (!e.estimate) return;
    tree_.key("estimate");
    tree_.estimate(e);
  }

  // Members that others imply, and members for people.
  template <class Make, class Refusal>
  void implied(const char* key, const Make& make, const Refusal&) {
    put(key, make());
  }
  template <class Make>
  void implied_if(bool is_there, const char* key, const Make& make, const Refusals&) {
    if (is_there) put(key, make());
  }
  template <class Make>
  void implied_ends(const Make& make, const char*) {
    const CertifiedInterval interval = make();
    ends(interval.lower, interval.upper);
  }
  void beside(const char* key, const std::string& text) { put(key, TextOrNull{text}); }
  template <class Make>
  void told(const char* key, const Make& make) {
    put(key, make());
  }
  void said(const char* key, const std::string&, const Answer& answer) {
    put(key, in_words(answer));
  }

  // Presence.
  template <class... T>
  bool has(const char*, const T&... members) {
    return (static_cast<bool>(members) && ...);
  }
  bool is_some(const char* key, bool is_there) {
    if (!is_there) put(key, TextOrNull{});
    return is_there;
  }

  // Objects and arrays.
  template <class Members>
  void object(const char* key, const Members& members) {
    tree_.key(key);
    put_object(members);
  }
  template <class Members>
  void bounds(const char* key, const Members& members) {
    object(key, members);
  }
  template <class Members>
  void object_if_there(const char* key, const Members& members) {
    object(key, members);
  }
  template <class T, class Members>
  void optional(const char* key, const std::optional<T>& value, const Members& members) {
    if (value) object(key, [&] { members(*value); });
  }
  template <class T, class Members>
  void nullable(const char* key, const std::optional<T>& value, const Members& members) {
    if (is_some(key, value.has_value())) object(key, [&] { members(*value); });
  }
  template <class T, class Make, class Members>
  void made(const char* key, const std::optional<T>& read, const Make& make,
            const Members& members) {
    const T value = read ? *read : make();
    object(key, [&] { members(value); });
  }
  template <class T, class Members>
  void list(const char* key, const std::vector<T>& items, const Members& members) {
    tree_.key(key);
    tree_.open_array();
    for (const T& item : items) put_object([&] { members(item); });
    tree_.close();
  }
  template <class T, class Members>
  void list_if_any(const char* key, const std::vector<T>& items, const Members& members) {
    if (!items.empty()) list(key, items, members);
  }
  template <class Members>
  void files(const char* key, const std::vector<FileHash>& files, bool are_known,
             const Members& members) {
    if (is_some(key, are_known)) list(key, files, members);
  }
  template <class Make, class Keep>
  void notes(const char* key, const std::vector<Note>&, const Make& make, const Keep&) {
    list(key, make(), [&](const Note& note) { visit(*this, note); });
  }
  template <class Members>
  void array_of_two(const char* key, const Members& members) {
    tree_.key(key);
    tree_.open_array();
    for (const bool is_second : {false, true}) put_object([&] { members(is_second); });
    tree_.close();
  }
  template <class T, class Members>
  void one_or_two(const char* key, const T& first, const std::optional<T>& second,
                  const Members& members) {
    tree_.key(key);
    tree_.open_array();
    put_object([&] { members(first, false); });
    if (second) put_object([&] { members(*second, true); });
    tree_.close();
  }
  void texts(const char* key, const std::vector<std::string>& texts) {
    tree_.key(key);
    tree_.open_array();
    for (const std::string& text : texts) put(text);
    tree_.close();
  }
  void texts_if_any(const char* key, const std::vector<std::string>& all) {
    if (!all.empty()) texts(key, all);
  }
  void vector(const char* key, const DVec3& v) { put_numbers(key, {v.x, v.y, v.z}); }
  void two_numbers(const char* key, double x, double y) { put_numbers(key, {x, y}); }
  /// All four rows, as a matrix's file has them.
  void matrix(const char* key, const std::optional<MatrixRows>& matrix) {
    if (!is_some(key, matrix.has_value())) return;
    tree_.key(key);
    tree_.open_array();
    for (const auto& row : *matrix) put_row({row[0], row[1], row[2], row[3]});
    put_row({0, 0, 0, 1});
    tree_.close();
  }
  void named_counts(const char* key, const std::vector<CullCount>& counts) {
    object(key, [&] {
      for (const CullCount& one : counts) put(one.name.c_str(), one.candidates);
    });
  }
  struct NamedCount {
    const char* key;
    const uint64_t& count;
  };
  void counts(const char*, bool are_known, std::initializer_list<NamedCount> counts) {
    for (const NamedCount& one : counts)
      put(one.key, are_known ? std::optional(one.count) : std::nullopt);
  }

 private:
  void put(bool truth) { tree_.truth(truth); }
  void put(double number) { tree_.number(number); }
  void put(uint64_t count) { tree_.count(count); }
  void put(std::string_view text) { tree_.text(text); }
  void put(const char* text) { tree_.text(text); }
  void put(const std::string& text) { tree_.text(text); }
  void put(const TextOrNull& one) { one.text.empty() ? tree_.null() : tree_.text(one.text); }
  template <class T>
  void put(const std::optional<T>& value) {
    value ? put(*value) : tree_.null();
  }
  template <class T>
  void put(const char* key, const T& value) {
    tree_.key(key);
    put(value);
  }
  void put_row(std::initializer_list<double> numbers) {
    tree_.open_array();
    for (const double number : numbers) put(number);
    tree_.close();
  }
  void put_numbers(const char* key, std::initializer_list<double> numbers) {
    tree_.key(key);
    put_row(numbers);
  }
  template <class Members>
  void put_object(const Members& members) {
    tree_.open_object();
    members();
    tree_.close();
  }

  Tree& tree_;
  Detail detail_;
  const std::string* unit_ = nullptr;
};

}  // namespace vkh
