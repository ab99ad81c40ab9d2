#include "host/app/typed.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "host/answer/options.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

constexpr const char* kStandardOutput = "true";  ///< CLI11's value for a lone --json

void check_names(const char* option, const std::vector<std::string>& names,
                 const std::vector<std::string>& known) {
  const auto stranger = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return std::find(known.begin(), known.end(), name) == known.end();
  });
  if (stranger == names.end()) return;
  std::string list;
  for (const std::string& k : known) list.append(list.empty() ? "" : ", ").append(k);
  throw UsageError(std::string(option) + " '" + *stranger + "': expected one of " + list);
}

SolveOptions options_of(const Typed& typed) {
  SolveOptions options;
  if (typed.memory) options.memory_bytes = parse_memory(*typed.memory);
  if (typed.waves) options.wave_limit = parse_waves(*typed.waves);
  check_names("--enable", typed.enabled, switch_names());
  check_names("--disable", typed.disabled, switch_names());
  if (!typed.preset.empty()) check_names("--preset", {typed.preset}, preset_names());
  options.preset = typed.preset;
  options.enabled = typed.enabled;
  options.disabled = typed.disabled;
  return options;
}

void add_survey_of(const Typed& typed, Question& question) {
  question.faces = !typed.field_tolerance.empty();
  if (question.faces)
    question.face_tolerance =
        parse_length("--field-tol", typed.field_tolerance, PlainNumber::kSmallFraction);
  for (const std::string& band : typed.bands)
    question.bands.push_back(parse_length("--bands", band, PlainNumber::kRefused));
  question.statistics = typed.statistics || (!typed.bands.empty() && !typed.metrics);
  if (typed.metrics) {
    question.metrics.emplace();
    if (!typed.percentile.empty())
      question.metrics->percentile = parse_percentile("--percentile", typed.percentile);
    question.metrics->figures =
        checked_figures("--figures", typed.figures, question.metrics->percentile);
    if (!typed.normals.empty()) question.metrics->normals = parse_angle("--normals", typed.normals);
  }
  if (!typed.max_distance.empty())
    question.max_distance =
        parse_length("--max-distance", typed.max_distance, PlainNumber::kRefused);
  if (!typed.area.empty()) question.area = parse_share("--area", typed.area);
  question.area_requested = typed.area;
  question.is_signed = typed.is_signed;
  if (typed.effort) question.effort = parse_effort(*typed.effort);
}

void add_placement_of(const Typed& typed, Question& question) {
  for (const auto& [option, unit] : {std::pair{"--unit", &typed.unit},
                                     {"--unit-a", &typed.unit_a},
                                     {"--unit-b", &typed.unit_b}}) {
    if (!unit->empty()) check_unit(option, *unit);
  }
  if (typed.may_stretch && typed.transform.empty())
    throw UsageError("--scale: allows a --transform to stretch A; there is none");
  question.unit = typed.unit;
  question.unit_a = typed.unit_a;
  question.unit_b = typed.unit_b;
  question.transform_file = typed.transform;
  question.may_stretch = typed.may_stretch;
  question.align = typed.align;
  if (!typed.saved_transform.empty() && !typed.align && typed.transform.empty())
    throw UsageError("--save-transform: there is no matrix: ask for --align or --transform");
}

void check_together(const Typed& typed) {
  const bool by_face = !typed.face_max_a.empty() || !typed.face_max_b.empty();
  if (!typed.face_max_b.empty() && !typed.symmetric)
    throw UsageError("--face-max-b: limits of B's faces are asked about by --symmetric alone");
  if (by_face && typed.verify) throw UsageError("--verify: is not to be had with --face-max");
  if (by_face && !typed.area.empty())
    throw UsageError("--area: faces with limits of their own are asked about whole");
  if (!typed.pictures.certificate.empty() && (by_face || !typed.area.empty()))
    throw UsageError("--certificate: is of the interval, not to be had with --area or --face-max");
  const bool is_of_triangles = typed.statistics || typed.metrics || typed.is_signed ||
                               !typed.bands.empty() || !typed.area.empty() ||
                               typed.pictures.is_of_triangles();
  if (typed.polygons == "any" && is_of_triangles)
    throw UsageError(
        "--polygons any: areas and certificates are of one triangulation: no metrics, --stats, "
        "--signed, --bands, --area, --report, --figures-csv or --certificate");
}

// A GLB has triangles, which points are not.
void check_field(const Typed& typed, const Question& question) {
  const bool starts_at_points = question.points_a || (question.points_b && typed.symmetric);
  if (starts_at_points && typed.pictures.field.ends_with(".glb"))
    throw UsageError("--field: points with their distances are written as .ply, not as .glb");
}

// A verdict is of all of A, and sides have no such part.
void check_max_distance(const Typed& typed) {
  if (typed.max_distance.empty()) return;
  if (typed.metrics) throw UsageError("--max-distance: metrics are of all of A and B");
  if (!typed.statistics && typed.bands.empty() && !typed.pictures.draws_surface())
    throw UsageError(
        "--max-distance: is of figures and pictures: ask for --stats, --bands, --image or "
        "--report; in a batch for --image-dir or --report-dir");
  const bool has_sides = typed.is_signed || typed.max.find(',') != std::string::npos;
  if (!typed.area.empty() || has_sides)
    throw UsageError(
        "--max-distance: leaves out of figures and pictures alone: no --area, no sides");
}

void check_part(const Typed& typed) {
  if (typed.known_lower && !typed.part)
    throw UsageError("--known-lower: is what other parts have shown: ask for a --part");
  if (typed.part && typed.align)
    throw UsageError(
        "--part: is of A where it lies: find the place once, by --align and --save-transform, and "
        "give it to each part by --transform");
  const bool asks_more = typed.symmetric || typed.statistics || typed.is_signed ||
                         !typed.bands.empty() || !typed.field_tolerance.empty() ||
                         typed.pictures.any();
  if (typed.part && asks_more)
    throw UsageError(
        "--part: one direction's interval is all that is to be had of a part: no --symmetric, "
        "--stats, --signed, --bands, --field-tol, --field, --image, --report, --figures-csv, "
        "--points-out or --certificate");
}

}  // namespace

const char* const kLengths =
    "0.1mm (um, cm, m, in, ft, mil and thou, too), 0.1abs in the files' own unit, 0.1% of A's "
    "bounding-box "
    "diagonal, 1e-6diag";

Question question_of(const Typed& typed, const Words& words, const char* command) {
  Question question;
  question.command = command;
  question.words = words;
  question.file_a = typed.file_a;
  question.file_b = typed.file_b;
  add_placement_of(typed, question);
  question.tolerance = parse_length("--tol", typed.tolerance, PlainNumber::kSmallFraction);
  if (!typed.max.empty()) put_max("--max", typed.max, question);
  question.face_max_a = typed.face_max_a;
  question.face_max_b = typed.face_max_b;
  question.certificate = !typed.pictures.certificate.empty();
  check_together(typed);
  check_part(typed);
  check_max_distance(typed);
  if (typed.part) question.part = parse_part(*typed.part);
  if (typed.known_lower)
    question.known_lower = parse_length("--known-lower", *typed.known_lower, PlainNumber::kRefused);
  question.several_devices = question.command == "distance";
  question.symmetric = typed.symmetric || typed.metrics;
  question.worst = typed.worst || typed.pictures.shows_cells();
  add_survey_of(typed, question);
  question.verify = typed.verify;
  question.device = typed.device;
  question.caches = !typed.no_cache;
  question.verbose = typed.verbose;
  question.options = options_of(typed);
  if (typed.max_input)
    question.limits.max_input_bytes = parse_size("--max-input", *typed.max_input);
  if (!typed.polygons.empty()) {
    check_names("--polygons", {typed.polygons}, {"fan", "any"});
    if (typed.polygons == "fan") question.limits.odd_polygons = OddPolygons::kFanned;
    question.limits.any_triangulation = typed.polygons == "any";
  }
  if (!typed.bodies.empty()) {
    check_names("--bodies", {typed.bodies}, {"solid", "all"});
    if (typed.bodies == "all") question.limits.bodies = Bodies::kAll;
  }
  if (!typed.points.empty()) put_points("--points", typed.points, question);
  check_field(typed, question);
  return question;
}

Outputs outputs_of(const Typed& typed) {
  Outputs outputs;
  outputs.json = typed.json == kStandardOutput;
  if (!typed.json.empty() && !outputs.json) outputs.json_file = typed.json;
  if (!typed.junit.empty()) outputs.junit_file = typed.junit;
  if (!typed.saved_transform.empty()) outputs.transform_file = typed.saved_transform;
  outputs.github = typed.github;
  outputs.verbose = typed.verbose;
  outputs.pictures = asked_of(typed.pictures);
  return outputs;
}

void add_device_option(CLI::App& command, Typed& typed) {
  const bool several = command.get_name() == "distance";
  command.add_option("--device", typed.device,
                     std::string("An index from 'doctor', gpu, cpu, or part of a name") +
                         (several ? "; several, 0,1, or all GPUs, each for a part of A" : "") +
                         " [best: discrete, integrated, virtual, CPU]");
}

void add_time_option(CLI::App& command, Typed& typed) {
  command.add_option("--time", typed.time,
                     "Answer after so long, from the program's start: 250ms, 10s, 2min [no limit]");
}

void add_engine_options(CLI::App& command, Typed& typed) {
  command.add_option("--memory", typed.memory,
                     "Device memory for the search, such as 512MiB or 2G [chosen from the meshes]");
  command.add_option("--waves", typed.waves, "End the search after so many waves [no limit]")
      ->type_name("N");
  command.add_option("--preset", typed.preset,
                     "Which parts of the method are on: default, what pays on the device; paper, "
                     "what the paper has; baseline-gpu, the paper's baseline [default]");
  command
      .add_option("--enable", typed.enabled,
                  "Switch on parts that the preset has not, by name: u4,sort")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--disable", typed.disabled, "Switch off parts of the method, by name: a,b")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_flag("--no-cache", typed.no_cache,
                   "Neither read nor write compiled pipelines in the user's cache folder");
}

void add_search_options(CLI::App& command, Typed& typed) {
  add_device_option(command, typed);
  add_time_option(command, typed);
  add_engine_options(command, typed);
}

void add_json_option(CLI::App& command, Typed& typed, const std::string& shown) {
  command
      .add_flag("--json", typed.json,
                "Print one JSON object instead of the " + shown +
                    "; --json=FILE, without a space, writes it beside the " + shown)
      ->type_name("[=FILE]");
}

void add_output_options(CLI::App& command, Typed& typed) {
  add_json_option(command, typed, "table");
  command.add_flag("--verbose", typed.verbose,
                   "Also print switches, stages, waves and culled candidates");
  command.add_flag("--verify", typed.verify,
                   "Check the answer on the host: the witness against every face of B, by brute "
                   "force in 113-bit arithmetic; the parts of A as exact integers");
}

void add_survey_options(CLI::App& command, Typed& typed) {
  command.add_flag("--stats", typed.statistics,
                   "Also enclose the mean over A's area, the root mean square and percentiles");
  add_signed_option(command, typed, "with --stats the signed mean and percentiles");
  command
      .add_option("--bands", typed.bands,
                  "And the shares of A's area within these distances: 0.1mm,0.5mm")
      ->delimiter(',')
      ->type_name("LENGTH,..")
      ->allow_extra_args(false);
  add_max_distance_option(command, typed, "figures and pictures");
  command
      .add_option("--field-tol", typed.field_tolerance,
                  "Bound the largest distance on each face of A, to so much [1 % of the largest]")
      ->type_name("LENGTH");
  add_effort_option(command, typed);
}

void add_signed_option(CLI::App& command, Typed& typed, const char* figures) {
  command.add_flag("--signed", typed.is_signed,
                   std::string("Also tell where A is over B, in front of its faces as they are "
                               "oriented, and where under it, as far as that is proven; ") +
                       figures);
}

void add_max_distance_option(CLI::App& command, Typed& typed, const char* of) {
  command
      .add_option("--max-distance", typed.max_distance,
                  std::string("Leave out of ") + of +
                      " what is farther, and say its share: strays of a scan; h and verdicts are "
                      "of all of A")
      ->type_name("LENGTH");
}

void add_effort_option(CLI::App& command, Typed& typed, const std::string& otherwise) {
  command
      .add_option("--effort", typed.effort,
                  "Cells to bound at most for figures and faces' bounds, besides each face once; "
                  "the same number gives the same bits on a device [" +
                      std::to_string(default_effort(false)) + " on a GPU, " +
                      std::to_string(default_effort(true)) + " on a CPU" + otherwise + "]")
      ->type_name("N");
}

void add_metrics_options(CLI::App& command, Typed& typed) {
  command
      .add_option("--percentile", typed.percentile,
                  "The percentile of hd_p and hd_p_pooled, in percent [95]")
      ->type_name("P");
  command
      .add_option("--bands", typed.bands,
                  "Also the shares of area within these distances, nsd, precision (A's), recall "
                  "(B's) and f1: 0.5mm,1%; a percentage is of A's diagonal")
      ->delimiter(',')
      ->type_name("LENGTH,..")
      ->allow_extra_args(false);
  command
      .add_option("--figures", typed.figures,
                  "Seek these alone, which takes less time: f1,hd95,assd; others are as wide as "
                  "that leaves them [all]")
      ->delimiter(',')
      ->type_name("NAME,..")
      ->allow_extra_args(false);
  command
      .add_option("--normals", typed.normals,
                  "Also figures of normals: normal_consistency, and precision_normals, "
                  "recall_normals and f1_normals, of area whose normals agree to this angle: 20deg")
      ->type_name("ANGLE");
}

void add_pair(CLI::App& command, Typed& typed) {
  command.add_option("A", typed.file_a, "Mesh to start from (OBJ, STL, PLY, OFF, glTF, 3MF)")
      ->required();
  command.add_option("B", typed.file_b, "Mesh to go to")->required();
  add_unit_and_input(command, typed);
  add_saved_transform(command, typed);
}

void add_unit_and_input(CLI::App& command, Typed& typed) {
  command
      .add_option("--unit", typed.unit,
                  "What the files are in, where they do not say: um, mm, cm, m, in or ft")
      ->type_name("UNIT");
  add_placement(command, typed);
  add_input_options(command, typed);
  command
      .add_option("--points", typed.points,
                  "Which files are points without faces: PLY, OBJ, OFF, XYZ, PTS or LAS; their "
                  "figures weigh points, not areas [none]")
      ->type_name("a|b|both");
}

void add_input_options(CLI::App& command, Typed& typed) {
  command.add_option(
      "--max-input", typed.max_input,
      "Refuse a file of more bytes, or with a mesh that takes more, such as 100M or 2GiB; reading "
      "takes up to six times that [no limit]");
  command
      .add_option("--polygons", typed.polygons,
                  "fan: measure the fan of a polygon's corners where its outline crosses itself or "
                  "encloses no area [such a file is refused]; any: answer for every triangulation "
                  "of corners that lie in no plane [the one that is made]")
      ->type_name("fan|any");
  command
      .add_option("--bodies", typed.bodies,
                  "solid: measure what is printed as body (3MF), or shown (glTF); all: everything "
                  "as it lies, such as modifiers, negative volumes and hidden nodes [solid]")
      ->type_name("solid|all");
}

void add_placement(CLI::App& command, Typed& typed) {
  command
      .add_option("--unit-a", typed.unit_a,
                  "What A's file is in; where B is in another unit, A is converted to that")
      ->type_name("UNIT");
  command.add_option("--unit-b", typed.unit_b, "What B's file, and so the answer, is in")
      ->type_name("UNIT");
  command
      .add_option(
          "--transform", typed.transform,
          "Place A by a matrix: a text file of four rows of four numbers, the last 0 0 0 1; "
          "lengths in B's unit")
      ->type_name("FILE");
  command.add_flag("--scale", typed.may_stretch,
                   "Allow a --transform that stretches A by more than 1e-6");
  command.add_flag("--align", typed.align,
                   "Then lay A onto B by a fit (rotation and shift), which is found, not proven "
                   "the best; the answer is for A as it lies there");
}

void add_saved_transform(CLI::App& command, Typed& typed) {
  command
      .add_option("--save-transform", typed.saved_transform,
                  "Write the matrix by which A was placed, as --transform reads it")
      ->type_name("FILE");
}

void add_tolerance(CLI::App& command, Typed& typed, const char* by_default) {
  typed.tolerance = by_default;
  command
      .add_option("--tol", typed.tolerance,
                  std::string("Width of the interval: ") + kLengths +
                      ", or a number alone up to 1e-3, which is a fraction of the diagonal")
      ->type_name("LENGTH")
      ->default_str(by_default);
}

void add_part(CLI::App& command, Typed& typed) {
  command
      .add_option("--part", typed.part,
                  "Of A's faces part I alone, from 0, of N; 'merge' joins the answers of all parts")
      ->type_name("I/N");
  command
      .add_option("--known-lower", typed.known_lower,
                  "What another part has shown: what is within the tolerance of it is not refined")
      ->type_name("LENGTH");
}

void add_symmetric(CLI::App& command, Typed& typed) {
  command.add_flag("--symmetric", typed.symmetric,
                   "Both directions: max(h(A,B), h(B,A)) instead of h(A,B)");
}

}  // namespace vkh
