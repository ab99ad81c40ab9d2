// The visitor of members.h that reads them. A member that was changed after it was written is
// refused if the others contradict it.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/answer/json_object.h"
#include "host/answer/members.h"
#include "vkhausdorff/error.h"

namespace vkh {

/// A member that is missing is an error, or is noted: lines of older programs lack some. Bounds and
/// named words are never left out.
enum class Missing { kRefused, kNoted };

/// Reads in two passes: members first, and then, with compare(), what they imply.
class JsonReader {
 public:
  static constexpr bool kReads = true;

  /// `document`: an object, which outlives the reader.
  JsonReader(const Json& document, Detail detail, Missing missing)
      : detail_(detail), missing_(missing) {
    enter(document, "answer");
  }
  void compare() { compares_ = true; }
  const std::vector<std::string>& lacking() const { return lacking_; }

  bool is_full() const { return detail_ == Detail::kFull; }
  void in_unit(const std::string& unit) { unit_ = &unit; }
  void in_version(const std::string& version) { version_ = &version; }

  // Values.
  void text(const char* key, std::string& text);
  void text_or_null(const char* key, std::string& text);
  void number(const char* key, double& number);
  void number_or_null(const char* key, double& number);
  void number_or_none(const char* key, std::optional<double>& number);
  void number_if_known(const char* key, double& number, bool);
  void number_since(const char* version, const char* key, double& number, bool is_known);
  template <std::integral T>
  void count(const char* key, T& count) {
    const Json* json = unread(key);
    if (json == nullptr) return;
    const uint64_t number = count_in(*json, key);
    if (!std::in_range<T>(number)) throw InputError(std::string(key) + " is too large");
    count = static_cast<T>(number);
  }
  void count_or_none(const char* key, std::optional<uint64_t>& count);
  void count_if_any(const char* key, uint64_t& count);
  void truth(const char* key, bool& truth);
  void mark(const char* key, bool& truth);
  template <class Enum>
  void named(const char* key, Enum& value, const Words<Enum>& words) {
    if (compares_) return;
    const std::string name = needed_text(key);
    for (int i = static_cast<int>(words.first); i <= static_cast<int>(words.last); ++i) {
      if (name == words.word(static_cast<Enum>(i))) return void(value = static_cast<Enum>(i));
    }
    throw InputError(std::string(key) + " '" + name + "'");
  }
  template <class Enum>
  void named_unless(Enum, const char* key, Enum& value, const Words<Enum>& words) {
    if (find(key) != nullptr) named(key, value, words);
  }
  void exit_code(const char* key, ExitCode& code);
  void note_code(const char* key, NoteCode& code);
  void length(const char* key, Length& length);
  void face(const char* key, SurfacePoint& point);
  void unit(int power) {
    if (compares_) beside("unit", unit_of(*unit_, power));
  }

  // Bounds.
  void down(const char* key, double& bound) {
    if (!compares_) bound = bound_at(key, false);
  }
  void up(const char* key, double& bound) { down(key, bound); }
  void ends(double& lower, double& upper) { read_ends(lower, upper, false); }
  void signed_ends(double& lower, double& upper) { read_ends(lower, upper, true); }
  void enclosure(Enclosure& e);

  // Members that others imply, and members for people.
  template <class Make, class Refusal>
  void implied(const char* key, const Make& make, const Refusal& refusal) {
    if (!compares_) return;
    const Json* json = member(key);
    if (json != nullptr && !is_same(*json, make())) refuse(refusal);
  }
  template <class Make>
  void implied_if(bool is_there, const char* key, const Make& make, const Refusals& refusals) {
    if (!compares_) return;
    const Json* json = find(key);
    if ((json != nullptr) != is_there) throw InputError(refusals.of_presence);
    if (is_there && !is_same(*json, make())) throw InputError(refusals.of_value);
  }
  template <class Make>
  void implied_ends(const Make& make, const char* refusal) {
    if (compares_) compare_ends(make(), refusal);
  }
  void beside(const char* key, const std::string& text);
  template <class Make>
  void told(const char* key, const Make& make) {
    const Json* json = compares_ ? member(key) : nullptr;
    if (json != nullptr && is_of_this_version() && !is_same(*json, make()))
      throw InputError(std::string(key) + " is not what this version says of the rest");
  }
  void said(const char* key, std::string& kept, const Answer& answer);

  // Presence.
  template <class... T>
  bool has(const char* key, std::optional<T>&... members) {
    const bool is_there = find(key) != nullptr;
    if (is_there && !compares_) (members.emplace(), ...);
    return is_there;
  }
  bool has(const char* key, bool& is_there) { return is_there = find(key) != nullptr; }
  bool is_some(const char* key, bool& is_there);
  bool is_some(const char* key, bool&& is_there) { return is_some(key, is_there); }

  // Objects and arrays.
  template <class Members>
  void object(const char* key, const Members& members) {
    if (const Json* json = member(key)) within(*json, key, members);
  }
  template <class Members>
  void bounds(const char* key, const Members& members) {
    within(needed(key), key, members);
  }
  template <class Members>
  void object_if_there(const char* key, const Members& members) {
    if (const Json* json = find(key)) within(*json, key, members);
  }
  template <class T, class Members>
  void optional(const char* key, std::optional<T>& value, const Members& members) {
    if (has(key, value)) object(key, [&] { members(*value); });
  }
  template <class T, class Members>
  void nullable(const char* key, std::optional<T>& value, const Members& members) {
    const Json* json = member(key);
    if (json == nullptr || json->is_null()) return;
    if (!compares_) value.emplace();
    within(*json, key, [&] { members(*value); });
  }
  template <class T, class Make, class Members>
  void made(const char* key, std::optional<T>& read, const Make&, const Members& members) {
    if (!compares_) read.emplace();
    object(key, [&] { members(*read); });
  }
  template <class T, class Members>
  void list(const char* key, std::vector<T>& items, const Members& members) {
    const Json* rows = array(key);
    if (rows == nullptr) return;
    if (!compares_) items.resize(rows->size());
    for (size_t i = 0; i < items.size(); ++i) within((*rows)[i], key, [&] { members(items[i]); });
  }
  template <class T, class Members>
  void list_if_any(const char* key, std::vector<T>& items, const Members& members) {
    if (find(key) != nullptr) list(key, items, members);
  }
  template <class Members>
  void files(const char* key, std::vector<FileHash>& files, bool, const Members& members) {
    if (has_files(key)) list(key, files, members);
  }
  template <class Make, class Keep>
  void notes(const char* key, std::vector<Note>& notes, const Make&, const Keep& keep) {
    if (compares_) return;
    const Json* rows = find(key);
    if (rows == nullptr) return;
    for (const Json& row : array_in(*rows, key)) {
      std::optional<Note> note = note_in(row);
      if (note && keep(*note)) notes.push_back(std::move(*note));
    }
  }
  template <class Members>
  void array_of_two(const char* key, const Members& members) {
    const Json* rows = array(key);
    if (rows == nullptr) return;
    if (rows->size() != 2) throw InputError(std::string(key) + " are not two");
    for (const bool is_second : {false, true})
      within((*rows)[is_second ? 1 : 0], key, [&] { members(is_second); });
  }
  template <class T, class Members>
  void one_or_two(const char* key, T& first, std::optional<T>& second, const Members& members) {
    const Json& rows = array_in(needed(key), key);
    if (rows.empty() || rows.size() > 2) throw InputError(std::string(key) + " are not one or two");
    if (rows.size() == 2 && !compares_) second.emplace();
    within(rows[0], key, [&] { members(first, false); });
    if (second) within(rows[1], key, [&] { members(*second, true); });
  }
  void texts(const char* key, std::vector<std::string>& texts);
  void texts_if_any(const char* key, std::vector<std::string>& all) {
    if (find(key) != nullptr) texts(key, all);
  }
  void vector(const char* key, DVec3& v);
  void two_numbers(const char* key, double& x, double& y);
  void matrix(const char* key, std::optional<MatrixRows>& matrix);
  void named_counts(const char* key, std::vector<CullCount>& counts);
  struct NamedCount {
    const char* key;
    uint64_t& count;
  };
  void counts(const char* of, bool& are_known, std::initializer_list<NamedCount> counts);

 private:
  /// Looks first where the last one was: members come in the order in which they are visited.
  const Json* find(std::string_view key);
  const Json& needed(const char* key);
  std::string needed_text(const char* key);
  const Json* member(const char* key);  ///< null: it is missing, which is noted
  const Json* unread(const char* key) { return compares_ ? nullptr : member(key); }
  const Json* array(const char* key);
  static const Json& array_in(const Json& json, const char* key);
  static std::optional<Note> note_in(const Json& json);
  bool has_files(const char* key);
  bool is_of_this_version() const { return *version_ == program_version(); }
  static uint64_t count_in(const Json& json, const char* key);
  double bound_at(const char* key, bool is_signed);
  Enclosure ends_at(bool is_signed);
  void read_ends(double& lower, double& upper, bool is_signed);
  void compare_ends(const CertifiedInterval& implied, const char* refusal);
  static bool is_same(const Json& json, bool truth) { return json.is_boolean() && json == truth; }
  static bool is_same(const Json& json, const char* text) {
    return json.is_string() && json == text;
  }
  static bool is_same(const Json& json, const TextOrNull& text);
  static bool is_same(const Json& json, double number);
  [[noreturn]] static void refuse(const char* why) { throw InputError(why); }
  template <class Why>
  [[noreturn]] static void refuse(const Why& why) {
    throw InputError(why());
  }

  void enter(const Json& json, const char* key);
  template <class Members>
  void within(const Json& json, const char* key, const Members& members) {
    const Json* const outer = at_;
    const size_t next = next_;
    enter(json, key);
    members();
    at_ = outer;
    next_ = next;
  }

  Detail detail_;
  Missing missing_;
  bool compares_ = false;
  const Json* at_ = nullptr;
  size_t next_ = 0;
  const std::string *unit_ = nullptr, *version_ = nullptr;
  std::vector<std::string> lacking_;
};

/// Fills in, for B's direction, the members that an answer has once for both directions. A program
/// before 0.3.0 did not write that direction's diagonal: it is B's, or A's if the direction was not
/// run, which its gap shows.
void fill_in_reverse(const Json& json, Answer& answer);

}  // namespace vkh
