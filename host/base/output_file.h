// A file for an answer: checked before a run, written after it, whole or not at all.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vkh {

/// A regular file is written beside its place and renamed, so that an older file stays whole until
/// the new one is. If renaming is impossible, as for a file that is a mount point, the older file
/// is overwritten. Links are followed: their target is replaced. Pipes, terminals and the file that
/// is already standard output are written to, not replaced. The implementations are
/// output_file_posix.cpp and output_file_windows.cpp.
class OutputFile {
 public:
  /// Names `option` in messages. Throws UsageError, and has changed nothing, if `path` is one of
  /// `inputs` under any name, or cannot be written. A pipe without a reader is refused: opening it
  /// would wait for one, perhaps forever.
  OutputFile(std::string option, std::string path, const std::vector<std::string>& inputs);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Called with the whole file before it has its name; throws if it must not have that.
  using Check = std::function<void(const std::string&)>;

  /// Throws OutputError, and what `check` throws: an older file is then unchanged. Pipes and
  /// terminals are not checked.
  void write(std::string_view text, const Check& check = {}) const;
  /// Whether the file is replaced: false for pipes, terminals and standard output.
  bool is_replaced() const { return special_ == -1; }

 private:
  void open_special(unsigned kind);
  void check_place() const;
  void replace(std::string_view text, const Check& check) const;
  void write_over(std::string_view text) const;
  [[noreturn]] void refuse(const std::string& why) const;
  [[noreturn]] void fail(const std::string& reason) const;

  std::string option_, path_;
  std::string target_;  ///< the target of `path_`'s links
  /// A descriptor or a HANDLE, open for writing, if there is nothing to rename.
  std::intptr_t special_ = -1;
};

/// A file that grows by whole lines, by one process at a time.
class LineFile {
 public:
  /// Opens it, creates it if it does not exist, and locks it. Throws UsageError if it is no regular
  /// file, one of `inputs` under any name, or another process has it.
  LineFile(std::string option, std::string path, const std::vector<std::string>& inputs);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  uint64_t size() const { return size_; }
  /// Whether it begins with `text`, or all of it is a beginning of `text`.
  bool begins_with(std::string_view text);
  /// Hands out each whole line, without its end, and cuts off the bytes after the last: a process
  /// ended while it wrote them. Throws OutputError.
  void read(const std::function<void(std::string_view)>& take);
  /// Throws OutputError after taking away the written part of the line. A reader of the file sees
  /// the line once this returns, even if this process ends.
  void append(std::string_view line);
  void sync() const;  ///< keeps lines through a power loss, once this returns

 private:
  [[noreturn]] void fail(const std::string& what) const;
  std::string option_, path_;
  std::intptr_t file_ = -1;  ///< a descriptor or a HANDLE
  uint64_t size_ = 0;        ///< the whole lines' size
};

}  // namespace vkh
