// A text cut at line ends, for several threads at once.
#pragma once

#include <cstdint>
#include <string_view>

#include "host/read/file_mesh_builder.h"
#include "host/read/text_scanner.h"

namespace vkh {

/// The lines that may begin a block.
enum class Cut {
  kLine,         ///< any
  kUncontinued,  ///< lines that a backslash does not make part of the line before
  kFacet,        ///< lines that begin with the word facet
};

struct TextBlock {
  std::string_view text;
  char terminator = '\n';                  ///< line_terminator of the whole text
  bool is_first = false, is_last = false;  ///< in the text that was cut

  TextScanner scanner(std::string_view name, char comment = '\0') const {
    return {text, name, comment, terminator};
  }
};

/// The whole text of a source in memory.
TextBlock whole_text(const MeshSource& source);

class TextBlocks {
 public:
  /// Cuts the text after the byte `begin`. Throws InputError if the text does not soon show how its
  /// lines end.
  TextBlocks(const MeshSource& source, uint64_t begin, Cut cut);

  size_t count() const { return count_; }
  /// Sets whether for_each adds what it reads to the progress from now on.
  void count_bytes(bool counts) { counts_ = counts; }
  /// The source that was cut, but without its keep_going: the pool asks that.
  const MeshSource& source() const { return quiet_; }
  /// Makes one builder for each block.
  std::vector<FileMeshBuilder> builders() const {
    return std::vector<FileMeshBuilder>(count_, FileMeshBuilder(quiet_));
  }

  /// Calls work(i, block) for every block that is not empty, and passes on what `work` throws.
  /// Throws InputError if no line that may begin a block follows soon after a cut.
  template <class F>
  void for_each(const ThreadPool& pool, const F& work) {
    pool.for_each(count_, [&](size_t i) {
      Windows::Window window(windows_);
      const TextBlock block = block_at(i, window);
      if (block.text.empty()) return;
      work(i, block);
      if (counts_) count_read(quiet_, block.text.size());
    });
  }

 private:
  TextBlock block_at(size_t i, Windows::Window& window) const;

  MeshSource quiet_;
  Windows windows_;
  uint64_t begin_, size_;
  size_t block_bytes_, count_;
  Cut cut_;
  char terminator_;
  bool counts_ = true;
};

/// Lines that hold a word, which are numbered from the first block on.
struct Rows {
  TextScanner& scanner;
  uint64_t begin, end;
};

/// A text of one row a line, after its header.
class RowBlocks {
 public:
  RowBlocks(const MeshSource& source, uint64_t begin, char comment)
      : pool_(pool_of(source)), blocks_(source, begin, Cut::kLine), comment_(comment) {}

  std::vector<FileMeshBuilder> builders() const { return blocks_.builders(); }

  /// Calls work(i, rows) for each block, which has to read all of them. Throws InputError unless
  /// there are `row_count` in all.
  template <class F>
  void for_each(uint64_t row_count, const F& work) {
    const std::vector<size_t> starts = count(row_count);
    blocks_.for_each(pool_, [&](size_t i, const TextBlock& block) {
      TextScanner scanner = block.scanner(blocks_.source().name, comment_);
      work(i, Rows{scanner, starts[i], starts[i + 1]});
      check_end(scanner);
    });
  }

 private:
  /// The number of the first row of each block, and then the number of all rows.
  std::vector<size_t> count(uint64_t row_count);
  void check_end(TextScanner& scanner) const;

  ThreadPool pool_;
  TextBlocks blocks_;
  char comment_;
};

/// The bytes in which a header of a text is looked for.
inline constexpr uint64_t kTextHeader = uint64_t{1} << 20;
/// Throws InputError if more of it may follow the bytes that were looked at.
void check_header_ends(const TextScanner& header, const MeshSource& source);

}  // namespace vkh
