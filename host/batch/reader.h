// The steps from an entry of a list to a pair to solve: names and hashes first, then meshes.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "host/answer/asked_pair.h"
#include "host/answer/input_hashes.h"
#include "host/answer/result.h"
#include "host/answer/stop.h"
#include "host/base/made_once.h"
#include "host/batch/list.h"

namespace vkh {

/// An entry, with what is known before its meshes are read.
struct NamedEntry {
  ResultName name;
  std::unique_ptr<AskedPair> pair;  ///< without its meshes; its answer has the inputs' hashes
  bool shares_b = false;
  uint64_t file_bytes = 0;  ///< the size of all files that are read for it alone
};

/// The files that are B in more than one entry: their meshes are kept and prepared.
std::set<std::string> shared_files(const std::vector<Entry>& entries);

/// Threads may share it.
class EntryReader {
 public:
  /// `base`: the request for every pair. `shared`: shared_files() of the whole list, even for a
  /// shard, since answers depend on it. `keep_going`: false ends reading with Interrupted.
  EntryReader(Request base, std::set<std::string> shared, std::function<bool()> keep_going)
      : base_(std::move(base)), shared_(std::move(shared)), keep_going_(std::move(keep_going)) {}

  /// Throws UsageError for an entry's wrong options, and InputError for one without a partner.
  NamedEntry name(const Entry& entry);
  /// Gives a named pair its meshes. Throws what read_mesh and AskedPair::take throw.
  void read(bool shares_b, AskedPair& pair);

 private:
  struct Kept {
    uint64_t last_use = 0, bytes = 0;
  };
  InputHashes hashes_of(const std::string& file, bool is_shared);
  std::shared_ptr<ReadMesh> mesh_of(const std::string& file, const ReadLimits& limits) const;
  ShapedMesh b_of(const Question& question, bool is_shared);
  void note_use(const std::string& key, const std::string& file);

  Request base_;
  std::set<std::string> shared_;
  std::function<bool()> keep_going_;
  MadeOnce<std::string, InputHashes> hashes_;  // of shared files
  MadeOnce<std::string, ShapedMesh> meshes_;   // of shared files
  std::mutex mutex_;                           // guards what follows
  std::map<std::string, Kept> kept_;           // by the keys of meshes_
  uint64_t uses_ = 0;
};

}  // namespace vkh
