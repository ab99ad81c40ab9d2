// The steps from an entry of a list to a pair to solve: names and hashes first, then meshes.
#pragma once

#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "host/answer/asked_pair.h"
#include "host/answer/input_hashes.h"
#include "host/answer/result.h"
#include "host/answer/stop.h"
#include "host/batch/list.h"

namespace vkh {

/// The memory per byte of a file, while it is read and as a mesh, about.
constexpr uint64_t kBytesOfAByte = 3;

/// An entry with the facts known before its meshes are read.
struct NamedEntry {
  ResultName name;
  std::unique_ptr<AskedPair> pair;  ///< without its meshes; its answer has the inputs' hashes
  bool shares_b = false;
  uint64_t file_bytes = 0;  ///< the size of all files that are read for it alone
};

/// The files that lists name as B more than once: their meshes are kept for each other, and
/// prepared.
std::set<std::string> shared_files(const std::vector<Entry>& entries);

/// Threads may share it.
class EntryReader {
 public:
  /// `base`: what is asked of every pair. `shared`: the files of the whole list, whatever the
  /// shard, since answers depend on it. `keep_going`: false ends reading with Interrupted.
  EntryReader(Request base, std::set<std::string> shared, std::function<bool()> keep_going)
      : base_(std::move(base)), shared_(std::move(shared)), keep_going_(std::move(keep_going)) {}

  /// Throws UsageError for an entry's wrong options, and InputError for one without a partner.
  NamedEntry name(const Entry& entry);
  /// Gives a named pair its meshes. Throws what read_mesh and AskedPair::take throw.
  void read(bool shares_b, AskedPair& pair);

 private:
  struct Kept {
    std::shared_future<ShapedMesh> mesh;
    uint64_t last_use = 0, bytes = 0;
  };
  InputHashes hashes_of(const std::string& file, bool is_shared);
  std::shared_ptr<ReadMesh> mesh_of(const std::string& file, const ReadLimits& limits) const;
  ShapedMesh b_of(const Question& question, bool is_shared);
  ShapedMesh kept_mesh_of(const std::string& file, const ReadLimits& limits);
  void drop_old();

  Request base_;
  std::set<std::string> shared_;
  std::function<bool()> keep_going_;
  std::mutex mutex_;
  std::map<std::string, std::shared_future<InputHashes>> hashes_;  // the hashes of shared files
  std::map<std::string, Kept> meshes_;                             // the meshes of shared files
  uint64_t uses_ = 0;
};

}  // namespace vkh
