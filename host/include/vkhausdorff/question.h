// The question about a pair of meshes, before any file or device is touched. The command line, a
// row of a list and Python fill it in; the program turns it into an answer by the steps of Asking.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "vkhausdorff/device_description.h"
#include "vkhausdorff/engine_options.h"
#include "vkhausdorff/length.h"
#include "vkhausdorff/limit.h"
#include "vkhausdorff/mesh_transform.h"
#include "vkhausdorff/metrics.h"
#include "vkhausdorff/read_limits.h"

namespace vkh {

/// The part of A's faces that an answer covers: `index` from 0. It never passes for the whole.
struct PartOf {
  uint64_t index = 0, count = 1;
};

/// Limits of points over B, in front of its faces, and of points under it.
struct SidedMax {
  Length over, under;
};

/// The most that an answer may cost, without the cost of reading files.
struct Budget {
  double time_limit_s = std::numeric_limits<double>::infinity();  ///< for all work
  std::optional<double> survey_time_s;  ///< the time of each survey; none: as the rest
  std::optional<uint64_t> effort;       ///< SurveyOptions::effort
  uint32_t wave_limit = std::numeric_limits<uint32_t>::max();
  uint64_t memory_bytes = 0;  ///< SolveOptions::memory_bytes
};

/// Answer repeats these members of its question.
struct Stated {
  std::string command;             ///< "distance", "gate", "metrics" or "demo"
  std::vector<std::string> words;  ///< those typed after the program's name; empty: none were
  Length tolerance{.requested = "1e-6", .number = 1e-6};  ///< a fraction is of A's diagonal
  std::optional<PartOf> part;  ///< the part of A that is asked about, alone, in one direction
};

struct Question : Stated {
  // The meshes.
  std::string file_a, file_b;  ///< both empty: the built-in pair
  std::string unit;            ///< the unit of files that do not name one; empty: unknown
  std::string unit_a, unit_b;  ///< the same for one of them, in place of `unit`
  std::string transform_file;  ///< a file with the matrix by which A is placed; empty: none
  std::optional<MatrixRows> transform;      ///< the matrix itself, if it was read before
  bool may_stretch = false;                 ///< the matrix may be any that does not mirror
  bool align = false;                       ///< A is then laid onto B by a fit: fit_a()
  ReadLimits limits;                        ///< all but the callbacks, and `points`: limits_of()
  bool points_a = false, points_b = false;  ///< ReadLimits::points of each
  bool hashes = false;                      ///< Input::sha256 is wanted

  // The distance.
  bool symmetric = false;             ///< both directions
  std::optional<Length> known_lower;  ///< the bound that other parts have shown

  // A limit.
  std::optional<Length> max;
  std::optional<SidedMax> max_sides;   ///< in place of `max`, which is then either of them
  std::string face_max_a, face_max_b;  ///< files with limits per face; empty: none
  std::optional<std::vector<Limit>>
      face_limits_a;           ///< limits of A's faces; none: those of the file
  std::optional<double> area;  ///< the share of A's area that has to be within `max`
  std::string area_requested;  ///< the share as the user typed it
  bool worst = false;          ///< a limit that is failed goes on to the worst point

  // Results about all of A, in addition to its distance.
  bool faces = false;                    ///< bounds of each face: for a picture, or a file
  std::optional<Length> face_tolerance;  ///< the width of those
  bool statistics = false;
  bool is_signed = false;              ///< the sides of B on which A lies
  std::vector<Length> bands;           ///< shares of A's area within these distances
  std::optional<Length> max_distance;  ///< figures leave out what is farther; none: nothing
  /// Answer::metrics is wanted, of both directions; of percentiles, theirs alone is sought.
  std::optional<MetricsOptions> metrics;
  double map_pixels = 0;  ///< MapOptions::pixels of a map of A by cells; 0: none
  /// The ends of the map's colours; none: the limit decides, or the map.
  std::optional<std::array<Length, 2>> map_range;
  bool map_sides = false;    ///< MapOptions::sides_if_cheap
  bool certificate = false;  ///< Answer::proof_a is wanted
  bool verify = false;       ///< the host checks the answer

  // The cost, and the devices.
  Budget budget;
  EngineOptions engine;
  std::string device;            ///< DeviceRequest::selector, or kNative
  bool several_devices = false;  ///< allows several, such as "0,1" or "all"
  uint64_t threads = 0;          ///< of kNative; 0: one for each core
  bool caches = true;            ///< keeps compiled pipelines in the user's folder
  bool verbose = false;          ///< the progress line has words of the method, too

  ReadLimits limits_of(bool is_b) const {
    ReadLimits own = limits;
    own.points = is_b ? points_b : points_a;
    return own;
  }
  bool is_native() const { return device == kNative; }
  bool is_by_face() const { return !face_max_a.empty() || !face_max_b.empty() || face_limits_a; }
  bool asks_for_sides() const { return is_signed || max_sides; }
  bool asks_for_survey() const {
    return faces || statistics || metrics || !bands.empty() || area || map_pixels > 0 ||
           asks_for_sides();
  }
  /// An option's name in messages: --max-distance where the question was typed on a command line,
  /// max_distance elsewhere.
  std::string option(const char* name) const {
    std::string text = name;
    if (words.empty()) std::replace(text.begin(), text.end(), '-', '_');
    return words.empty() ? text : "--" + text;
  }
  bool asks_for_cells() const { return certificate || asks_for_survey(); }
};

}  // namespace vkh
