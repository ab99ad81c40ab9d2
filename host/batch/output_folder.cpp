#include "host/batch/output_folder.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "host/base/id_hash.h"
#include "host/base/output_file.h"
#include "host/base/system.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

namespace fs = std::filesystem;

constexpr size_t kLongestName = 64;  // with hash and ending far under the 255 of file systems
constexpr std::string_view kMark = "vkhausdorff-of";
constexpr size_t kDigits = 16;

std::string digits_of(uint64_t hash) {
  std::string text(kDigits, '0');
  for (size_t i = kDigits; i-- > 0; hash >>= 4) text[i] = "0123456789abcdef"[hash & 15];
  return text;
}

bool is_small_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }

std::string lowered(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

// Keeps letters, and replaces each run of characters that are not allowed in a name by one _.
std::string cleaned(const std::string& id) {
  std::string name;
  for (const char c : id) {
    if (name.size() == kLongestName) break;
    const bool is_kept = is_small_or_digit(lowered({c})[0]) || c == '-' || c == '_';
    if (is_kept || !name.ends_with('_')) name += is_kept ? c : '_';
  }
  while (name.starts_with('-')) name.erase(0, 1);  // programs would take it for an option
  return name.empty() ? "pair" : name;
}

bool is_device(const std::string& name) {
  constexpr std::array kDevices{"con", "prn", "aux", "nul"};
  const bool is_port = name.starts_with("com") || name.starts_with("lpt");
  const bool is_numbered = is_port && name.size() == 4 && name[3] >= '0' && name[3] <= '9';
  return is_numbered || std::find(kDevices.begin(), kDevices.end(), name) != kDevices.end();
}

bool ends_like_a_hash(const std::string& name) {
  if (name.size() <= kDigits || name[name.size() - kDigits - 1] != '-') return false;
  return std::all_of(name.end() - kDigits, name.end(), is_small_or_digit);
}

uint32_t crc_of(std::string_view bytes) {  // the checksum of PNG's chunks
  uint32_t crc = ~0u;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}

std::string big_endian(uint32_t word) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 255);
  return bytes;
}

// Adds the mark as a text chunk before the last one, which has 12 bytes; or as a comment behind a
// page.
std::string marked(std::string text, const std::string& ending, const std::string& key) {
  constexpr size_t kLastChunk = 12;
  const std::string hash = digits_of(hash_of_id(key));
  if (ending != ".png")
    return text.append("<!-- ").append(kMark).append(" ").append(hash).append(" -->\n");
  const std::string data = std::string(kMark) + '\0' + hash, chunk = "tEXt" + data;
  return text.insert(text.size() - kLastChunk, big_endian(static_cast<uint32_t>(data.size())) +
                                                   chunk + big_endian(crc_of(chunk)));
}

std::string tail_of(const std::string& path) {
  constexpr std::streamoff kTail = 96;
  std::ifstream file(path_of(path), std::ios::binary | std::ios::ate);
  if (!file) return {};
  const std::streamoff size = file.tellg(), count = std::min(size, kTail);
  std::string text(static_cast<size_t>(count), '\0');
  file.seekg(size - count);
  return file.read(text.data(), count) ? text : std::string();
}

}  // namespace

std::string file_stem(const std::string& id) {
  std::string name = cleaned(id);
  const bool is_plain = name == id && name == lowered(name);
  const bool is_other = name == "index" || is_device(name) || name.ends_with("-b");
  if (is_plain && !is_other && !ends_like_a_hash(name)) return name;
  return name + "-" + digits_of(hash_of_id(id));
}

std::string PairFolder::name_of(const std::string& id, bool back) const {
  return file_stem(id) + (back ? "-b" : "") + ending_;
}

std::string PairFolder::path_in(const std::string& name) const {
  return vkh::name_of(path_of(folder_) / path_of(name));
}

void PairFolder::refuse(const std::string& why) const {
  throw UsageError({.option = option_, .file = folder_, .problem = why});
}

void PairFolder::open(const std::vector<std::string>& ids,
                      const std::vector<std::string>& taken) const {
  if (folder_.empty()) refuse("expected the name of a folder");
  const fs::path folder = path_of(folder_);
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) refuse("is a file, no folder");
  fs::create_directories(folder, error);
  if (error) refuse("cannot be made: " + error.message());
  std::set<std::string> names{kIndex};
  for (const std::string& id : ids) {
    for (const bool back : {false, true}) names.insert(lowered(name_of(id, back)));
  }
  check_taken(names, taken);
  (void)OutputFile(option_, path_in(kIndex), {});  // refuses a folder that cannot be written
}

// Refuses a name in the folder, or a link there to elsewhere.
void PairFolder::check_taken(const std::set<std::string>& names,
                             const std::vector<std::string>& taken) const {
  const fs::path folder = place_of(folder_);
  std::set<fs::path> places;
  for (const std::string& file : taken) {
    const fs::path place = place_of(file);
    if (place.parent_path() == folder && names.count(lowered(vkh::name_of(place.filename()))) > 0)
      refuse("would overwrite '" + file + "'");
    places.insert(place);
  }
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_of(folder_), error)) {
    if (!entry.is_symlink(error)) continue;
    const std::string link = vkh::name_of(entry.path());
    const std::string name = lowered(vkh::name_of(entry.path().filename()));
    if (names.count(name) > 0 && places.count(place_of(link)) > 0)
      refuse("would overwrite what '" + link + "' leads to");
  }
}

bool PairFolder::has(const std::string& id, bool back, const std::string& key) const {
  const std::string tail = tail_of(path_in(name_of(id, back)));
  const size_t at = tail.rfind(kMark);
  return at != std::string::npos &&
         tail.compare(at + kMark.size() + 1, kDigits, digits_of(hash_of_id(key))) == 0;
}

void PairFolder::replace(const std::string& name, const std::string& text) const {
  try {
    OutputFile(option_, path_in(name), {}).write(text);
  } catch (const UsageError& error) {  // the folder no longer exists
    throw OutputError(error.parts());
  }
}

void PairFolder::write(const std::string& id, bool back, std::string text,
                       const std::string& key) const {
  replace(name_of(id, back), marked(std::move(text), ending_, key));
}

void PairFolder::write_index(const std::string& page) const { replace(kIndex, page); }

}  // namespace vkh
