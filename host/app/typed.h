// The options of commands about pairs, and their typed values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/app/arguments.h"
#include "host/app/picture_options.h"

namespace CLI {
class App;
}

namespace vkh {

/// The options as the user typed them.
struct Typed {
  std::string file_a, file_b;
  std::string tolerance, max, face_max_a, face_max_b, unit, unit_a, unit_b, transform, device;
  std::string saved_transform;
  std::optional<std::string> memory, time, waves, effort, max_input, part, known_lower;
  std::vector<std::string> enabled, disabled;
  std::string preset, polygons, bodies, points;
  std::string json, junit, area, field_tolerance, max_distance;
  TypedPictures pictures;
  std::vector<std::string> bands;
  std::string percentile;            ///< of metrics
  std::vector<std::string> figures;  ///< of metrics
  std::string normals;               ///< of metrics
  bool metrics = false;              ///< both directions' figures by name
  bool may_stretch = false;          ///< --scale
  bool align = false;
  bool worst = false;
  bool github = false, verbose = false, symmetric = false, verify = false, no_cache = false,
       statistics = false, is_signed = false;
};

/// The forms of a length, for help.
extern const char* const kLengths;

// Adds options that commands share. `typed` must outlive `command`.
void add_pair(CLI::App& command, Typed& typed);
void add_unit_and_input(CLI::App& command, Typed& typed);
void add_input_options(CLI::App& command, Typed& typed);  ///< how files are read
void add_placement(CLI::App& command, Typed& typed);      ///< units of each side, a matrix, a fit
void add_saved_transform(CLI::App& command, Typed& typed);
void add_tolerance(CLI::App& command, Typed& typed, const char* by_default);
void add_symmetric(CLI::App& command, Typed& typed);
void add_part(CLI::App& command, Typed& typed);
void add_device_option(CLI::App& command, Typed& typed);
void add_time_option(CLI::App& command, Typed& typed);
void add_engine_options(CLI::App& command, Typed& typed);  ///< memory, waves, switches, cache
void add_search_options(CLI::App& command, Typed& typed);  ///< device, time and engine options
void add_survey_options(CLI::App& command, Typed& typed);
void add_signed_option(CLI::App& command, Typed& typed, const char* figures);
/// `otherwise`: what a command has besides the numbers for devices.
void add_effort_option(CLI::App& command, Typed& typed, const std::string& otherwise = "");
/// `of`: what it leaves out of.
void add_max_distance_option(CLI::App& command, Typed& typed, const char* of);
/// `shown`: what --json replaces on standard output, "table".
void add_json_option(CLI::App& command, Typed& typed, const std::string& shown);
void add_output_options(CLI::App& command, Typed& typed);
void add_metrics_options(CLI::App& command, Typed& typed);

/// Turn the typed options into questions. Throw UsageError.
Question question_of(const Typed& typed, const Words& words, const char* command);
Outputs outputs_of(const Typed& typed);

}  // namespace vkh
