#include <windows.h>

#include <algorithm>

#include "host/base/input_file.h"
#include "host/base/windows_handle.h"

namespace vkh {
namespace {

/// Makes one read of at most 1 GiB; returns the bytes read, 0 at the end of the file or where the
/// read fails.
DWORD read_once(HANDLE file, uint64_t offset, char* to, size_t count) {
  constexpr size_t kMost = size_t{1} << 30;
  OVERLAPPED place{};
  place.Offset = static_cast<DWORD>(offset);
  place.OffsetHigh = static_cast<DWORD>(offset >> 32);
  place.hEvent = CreateEventW(nullptr, TRUE, FALSE, nullptr);
  if (place.hEvent == nullptr) return 0;
  DWORD got = 0;
  const auto wanted = static_cast<DWORD>(std::min(count, kMost));
  const bool begun =
      ReadFile(file, to, wanted, nullptr, &place) != 0 || GetLastError() == ERROR_IO_PENDING;
  if (!begun || GetOverlappedResult(file, &place, &got, TRUE) == 0) got = 0;
  CloseHandle(place.hEvent);
  return got;
}

}  // namespace

// Opens it overlapped: otherwise Windows lets one thread read a file at a time.
InputFile::InputFile(const std::filesystem::path& path) {
  const HANDLE file = CreateFileW(
      path.c_str(), GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
      OPEN_EXISTING, FILE_FLAG_OVERLAPPED | FILE_FLAG_SEQUENTIAL_SCAN, nullptr);
  if (file == INVALID_HANDLE_VALUE) return;
  LARGE_INTEGER size{};
  if (GetFileType(file) != FILE_TYPE_DISK || GetFileSizeEx(file, &size) == 0) {
    CloseHandle(file);
    return;
  }
  handle_ = reinterpret_cast<std::intptr_t>(file);
  size_ = static_cast<uint64_t>(size.QuadPart);
}

InputFile::~InputFile() {
  if (is_open()) CloseHandle(handle_of(handle_));
}

size_t InputFile::read(uint64_t offset, char* to, size_t count) const {
  size_t done = 0;
  while (done < count) {
    const DWORD got = read_once(handle_of(handle_), offset + done, to + done, count - done);
    if (got == 0) break;
    done += got;
  }
  return done;
}

}  // namespace vkh
