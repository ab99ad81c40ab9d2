// The drawings of a batch: a picture and a report per pair, in folders with an index page each.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "host/batch/output_folder.h"
#include "host/batch/reader.h"
#include "host/show/draw_answer.h"
#include "vkhausdorff/solver.h"

namespace vkh {

/// A pair whose run has ended, on the thread that ran it.
struct EndedPair {
  const ResultName& name;
  const AskedPair& pair;
  Solver& solver;
  std::function<bool()> goes_on;  ///< false: the drawing is to end
};

/// Threads may share it.
class BatchFolders {
 public:
  /// Makes the folders. Throws UsageError if one cannot be written, or if a file in it would
  /// replace one that is `taken`.
  BatchFolders(const Request& asked, const std::vector<Entry>& entries,
               const std::vector<std::string>& taken);

  /// Whether files of this answer, drawn as requested, exist from before.
  bool has(const ResultName& name, bool symmetric) const;

  /// Adds to the question what the files show of a pair.
  void ask(Question& question) const;

  /// Surveys the pair, unless its answer has a survey with what ask() asked for. Writes its files,
  /// one pair at a time on a thread. Never throws, so that a picture cannot cost an answer.
  void draw(const EndedPair& ended) noexcept;

  /// Writes an index per folder, one for both if they are one, of all pairs in the results `file`.
  /// Throws OutputError.
  void write_indexes(const std::string& file, const std::vector<Entry>& entries,
                     bool has_limit) const;
  std::vector<std::string> indexes() const;  ///< the indexes' file names

  /// The reasons why files were not written, one line per pair.
  std::vector<std::string> failures() const;
  /// The number of pairs without all their files because the batch ended first.
  size_t left() const;

 private:
  std::string key_of(const ResultName& name) const;
  void write(const EndedPair& ended) const;

  PictureStyle style_;
  std::optional<uint64_t> effort_;      // SurveyOptions::effort
  std::optional<Length> max_distance_;  // Question::max_distance of what is drawn
  std::optional<PairFolder> images_, reports_;
  bool are_one_ = false;
  mutable std::mutex mutex_;
  std::vector<std::string> failures_;
  size_t left_ = 0;
};

}  // namespace vkh
