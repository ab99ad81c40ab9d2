// Escapes texts from files and people, so that they are harmless in a page.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "vkhausdorff/answer.h"

namespace vkh {
namespace escape {

struct Replacement {
  std::string_view from, to;
};

// Line and paragraph separators end a line of a script; the others reorder what people read.
inline constexpr std::array kUnseen = {
    Replacement{"\u2028", "\\u{2028}"}, Replacement{"\u2029", "\\u{2029}"},
    Replacement{"\u202a", "\\u{202a}"}, Replacement{"\u202b", "\\u{202b}"},
    Replacement{"\u202c", "\\u{202c}"}, Replacement{"\u202d", "\\u{202d}"},
    Replacement{"\u202e", "\\u{202e}"}, Replacement{"\u2066", "\\u{2066}"},
    Replacement{"\u2067", "\\u{2067}"}, Replacement{"\u2068", "\\u{2068}"},
    Replacement{"\u2069", "\\u{2069}"}, Replacement{"\u200e", "\\u{200e}"},
    Replacement{"\u200f", "\\u{200f}"}};
inline constexpr std::array kMarkup = {Replacement{"&", "&amp;"}, Replacement{"<", "&lt;"},
                                       Replacement{">", "&gt;"}, Replacement{"\"", "&quot;"},
                                       Replacement{"'", "&#39;"}};
// Replacements in strings, which are the only place where JSON has such characters.
inline constexpr std::array kInScript = {
    Replacement{"<", "\\u003c"}, Replacement{">", "\\u003e"}, Replacement{"&", "\\u0026"},
    Replacement{"\u2028", "\\u2028"}, Replacement{"\u2029", "\\u2029"}};

template <size_t kCount>
std::string replaced(std::string_view text, const std::array<Replacement, kCount>& list) {
  std::string out;
  out.reserve(text.size() + text.size() / 16);
  for (size_t at = 0; at < text.size();) {
    const Replacement* found = nullptr;
    for (const Replacement& each : list) {
      if (text.substr(at, each.from.size()) == each.from) found = &each;
    }
    if (found) {
      out += found->to;
    } else {
      out += text[at];
    }
    at += found ? found->from.size() : 1;
  }
  return out;
}

}  // namespace escape

/// Escapes for text and for attributes in quotes. Control characters, and characters that change a
/// line's direction, are written out, as \xNN and \u{NNNN}. `text` is UTF-8.
inline std::string html_text(const std::string& text) {
  return escape::replaced(escape::replaced(printable(text), escape::kUnseen), escape::kMarkup);
}

/// Escapes JSON for a script element: the same JSON, in which nothing can end the element.
inline std::string script_json(std::string_view json) {
  return escape::replaced(json, escape::kInScript);
}

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t at = 0; at < bytes.size(); at += 3) {
    uint32_t word = 0;
    for (size_t i = 0; i < 3; ++i) {
      word = word << 8 | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0u);
    }
    for (size_t i = 0; i < 4; ++i) {
      out += at + i <= bytes.size() ? kDigits[word >> (18 - 6 * i) & 63] : '=';
    }
  }
  return out;
}

}  // namespace vkh
