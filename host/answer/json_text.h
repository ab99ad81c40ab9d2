// JSON in one line, put together in order: nlohmann cannot write a number in a given form, and
// bounds must be written as they were rounded.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "host/base/decimal.h"
#include "vkhausdorff/field.h"

namespace vkh {

/// Whether a text is valid UTF-8, and so may stand in JSON unchanged.
bool is_utf8(const std::string& text);
/// The text as JSON has it: bytes that are no UTF-8 are replaced.
std::string in_utf8(const std::string& text);

/// A tree of MemberWriter.
class JsonText {
 public:
  void key(const char* name);
  void null() { value() += "null"; }
  void truth(bool truth) { value() += truth ? "true" : "false"; }
  void count(uint64_t count);
  void number(double number);  ///< null where it is infinite
  /// Rounded outward, and all of it in hexadecimal.
  void bound(const char* name, double bound, Rounding rounding);
  /// Between both ends, and read back as the same double.
  void estimate(const Enclosure& e) { value() += decimal_between(*e.estimate, e.lower, e.upper); }
  void face(const SurfacePoint& point) { count(point.file_face); }
  /// Replaces bytes of a file name that are no UTF-8: they must not cost the answer.
  void text(std::string_view text);
  void open_object() { open('{', '}'); }
  void open_array() { open('[', ']'); }
  void close();

  const std::string& text() const { return text_; }

 private:
  std::string& value();  ///< the text, to which a value is added: after a comma if it is not first
  void open(char opening, char closing);

  std::string text_, closing_;
  bool is_first_ = true;
};

/// The object whose members `visit` adds to a tree.
template <class Visit>
std::string json_object(const Visit& visit) {
  JsonText json;
  json.open_object();
  visit(json);
  json.close();
  return json.text();
}

}  // namespace vkh
