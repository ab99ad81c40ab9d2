// JSON text on its way into the parser, which keeps each token two or three times: long strings
// are taken out before it sees them.
#pragma once

#include <cstddef>
#include <iterator>
#include <string_view>

namespace vkh::gltf {

/// The bytes that a parser is given for a document's: the same ones, but strings of more than
/// kLongest bytes are empty.
class GltfJsonText {
 public:
  static constexpr size_t kLongest = 2048;

  explicit GltfJsonText(std::string_view text) : text_(text) {}

  /// -1 at the end, and where a number has more than kLongest digits.
  int next() {
    if (offset_ >= text_.size() || is_too_long_) return -1;
    const char c = text_[offset_++];
    if (is_escaped_) {
      is_escaped_ = false;
    } else if (c == '"') {
      in_string_ ? end_string() : begin_string();
    } else if (in_string_) {
      is_escaped_ = c == '\\';
    } else {
      count_digit(c);
    }
    return static_cast<unsigned char>(c);
  }

  size_t offset() const { return offset_; }
  bool is_too_long() const { return is_too_long_; }
  /// The string that ended last, as the document writes it, escapes and all.
  std::string_view last_string() const { return last_; }

 private:
  void begin_string() {
    in_string_ = true;
    begin_ = offset_;
    size_t end = offset_;
    while (end < text_.size() && text_[end] != '"') end += text_[end] == '\\' ? 2 : 1;
    if (end < text_.size() && end - begin_ > kLongest) offset_ = end;
  }
  void end_string() {
    in_string_ = false;
    last_ = text_.substr(begin_, offset_ - 1 - begin_);
  }
  void count_digit(char c) {
    digits_ = c >= '0' && c <= '9' ? digits_ + 1 : 0;
    is_too_long_ = digits_ > kLongest;
  }

  std::string_view text_, last_;
  size_t offset_ = 0, begin_ = 0, digits_ = 0;
  bool in_string_ = false, is_escaped_ = false, is_too_long_ = false;
};

/// An input iterator over a GltfJsonText, which holds the position: copies advance together.
class JsonIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  JsonIterator() = default;  ///< the end
  explicit JsonIterator(GltfJsonText& text) : text_(&text), current_(text.next()) {}

  char operator*() const { return static_cast<char>(current_); }
  JsonIterator& operator++() {
    current_ = text_->next();
    return *this;
  }
  bool operator==(const JsonIterator& other) const { return current_ == other.current_; }
  bool operator!=(const JsonIterator& other) const { return current_ != other.current_; }

 private:
  GltfJsonText* text_ = nullptr;
  int current_ = -1;
};

}  // namespace vkh::gltf
