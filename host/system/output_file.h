// A file that an answer goes to: looked at before a run, written after it, whole or not at all.
#pragma once

#include <cstdint>
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

}  // namespace vkh
