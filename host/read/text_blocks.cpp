#include "host/read/text_blocks.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "host/base/reject.h"

namespace vkh {
namespace {

[[noreturn]] void refuse_to_cut(const MeshSource& source) {
  reject(source.name, "byte 0", "a text that is not cut", "lines");
}

char terminator_of(const MeshSource& source) {
  constexpr size_t kHead = size_t{1} << 16;
  const std::string head = head_of(source, kHead);
  const size_t end = std::min(head.find_first_of("\r\n"), head.size());
  if (head.find_first_not_of('\r', end) == std::string::npos && source.size() > head.size())
    refuse_to_cut(source);
  return line_terminator(head);
}

// Returns whether the line that ends at `end` is known not to be continued: all of it is there, or
// something else than blanks at its end.
bool is_uncontinued(std::string_view text, size_t end, char terminator) {
  size_t last = end;
  while (last > 0 && is_space(text[last - 1]) && text[last - 1] != terminator) --last;
  return last > 0 && text[last - 1] != '\\';
}

/// Returns whether the line at `at` begins with 'facet'; nothing where more of it is needed.
std::optional<bool> is_facet(std::string_view text, size_t at, char terminator) {
  constexpr std::string_view kWord = "facet";
  while (at < text.size() && is_space(text[at]) && text[at] != terminator) ++at;
  for (const char expected : kWord) {
    if (at == text.size()) return std::nullopt;
    if (std::tolower(static_cast<unsigned char>(text[at++])) != expected) return false;
  }
  if (at == text.size()) return std::nullopt;
  return is_space(text[at]);
}

/// The place where the first block in `text` begins, after its first byte; nothing if it is not
/// clear yet.
std::optional<size_t> first_start(std::string_view text, Cut cut, char terminator) {
  for (size_t end = text.find(terminator); end != std::string_view::npos;
       end = text.find(terminator, end + 1)) {
    if (cut == Cut::kUncontinued && !is_uncontinued(text, end, terminator)) continue;
    if (cut != Cut::kFacet) return end + 1;
    const std::optional<bool> facet = is_facet(text, end + 1, terminator);
    if (!facet) return std::nullopt;
    if (*facet) return end + 1;
  }
  return std::nullopt;
}

}  // namespace

TextBlock whole_text(const MeshSource& source) {
  return {source.bytes, line_terminator(source.bytes), true, true};
}

TextBlocks::TextBlocks(const MeshSource& source, uint64_t begin, Cut cut)
    : quiet_(source),
      windows_(quiet_),
      begin_(begin),
      size_(source.size()),
      block_bytes_(block_bytes_of(source)),
      count_(static_cast<size_t>((size_ - begin + block_bytes_ - 1) / block_bytes_)),
      cut_(cut),
      terminator_(terminator_of(source)) {
  quiet_.limits.keep_going = {};
}

// Block i begins at the first line after i times the block's bytes, and ends where the next one
// begins. Both places are found by the same rule from the text alone, so that neighbours agree.
TextBlock TextBlocks::block_at(size_t i, Windows::Window& window) const {
  // Looks for a block's last line 2^8, 2^10, .. bytes beyond the block. The test against kMost
  // follows the attempt, so that the last one looks 4 MiB beyond.
  constexpr uint64_t kMost = uint64_t{1} << 20;
  const uint64_t from = begin_ + i * block_bytes_;
  const uint64_t to = std::min(from + block_bytes_, size_);
  for (uint64_t beyond = 1 << 8;; beyond *= 4) {
    const uint64_t end = std::min(to + beyond, size_);
    const std::string_view text = window.read(from, end);
    const auto start_after = [&](uint64_t at) -> std::optional<size_t> {
      if (at == size_) return text.size();
      const size_t offset = static_cast<size_t>(at - from);
      const auto start = first_start(text.substr(offset), cut_, terminator_);
      if (start) return offset + *start;
      return end == size_ ? std::optional(text.size()) : std::nullopt;
    };
    const std::optional<size_t> first = i == 0 ? 0 : start_after(from);
    const std::optional<size_t> last = first ? start_after(to) : std::nullopt;
    if (last) {
      return {text.substr(*first, *last - *first), terminator_, i == 0, from + *last == size_};
    }
    if (beyond > kMost) refuse_to_cut(windows_.source());
  }
}

std::vector<size_t> RowBlocks::count(uint64_t row_count) {
  std::vector<size_t> rows(blocks_.count() + 1);
  blocks_.count_bytes(false);
  blocks_.for_each(pool_, [&](size_t i, const TextBlock& block) {
    TextScanner scanner = block.scanner(blocks_.source().name, comment_);
    while (scanner.next_full_line()) ++rows[i];
  });
  blocks_.count_bytes(true);
  if (starts_of(rows) != row_count) reject(blocks_.source().name, "byte 0", "other rows", "these");
  return rows;
}

void RowBlocks::check_end(TextScanner& scanner) const {
  if (scanner.next_full_line()) reject(blocks_.source().name, "byte 0", "other rows", "these");
}

void check_header_ends(const TextScanner& header, const MeshSource& source) {
  if (header.bytes_left() == 0) reject(source.name, "byte 0", "a long header", "a short one");
}

}  // namespace vkh
