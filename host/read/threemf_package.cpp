#include "host/read/threemf_package.h"

#include <zip.h>

#include <algorithm>
#include <array>
#include <vector>

#include "host/base/percent.h"
#include "host/base/reject.h"

namespace vkh::threemf {
namespace {

struct CloseEntry {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

constexpr const char* kExpected = "a 3MF file";

// Resolves a name from the root on, without "." and "..". A backslash counts as a slash, since some
// writers have Windows' names.
std::string without_dots(std::string_view name) {
  std::vector<std::string_view> steps;
  while (!name.empty()) {
    const std::string_view step = name.substr(0, name.find_first_of("/\\"));
    name.remove_prefix(std::min(name.size(), step.size() + 1));
    if (step == ".." && !steps.empty()) steps.pop_back();
    if (!step.empty() && step != "." && step != "..") steps.push_back(step);
  }
  std::string out;
  for (const std::string_view step : steps) {
    if (!out.empty()) out += '/';
    out += step;
  }
  return out;
}

}  // namespace

struct Package::Archive {
  zip_t* zip = nullptr;
  ~Archive() {
    if (zip != nullptr) zip_discard(zip);
  }
};

Package::Package(const MeshSource& source)
    : source_(source), archive_(std::make_unique<Archive>()) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* bytes =
      zip_source_buffer_create(source.bytes.data(), source.bytes.size(), 0, &error);
  if (bytes != nullptr) archive_->zip = zip_open_from_source(bytes, ZIP_RDONLY, &error);
  const std::string what = zip_error_strerror(&error);
  zip_error_fini(&error);
  if (archive_->zip != nullptr) return;
  zip_source_free(bytes);
  reject(source.name, "byte 0", "a zip archive that cannot be opened: " + vkh::quoted(what),
         kExpected);
}

Package::~Package() = default;

// Tries the name as it is written first: not all writers escape percents, or use slashes in a zip's
// names.
int64_t Package::find(const std::string& part) const {
  const std::string plain = without_dots(part);
  const auto with_backslashes = [](std::string name) {
    std::replace(name.begin(), name.end(), '/', '\\');
    return name;
  };
  const std::string resolved = without_percents(plain);
  for (const std::string& name :
       {plain, resolved, with_backslashes(plain), with_backslashes(resolved)}) {
    const zip_int64_t index =
        zip_name_locate(archive_->zip, name.c_str(), ZIP_FL_NOCASE | ZIP_FL_ENC_GUESS);
    if (index >= 0) return index;
  }
  return -1;
}

void Package::read(const std::string& part, const std::function<void(std::string_view)>& use) {
  const std::string name = part.starts_with('/') ? part.substr(1) : part;
  const auto fail = [&](const std::string& what) {
    reject(source_.name, "byte 0", "part " + vkh::quoted(name) + ": " + what, kExpected);
  };
  const zip_int64_t index = find(part);
  if (index < 0) fail("it is not in the archive");
  const std::unique_ptr<zip_file_t, CloseEntry> file(
      zip_fopen_index(archive_->zip, static_cast<zip_uint64_t>(index), 0));
  if (!file) fail("it cannot be unpacked: " + std::string(zip_strerror(archive_->zip)));
  std::array<char, 1 << 14> piece;
  while (true) {
    const zip_int64_t count = zip_fread(file.get(), piece.data(), piece.size());
    if (count < 0) fail("it is damaged, or ends before its end");
    if (count == 0) return;
    unpacked_bytes_ += static_cast<uint64_t>(count);
    if (unpacked_bytes_ > source_.limits.max_input_bytes) {
      reject(source_.name, "byte 0",
             "part " + vkh::quoted(name) + " goes beyond the limit of " +
                 counted(source_.limits.max_input_bytes, "byte") + " for all that is unpacked",
             "a smaller file, or a greater limit (--max-input)");
    }
    check_going(source_.name, source_.limits);
    use({piece.data(), static_cast<size_t>(count)});
  }
}

}  // namespace vkh::threemf
