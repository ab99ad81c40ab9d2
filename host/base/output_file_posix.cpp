#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <optional>

#include "host/base/output_file.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

namespace fs = std::filesystem;

std::optional<struct stat> status_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

bool is_same(const struct stat& x, const struct stat& y) {
  return x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// A reader that goes away must not end the program before the answer is printed.
class NoBrokenPipe {
 public:
  NoBrokenPipe() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~NoBrokenPipe() { std::signal(SIGPIPE, before_); }
  NoBrokenPipe(const NoBrokenPipe&) = delete;
  NoBrokenPipe& operator=(const NoBrokenPipe&) = delete;

 private:
  void (*before_)(int);
};

/// Returns false, with errno, if it cannot be.
bool write_all(int file, std::string_view text) {
  const NoBrokenPipe guard;
  while (!text.empty()) {
    const ssize_t written = write(file, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<size_t>(written));
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

/// Creates a new file in `folder`, under an unused name; -1 with errno.
int create_beside(const std::string& folder, mode_t mode, std::string& name) {
  constexpr int kMostTries = 1000;
  for (int i = 0; i < kMostTries; ++i) {
    name = folder + "/.vkhausdorff-" + std::to_string(getpid()) + "-" + std::to_string(i);
    const int file = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (file >= 0 || errno != EEXIST) return file;
  }
  return -1;
}

/// Removes the file again if the check throws.
void check_beside(const std::string& beside, const OutputFile::Check& check) {
  try {
    if (check) check(beside);
  } catch (...) {
    unlink(beside.c_str());
    throw;
  }
}

}  // namespace

OutputFile::OutputFile(std::string option, std::string path, const std::vector<std::string>& inputs)
    : option_(std::move(option)), path_(std::move(path)) {
  if (path_.empty()) refuse("expected the name of a file");
  if (path_ == "-") refuse("expected the name of a file; one that is called so is ./-");
  const std::optional<struct stat> there = status_of(path_);
  for (const std::string& input : inputs) {
    const std::optional<struct stat> read = status_of(input);
    if (there && read && is_same(*there, *read))
      refuse("would overwrite the input '" + input + "'");
  }
  for (const int standard : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat status {};
    if (!there || fstat(standard, &status) != 0 || !is_same(*there, status)) continue;
    special_ = fcntl(standard, F_DUPFD_CLOEXEC, 0);
    if (special_ < 0) refuse(std::string("cannot be opened for writing: ") + std::strerror(errno));
    return;
  }
  if (there && S_ISDIR(there->st_mode)) refuse("is a folder");
  if (there && !S_ISREG(there->st_mode)) {
    open_special(there->st_mode);
    return;
  }
  std::error_code none;
  target_ = fs::is_symlink(path_, none) ? fs::canonical(path_, none).string() : path_;
  if (target_.empty()) refuse("a link that leads nowhere");
  check_place();
}

OutputFile::~OutputFile() {
  if (special_ >= 0) close(static_cast<int>(special_));
}

void OutputFile::refuse(const std::string& why) const {
  throw UsageError({.option = option_, .file = path_, .problem = why});
}

void OutputFile::fail(const std::string& reason) const {
  throw OutputError({.option = option_, .file = path_, .problem = "cannot be written: " + reason});
}

// Keeps the file open until it is written to: a pipe's reader would take closing it for the end.
// O_NONBLOCK is only for opening, which would otherwise wait for a reader.
void OutputFile::open_special(unsigned mode) {
  if (S_ISBLK(mode)) refuse("is a disk, not a file");
  const int file = open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  special_ = file;
  if (file >= 0 && fcntl(file, F_SETFL, 0) == 0) return;
  if (errno == ENXIO && S_ISFIFO(mode)) refuse("a pipe without a reader: start the reader first");
  refuse(std::string("cannot be opened for writing: ") + std::strerror(errno));
}

// Checks the folder early: an answer that took an hour must not meet a missing one.
void OutputFile::check_place() const {
  const std::string folder = folder_of(target_);
  if (fs::path(target_).filename().empty()) refuse("is a folder's name");
  const bool may_write_over = access(target_.c_str(), W_OK) == 0;
  if (!may_write_over && access(folder.c_str(), W_OK | X_OK) != 0)
    refuse("the folder '" + folder + "' cannot be written: " + std::strerror(errno));
  if (access(target_.c_str(), W_OK) != 0 && errno != ENOENT)
    refuse(std::string("cannot be opened for writing: ") + std::strerror(errno));
}

void OutputFile::write(std::string_view text, const Check& check) const {
  if (special_ < 0) return replace(text, check);
  if (!write_all(static_cast<int>(special_), text)) fail(std::strerror(errno));
}

// Writes over an older file that nothing can be renamed over: it is mounted by itself, or its
// folder is not ours to write.
void OutputFile::write_over(std::string_view text) const {
  const int file = open(target_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  const bool good = file >= 0 && write_all(file, text);
  const int error = errno;
  if (file >= 0 && close(file) == 0 && good) return;
  fail(std::strerror(good ? errno : error));
}

void OutputFile::replace(std::string_view text, const Check& check) const {
  std::string beside;
  const std::optional<struct stat> older = status_of(target_);
  const int file = create_beside(folder_of(target_), 0666, beside);
  bool good = file >= 0;
  if (good && older) good = fchmod(file, older->st_mode & 07777) == 0;
  good = good && write_all(file, text);
  int error = good ? 0 : errno;
  if (file >= 0 && close(file) != 0 && good) error = errno;  // a quota or NFS may report here
  if (error == 0) check_beside(beside, check);
  if (error == 0 && rename(beside.c_str(), target_.c_str()) != 0) error = errno;
  if (error == 0) return;
  if (file >= 0) unlink(beside.c_str());
  const bool may_write_over = error == EBUSY || error == EACCES || error == EPERM || error == EXDEV;
  if (older && may_write_over) return write_over(text);
  fail(std::strerror(error));
}

void LineFile::fail(const std::string& what) const {
  throw OutputError(
      {.option = option_, .file = path_, .problem = what + ": " + std::strerror(errno)});
}

LineFile::LineFile(std::string option, std::string path, const std::vector<std::string>& inputs)
    : option_(std::move(option)), path_(std::move(path)) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError({.option = option_, .file = path_, .problem = why});
  };
  const std::optional<struct stat> older = status_of(path_);
  for (const std::string& input : older ? inputs : std::vector<std::string>()) {
    const std::optional<struct stat> read = status_of(input);
    if (read && is_same(*older, *read)) refuse("would overwrite the input '" + input + "'");
  }
  if (older && !S_ISREG(older->st_mode)) refuse("is no file that lines can be added to");
  const int file = open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) refuse(std::string("cannot be opened for writing: ") + std::strerror(errno));
  file_ = file;
  // Some file systems have no locks: then other processes are not kept out.
  const bool is_taken = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (is_taken) close(file);
  if (is_taken) refuse("another process writes to it");
  struct stat status {};
  if (fstat(file, &status) == 0) size_ = static_cast<uint64_t>(status.st_size);
}

LineFile::~LineFile() { close(static_cast<int>(file_)); }

bool LineFile::begins_with(std::string_view text) {
  std::string start(std::min<uint64_t>(text.size(), size_), '\0');
  const ssize_t bytes = pread(static_cast<int>(file_), start.data(), start.size(), 0);
  return bytes == static_cast<ssize_t>(start.size()) && text.starts_with(start);
}

void LineFile::read(const std::function<void(std::string_view)>& take) {
  const int file = static_cast<int>(file_);
  std::string text;  // the beginning of a line
  uint64_t whole = 0;
  for (off_t at = 0;;) {
    char block[1 << 16];
    const ssize_t bytes = pread(file, block, sizeof block, at);
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes < 0) fail("cannot be read");
    if (bytes == 0) break;
    at += bytes;
    text.append(block, static_cast<size_t>(bytes));
    size_t begin = 0;
    for (size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
      take(std::string_view(text).substr(begin, end - begin));
    whole += begin;
    text.erase(0, begin);
  }
  if (whole != size_ && ftruncate(file, static_cast<off_t>(whole)) != 0)
    fail("cannot be shortened");
  size_ = whole;
}

void LineFile::append(std::string_view line) {
  const std::string text = std::string(line) + '\n';
  if (write_all(static_cast<int>(file_), text)) {
    size_ += text.size();
    return;
  }
  const int error = errno;
  if (ftruncate(static_cast<int>(file_), static_cast<off_t>(size_)) != 0) {
    // The written part of the line stays: the next process cuts it off.
  }
  errno = error;
  fail("cannot be written");
}

void LineFile::sync() const {
  if (fsync(static_cast<int>(file_)) != 0 && errno != EINVAL) fail("cannot be written");
}

}  // namespace vkh
