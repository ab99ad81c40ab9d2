#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "host/base/input_file.h"

namespace vkh {

// Does not open pipes: the writer would see a reader that goes away.
InputFile::InputFile(const std::filesystem::path& path) {
  struct stat known = {};
  if (stat(path.c_str(), &known) != 0 || !S_ISREG(known.st_mode)) return;
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file == -1) return;
  if (fstat(file, &known) != 0 || !S_ISREG(known.st_mode)) {
    close(file);
    return;
  }
  handle_ = file;
  size_ = static_cast<uint64_t>(known.st_size);
}

InputFile::~InputFile() {
  if (is_open()) close(static_cast<int>(handle_));
}

size_t InputFile::read(uint64_t offset, char* to, size_t count) const {
  constexpr size_t kMost = size_t{1} << 30;  // per call; Linux ends it at 2 GiB
  size_t done = 0;
  while (done < count) {
    const ssize_t got = pread(static_cast<int>(handle_), to + done, std::min(count - done, kMost),
                              static_cast<off_t>(offset + done));
    if (got > 0) done += static_cast<size_t>(got);
    if (got == 0 || (got < 0 && errno != EINTR)) break;
  }
  return done;
}

}  // namespace vkh
