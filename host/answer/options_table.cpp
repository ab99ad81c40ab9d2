#include "host/answer/options_table.h"

#include <algorithm>
#include <array>

#include "host/answer/option_values.h"
#include "host/answer/quantities.h"
#include "host/base/decimal.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

/// The part of a request that has members of this class.
template <class Part>
Part& part_of(Request& asked);
template <>
Request& part_of<Request>(Request& asked) {
  return asked;
}
template <>
Question& part_of<Question>(Request& asked) {
  return asked.question;
}
template <>
Stated& part_of<Stated>(Request& asked) {
  return asked.question;
}
template <>
ReadLimits& part_of<ReadLimits>(Request& asked) {
  return asked.question.limits;
}
template <>
Budget& part_of<Budget>(Request& asked) {
  return asked.question.budget;
}
template <>
EngineOptions& part_of<EngineOptions>(Request& asked) {
  return asked.question.engine;
}
template <>
MetricsOptions& part_of<MetricsOptions>(Request& asked) {
  return asked.metric_options;
}
template <>
Outputs& part_of<Outputs>(Request& asked) {
  return asked.outputs;
}
template <>
Look& part_of<Look>(Request& asked) {
  return asked.outputs.look;
}
template <>
ManyRequest& part_of<ManyRequest>(Request& asked) {
  return asked.many;
}
template <>
SimplifyRequest& part_of<SimplifyRequest>(Request& asked) {
  return asked.simplify;
}

template <auto kMember>
struct At;
template <class Part, class T, T Part::*kMember>
struct At<kMember> {
  static T& of(Request& asked) { return part_of<Part>(asked).*kMember; }
};
/// The place of a member, such as &Question::unit.
template <auto kMember>
constexpr auto to = &At<kMember>::of;

constexpr Commands kPair = kDistance | kGate | kMetrics;
constexpr Commands kSurveyed = kDistance | kGate | kDemo;
constexpr Commands kSolving = kPair | kBatch | kSimplify | kDemo;
constexpr Commands kReading = kPair | kBatch;
constexpr Functions kPyPair = kPyDistance | kPyGate | kPyMany | kPySolver;
constexpr Functions kPySolving = kPyPair | kPyMetrics;
constexpr Functions kPyFiles = kPyMany | kPyRead;

constexpr const char* kHost = "how a run is done, not what it finds";
constexpr const char* kPlace = "where an answer goes, not what it is";
constexpr const char* kDrawn = "pictures have names of their own in the results";

const std::vector<std::string>& units() {
  static const std::vector<std::string> known{"um", "mm", "cm", "m", "in", "ft"};
  return known;
}

std::vector<std::string> figure_names() {
  std::vector<std::string> names;
  names.reserve(kNamedMetrics.size() + kNamedShares.size());
  for (const NamedMetric& metric : kNamedMetrics) names.emplace_back(metric.name);
  for (const NamedShare& share : kNamedShares) names.emplace_back(share.name);
  return names;
}

// NOLINTBEGIN(readability-function-size): rows of a table

std::vector<Option> options_of_the_question() {
  const char* const plain = ", or a number alone up to 1e-3, ";
  const std::string tolerance = std::string("Width of the interval: {lengths}") + plain +
                                "which is a fraction of the diagonal";
  const std::string signed_help =
      "Also tell where A is over B, in front of its faces as they are oriented, and where under "
      "it, as far as that is proven; ";
  const std::string effort =
      "The most cells to bound for figures and faces' bounds, after each face once; the same "
      "number gives the same bits on a device [" +
      std::to_string(default_effort(false)) + " on a GPU, " + std::to_string(default_effort(true)) +
      " on a CPU";
  const std::string farther =
      " what is farther, and say its share: stray points of a scan; h and verdicts are of all of A";
  return {
      {.name = "max",
       .kind = Kind::kLength,
       .group = Group::kQuestion,
       .target = Own{put_max, typed_max},
       .uses = {{kGate,
                 "The limit: {lengths}; or one over B, in front of its faces, and one under it: "
                 "+0.25mm,-0.4mm",
                 "", true},
                {kBatch,
                 "Ask whether each is within a limit: {lengths}; or one over B, in front of its "
                 "faces, and one under it: +0.25mm,-0.4mm"},
                {kSimplify, "The limit, for each point of either mesh: {lengths}", "", true}},
       .few = kGate | kBatch | kSimplify,
       .is_column = true,
       .functions = kPyGate | kPyMany | kPySimplify,
       .also = {"limit", "maximum", "threshold", "maxdistance", "maxdeviation", "tolerance"}},
      {.name = "face-max",
       .kind = Kind::kInput,
       .group = Group::kQuestion,
       .target = to<&Question::face_max_a>,
       .uses = {{kGate,
                 "Limits of A's faces: a CSV of face, max, counted from 0 as in A's file; a number "
                 "alone is in the files' unit, others have --max. Or a PLY, such as A, whose faces "
                 "have a property max"}}},
      {.name = "face-max-b",
       .kind = Kind::kInput,
       .group = Group::kQuestion,
       .target = to<&Question::face_max_b>,
       .uses = {{kGate, "The same for B's faces, the way back"}}},
      {.name = "area",
       .kind = Kind::kShare,
       .group = Group::kQuestion,
       .target = Own{put_area, area_text},
       .uses = {{kGate,
                 "Ask that this share of A's area is within the limit, such as 99.5%, instead of "
                 "every point"}},
       .few = kGate,
       .functions = kPyGate},
      {.name = "worst",
       .kind = Kind::kFlag,
       .group = Group::kQuestion,
       .target = to<&Question::worst>,
       .uses = {{kGate,
                 "After the verdict, go on to the farthest point, as --image, --report and --field "
                 "do"}},
       .few = kGate,
       .functions = kPyGate},
      {.name = "tol",
       .kind = Kind::kTolerance,
       .group = Group::kQuestion,
       .target = to<&Stated::tolerance>,
       .uses = {{kDistance | kMetrics, tolerance, "1e-6"},
                {kGate, tolerance, "1e-7"},
                {kDemo, tolerance, "1e-8"},
                {kBatch, std::string("Width of the intervals: {lengths}") + plain +
                             "a fraction of the diagonal [1e-6; with --max 1e-7]"}},
       .few = kDistance | kMetrics | kDemo,
       .is_column = true,
       .functions = kPySolving,
       .also = {"tolerance"}},
      {.name = "symmetric",
       .kind = Kind::kFlag,
       .group = Group::kQuestion,
       .target = to<&Question::symmetric>,
       .uses = {{kSurveyed | kBatch, "Both directions: max(h(A,B), h(B,A)) instead of h(A,B)"}},
       .few = kSurveyed | kBatch,
       .is_column = true,
       .functions = kPyDistance | kPyGate | kPyMany,
       .also = {"bothways"}},
      {.name = "part",
       .kind = Kind::kPart,
       .group = Group::kQuestion,
       .target = to<&Stated::part>,
       .uses = {{kDistance,
                 "Only part I of N of A's faces, from 0; 'merge' joins the answers of all "
                 "parts"}}},
      {.name = "known-lower",
       .kind = Kind::kLength,
       .group = Group::kQuestion,
       .target = to<&Question::known_lower>,
       .uses = {{kDistance,
                 "A bound that another part has proven: what is within the tolerance of it is "
                 "not refined"}}},
      {.name = "stats",
       .kind = Kind::kFlag,
       .group = Group::kQuestion,
       .target = to<&Question::statistics>,
       .uses = {{kSurveyed,
                 "Also enclose the mean over A's area, the root mean square and percentiles"}},
       .few = kDistance | kDemo,
       .functions = kPyPair,
       .keyword = "statistics"},
      {.name = "signed",
       .kind = Kind::kFlag,
       .group = Group::kQuestion,
       .target = to<&Question::is_signed>,
       .uses = {{kSurveyed, signed_help + "with --stats the signed mean and percentiles"},
                {kBatch, signed_help + "with the signed mean and percentiles"}},
       .is_column = true,
       .functions = kPyPair,
       .also = {"sign"}},
      {.name = "metrics",
       .kind = Kind::kFlag,
       .group = Group::kQuestion,
       .target = to<&Request::metrics>,
       .uses = {{kBatch,
                 "Both directions' figures by the names that papers use, as 'metrics' has them"}}},
      {.name = "percentile",
       .kind = Kind::kPercentile,
       .group = Group::kQuestion,
       .target = to<&MetricsOptions::percentile>,
       .uses = {{kMetrics | kBatch, "The percentile of hd_p and hd_p_pooled, in percent [95]"}},
       .few = kMetrics,
       .functions = kPyMetrics},
      {.name = "bands",
       .kind = Kind::kLengths,
       .group = Group::kQuestion,
       .target = to<&Question::bands>,
       .uses = {{kSurveyed, "Also the shares of A's area within these distances: 0.1mm,0.5mm"},
                {kMetrics | kBatch,
                 "Also the shares of area within these distances, nsd, precision (A's), recall "
                 "(B's) and f1: 0.5mm,1%; a percentage is of A's diagonal"}},
       .few = kMetrics,
       .functions = kPySolving},
      {.name = "figures",
       .kind = Kind::kNames,
       .group = Group::kQuestion,
       .target = to<&MetricsOptions::figures>,
       .uses = {{kMetrics | kBatch,
                 "Seek only these, which takes less time: f1,hd95,assd; others stay as wide as "
                 "that leaves them [all]"}},
       .few = kMetrics,
       .functions = kPyMetrics,
       .choices = figure_names(),
       .has_others = true},
      {.name = "normals",
       .kind = Kind::kAngle,
       .group = Group::kQuestion,
       .target = to<&MetricsOptions::normals>,
       .uses = {{kMetrics | kBatch,
                 "Also figures of normals: normal_consistency, and precision_normals, "
                 "recall_normals and f1_normals, of area whose normals agree to this angle: "
                 "20deg"}},
       .few = kMetrics,
       .functions = kPyMetrics},
      {.name = "max-distance",
       .kind = Kind::kLength,
       .group = Group::kQuestion,
       .target = to<&Question::max_distance>,
       .uses = {{kSurveyed, "Leave out of figures and pictures" + farther},
                {kBatch, "Leave out of pictures and pages" + farther}},
       .functions = kPyPair,
       .unlike = kDrawn},
      {.name = "field-tol",
       .kind = Kind::kTolerance,
       .group = Group::kQuestion,
       .target = to<&Question::face_tolerance>,
       .uses = {{kSurveyed,
                 "Bound the largest distance on each face of A, to this width [1 % of the "
                 "largest]"}},
       .functions = kPyPair,
       .keyword = "field",
       .none = "False"},
      {.name = "effort",
       .kind = Kind::kCount,
       .group = Group::kQuestion,
       .target = to<&Budget::effort>,
       .uses = {{kPair | kDemo, effort + "]"},
                {kBatch, effort + "; with --metrics " + std::to_string(kEffortOfMetrics) + "]"}},
       .few = kMetrics,
       .functions = kPySolving,
       .noun = "cells",
       .most = 1e12},
      {.name = "one-way",
       .kind = Kind::kFlag,
       .group = Group::kQuestion,
       .target = to<&SimplifyRequest::one_way>,
       .uses = {{kSimplify, "Limit only the points of A: the result may reach farther from A"}},
       .few = kSimplify,
       .functions = kPySimplify},
      {.name = "lock-borders",
       .kind = Kind::kFlag,
       .group = Group::kQuestion,
       .target = to<&SimplifyRequest::lock_borders>,
       .uses = {{kSimplify, "Keep each vertex of an edge that only one face has"}},
       .few = kSimplify,
       .functions = kPySimplify},
      {.name = "levels",
       .kind = Kind::kCount,
       .group = Group::kQuestion,
       .target = to<&SimplifyRequest::levels>,
       .uses = {{kSimplify,
                 "Write a chain instead, each level measured against A itself: B-1.ply, the "
                 "finest, to B-N.ply, as far as the limit allows, 32 at most"}},
       .few = kSimplify,
       .noun = "levels",
       .least = 1,
       .most = 32},
      {.name = "ratio",
       .kind = Kind::kNumber,
       .group = Group::kQuestion,
       .target = to<&SimplifyRequest::ratio>,
       .uses = {{kSimplify,
                 "With --levels: the share of faces from one to the next, 0.01 to 0.99 [0.5]"}},
       .shape = "SHARE",
       .least = 0.01,
       .most = 0.99}};
}

std::vector<Option> options_of_placement() {
  return {
      {.name = "polygons",
       .kind = Kind::kChoice,
       .group = Group::kPlacement,
       .target = Own{put_polygons, polygons_text},
       .uses = {{kReading | kSimplify,
                 "fan: measure the fan of a polygon's corners where its outline crosses itself or "
                 "encloses no area [such a file is refused]; any: answer for every triangulation "
                 "of corners that lie in no plane [the one that is made]"}},
       .functions = kPyFiles,
       .choices = {"fan", "any"},
       .none = "'refuse'"},
      {.name = "bodies",
       .kind = Kind::kChoice,
       .group = Group::kPlacement,
       .target = Own{put_bodies, bodies_text},
       .uses = {{kReading | kSimplify,
                 "solid: measure what is printed as body (3MF), or shown (glTF); all: everything "
                 "as it lies, such as modifiers, negative volumes and hidden nodes [solid]"}},
       .functions = kPyFiles,
       .choices = {"solid", "all"},
       .none = "'solid'"},
      {.name = "points",
       .kind = Kind::kChoice,
       .group = Group::kPlacement,
       .target = Own{put_points, points_text},
       .uses = {{kReading,
                 "Which files are points without faces: PLY, OBJ, OFF, XYZ, PTS or LAS; their "
                 "figures weigh points, not areas [none]"}},
       .is_column = true,
       .functions = kPyPair,
       .choices = {"a", "b", "both"},
       .also = {"pointcloud"}},
      {.name = "unit",
       .kind = Kind::kUnit,
       .group = Group::kPlacement,
       .target = to<&Question::unit>,
       .uses = {{kReading, "The unit of files that do not say theirs: um, mm, cm, m, in or ft"},
                {kSimplify, "The unit of A's file, if it does not say: um, mm, cm, m, in or ft"}},
       .few = kReading | kSimplify,
       .is_column = true,
       .choices = units()},
      {.name = "unit-a",
       .kind = Kind::kUnit,
       .group = Group::kPlacement,
       .target = to<&Question::unit_a>,
       .uses = {{kReading, "The unit of A's file; if B has another unit, A is converted to that"}},
       .is_column = true,
       .functions = kPySolving,
       .choices = units()},
      {.name = "unit-b",
       .kind = Kind::kUnit,
       .group = Group::kPlacement,
       .target = to<&Question::unit_b>,
       .uses = {{kReading, "The unit of B's file, and so of the answer"}},
       .is_column = true,
       .functions = kPySolving,
       .choices = units()},
      {.name = "transform",
       .kind = Kind::kInput,
       .group = Group::kPlacement,
       .target = Own{put_transform, transform_text},
       .uses = {{kReading,
                 "Place A by a matrix: a text file of four rows of four numbers, the last 0 0 0 1; "
                 "lengths in B's unit"}},
       .is_column = true,
       .functions = kPySolving,
       .also = {"matrix"}},
      {.name = "scale",
       .kind = Kind::kFlag,
       .group = Group::kPlacement,
       .target = to<&Question::may_stretch>,
       .uses = {{kReading, "Allow a --transform that stretches A by more than 1e-6"}},
       .functions = kPySolving},
      {.name = "align",
       .kind = Kind::kFlag,
       .group = Group::kPlacement,
       .target = to<&Question::align>,
       .uses = {{kReading,
                 "Then lay A onto B by a fit (rotation and shift), which is found, not proven the "
                 "best; the answer is for A as it lies there"}},
       .is_column = true,
       .functions = kPyPair,
       .also = {"aligned"}},
      {.name = "save-transform",
       .kind = Kind::kFile,
       .group = Group::kPlacement,
       .target = to<&Outputs::transform>,
       .uses = {{kPair, "Write the matrix by which A was placed, as --transform reads it"}}}};
}

std::vector<Option> options_of_outputs() {
  const std::string words = "; --json=FILE, without a space, writes it beside the ";
  return {
      {.name = "out",
       .kind = Kind::kFile,
       .group = Group::kOutput,
       .target = to<&Outputs::out>,
       .uses = {{kBatch | kMerge, "The results: one JSON object a line, a line a pair (JSONL)", "",
                 true},
                {kSimplify, "The result: .ply, .obj, .stl or .glb", "", true}},
       .few = kBatch | kSimplify,
       .unlike = kPlace},
      {.name = "csv",
       .kind = Kind::kFile,
       .group = Group::kOutput,
       .target = to<&Outputs::csv>,
       .uses = {{kBatch | kMerge, "Write them as CSV, too"}},
       .few = kBatch,
       .unlike = kPlace},
      {.name = "field",
       .kind = Kind::kFile,
       .group = Group::kOutput,
       .target = to<&Outputs::field>,
       .uses = {{kSurveyed,
                 "Write A with bounds and colours of its faces: .ply or .glb (B: beside it, -b)"}},
       .few = kDistance},
      {.name = "image",
       .kind = Kind::kFile,
       .group = Group::kOutput,
       .target = to<&Outputs::image>,
       .uses = {{kSurveyed, "Draw A in the colours of its distances from B: .png"}},
       .few = kDistance | kDemo},
      {.name = "report",
       .kind = Kind::kFile,
       .group = Group::kOutput,
       .target = to<&Outputs::report>,
       .uses = {{kSurveyed,
                 "Write all of it as a page to look at and to pass on: .html, which needs no "
                 "network"}},
       .few = kSurveyed},
      {.name = "title",
       .kind = Kind::kText,
       .group = Group::kOutput,
       .target = to<&Outputs::title>,
       .uses = {{kSurveyed, "The heading of the report [the names of the files]"}}},
      {.name = "figures-csv",
       .kind = Kind::kFile,
       .group = Group::kOutput,
       .target = to<&Outputs::figures>,
       .uses = {{kSurveyed, "Write the figures of the report as a table: .csv"}}},
      {.name = "points-out",
       .kind = Kind::kFile,
       .group = Group::kOutput,
       .target = to<&Outputs::points>,
       .uses = {{kSurveyed,
                 "Write the worst places of the report as a table of x, y, z and deviation: "
                 ".csv"}}},
      {.name = "certificate",
       .kind = Kind::kFile,
       .group = Group::kOutput,
       .target = to<&Outputs::certificate>,
       .uses = {{kDistance | kGate, "Write what proves the interval, for vkh_check to check: .vhc"},
                {kSimplify, "Write what proves the distances, for vkh_check to check: .vhc"}},
       .few = kSimplify,
       .functions = kPyDistance | kPyGate | kPySolver},
      {.name = "junit",
       .kind = Kind::kFile,
       .group = Group::kOutput,
       .target = to<&Outputs::junit>,
       .uses = {{kGate, "Write a test suite of one test case: JUnit's XML"},
                {kBatch | kMerge, "Write a test suite, a test case a pair: JUnit's XML"}},
       .few = kGate | kBatch,
       .unlike = kPlace},
      {.name = "github",
       .kind = Kind::kFlag,
       .group = Group::kOutput,
       .target = to<&Outputs::github>,
       .uses = {{kGate,
                 "Print a workflow annotation for GitHub Actions, and add to the summary of the "
                 "run ($GITHUB_STEP_SUMMARY)"},
                {kBatch,
                 "Print workflow annotations for GitHub Actions, of all pairs and of each that is "
                 "no PASS, and add to the summary of the run ($GITHUB_STEP_SUMMARY)"}},
       .few = kGate | kBatch,
       .unlike = kPlace},
      {.name = "image-dir",
       .kind = Kind::kFolder,
       .group = Group::kOutput,
       .target = to<&ManyRequest::image_folder>,
       .uses = {{kBatch,
                 "Draw each A in the colours of its distances, as .png in this folder, with an "
                 "index page"}},
       .unlike = kDrawn},
      {.name = "report-dir",
       .kind = Kind::kFolder,
       .group = Group::kOutput,
       .target = to<&ManyRequest::report_folder>,
       .uses = {{kBatch, "Write each pair's report, as .html in this folder, with an index page"}},
       .few = kBatch,
       .unlike = kDrawn},
      {.name = "json",
       .kind = Kind::kFlag,
       .group = Group::kOutput,
       .target = Own{put_json, nullptr},
       .uses = {{kPair | kSimplify | kDemo,
                 "Print one JSON object instead of the table" + words + "table"},
                {kDoctor, "Print one JSON object instead of the words" + words + "words"}},
       .few = kPair | kSimplify | kDemo,
       .shape = "[=FILE]",
       .unlike = kPlace},
      {.name = "verbose",
       .kind = Kind::kFlag,
       .group = Group::kOutput,
       .target = to<&Question::verbose>,
       .uses = {{kPair | kDemo, "Also print switches, stages, waves and culled candidates"}},
       .few = kDemo},
      {.name = "verify",
       .kind = Kind::kFlag,
       .group = Group::kOutput,
       .target = to<&Question::verify>,
       .uses = {{kPair | kDemo,
                 "Check the answer on the host: the witness against every face of B, by brute "
                 "force in 113-bit arithmetic; the parts of A as exact integers"}},
       .few = kDemo}};
}

std::vector<Option> options_of_drawing() {
  const Commands drawing = kSurveyed | kBatch;
  return {{.name = "view",
           .kind = Kind::kText,
           .group = Group::kDrawing,
           .target = to<&Look::view>,
           .uses = {{drawing, "From where it is drawn: iso, six, or x,y,z [iso]"}},
           .shape = "iso|six|X,Y,Z",
           .choices = {"iso", "six"},
           .unlike = kDrawn},
          {.name = "up",
           .kind = Kind::kChoice,
           .group = Group::kDrawing,
           .target = to<&Look::up>,
           .uses = {{drawing, "The axis that points up, y or z [z]"}},
           .choices = {"y", "z"},
           .unlike = kDrawn},
          {.name = "size",
           .kind = Kind::kText,
           .group = Group::kDrawing,
           .target = to<&Look::size>,
           .uses = {{drawing, "Of the picture [1600x1000]"}},
           .shape = "WxH",
           .unlike = kDrawn},
          {.name = "map",
           .kind = Kind::kText,
           .group = Group::kDrawing,
           .target = to<&Look::map>,
           .uses = {{drawing,
                     "Its colours, of distances without a side: viridis, batlow or cividis [by "
                     "side where it costs little, otherwise viridis]"}},
           .shape = "NAME",
           .choices = {"viridis", "batlow", "cividis"},
           .unlike = kDrawn},
          {.name = "range",
           .kind = Kind::kLengths,
           .group = Group::kDrawing,
           .target = Own{put_range, nullptr},
           .uses = {{drawing, "Lengths at the ends of its colours: 0,0.5mm"}},
           .shape = "LENGTH,LENGTH",
           .unlike = kDrawn},
          {.name = "steps",
           .kind = Kind::kCount,
           .group = Group::kDrawing,
           .target = to<&Look::steps>,
           .uses = {{drawing, "Number of steps of colour, 256 at most [smooth]"}},
           .noun = "steps",
           .most = 256,
           .unlike = kDrawn}};
}

std::vector<Option> options_of_many() {
  return {
      {.name = "against",
       .kind = Kind::kInput,
       .group = Group::kMany,
       .target = to<&ManyRequest::against>,
       .uses = {{kBatch, "The mesh to which all named ones are compared"}},
       .few = kBatch,
       .shape = "B",
       .unlike = "the hash of the file is in the key"},
      {.name = "allow-unpaired",
       .kind = Kind::kFlag,
       .group = Group::kMany,
       .target = to<&ManyRequest::allows_unpaired>,
       .uses = {{kBatch,
                 "Name and count the meshes of two folders that have no partner, without an error "
                 "[each is a pair without an answer, code 4]"}},
       .unlike = "such a mesh has no pair"},
      {.name = "resume",
       .kind = Kind::kFlag,
       .group = Group::kMany,
       .target = to<&ManyRequest::resumes>,
       .uses = {{kBatch,
                 "Keep existing results, and do pairs that have none, or none of these "
                 "inputs and options"}},
       .few = kBatch,
       .unlike = kHost},
      {.name = "shard",
       .kind = Kind::kPart,
       .group = Group::kMany,
       .target = to<&ManyRequest::shard>,
       .uses = {{kBatch,
                 "Do one of n parts of the list, i from 0; which pairs it has is a matter of "
                 "their ids alone"}},
       .shape = "i/n",
       .unlike = kHost},
      {.name = "fail-fast",
       .kind = Kind::kFlag,
       .group = Group::kMany,
       .target = to<&ManyRequest::fails_fast>,
       .uses = {{kBatch, "End with the first pair that is beyond its limit or has no answer"}},
       .unlike = kHost},
      {.name = "list",
       .kind = Kind::kInput,
       .group = Group::kMany,
       .target = to<&ManyRequest::list>,
       .uses = {{kMerge,
                 "Name the pairs of this list that have no result; exit code 3 if there are "
                 "any"}},
       .shape = "LIST"},
      {.name = "reproducible",
       .kind = Kind::kFlag,
       .group = Group::kMany,
       .target = to<&ManyRequest::reproducible>,
       .uses = {{kMerge,
                 "Leave out times, hosts and devices, so that two runs can be compared byte "
                 "for byte"}}},
      {.name = "together",
       .kind = Kind::kCount,
       .group = Group::kMany,
       .target = to<&ManyRequest::together>,
       .uses = {{kBatch, "Pairs side by side on a device [16 on a GPU, 1 on a CPU]"}},
       .functions = kPyMany,
       .noun = "pairs",
       .least = 1,
       .most = 65536,
       .unlike = kHost},
      {.name = "lanes",
       .kind = Kind::kCount,
       .group = Group::kMany,
       .target = to<&ManyRequest::lanes>,
       .uses = {{kBatch, "Groups of them at a time on a device [3 on a GPU, 1 on a CPU]"}},
       .functions = kPyMany,
       .noun = "groups",
       .least = 1,
       .most = 65536,
       .unlike = kHost},
      {.name = "read-ahead",
       .kind = Kind::kSize,
       .group = Group::kMany,
       .target = to<&ManyRequest::read_ahead_bytes>,
       .uses = {{kBatch, "Memory for meshes that are read and not solved yet [2GiB]"}},
       .unlike = kHost}};
}

std::vector<Option> options_of_cost() {
  const std::string device = "An index from 'doctor', gpu, cpu, or part of a name";
  const std::string native = "; native: this processor without Vulkan";
  const std::string best = " [best: discrete, integrated, virtual, CPU]";
  return {
      {.name = "max-input",
       .kind = Kind::kSize,
       .group = Group::kCost,
       .target = to<&ReadLimits::max_input_bytes>,
       .uses = {{kReading | kSimplify,
                 "Refuse a file of more bytes, or with a mesh that takes more, such as 100M or "
                 "2GiB; reading takes up to six times that [no limit]"}},
       .functions = kPyFiles},
      {.name = "device",
       .kind = Kind::kText,
       .group = Group::kCost,
       .target = to<&Question::device>,
       .uses = {{.of = kDistance,
                 .help =
                     device + "; several, 0,1, or all GPUs, each for a part of A" + native + best,
                 .more = {"all", "native"}},
                {.of = kGate | kMetrics | kSimplify | kDemo | kDoctor,
                 .help = device + native + best,
                 .more = {"native"}},
                {.of = kBatch,
                 .help = "Devices, between commas, as 'doctor' names them; all: every GPU" +
                         native + " [the best]",
                 .more = {"all", "native"}}},
       .few = kDistance | kMetrics | kSimplify | kDemo,
       .functions = kPyDistance | kPyGate | kPyMetrics | kPyMany | kPySimplify,
       .shape = "DEVICE",
       .choices = {"gpu", "cpu"},
       .none = "''",
       .unlike = kHost},
      {.name = "threads",
       .kind = Kind::kCount,
       .group = Group::kCost,
       .target = to<&Question::threads>,
       .uses = {{kDistance | kGate | kMetrics | kBatch | kSimplify | kDemo,
                 "Threads of --device native; answers are the same for any number [one a core]"}},
       .noun = "threads",
       .least = 1,
       .most = 256,
       .unlike = kHost},
      {.name = "time",
       .kind = Kind::kTime,
       .group = Group::kCost,
       .target = to<&Budget::time_limit_s>,
       .uses = {{kPair | kSimplify | kDemo,
                 "Answer after this time, from the program's start: 250ms, 10s, 2min [no limit]"},
                {kBatch, "End a pair's run after this time: 250ms, 10s, 2min [no limit]"}},
       .few = kPair | kSimplify | kDemo,
       .functions = kPySolving | kPySimplify},
      {.name = "survey-time",
       .kind = Kind::kTime,
       .group = Group::kCost,
       .target = to<&Budget::survey_time_s>,
       .uses = {},  // the program has one limit for all work
       .functions = kPySolving},
      {.name = "memory",
       .kind = Kind::kSize,
       .group = Group::kCost,
       .target = to<&Budget::memory_bytes>,
       .uses = {{kSolving,
                 "Device memory for the search, such as 512MiB or 2G [chosen from the meshes]"}},
       .functions = kPySolving},
      {.name = "waves",
       .kind = Kind::kCount,
       .group = Group::kCost,
       .target = to<&Budget::wave_limit>,
       .uses = {{kSolving, "End the search after this many waves [no limit]"}},
       .functions = kPySolving,
       .noun = "waves",
       .most = 4294967295},
      {.name = "preset",
       .kind = Kind::kChoice,
       .group = Group::kCost,
       .target = to<&EngineOptions::preset>,
       .uses = {{kSolving,
                 "Which parts of the method are on: default, what pays on the device; paper, what "
                 "the paper has; baseline-gpu, the paper's baseline [default]"}},
       .functions = kPySolving,
       .shape = "NAME",
       .choices = preset_names(),
       .none = "''"},
      {.name = "enable",
       .kind = Kind::kNames,
       .group = Group::kCost,
       .target = to<&EngineOptions::enabled>,
       .uses = {{kSolving, "Switch on parts that the preset has not, by name: u4,sort"}},
       .functions = kPySolving,
       .choices = switch_names()},
      {.name = "disable",
       .kind = Kind::kNames,
       .group = Group::kCost,
       .target = to<&EngineOptions::disabled>,
       .uses = {{kSolving, "Switch off parts of the method, by name: a,b"}},
       .functions = kPySolving,
       .choices = switch_names()},
      {.name = "no-cache",
       .kind = Kind::kFlag,
       .group = Group::kCost,
       .target = Own{put_no_cache, nullptr},
       .uses = {{kSolving, "Neither read nor write compiled pipelines in the user's cache folder"}},
       .unlike = kHost}};
}

// NOLINTEND(readability-function-size)

std::string with_underscores(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

template <class Is>
const Option* first(const Is& is) {
  const std::vector<Option>& known = options();
  const auto found = std::find_if(known.begin(), known.end(), is);
  return found == known.end() ? nullptr : &*found;
}

}  // namespace

const char* heading_of(Group group) {
  constexpr std::array kHeadings{"What is asked",
                                 "What the meshes are, and where A lies",
                                 "What is printed and written",
                                 "How it is drawn",
                                 "How a batch goes on",
                                 "What it may cost, and how it is done"};
  return kHeadings[static_cast<size_t>(group)];
}

const std::vector<Option>& options() {
  static const std::vector<Option> known = [] {
    std::vector<Option> all;
    for (auto* rows : {options_of_the_question, options_of_placement, options_of_outputs,
                       options_of_drawing, options_of_many, options_of_cost})
      for (Option& option : rows()) all.push_back(std::move(option));
    return all;
  }();
  return known;
}

const Option* option_of(std::string_view name) {
  return first([&](const Option& option) { return option.name == name; });
}

const Option* column_of(std::string_view name) {
  return first([&](const Option& o) { return o.is_column && column_name(o) == name; });
}

std::string column_name(const Option& option) { return with_underscores(option.name); }

std::string keyword_name(const Option& option) {
  return *option.keyword != '\0' ? option.keyword : with_underscores(option.name);
}

std::string keyword_default(const Option& option, Functions function) {
  if (*option.none != '\0') return option.none;
  switch (option.kind) {
    case Kind::kFlag:
      return "False";
    case Kind::kPercentile:
      return "95";
    case Kind::kNames:
    case Kind::kLengths:
      return "()";
    case Kind::kTolerance:
      return function == kPyMany ? "None" : function == kPyGate ? "1e-7" : "1e-6";
    default:
      return "None";
  }
}

const Use* use_of(const Option& option, Commands command) {
  const auto found = std::find_if(option.uses.begin(), option.uses.end(),
                                  [&](const Use& use) { return (use.of & command) != 0; });
  return found == option.uses.end() ? nullptr : &*found;
}

std::string shape_of(const Option& option) {
  if (*option.shape != '\0') return option.shape;
  switch (option.kind) {
    case Kind::kFlag:
      return "";
    case Kind::kFile:
    case Kind::kInput:
      return "FILE";
    case Kind::kFolder:
      return "DIR";
    case Kind::kUnit:
      return "UNIT";
    case Kind::kLength:
    case Kind::kTolerance:
      return "LENGTH";
    case Kind::kLengths:
      return "LENGTH,..";
    case Kind::kNames:
      return "NAME,..";
    case Kind::kShare:
      return "SHARE";
    case Kind::kPercentile:
      return "P";
    case Kind::kAngle:
      return "ANGLE";
    case Kind::kSize:
      return "SIZE";
    case Kind::kTime:
      return "TIME";
    case Kind::kCount:
    case Kind::kNumber:
      return "N";
    case Kind::kPart:
      return "I/N";
    case Kind::kText:
      return "TEXT";
    case Kind::kChoice:
      break;
  }
  std::string choices;
  for (const std::string& choice : option.choices) choices += (choices.empty() ? "" : "|") + choice;
  return choices;
}

}  // namespace vkh
