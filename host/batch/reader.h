// The steps from an entry of a list to a pair to solve: names and hashes first, then meshes.
#pragma once

#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "host/answer/input_hashes.h"
#include "host/answer/result.h"
#include "host/answer/steps.h"
#include "host/answer/stop.h"
#include "host/batch/list.h"

namespace vkh {

/// The memory per byte of a file, while it is read and as a mesh, about.
constexpr uint64_t kBytesOfAByte = 3;

/// An entry with the facts known before its meshes are read.
struct NamedEntry {
  const Entry* entry = nullptr;
  Question question;
  ResultName name;
  Answer known;             ///< the known answer, with its inputs' hashes
  uint64_t file_bytes = 0;  ///< the size of all files that are read for it alone
};

struct EntryMeshes {
  std::shared_ptr<const ReadMesh> a, b;
  MeshShape shape_b;
  bool shares_b = false;
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
  /// Throws what read_mesh and take_meshes throw. Fills entry.known, unless a fit is asked for.
  EntryMeshes read(NamedEntry& entry);
  /// Lays A onto B, and fills entry.known. `prepared_b`: B on the device, or null. Throws what
  /// fit_a and take_meshes throw.
  static void fit(Solver& solver, const Observer& observer, const PreparedMesh* prepared_b,
                  EntryMeshes& meshes, NamedEntry& entry);

 private:
  /// A mesh of several pairs, and its shape, which is found once.
  struct SharedMesh {
    std::shared_ptr<const ReadMesh> mesh;
    MeshShape shape;
  };
  struct Kept {
    std::shared_future<SharedMesh> mesh;
    uint64_t last_use = 0, bytes = 0;
  };
  static void take(const EntryMeshes& meshes, NamedEntry& entry);
  InputHashes hashes_of(const std::string& file, bool is_shared);
  std::shared_ptr<ReadMesh> mesh_of(const std::string& file, const ReadLimits& limits) const;
  SharedMesh b_of(const Question& question, bool is_shared);
  SharedMesh kept_mesh_of(const std::string& file, const ReadLimits& limits);
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
