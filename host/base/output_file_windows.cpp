#include <windows.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "host/base/output_file.h"
#include "host/base/system.h"
#include "host/base/windows_handle.h"
#include "host/base/windows_text.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

namespace fs = std::filesystem;

constexpr DWORD kShareAll = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

class File {
 public:
  explicit File(HANDLE handle) : handle_(handle) {}
  File(const fs::path& path, DWORD access, DWORD how, DWORD flags)
      : handle_(CreateFileW(path.c_str(), access, kShareAll, nullptr, how, flags, nullptr)) {}
  ~File() { close(); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  bool is_open() const { return handle_ != INVALID_HANDLE_VALUE; }
  HANDLE handle() const { return handle_; }
  HANDLE release() { return std::exchange(handle_, INVALID_HANDLE_VALUE); }
  bool close() {
    const HANDLE handle = release();
    return handle == INVALID_HANDLE_VALUE || CloseHandle(handle) != 0;
  }

 private:
  HANDLE handle_;
};

/// Returns Windows' text for an error, in one line.
std::string text_of(DWORD error) {
  wchar_t* text = nullptr;
  constexpr DWORD kHow = FORMAT_MESSAGE_ALLOCATE_BUFFER | FORMAT_MESSAGE_FROM_SYSTEM |
                         FORMAT_MESSAGE_IGNORE_INSERTS | FORMAT_MESSAGE_MAX_WIDTH_MASK;
  const DWORD size =
      FormatMessageW(kHow, nullptr, error, 0, reinterpret_cast<wchar_t*>(&text), 0, nullptr);
  std::string out = size == 0 ? "error " + std::to_string(error) : utf8_of({text, size});
  LocalFree(text);
  out.erase(out.find_last_not_of(" .") + 1);
  return out;
}

using FileId = BY_HANDLE_FILE_INFORMATION;

std::optional<FileId> id_of(HANDLE handle) {
  FileId id{};
  if (GetFileType(handle) != FILE_TYPE_DISK || GetFileInformationByHandle(handle, &id) == 0)
    return std::nullopt;
  return id;
}

bool is_same(const FileId& x, const FileId& y) {
  return x.dwVolumeSerialNumber == y.dwVolumeSerialNumber && x.nFileIndexHigh == y.nFileIndexHigh &&
         x.nFileIndexLow == y.nFileIndexLow;
}

/// Opens a file or folder for its status, neither to read nor to write.
File look_at(const std::string& path) {
  return {path_of(path), 0, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS};
}

/// Recognises a pipe by name: opening it would count as a reader.
bool is_pipe(const std::string& path) {
  std::string start = path.substr(0, 9);
  std::replace(start.begin(), start.end(), '/', '\\');
  return start == R"(\\.\pipe\)";
}

fs::path folder_of(const fs::path& path) {
  const fs::path folder = path.parent_path();
  return folder.empty() ? "." : folder;
}

/// The name of an open file without any link in it.
std::string final_name(HANDLE handle) {
  std::wstring name(GetFinalPathNameByHandleW(handle, nullptr, 0, FILE_NAME_NORMALIZED), L'\0');
  const auto room = static_cast<DWORD>(name.size());
  name.resize(GetFinalPathNameByHandleW(handle, name.data(), room, FILE_NAME_NORMALIZED));
  return name.size() < room ? utf8_of(name) : std::string();
}

/// Creates a new file in `folder`, under an unused name.
File create_beside(const fs::path& folder, DWORD flags, fs::path& name) {
  constexpr int kMostTries = 1000;
  for (int i = 0;; ++i) {
    name = folder / (".vkhausdorff-" + std::to_string(process_id()) + "-" + std::to_string(i));
    File file(name, GENERIC_WRITE | DELETE, CREATE_NEW, FILE_ATTRIBUTE_NORMAL | flags);
    if (file.is_open() || GetLastError() != ERROR_FILE_EXISTS || i == kMostTries)
      return File(file.release());
  }
}

/// Returns false, with GetLastError(), if it cannot be.
bool write_all(HANDLE file, std::string_view text) {
  constexpr size_t kMostAtOnce = size_t{1} << 26;
  while (!text.empty()) {
    DWORD written = 0;
    const auto size = static_cast<DWORD>(std::min(text.size(), kMostAtOnce));
    if (WriteFile(file, text.data(), size, &written, nullptr) == 0) return false;
    text.remove_prefix(written);
  }
  return true;
}

/// Removes the file again if the check throws.
void check_beside(const fs::path& beside, const OutputFile::Check& check) {
  try {
    if (check) check(name_of(beside));
  } catch (...) {
    DeleteFileW(beside.c_str());
    throw;
  }
}

}  // namespace

OutputFile::OutputFile(std::string option, std::string path, const std::vector<std::string>& inputs)
    : option_(std::move(option)), path_(std::move(path)) {
  if (path_.empty()) refuse("expected the name of a file");
  if (path_ == "-") refuse("expected the name of a file; one that is called so is ./-");
  if (is_pipe(path_)) {
    open_special(FILE_TYPE_PIPE);
    return;
  }
  const File found = look_at(path_);
  const std::optional<FileId> there = id_of(found.handle());
  for (const std::string& input : inputs) {
    const std::optional<FileId> read = id_of(look_at(input).handle());
    if (there && read && is_same(*there, *read))
      refuse("would overwrite the input '" + input + "'");
  }
  for (const DWORD standard : {STD_OUTPUT_HANDLE, STD_ERROR_HANDLE}) {
    const std::optional<FileId> id = id_of(GetStdHandle(standard));
    if (!there || !id || !is_same(*there, *id)) continue;
    HANDLE copy = INVALID_HANDLE_VALUE;
    const HANDLE us = GetCurrentProcess();
    if (DuplicateHandle(us, GetStdHandle(standard), us, &copy, 0, FALSE, DUPLICATE_SAME_ACCESS) ==
        0)
      refuse("cannot be opened for writing: " + text_of(GetLastError()));
    special_ = reinterpret_cast<std::intptr_t>(copy);
    return;
  }
  if (there && (there->dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0) refuse("is a folder");
  if (found.is_open() && !there) {
    open_special(GetFileType(found.handle()));
    return;
  }
  target_ = path_;
  const DWORD attributes = GetFileAttributesW(path_of(path_).c_str());
  const bool is_link =
      attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
  if (is_link) target_ = found.is_open() ? final_name(found.handle()) : "";
  if (target_.empty()) refuse("a link that leads nowhere");
  check_place();
}

OutputFile::~OutputFile() {
  if (special_ != -1) CloseHandle(handle_of(special_));
}

void OutputFile::refuse(const std::string& why) const {
  throw UsageError({.option = option_, .file = path_, .problem = why});
}

void OutputFile::fail(const std::string& reason) const {
  throw OutputError({.option = option_, .file = path_, .problem = "cannot be written: " + reason});
}

// Keeps NUL, a console or a pipe open until it is written to.
void OutputFile::open_special(unsigned kind) {
  File file(path_of(path_), GENERIC_WRITE, OPEN_EXISTING, 0);
  if (file.is_open()) {
    special_ = reinterpret_cast<std::intptr_t>(file.release());
    return;
  }
  const DWORD error = GetLastError();
  if (kind == FILE_TYPE_PIPE && error == ERROR_FILE_NOT_FOUND)
    refuse("a pipe without a reader: start the reader first");
  refuse("cannot be opened for writing: " + text_of(error));
}

// Checks the folder early: an answer that took an hour must not meet a missing one. Only creating a
// file shows what access lists allow; that file is deleted when it is closed.
void OutputFile::check_place() const {
  const fs::path target = path_of(target_), folder = folder_of(target);
  if (target.filename().empty()) refuse("is a folder's name");
  const bool may_write_over = File(target, GENERIC_WRITE, OPEN_EXISTING, 0).is_open();
  const DWORD over = GetLastError();
  if (!may_write_over && over != ERROR_FILE_NOT_FOUND && over != ERROR_PATH_NOT_FOUND)
    refuse("cannot be opened for writing: " + text_of(over));
  fs::path tried;
  if (!may_write_over && !create_beside(folder, FILE_FLAG_DELETE_ON_CLOSE, tried).is_open()) {
    refuse("the folder '" + name_of(folder) + "' cannot be written: " + text_of(GetLastError()));
  }
}

void OutputFile::write(std::string_view text, const Check& check) const {
  if (special_ == -1) return replace(text, check);
  if (!write_all(handle_of(special_), text)) fail(text_of(GetLastError()));
}

// Writes over an older file that another process holds open, or whose folder is not ours to write.
void OutputFile::write_over(std::string_view text) const {
  File file(path_of(target_), GENERIC_WRITE, TRUNCATE_EXISTING, 0);
  if (file.is_open() && write_all(file.handle(), text) && file.close()) return;
  fail(text_of(GetLastError()));
}

void OutputFile::replace(std::string_view text, const Check& check) const {
  const fs::path target = path_of(target_);
  const bool has_older = GetFileAttributesW(target.c_str()) != INVALID_FILE_ATTRIBUTES;
  fs::path beside;
  File file = create_beside(folder_of(target), 0, beside);
  const bool is_made = file.is_open();
  bool good = is_made && write_all(file.handle(), text) && file.close();
  if (good) check_beside(beside, check);
  // ReplaceFileW keeps the older file's access list.
  good = good &&
         ((has_older && ReplaceFileW(target.c_str(), beside.c_str(), nullptr,
                                     REPLACEFILE_IGNORE_MERGE_ERRORS, nullptr, nullptr) != 0) ||
          MoveFileExW(beside.c_str(), target.c_str(), MOVEFILE_REPLACE_EXISTING) != 0);
  if (good) return;
  const DWORD error = GetLastError();
  file.close();
  if (is_made) DeleteFileW(beside.c_str());
  if (has_older && (error == ERROR_ACCESS_DENIED || error == ERROR_SHARING_VIOLATION))
    return write_over(text);
  fail(text_of(error));
}

void LineFile::fail(const std::string& what) const {
  throw OutputError(
      {.option = option_, .file = path_, .problem = what + ": " + text_of(GetLastError())});
}

// Lets no other process write to it while it is open: that is the lock.
LineFile::LineFile(std::string option, std::string path, const std::vector<std::string>& inputs)
    : option_(std::move(option)), path_(std::move(path)) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError({.option = option_, .file = path_, .problem = why});
  };
  const std::optional<FileId> older =
      is_pipe(path_) ? std::nullopt : id_of(look_at(path_).handle());
  for (const std::string& input : older ? inputs : std::vector<std::string>()) {
    const std::optional<FileId> read = id_of(look_at(input).handle());
    if (read && is_same(*older, *read)) refuse("would overwrite the input '" + input + "'");
  }
  File file(CreateFileW(path_of(path_).c_str(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ,
                        nullptr, OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr));
  const DWORD error = GetLastError();
  if (!file.is_open() && error == ERROR_SHARING_VIOLATION) refuse("another process writes to it");
  if (!file.is_open()) refuse("cannot be opened for writing: " + text_of(error));
  if (GetFileType(file.handle()) != FILE_TYPE_DISK) refuse("is no file that lines can be added to");
  LARGE_INTEGER size{};
  if (GetFileSizeEx(file.handle(), &size) != 0) size_ = static_cast<uint64_t>(size.QuadPart);
  file_ = reinterpret_cast<std::intptr_t>(file.release());
}

LineFile::~LineFile() { CloseHandle(handle_of(file_)); }

namespace {

bool go_to(HANDLE file, uint64_t place) {
  LARGE_INTEGER at{};
  at.QuadPart = static_cast<LONGLONG>(place);
  return SetFilePointerEx(file, at, nullptr, FILE_BEGIN) != 0;
}

}  // namespace

bool LineFile::begins_with(std::string_view text) {
  std::string start(static_cast<size_t>(std::min<uint64_t>(text.size(), size_)), '\0');
  const HANDLE file = handle_of(file_);
  DWORD bytes = 0;
  const bool is_read =
      go_to(file, 0) &&
      ReadFile(file, start.data(), static_cast<DWORD>(start.size()), &bytes, nullptr) != 0;
  return is_read && bytes == start.size() && text.starts_with(start);
}

void LineFile::read(const std::function<void(std::string_view)>& take) {
  const HANDLE file = handle_of(file_);
  std::string text;  // the beginning of a line
  uint64_t whole = 0;
  if (!go_to(file, 0)) fail("cannot be read");
  for (;;) {
    char block[1 << 16];
    DWORD bytes = 0;
    if (ReadFile(file, block, sizeof block, &bytes, nullptr) == 0) fail("cannot be read");
    if (bytes == 0) break;
    text.append(block, bytes);
    size_t begin = 0;
    for (size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
      take(std::string_view(text).substr(begin, end - begin));
    whole += begin;
    text.erase(0, begin);
  }
  if (!go_to(file, whole) || SetEndOfFile(file) == 0) fail("cannot be shortened");
  size_ = whole;
}

void LineFile::append(std::string_view line) {
  const std::string text = std::string(line) + '\n';
  const HANDLE file = handle_of(file_);
  if (go_to(file, size_) && write_all(file, text)) {
    size_ += text.size();
    return;
  }
  const DWORD error = GetLastError();
  if (go_to(file, size_)) SetEndOfFile(file);
  SetLastError(error);
  fail("cannot be written");
}

void LineFile::sync() const {
  if (FlushFileBuffers(handle_of(file_)) == 0) fail("cannot be written");
}

}  // namespace vkh
