// A file that an answer goes to: looked at before a run, written after it, whole or not at all.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vkh {

/// A regular file is written beside its place and renamed, so that an older one is whole until the
/// new one is; where that cannot be, as it is mounted by itself, it is written over. Links are
/// followed: their target is replaced. Pipes, terminals and whatever is
/// standard output already are not replaced but written to.
/// output_file_posix.cpp and output_file_windows.cpp are two forms of it.
class OutputFile {
 public:
  /// `option` is named by messages. Throws UsageError, and has changed nothing, where `path` is one
  /// of `inputs` under any name, or cannot be written. A pipe that nobody reads is refused: opening
  /// it would wait for a reader, for ever if none comes.
  OutputFile(std::string option, std::string path, const std::vector<std::string>& inputs);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Throws OutputError.
  void write(std::string_view text) const;

 private:
  void open_special(unsigned kind);
  void check_place() const;
  void replace(std::string_view text) const;
  void write_over(std::string_view text) const;
  [[noreturn]] void refuse(const std::string& why) const;

  std::string option_, path_;
  std::string target_;  ///< what the links of `path_` lead to
  /// A descriptor or a HANDLE, open for writing, where there is nothing to rename.
  std::intptr_t special_ = -1;
};

/// A file that grows by whole lines, by one process at a time.
class LineFile {
 public:
  /// Opens it, makes it where there is none, and locks it. Throws UsageError where it is no regular
  /// file, one of `inputs` under any name, or another process has it.
  LineFile(std::string option, std::string path, const std::vector<std::string>& inputs);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  uint64_t size() const { return size_; }
  /// Whether its first bytes are those, or all of it is the beginning of them.
  bool begins_with(std::string_view text);
  /// Hands out each line that is whole, without its end; what comes after the last is cut off: a
  /// process ended while it wrote it. Throws OutputError.
  void read(const std::function<void(std::string_view)>& take);
  /// Throws OutputError, and has then taken away what was written of the line. Whoever reads the
  /// file sees the line once this returns, whatever becomes of this process.
  void append(std::string_view line);
  void sync() const;  ///< nor is it lost with the machine's power, once this returns

 private:
  [[noreturn]] void fail(const std::string& what) const;
  std::string option_, path_;
  std::intptr_t file_ = -1;  ///< a descriptor or a HANDLE
  uint64_t size_ = 0;        ///< of whole lines
};

}  // namespace vkh
