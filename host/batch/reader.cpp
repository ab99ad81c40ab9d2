#include "host/batch/reader.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "host/answer/quantities.h"
#include "host/base/decimal.h"
#include "host/base/system.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/place.h"
#include "vkhausdorff/sha256.h"

namespace vkh {
namespace {

uint64_t size_of(const std::string& file) {
  std::error_code none;
  const uintmax_t size = std::filesystem::file_size(path_of(file), none);
  return none ? 0 : size;
}

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

/// Puts what a row asks for itself in place of the batch's.
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

// A thread that requests a file that another thread reads waits for it.
InputHashes EntryReader::hashes_of(const std::string& file, bool is_shared) {
  ReadLimits limits = base_.question.limits;
  limits.keep_going = keep_going_;
  if (!is_shared) return hashes_of_input(file, limits);
  std::promise<InputHashes> mine;
  std::shared_future<InputHashes> theirs;
  {
    const std::lock_guard lock(mutex_);
    const auto [known, is_new] = hashes_.try_emplace(file);
    if (is_new) known->second = mine.get_future().share();
    if (!is_new) theirs = known->second;
  }
  if (theirs.valid()) return theirs.get();
  try {
    InputHashes hashes = hashes_of_input(file, limits);
    mine.set_value(hashes);
    return hashes;
  } catch (...) {
    mine.set_exception(std::current_exception());
    throw;
  }
}

NamedEntry EntryReader::name(const Entry& entry) {
  if (!entry.missing.empty())
    throw InputError({.file = entry.one_file(), .problem = entry.missing});
  NamedEntry named;
  named.entry = &entry;
  Request asked = base_;
  put_row(entry, asked);
  Question& question = named.question = asked.question;
  question.file_a = entry.file_a;
  question.file_b = entry.file_b;
  named.known = unread_answer(question);
  const bool shares_b = shared_.count(entry.file_b) > 0;
  named.known.inputs[0].path = entry.a;
  named.known.inputs[1].path = entry.b;
  for (size_t i = 0; i < named.known.inputs.size(); ++i) {
    const bool is_shared = i == 1 && shares_b;
    InputHashes hashes = hashes_of(i == 0 ? entry.file_a : entry.file_b, is_shared);
    named.known.inputs[i].sha256 = std::move(hashes.sha256);
    named.known.inputs[i].files = std::move(hashes.files);
    if (!is_shared) named.file_bytes += hashes.bytes;
  }
  named.name = {entry.id, key_of(std::move(asked), named.known, shares_b)};
  return named;
}

std::shared_ptr<ReadMesh> EntryReader::mesh_of(const std::string& file,
                                               const ReadLimits& limits) const {
  constexpr uint64_t kLarge = uint64_t{1} << 25;  // smaller ones are read one per thread
  ReadLimits of_this = limits;
  of_this.keep_going = keep_going_;
  of_this.threads = size_of(file) < kLarge ? 1 : 0;
  return std::make_shared<ReadMesh>(read_mesh(path_of(file), of_this));
}

// Keeps those used last, so that a list that goes back and forth between two B's reads each once.
void EntryReader::drop_old() {
  constexpr size_t kMost = 256;  // as many as are kept prepared
  constexpr uint64_t kMostBytes = uint64_t{1} << 29;
  uint64_t bytes = 0;
  for (const auto& [file, kept] : meshes_) bytes += kept.bytes;
  while (meshes_.size() > 1 && (meshes_.size() > kMost || bytes > kMostBytes)) {
    const auto oldest = std::min_element(
        meshes_.begin(), meshes_.end(),
        [](const auto& x, const auto& y) { return x.second.last_use < y.second.last_use; });
    bytes -= oldest->second.bytes;
    meshes_.erase(oldest);
  }
}

EntryReader::SharedMesh EntryReader::kept_mesh_of(const std::string& file,
                                                  const ReadLimits& limits) {
  std::promise<SharedMesh> mine;
  std::shared_future<SharedMesh> theirs;
  {
    const std::lock_guard lock(mutex_);
    const auto [known, is_new] = meshes_.try_emplace((limits.points ? "points " : "mesh ") + file);
    known->second.last_use = ++uses_;
    if (is_new) known->second.mesh = mine.get_future().share();
    if (is_new) known->second.bytes = kBytesOfAByte * size_of(file);
    if (!is_new) theirs = known->second.mesh;
    if (is_new) drop_old();
  }
  if (theirs.valid()) return theirs.get();
  try {
    const std::shared_ptr<const ReadMesh> mesh = mesh_of(file, limits);
    SharedMesh made{mesh, shape_of(*mesh)};
    mine.set_value(made);
    return made;
  } catch (...) {
    mine.set_exception(std::current_exception());
    throw;
  }
}

EntryReader::SharedMesh EntryReader::b_of(const Question& question, bool is_shared) {
  if (is_shared) return kept_mesh_of(question.file_b, question.limits_of(true));
  const std::shared_ptr<const ReadMesh> mesh = mesh_of(question.file_b, question.limits_of(true));
  return {mesh, shape_of(*mesh)};
}

EntryMeshes EntryReader::read(NamedEntry& entry) {
  const auto start = Clock::now();
  EntryMeshes meshes;
  meshes.shares_b = shared_.count(entry.question.file_b) > 0;
  const std::shared_ptr<ReadMesh> a =
      mesh_of(entry.question.file_a, entry.question.limits_of(false));
  const SharedMesh b = b_of(entry.question, meshes.shares_b);
  meshes.b = b.mesh;
  place_a(entry.question, *a, *meshes.b);
  meshes.a = a;
  meshes.shape_b = b.shape;
  check_sides(entry.question, *meshes.a, *meshes.b);
  if (!entry.question.align) take(meshes, entry);
  entry.known.waits.read = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return meshes;
}

void EntryReader::fit(Solver& solver, const Observer& observer, const PreparedMesh* prepared_b,
                      EntryMeshes& meshes, NamedEntry& entry) {
  const auto start = Clock::now();
  auto moved = std::make_shared<ReadMesh>(*meshes.a);
  fit_a(entry.question, solver, observer, {*moved, *meshes.b, prepared_b});
  meshes.a = std::move(moved);
  const double read_ms = entry.known.waits.read;
  take(meshes, entry);
  entry.known.waits.read =
      read_ms + std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void EntryReader::take(const EntryMeshes& meshes, NamedEntry& entry) {
  Answer known = entry.known;  // a copy: an unresolved length must not cost the hashes
  take_meshes(entry.question, {*meshes.a, shape_of(*meshes.a)}, {*meshes.b, meshes.shape_b}, known);
  for (size_t i = 0; i < known.inputs.size(); ++i) {
    known.inputs[i].path = entry.known.inputs[i].path;
    known.inputs[i].sha256 = entry.known.inputs[i].sha256;
    known.inputs[i].files = entry.known.inputs[i].files;
  }
  entry.known = std::move(known);
}

}  // namespace vkh
