#include "host/batch/reader.h"

#include <algorithm>
#include <utility>

#include "host/answer/one_of_many.h"
#include "host/answer/quantities.h"
#include "host/base/decimal.h"
#include "host/base/system.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/place.h"
#include "vkhausdorff/sha256.h"

namespace vkh {
namespace {

std::string sha256_of_text(const std::string& text) {
  bool is_over = false;
  return sha256_of_pieces([&]() -> std::string_view {
    return std::exchange(is_over, true) ? std::string_view() : std::string_view(text);
  });
}

// Joins names and hashes: names hold no line's end (files_beneath), and counts mark where a list
// ends.
std::string hashes_in_text(const Input& input) {
  std::string text = input.sha256 + '\n' + std::to_string(input.files.size());
  for (const FileHash& file : input.files) text += '\n' + file.path + '\n' + file.sha256;
  return text;
}

// Hashes all that an answer depends on, except for the device.
std::string key_of(Request asked, const Answer& known, bool shares_b) {
  std::string text = program_version();
  for (const Input& input : known.inputs) text += '\n' + hashes_in_text(input);
  text += shares_b ? "\nprepared" : "";
  return sha256_of_text(text + key_text(std::move(asked)));
}

/// Replaces the batch's options by the ones that a row gives.
void put_row(const Entry& entry, Request& asked) {
  for (const auto& [option, text] : entry.options)
    put(*option, {column_name(*option), std::span(&text, 1)}, asked);
  Question& question = asked.question;
  if (!asked.has("tol")) question.tolerance = default_tolerance(question.max.has_value());
  if (!question.transform_file.empty())
    question.transform = read_matrix(path_of(question.transform_file));
  question.statistics = question.is_signed;
}

}  // namespace

std::set<std::string> shared_files(const std::vector<Entry>& entries) {
  std::set<std::string> once, more;
  for (const Entry& entry : entries) {
    const bool has_b = !entry.file_b.empty();
    if (has_b && !once.insert(entry.file_b).second) more.insert(entry.file_b);
  }
  return more;
}

InputHashes EntryReader::hashes_of(const std::string& file, bool is_shared) {
  ReadLimits limits = base_.question.limits;
  limits.keep_going = keep_going_;
  const auto made = [&] { return hashes_of_input(file, limits); };
  return is_shared ? hashes_.get(file, made) : made();
}

NamedEntry EntryReader::name(const Entry& entry) {
  if (!entry.missing.empty())
    throw InputError({.file = entry.one_file(), .problem = entry.missing});
  Request asked = base_;
  put_row(entry, asked);
  Question question = asked.question;
  question.file_a = entry.file_a;
  question.file_b = entry.file_b;
  NamedEntry named{.name = {entry.id, ""},
                   .pair = std::make_unique<AskedPair>(std::move(question)),
                   .shares_b = shared_.count(entry.file_b) > 0};
  for (size_t i = 0; i < 2; ++i) {
    const bool is_shared = i == 1 && named.shares_b;
    InputHashes hashes = hashes_of(i == 0 ? entry.file_a : entry.file_b, is_shared);
    if (!is_shared) named.file_bytes += hashes.bytes;
    named.pair->name(i, i == 0 ? entry.a : entry.b, std::move(hashes));
  }
  named.name.key = key_of(std::move(asked), named.pair->answer(), named.shares_b);
  return named;
}

std::shared_ptr<ReadMesh> EntryReader::mesh_of(const std::string& file,
                                               const ReadLimits& limits) const {
  ReadLimits of_this = limits;
  of_this.keep_going = keep_going_;
  return std::make_shared<ReadMesh>(read_one_of_many(file, of_this));
}

// Keeps the meshes used last, so that a list that alternates between two B's reads each once.
void EntryReader::note_use(const std::string& key, const std::string& file) {
  constexpr size_t kMost = 256;  // as many as are kept prepared
  constexpr uint64_t kMostBytes = uint64_t{1} << 29;
  const std::lock_guard lock(mutex_);
  kept_[key] = {.last_use = ++uses_, .bytes = kBytesOfAByte * file_bytes(path_of(file))};
  uint64_t bytes = 0;
  for (const auto& [name, kept] : kept_) bytes += kept.bytes;
  while (kept_.size() > 1 && (kept_.size() > kMost || bytes > kMostBytes)) {
    const auto oldest = std::min_element(
        kept_.begin(), kept_.end(),
        [](const auto& x, const auto& y) { return x.second.last_use < y.second.last_use; });
    bytes -= oldest->second.bytes;
    meshes_.forget(oldest->first);
    kept_.erase(oldest);
  }
}

ShapedMesh EntryReader::b_of(const Question& question, bool is_shared) {
  const ReadLimits limits = question.limits_of(true);
  const auto made = [&] { return shaped(mesh_of(question.file_b, limits)); };
  if (!is_shared) return made();
  const std::string key = (limits.points ? "points " : "mesh ") + question.file_b;
  note_use(key, question.file_b);
  return meshes_.get(key, made);
}

void EntryReader::read(bool shares_b, AskedPair& pair) {
  const auto start = Clock::now();
  const Question& question = pair.question();
  std::shared_ptr<ReadMesh> a = mesh_of(question.file_a, question.limits_of(false));
  pair.take(std::move(a), b_of(question, shares_b));
  pair.answer().waits.read = 1000 * seconds_since(start);
}

}  // namespace vkh
