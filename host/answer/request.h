// The request to a command, as its options fill it in: options_table.h has a row for each option.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "vkhausdorff/question.h"

namespace vkh {

/// A set of commands, one bit each; a call from Python is one, too.
using Commands = uint32_t;
constexpr Commands kDistance = 1, kGate = 2, kMetrics = 4, kBatch = 8, kMerge = 16, kSimplify = 32,
                   kDemo = 64, kDoctor = 128, kPython = 256;

/// The look of pictures, as it was typed; style_of() of host/show reads it.
struct Look {
  std::string view = "iso", up = "z";
  std::optional<std::string> size, map;
  std::optional<std::array<Length, 2>> range;  ///< the ends of the colours
  uint64_t steps = 0;                          ///< of colour; 0: smooth
};

/// The outputs of an answer other than the table.
struct Outputs {
  bool json = false;  ///< one object on standard output instead of the table
  std::string out;    ///< the results of many pairs, or the mesh of fewer faces
  std::optional<std::string> json_file, junit, csv, transform;
  bool github = false;  ///< annotations and a summary for GitHub Actions
  std::optional<std::string> field, image, report, certificate, figures, points;
  std::string title;  ///< the report's heading; empty: the names of the files
  Look look;

  bool shows_cells() const { return field || image || report || figures || points; }
  bool has_pictures() const { return shows_cells() || certificate; }
};

/// The options of many pairs, in addition to the question about each.
struct ManyRequest {
  std::vector<std::string> files;  ///< as they were named: a list, folders, meshes or results
  std::string against;             ///< one B for each of `files`; empty: they name pairs
  bool allows_unpaired = false;    ///< a file without a partner there is no failure
  std::string list;                ///< merge: the list whose ids must be there; empty: no check
  std::optional<std::string> image_folder, report_folder;
  PartOf shard;
  bool resumes = false, fails_fast = false;
  bool reproducible = false;         ///< leaves out what differs between two runs
  uint64_t together = 0, lanes = 0;  ///< StreamOptions' of these names; 0: what pays
  uint64_t read_ahead_bytes = 0;
};

/// The options of `simplify`, in addition to the question about its mesh.
struct SimplifyRequest {
  bool one_way = false, lock_borders = false;
  uint64_t levels = 0;  ///< 0: one mesh, as few faces as are found
  double ratio = 0.5;
};

struct Request {
  Commands command = 0;  ///< one of them
  Question question;
  bool metrics = false;  ///< Question::metrics is wanted, with these
  MetricsOptions metric_options;
  Outputs outputs;
  ManyRequest many;
  SimplifyRequest simplify;

  std::set<std::string_view> given;  ///< names of the options that were given
  bool has(std::string_view option) const { return given.count(option) > 0; }
};

}  // namespace vkh
