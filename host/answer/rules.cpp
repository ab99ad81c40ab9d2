#include "host/answer/rules.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "host/answer/option_values.h"
#include "host/answer/options_table.h"
#include "host/answer/quantities.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

using Names = std::vector<std::string_view>;
constexpr Commands kProgram =
    kDistance | kGate | kMetrics | kBatch | kMerge | kSimplify | kDemo | kDoctor;
constexpr Commands kAll = kProgram | kPython;

using When = std::function<bool(const Request&)>;

/// Refuses a request if `when` holds and one of `options` was given. In its message "{option}"
/// stands for that option, and "{stats}" for the name of another.
struct Rule {
  Names options;
  When when;
  const char* says;
  Commands of = kProgram;
};

/// A rule for every question, no matter whether it comes from a command line, a list, Python or
/// C++.
struct QuestionRule {
  bool (*when)(const Question&);
  const char* says;
  bool is_of_all = false;  ///< members that are filled in later may satisfy it
};

bool any_of(const Request& asked, const Names& names) {
  return std::any_of(names.begin(), names.end(), [&](auto name) { return asked.has(name); });
}
When with(Names names) {
  return [names = std::move(names)](const Request& asked) { return any_of(asked, names); };
}
When without(Names names) {
  return [names = std::move(names)](const Request& asked) { return !any_of(asked, names); };
}

const Names kCells{"field", "image", "report", "figures-csv", "points-out"};
const Names kPages{"report", "figures-csv", "report-dir", "certificate"};
const Names kSurface{"image", "report", "figures-csv", "points-out", "image-dir", "report-dir"};

bool is_of_triangles(const Request& asked) {
  return asked.metrics || any_of(asked, {"stats", "signed", "bands", "area"}) ||
         any_of(asked, kPages);
}

// A pair of a list may ask for figures itself.
bool has_no_survey(const Request& asked) {
  const bool has_list =
      asked.command == kBatch && asked.many.against.empty() && asked.many.files.size() == 1;
  return !has_list && !asked.metrics && !asked.question.asks_for_sides() &&
         !any_of(asked, {"stats", "bands", "area", "field-tol", "image-dir", "report-dir"}) &&
         !any_of(asked, kCells);
}

bool writes_points_as_glb(const Request& asked) {
  const Question& question = asked.question;
  const bool starts_at_points = question.points_a || (question.points_b && question.symmetric);
  return starts_at_points && asked.outputs.field && asked.outputs.field->ends_with(".glb");
}

std::vector<Rule> rules_of_placement() {
  return {
      {{"scale"},
       [](const Request& a) { return a.question.transform_file.empty() && !a.question.transform; },
       "{scale}: allows a {transform} to stretch A; there is none",
       kAll},
      {{"save-transform"},
       without({"align", "transform"}),
       "{save-transform}: there is no matrix: ask for {align} or {transform}"}};
}

std::vector<Rule> rules_of_limits() {
  return {{{"known-lower"},
           without({"part"}),
           "{known-lower}: is a bound from other parts: ask for a {part}"},
          {{"face-max-b"},
           without({"symmetric"}),
           "{face-max-b}: limits of B's faces need {symmetric}"},
          {{"polygons"},
           [](const Request& asked) {
             return asked.question.limits.any_triangulation && is_of_triangles(asked);
           },
           "{polygons} any: areas and certificates are of one triangulation: no metrics, {stats}, "
           "{signed}, {bands}, {area}, {report}, {figures-csv} or {certificate}"},
          {{"field"},
           writes_points_as_glb,
           "{field}: points with their distances are written as .ply, not as .glb"}};
}

std::vector<Rule> rules_of_figures() {
  Names shown{"stats", "bands"};
  shown.insert(shown.end(), kSurface.begin(), kSurface.end());
  return {{{"bands", "percentile", "figures", "normals"},
           without({"metrics"}),
           "{bands}, {percentile}, {figures}, {normals}: are of {metrics}",
           kBatch},
          {{"max-distance"},
           without(std::move(shown)),
           "{max-distance}: concerns figures and pictures: ask for {stats}, {bands}, {image} or "
           "{report}; in a batch for {image-dir} or {report-dir}"},
          {{"effort"},
           has_no_survey,
           "{effort}: is of figures and faces' bounds: ask for {stats}, {signed}, {bands}, {area}, "
           "{field-tol}, {field}, {image}, {report}, {figures-csv} or {points-out}",
           kDistance | kGate | kDemo},
          {{"effort"},
           has_no_survey,
           "{effort}: is of figures and of what is drawn: ask for {signed}, {metrics}, "
           "{image-dir} or {report-dir}",
           kBatch}};
}

std::vector<Rule> rules_of_pictures() {
  const Names look{"view", "up", "size", "range", "steps"};
  return {{look, without({"image", "report"}),
           "{option}: concerns a picture: ask for {image} or {report}", kDistance | kGate | kDemo},
          {look, without({"image-dir", "report-dir"}),
           "{option}: concerns a picture: ask for {image-dir} or {report-dir}", kBatch},
          {{"map"},
           without({"image", "report", "field"}),
           "{map}: concerns colours: ask for {image}, {report} or {field}",
           kDistance | kGate | kDemo},
          {{"map"},
           without({"image-dir", "report-dir"}),
           "{map}: concerns colours: ask for {image-dir} or {report-dir}",
           kBatch},
          {{"title"}, without({"report"}), "{title}: concerns a page: ask for {report}"}};
}

bool is_native(const Request& asked) { return asked.question.is_native(); }

std::vector<Rule> rules_of_devices() {
  return {{{"threads"},
           [](const Request& asked) { return !is_native(asked); },
           "{threads}: only for {device} native"}};
}

std::vector<Rule> rules_of_simplify() {
  return {{{"max"},
           [](const Request& asked) { return asked.question.max_sides.has_value(); },
           "{max}: expected one length, such as 0.1mm",
           kSimplify},
          {{"ratio"}, without({"levels"}), "{ratio}: only with {levels}", kSimplify},
          {{"certificate"},
           with({"levels"}),
           "{certificate}: proves one mesh: leave {levels} out",
           kSimplify}};
}

/// Names an option that only a Vulkan device serves, and tells whether it is asked for.
struct OfDevices {
  const char* option;
  bool (*is_asked)(const Question&);
};
constexpr OfDevices kOfDevices[] = {
    {"preset",
     [](const Question& q) {
       return !q.engine.preset.empty() && q.engine.preset != preset_names().front();
     }},
    {"enable", [](const Question& q) { return !q.engine.enabled.empty(); }},
    {"disable", [](const Question& q) { return !q.engine.disabled.empty(); }}};

constexpr QuestionRule kQuestionRules[] = {
    {[](const Question& q) { return q.metrics && (!q.symmetric || q.max); },
     "{metrics}: figures are of both directions and no verdict: leave out {max}, and a {symmetric} "
     "that is false"},
    {[](const Question& q) { return q.metrics && q.max_distance; },
     "{max-distance}: metrics are of all of A and B"},
    {[](const Question& q) { return q.max_distance && (q.area || q.asks_for_sides()); },
     "{max-distance}: only concerns figures and pictures: no {area}, no sides"},
    {[](const Question& q) { return q.max_distance && !q.statistics && !(q.map_pixels > 0); },
     "{max-distance}: concerns figures and pictures by cells, and none are asked for", true},
    {[](const Question& q) { return q.verify && q.is_by_face(); },
     "{verify}: not possible with {face-max}"},
    {[](const Question& q) { return q.area && q.is_by_face(); },
     "{area}: faces with limits of their own are asked about whole"},
    {[](const Question& q) { return q.symmetric && q.face_limits_a; },
     "{max}: limits of A's faces are no limits of B's; ask for each direction separately"},
    {[](const Question& q) { return q.certificate && (q.area || q.is_by_face()); },
     "{certificate}: is of the interval, not to be had with {area} or {face-max}"},
    {[](const Question& q) { return q.max_sides && q.symmetric; },
     "{symmetric}: limits of two sides are of A's points, over B or under it, and a dent of A is "
     "no dent of B; ask for each direction separately"},
    {[](const Question& q) { return q.max_sides && (q.is_by_face() || q.area); },
     "{max}: limits of two sides hold for every point: not possible by face or by area"},
    {[](const Question& q) { return q.part && q.align; },
     "{part}: needs a fixed place of A: find it once, by {align} and {save-transform}, and "
     "give it to each part by {transform}"},
    {[](const Question& q) { return q.part && (q.symmetric || q.worst || q.asks_for_cells()); },
     "{part}: one direction's interval is all that is to be had of a part: no {symmetric}, "
     "{stats}, {signed}, {bands}, {field-tol}, {field}, {image}, {report}, {figures-csv}, "
     "{points-out} or {certificate}"}};

const std::vector<Rule>& rules() {
  static const std::vector<Rule> known = [] {
    std::vector<Rule> all;
    for (auto* some : {rules_of_placement, rules_of_limits, rules_of_figures, rules_of_pictures,
                       rules_of_devices, rules_of_simplify})
      for (Rule& rule : some()) all.push_back(std::move(rule));
    return all;
  }();
  return known;
}

/// Puts names in place of what stands in braces.
std::string worded(std::string text, std::string_view option, const Naming& naming) {
  for (size_t at = 0; (at = text.find('{', at)) != std::string::npos;) {
    const size_t end = text.find('}', at);
    const std::string named = text.substr(at + 1, end - at - 1);
    text.replace(at, end + 1 - at, naming(named == "option" ? option : named));
  }
  return text;
}

void check_figure(const Question& question, const std::string& figure, const Naming& naming) {
  const std::string option = naming("figures") + " " + figure;
  const auto is_it = [&](const auto& named) { return figure == named.name; };
  const auto metric = std::find_if(kNamedMetrics.begin(), kNamedMetrics.end(), is_it);
  const auto share = std::find_if(kNamedShares.begin(), kNamedShares.end(), is_it);
  const bool is_share = share != kNamedShares.end();
  if (!is_share && metric == kNamedMetrics.end())
    throw UsageError(option + ": expected names of " + names_of_figures());
  if (is_share && question.bands.empty())
    throw UsageError(option + ": give its distances by " + naming("bands"));
  if ((is_share ? share->of_normals : metric->of_normals) && !question.metrics->normals)
    throw UsageError(option + ": give the angle by " + naming("normals"));
}

void refuse_natively_asked(const Question& question, const Naming& naming) {
  for (const OfDevices& one : kOfDevices) {
    if (one.is_asked(question))
      throw UsageError(worded("{option}: needs a Vulkan device, which {device} native is not",
                              one.option, naming));
  }
}

/// `is_all`: all members are filled in.
void check_question(const Question& question, const Naming& naming, bool is_all) {
  if (question.is_native()) refuse_natively_asked(question, naming);
  for (const QuestionRule& rule : kQuestionRules) {
    if ((is_all || !rule.is_of_all) && rule.when(question))
      throw UsageError(worded(rule.says, "", naming));
  }
  if (!question.metrics) return;
  for (const std::string& figure : question.metrics->figures)
    check_figure(question, figure, naming);
}

void complete_metrics(Request& asked, const Naming& naming) {
  if (!asked.metrics) return;
  asked.question.symmetric = true;
  asked.question.metrics = asked.metric_options;
  asked.question.metrics->figures = checked_figures(naming("figures"), asked.metric_options.figures,
                                                    asked.metric_options.percentile);
}

void complete_outputs(Request& asked) {
  Question& question = asked.question;
  const Outputs& outputs = asked.outputs;
  question.certificate = outputs.certificate.has_value();
  question.worst = question.worst || outputs.shows_cells();
  question.faces = question.faces || question.face_tolerance || outputs.field;
  question.statistics = question.statistics || outputs.report || outputs.figures;
  question.hashes = outputs.json || outputs.json_file || outputs.report || outputs.certificate;
}

void complete_batch(Request& asked) {
  Question& question = asked.question;
  if (!asked.has("tol")) question.tolerance = default_tolerance(question.max.has_value());
  question.statistics = question.is_signed;  // a line of results has figures
  if (asked.metrics && !question.budget.effort) question.budget.effort = kEffortOfMetrics;
}

}  // namespace

std::string with_dashes(std::string_view option) { return "--" + std::string(option); }

void check_together(const Request& asked, const Naming& naming) {
  for (const Rule& rule : rules()) {
    if ((rule.of & asked.command) == 0 || !rule.when(asked)) continue;
    const auto given = std::find_if(rule.options.begin(), rule.options.end(),
                                    [&](auto name) { return asked.has(name); });
    if (given != rule.options.end()) throw UsageError(worded(rule.says, *given, naming));
  }
}

void complete(Request& asked, const Naming& naming) {
  Question& question = asked.question;
  question.statistics = question.statistics || (!question.bands.empty() && !asked.metrics);
  question.several_devices = asked.command == kDistance;
  complete_metrics(asked, naming);
  complete_outputs(asked);
  if (asked.command == kBatch) complete_batch(asked);
  check_question(question, naming, false);
  if (asked.command != kSimplify) return;
  question.tolerance = default_tolerance(true);
  question.symmetric = !asked.simplify.one_way;
}

void check_question(const Question& question) {
  const Naming naming = [&](std::string_view option) {
    return question.option(std::string(option).c_str());
  };
  check_question(question, naming, true);
}

}  // namespace vkh
