// Results of batches, from any number of files, merged: ordered by id, each once.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "host/answer/result.h"

namespace vkh {

/// The line that counts for each id, by its place in its file. Among lines of one file the last one
/// counts: a later run replaces an earlier one with other inputs or options. Among several files'
/// lines with the same key it is the one with the better answer, else the first by its text. Lines
/// of one key answer one question: both intervals are true, or one line is not.
class Results {
 public:
  /// Adds a file's lines; a last one that is not whole is left out. Throws InputError that names
  /// the file and the line or id, if a line is no result, if another file has the id with another
  /// key or a key that does not cover all files that were read, or if intervals of one key do not
  /// meet.
  void add(const std::string& path);

  size_t size() const { return places_.size(); }
  bool has(const std::string& id) const { return places_.count(id) > 0; }
  /// Calls `take` with each line, by id.
  void for_each(const std::function<void(const Result&, const std::string& line)>& take) const;

 private:
  /// An enclosure of a distance.
  struct Bounds {
    double lower = 0, upper = std::numeric_limits<double>::infinity();
    /// Whether both may be true of one distance.
    bool meets(const Bounds& other) const { return lower <= other.upper && other.lower <= upper; }
  };
  struct Place {
    size_t file = 0;
    uint64_t begin = 0, size = 0;
    std::string key;
    ExitCode code = kExitClosed;
    bool is_answer = false, names_files = false;
    std::array<Bounds, 3> bounds;  ///< the whole's, and both directions'
    double width() const { return bounds[0].upper - bounds[0].lower; }
  };
  static Place place_of(const Result& result, size_t file, uint64_t begin, uint64_t size);
  /// Says how a line contradicts an older one of `file`; empty: it does not.
  static std::string contradiction(const Place& place, const Place& older, const std::string& file);
  void check_same(const std::string& id, const Place& older, const Place& place) const;
  void put(const std::map<std::string, Place>& of_file);
  std::string text_of(const Place& place) const;
  bool is_better(const Place& x, const Place& y) const;

  std::vector<std::string> files_;
  std::map<std::string, Place> places_;
};

}  // namespace vkh
