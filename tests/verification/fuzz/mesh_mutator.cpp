#include "tests/verification/fuzz/mesh_mutator.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tests/verification/fuzz/fuzz_target.h"

namespace vkh::test {
namespace {

using Random = std::minstd_rand;

size_t pick(Random& random, size_t count) { return static_cast<size_t>(random()) / 7 % count; }

size_t give_back(const std::string& text, uint8_t* data, size_t max_size) {
  const size_t size = std::min(text.size(), max_size);
  std::memcpy(data, text.data(), size);
  return size;
}

/// One of libFuzzer's own changes.
std::string changed(std::string_view part, size_t room) {
  std::vector<uint8_t> bytes(part.begin(), part.end());
  const size_t most = part.size() + room;
  bytes.resize(std::max<size_t>(most, 1));
  bytes.resize(LLVMFuzzerMutate(bytes.data(), part.size(), bytes.size()));
  return {bytes.begin(), bytes.end()};
}

/// The lines with their ends, as views of the text.
std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  lines.reserve(64);
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size() - 1);
    lines.push_back(text.substr(at, end + 1 - at));
    at = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<std::string_view>& lines) {
  std::string text;
  text.reserve(4096);
  for (const std::string_view line : lines) text += line;
  return text;
}

const char* odd_number(Random& random) {
  static constexpr std::array<const char*, 24> kNumbers = {
      "0",          "-0",         "1",     "-1",       "2",          "3",
      "4",          "255",        "256",   "65536",    "2147483647", "2147483648",
      "4294967295", "4294967296", "1e308", "-1.8e308", "5e-324",     "1e-400",
      "3.5e38",     "1e400",      "nan",   "0x1p3",    "+7",         "9223372036854775808"};
  return kNumbers[pick(random, kNumbers.size())];
}

std::string with_number(std::string_view line, Random& random) {
  constexpr std::string_view digits = "+-.0123456789eE";
  std::vector<size_t> starts;
  for (size_t at = line.find_first_of(digits); at < line.size();) {
    starts.push_back(at);
    at = line.find_first_of(digits, std::min(line.find_first_not_of(digits, at), line.size()));
  }
  if (starts.empty()) return std::string(line);
  const size_t at = starts[pick(random, starts.size())];
  const size_t end = std::min(line.find_first_not_of(digits, at), line.size());
  return std::string(line.substr(0, at)) + odd_number(random) + std::string(line.substr(end));
}

std::string mutated_lines(std::string_view text, size_t room, Random& random) {
  std::vector<std::string_view> lines = lines_of(text);
  std::string line;  // outlives its view
  if (lines.empty()) return changed(text, room);
  const size_t i = pick(random, lines.size()), j = pick(random, lines.size());
  switch (pick(random, 8)) {
    case 0:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(i), lines[j]);
      break;
    case 1:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    case 2:
      std::swap(lines[i], lines[j]);
      break;
    case 3:
    case 4:
      lines[i] = line = with_number(lines[i], random);
      break;
    case 5:
      lines[i] = line = changed(lines[i], room);
      break;
    default:
      return changed(text, room);
  }
  return joined(lines);
}

/// Gives the first line that begins so this number as its last word, or as the one after `before`.
void set_count(std::string& header, std::string_view before, size_t count) {
  const size_t at = header.find(before);
  if (at == std::string::npos) return;
  const size_t begin = at + before.size();
  const size_t end = std::min(header.find_first_not_of("0123456789", begin), header.size());
  header.replace(begin, end - begin, std::to_string(count));
}

size_t rows_of(std::string_view body) {
  return static_cast<size_t>(std::count(body.begin(), body.end(), '\n'));
}

/// Vertices first, faces after them, as most files have it.
void fit_text_counts(std::string& header, const std::string& body, Random& random) {
  const size_t rows = rows_of(body), vertices = pick(random, rows + 1);
  if (pick(random, 2) == 0) return;
  set_count(header, "element vertex ", vertices);
  set_count(header, "element face ", rows - vertices);
}

std::string mutated_ply(std::string_view text, size_t room, Random& random) {
  constexpr std::string_view kEnd = "end_header\n";
  const size_t end = text.find(kEnd);
  if (end == std::string::npos || pick(random, 16) == 0) return mutated_lines(text, room, random);
  const size_t split = end + kEnd.size();
  std::string header(text.substr(0, split)), body(text.substr(split));
  const bool is_text = header.find("format ascii") != std::string::npos;
  if (pick(random, 4) == 0) {
    header = mutated_lines(header, room, random);
  } else {
    body = is_text ? mutated_lines(body, room, random) : changed(body, room);
  }
  if (is_text) {
    fit_text_counts(header, body, random);
  } else if (pick(random, 4) == 0) {
    set_count(header, "element face ", pick(random, body.size() / 4 + 2));
  } else if (pick(random, 4) == 0) {
    set_count(header, "element vertex ", pick(random, body.size() / 3 + 2));
  }
  return header + body;
}

std::string mutated_bytes(std::string_view bytes, size_t room, Random& /*random*/) {
  return changed(bytes, room);
}

/// A member and its comma, or an object, moved, doubled or taken out.
std::string with_part_moved(std::string_view text, Random& random) {
  const size_t from = text.find_first_of(",{[", pick(random, text.size()));
  if (from == std::string_view::npos) return std::string(text);
  const size_t end = std::min(text.find_first_of(",}]", from + 1), text.size());
  const std::string part(text.substr(from, end - from));
  std::string out(text);
  if (pick(random, 2) == 0) out.erase(from, end - from);
  if (pick(random, 3) == 0) return out;
  const size_t to = std::min(out.find_first_of(",}]", pick(random, out.size() + 1)), out.size());
  return out.insert(to, part);
}

std::string mutated_json(std::string_view text, size_t room, Random& random) {
  switch (text.empty() ? 7 : pick(random, 8)) {
    case 0:
    case 1:
    case 2:
    case 3:
      return with_number(text, random);
    case 4:
    case 5:
      return with_part_moved(text, random);
    default:
      return changed(text, room);
  }
}

std::string mutated_xml(std::string_view text, size_t room, Random& random) {
  if (text.empty() || pick(random, 4) == 0) return changed(text, room);
  if (pick(random, 2) == 0) return with_number(text, random);
  const size_t from = text.find('<', pick(random, text.size()));
  if (from == std::string_view::npos) return std::string(text);
  const size_t end = std::min(text.find('>', from), text.size() - 1) + 1;
  const std::string part(text.substr(from, end - from));
  std::string out(text);
  if (pick(random, 2) == 0) out.erase(from, end - from);
  if (pick(random, 3) == 0) return out;
  return out.insert(std::min(out.find('<', pick(random, out.size() + 1)), out.size()), part);
}

std::string word_of(size_t x) {
  std::string word(4, '\0');
  for (size_t i = 0; i < 4; ++i) word[i] = static_cast<char>(x >> (8 * i) & 0xff);
  return word;
}

std::string mutated_glb(std::string_view text, size_t room, Random& random) {
  constexpr size_t kBefore = 20;
  const size_t end = text.rfind('}');
  if (text.size() < kBefore || end == std::string_view::npos || end < kBefore ||
      pick(random, 16) == 0) {
    return changed(text, room);
  }
  std::string json(text.substr(kBefore, end + 1 - kBefore));
  std::string binary(text.substr(std::min(end + 9, text.size())));
  if (pick(random, 3) == 0) {
    binary = changed(binary, room);
  } else {
    json = mutated_json(json, room, random);
  }
  return "glTF" + word_of(2) + word_of(kBefore + json.size() + 8 + binary.size()) +
         word_of(json.size()) + "JSON" + json + word_of(binary.size()) + std::string("BIN\0", 4) +
         binary;
}

std::string mutated_off(std::string_view text, size_t room, Random& random) {
  std::string out = mutated_lines(text, room, random);
  const size_t begin = out.find('\n') + 1, rows = rows_of(out);
  if (begin == 0 || rows < 3 || pick(random, 2) == 0) return out;
  const size_t vertices = pick(random, rows - 1);
  const std::string counts = std::to_string(vertices) + " " + std::to_string(rows - 2 - vertices);
  return out.replace(begin, std::min(out.find('\n', begin), out.size()) - begin, counts + " 0");
}

std::string mutated_stl(std::string_view text, size_t room, Random& random) {
  constexpr size_t kHeader = 84, kTriangle = 50;
  std::string out = changed(text, room);
  if (out.size() < kHeader || pick(random, 4) == 0) return out;
  const auto count = static_cast<uint32_t>((out.size() - kHeader) / kTriangle);
  if (pick(random, 2) == 0) out.resize(kHeader + kTriangle * size_t{count});
  std::memcpy(out.data() + kHeader - 4, &count, sizeof(count));
  return out;
}

std::string mutated_las(std::string_view text, size_t room, Random& random) {
  constexpr size_t kOldCount = 107, kCount = 247, kHeader = 227, kHeader14 = 375;
  std::string out = changed(text, room);
  if (out.size() < kHeader || pick(random, 4) == 0) return out;
  uint32_t begin = 0;
  uint16_t record = 0;
  std::memcpy(&begin, out.data() + 96, sizeof(begin));
  std::memcpy(&record, out.data() + 105, sizeof(record));
  if (record == 0 || begin > out.size()) return out;
  const uint64_t count = (out.size() - begin) / record;
  const auto old_count = static_cast<uint32_t>(count);
  std::memcpy(out.data() + kOldCount, &old_count, sizeof(old_count));
  if (out[25] == 4 && out.size() >= kHeader14)
    std::memcpy(out.data() + kCount, &count, sizeof(count));
  return out;
}

using MutateText = std::string (*)(std::string_view, size_t, Random&);

size_t mutate(MutateText with, uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  Random random(seed % 0x7ffffffe + 1);
  std::string text(reinterpret_cast<const char*>(data), size);
  // Makes some changes at once: one change of a header alone is mostly refused.
  for (size_t left = 1 + pick(random, 3); left > 0; --left)
    text = with(text, max_size > text.size() ? max_size - text.size() : 0, random);
  return give_back(text, data, max_size);
}

}  // namespace

size_t mutate_text(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return mutate(mutated_lines, data, size, max_size, seed);
}

size_t mutate_off(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return mutate(mutated_off, data, size, max_size, seed);
}

size_t mutate_ply(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return mutate(mutated_ply, data, size, max_size, seed);
}

size_t mutate_stl(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return mutate(mutated_stl, data, size, max_size, seed);
}

size_t mutate_las(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return mutate(mutated_las, data, size, max_size, seed);
}

size_t mutate_gltf(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return mutate(mutated_json, data, size, max_size, seed);
}

size_t mutate_glb(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return mutate(mutated_glb, data, size, max_size, seed);
}

size_t mutate_xml(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return mutate(mutated_xml, data, size, max_size, seed);
}

size_t mutate_any(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (text.starts_with("ply")) return mutate_ply(data, size, max_size, seed);
  if (text.starts_with("{")) return mutate_gltf(data, size, max_size, seed);
  if (text.starts_with("PK")) return mutate(mutated_bytes, data, size, max_size, seed);
  if (text.starts_with("LASF")) return mutate_las(data, size, max_size, seed);
  if (text.starts_with("glTF")) return mutate_glb(data, size, max_size, seed);
  if (text.find("OFF") < 8) return mutate_off(data, size, max_size, seed);
  if (text.find('\0') != std::string_view::npos) return mutate_stl(data, size, max_size, seed);
  return mutate_text(data, size, max_size, seed);
}

}  // namespace vkh::test
