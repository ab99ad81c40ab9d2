// The file that pipelines are kept in: written data comes back, and anything else counts as no
// file.
#include "host/gpu/pipeline_cache.h"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "tests/support/files.h"

namespace fs = std::filesystem;
using namespace vkh;

namespace {

std::vector<char> some_data() {
  std::vector<char> data(1003);
  for (size_t i = 0; i < data.size(); ++i) data[i] = static_cast<char>(i * i);
  return data;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// A file that is not there yet, in a folder that is not there either.
fs::path fresh_file() {
  const fs::path folder = vkh::test::folder() / "cache";
  fs::remove_all(folder);
  return folder / "deep" / "x.pipelines";
}

}  // namespace

TEST_CASE("pipelines that were written come back, and replace older ones") {
  const fs::path file = fresh_file();
  CHECK(read_checked(file).empty());
  write_checked(file, {'o', 'l', 'd'});
  write_checked(file, some_data());
  CHECK(read_checked(file) == some_data());
  CHECK(std::distance(fs::directory_iterator(file.parent_path()), {}) ==
        1);  // nothing is left over
}

TEST_CASE("a file that is cut short, longer, changed or foreign is no file") {
  const fs::path file = fresh_file();
  write_checked(file, some_data());
  const std::string whole = bytes_of(file);
  for (const size_t kept : {size_t{0}, size_t{7}, size_t{24}, whole.size() - 1}) {
    CAPTURE(kept);
    put(file, whole.substr(0, kept));
    CHECK(read_checked(file).empty());
  }
  put(file, whole + "x");
  CHECK(read_checked(file).empty());
  for (size_t at = 0; at < whole.size(); at += 13) {
    CAPTURE(at);
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    put(file, changed);
    CHECK(read_checked(file).empty());
  }
  put(file, whole);
  CHECK(read_checked(file) == some_data());
}

TEST_CASE("where nothing can be written, nothing happens") {
  const fs::path file = fresh_file();
  fs::create_directories(file.parent_path().parent_path());
  put(file.parent_path(), "a file where the folder should be");
  write_checked(file, some_data());
  CHECK(read_checked(file).empty());
}
