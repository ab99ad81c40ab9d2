// The steps after a distance is enclosed: surveys of all of A, certificates, the host's own check.
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "host/answer/steps.h"
#include "host/base/decimal.h"
#include "host/survey/distribution.h"
#include "host/survey/map_shares.h"
#include "host/survey/survey_with.h"
#include "vkhausdorff/certificate.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/note.h"
#include "vkhausdorff/verify.h"

namespace vkh {
namespace {

constexpr double kPartOfTime = 0.85;  // adding up and the outputs need the rest

Limit resolved(const Length& length, const char* option, const Answer& answer) {
  return in_files(length, option, answer.unit, diagonal_of_a(answer));
}

// Returns each band as two: rounded down, and up.
std::vector<Limit> bands_of(const Question& question, const Answer& answer) {
  std::vector<Limit> bands;
  if (answer.max && (question.area || question.statistics)) bands.push_back(answer.max->limit);
  for (const Length& band : question.bands) {
    bands.push_back(
        limit_in_files(band, question.option("bands").c_str(), answer.unit, diagonal_of_a(answer)));
  }
  return bands;
}

/// The state that the steps of one answer share.
struct Finishing {
  const Question& question;
  Solver& solver;
  const Observer& observer;
  const SolveOptions options;  ///< of the search
  Answer& answer;
};

double survey_time(const Finishing& at, size_t left) {
  if (at.question.budget.survey_time_s) return *at.question.budget.survey_time_s;
  const double time = at.observer.time_left_s();
  if (!std::isfinite(time)) return time;
  return kPartOfTime * std::max(time, 0.0) / static_cast<double>(left);
}

/// A direction, and what is to be found of the mesh that it begins at.
struct Side {
  const Mesh& from;
  const Mesh& to;
  const PreparedMesh* prepared;
  const char* name;
  bool back;
  Report& report;
};

std::optional<Enclosure> map_range(const Finishing& at) {
  if (!at.question.map_range) return {};
  return range_in_files(*at.question.map_range, at.answer);
}

// Adds the shares that a picture of the map names beside its colours. Its bar ends at the larger
// limit, or where the map says.
void add_shares(const Finishing& at, double upper, SurveyResult& survey) {
  if (!survey.map || survey.map->cells.empty()) return;
  BarOptions options{.upper = upper, .range = map_range(at)};
  if (at.answer.max) options.limit = at.answer.max->limit;
  if (at.answer.max && at.answer.max->sides) options.sided = at.answer.max->sides->limits;
  survey.shares = shares_of(*survey.map, bar_of(*survey.map, options));
}

// The colours of a picture go to one and a half times the limit, unless the user says where to.
std::optional<MapOptions> map_options(const Finishing& at) {
  constexpr double kBarOfLimit = 1.5;
  if (at.question.map_pixels <= 0) return {};
  MapOptions map{.pixels = at.question.map_pixels, .sides_if_cheap = at.question.map_sides};
  if (at.question.map_range) {
    map.bar = map_range(at)->upper;
  } else if (at.answer.max) {
    map.bar = kBarOfLimit * at.answer.max->limit.within;
  }
  return map;
}

// A share that is joined of two is wider by a rounding.
constexpr double kOfShareTolerance = 0.99 * MetricsOptions::kShareTolerance;

// The slope of f1 in a share is 2 at most, and both its shares are enclosed. Figures that are not
// asked for have no goal.
void ask_for_metrics(const MetricsOptions& metrics, SurveyOptions& options) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const bool has_shares = metrics.asks_for(
      {"nsd", "precision", "recall", "f1", "precision_normals", "recall_normals", "f1_normals"});
  const bool has_f1 = metrics.asks_for({"f1"});
  const double of_share = has_f1 ? MetricsOptions::kShareTolerance / 2 : kOfShareTolerance;
  options.area_tolerance = has_shares ? of_share : kNone;
  options.agreeing_tolerance = has_shares ? MetricsOptions::kShareTolerance / 2 : kNone;
  options.percentiles = {metrics.percentile / 100};
  options.mean_tolerance = MetricsOptions::kTolerance;
  options.narrows_mean = metrics.asks_for({"masd", "assd", "chamfer_l1"});
  options.narrows_rms = metrics.asks_for({"rms", "chamfer_l2"});
  options.narrows_percentiles = metrics.asks_for({"hd_p", "hd_p_pooled"});
  options.normals_within = metrics.normals;
  options.cosine_tolerance =
      metrics.asks_for({"normal_consistency"}) ? MetricsOptions::kNormalTolerance : kNone;
  options.keeps_distribution = true;
}

// `left`: the surveys that are still to come, this one among them.
SurveyOptions survey_options(const Finishing& at, const Side& side, size_t left) {
  const Question& question = at.question;
  SurveyOptions options;
  options.faces = question.faces;
  if (question.face_tolerance)
    options.field_tolerance =
        resolved(*question.face_tolerance, question.option("field-tol").c_str(), at.answer).within;
  if (at.answer.max && !at.answer.max->sides) options.limit = at.answer.max->limit;
  options.is_signed = question.is_signed;
  if (at.answer.max && at.answer.max->sides) options.sided = at.answer.max->sides->limits;
  const bool has_figures = question.statistics || question.metrics;
  options.statistics = has_figures || question.area;
  if (question.max_distance)
    options.max_distance =
        limit_in_files(*question.max_distance, question.option("max-distance").c_str(),
                       at.answer.unit, diagonal_of_a(at.answer));
  for (const Limit& band : bands_of(question, at.answer))
    options.bands.insert(options.bands.end(), {band.within, band.beyond});
  options.enough = question.area;
  if (question.metrics) ask_for_metrics(*question.metrics, options);
  if (!has_figures) options.percentiles.clear();
  if (!has_figures) {  // a share of area is all that is asked
    options.narrows_mean = options.narrows_rms = false;
    options.signed_tolerance = options.signed_floor = 1;
  }
  options.map = map_options(at);
  options.time_limit_s = survey_time(at, left);
  if (question.budget.effort) options.effort = *question.budget.effort;
  const bool on_cpu = at.solver.device().description().type == "cpu";
  SideCount heard{.back = side.back,
                  .faces = side.from.faces.size(),
                  .effort = question.budget.effort.value_or(default_effort(on_cpu))};
  options.goes_on = [&observer = at.observer, heard](size_t cells) mutable {
    heard.count = cells;
    if (observer.cells) observer.cells(heard);
    return observer.is_to_go_on();
  };
  return options;
}

// Joins both: a share that holds from a length rounded down up to it rounded up holds for it.
void join_bands(Statistics& s) {
  std::vector<AreaWithin> bands;
  for (size_t i = 0; i + 1 < s.bands.size(); i += 2) {
    const AreaWithin &down = s.bands[i], &up = s.bands[i + 1];
    AreaWithin band{typed_length({down.distance, up.distance}),
                    {down.share.lower, up.share.upper, down.share.estimate},
                    down.jump || up.jump};
    if (down.agreeing && up.agreeing)
      band.agreeing = {down.agreeing->lower, up.agreeing->upper, down.agreeing->estimate};
    bands.push_back(band);
  }
  s.bands = std::move(bands);
}

// Narrows the report, since a run that only decides a limit leaves a wide interval: no distance is
// above the largest bound of a face. A run that ended before its survey began has one bound for all
// faces.
void join(Report& report, SurveyResult& survey, size_t face_count) {
  Field& field = survey.field;
  if (field.face_count() != face_count) field = field_within(face_count, report.upper);
  report.upper = std::min(report.upper, *std::max_element(field.upper.begin(), field.upper.end()));
  if (survey.statistics) join_bands(*survey.statistics);
  if (!survey.sides) return;
  survey.sides->over.upper = std::min(survey.sides->over.upper, report.upper);
  survey.sides->under.upper = std::min(survey.sides->under.upper, report.upper);
}

void note(const Finishing& at, NoteCode code, const std::string& text) {
  at.answer.notes.push_back(note_of(code, text));
}

SurveyResult survey_of(const Finishing& at, const Side& side, const SurveyOptions& options) {
  SurveyResult result;
  result.ended = SurveyEnd::kCancelled;
  if (!at.observer.is_to_go_on()) return result;
  SolveOptions run = at.options;
  run.progress = [&](const Progress&) { return at.observer.is_to_go_on(); };
  try {
    hold_pair(at.solver, {.a = side.from, .b = side.to, .prepared = side.prepared}, run,
              survey_with(options, result));
  } catch (const std::bad_alloc&) {
    result.ended = SurveyEnd::kMemory;
    note(at, NoteCode::kSurvey, std::string("there was no memory to survey ") + side.name);
  } catch (const MemoryError&) {
    result.ended = SurveyEnd::kMemory;
    note(at, NoteCode::kSurvey, std::string("the device had no memory to survey ") + side.name);
  }
  return result;
}

/// The distance beyond which B is not covered by A: the limit, or a hundredth of A's diagonal where
/// that is larger. None unless B is surveyed for figures.
std::optional<double> uncovered_beyond(const Finishing& at, const Side& side) {
  if (&side.report == &at.answer.a_to_b || !at.question.statistics || at.question.max_distance)
    return std::nullopt;
  const double limit = at.answer.max ? at.answer.max->limit.beyond : 0;
  const double beyond = std::max(limit, 0.01 * at.answer.a_to_b.diagonal_a);
  return beyond > 0 && std::isfinite(beyond) ? std::optional(beyond) : std::nullopt;
}

/// Takes the last band out of the figures, and notes that more than a thousandth of B is beyond it.
void take_coverage(const Finishing& at, double beyond, Statistics& statistics) {
  constexpr double kLeast = 1e-3;
  const double share = 1 - statistics.bands.back().share.upper;
  statistics.bands.pop_back();
  if (!(share >= kLeast)) return;
  at.answer.notes.push_back(note_of(
      NoteCode::kCoverage,
      "at least " + decimal(100 * share, 3, Rounding::kDown) + " % of B's area is farther than " +
          with_unit(decimal(beyond, 3, Rounding::kDown), at.answer.unit) +
          " from A: does A lack a part of B?",
      {share, ""}));
}

// The second survey knows the first one's shares, and so how narrow f1 is: its own shares need not
// be narrower than that takes.
void take_shares_of_a(const Finishing& at, const Side& side, SurveyOptions& options) {
  const bool has_f1 = at.question.metrics && at.question.metrics->asks_for({"f1"});
  if (!side.back || !has_f1 || !at.answer.survey_a || !at.answer.survey_a->statistics) return;
  for (const AreaWithin& band : at.answer.survey_a->statistics->bands)
    options.other_shares.insert(options.other_shares.end(), 2, band.share);
  options.area_tolerance = kOfShareTolerance;
}

/// Notes that the other mesh is inside out where sides were found: over is then inside it.
void note_inside_out(const Finishing& at, const Side& side, const SurveyResult& result) {
  const InsideOut how = result.sides ? result.sides->inside_out
                        : result.map ? result.map->inside_out
                                     : InsideOut::kNone;
  if (how == InsideOut::kNone) return;
  const std::string other = side.back ? "A" : "B";
  const bool is_part = how == InsideOut::kPart;
  note(at, NoteCode::kInsideOut,
       (is_part ? "a part of " + other : other) + " is inside out, so that over means inside it: " +
           "its faces look inward; export it again with faces that look outward");
}

SurveyResult survey_side(const Finishing& at, const Side& side, size_t left) {
  SurveyOptions options = survey_options(at, side, left);
  take_shares_of_a(at, side, options);
  options.upper = side.report.upper;
  const std::optional<double> beyond = uncovered_beyond(at, side);
  if (beyond) options.bands.insert(options.bands.end(), 2, *beyond);
  SurveyResult result = survey_of(at, side, options);
  if (result.ended == SurveyEnd::kCancelled && at.observer.time_left_s() <= 0)
    result.ended = SurveyEnd::kTime;
  join(side.report, result, side.from.faces.size());
  add_shares(at, side.report.upper, result);
  note_inside_out(at, side, result);
  if (beyond && result.statistics) take_coverage(at, *beyond, *result.statistics);
  if (options.statistics && !result.statistics)
    note(at, NoteCode::kSurvey, std::string("there are no statistics of ") + side.name);
  return result;
}

void compute_metrics(const MetricsOptions& options, Answer& answer) {
  const SurveyResult &a = *answer.survey_a, &b = *answer.survey_b;
  answer.metrics = metrics_of(options, {answer.a_to_b, *a.statistics, *a.distribution},
                              {*answer.b_to_a, *b.statistics, *b.distribution});
}

/// Goes on with a survey until the pooled percentile is narrow, or the other mesh's cells are more
/// in its way. Returns whether cells were split. The reason why the survey ended stays.
bool go_on_for_pooled(const Finishing& at, const Side& side, SurveyResult& found,
                      const Distribution& other) {
  SurveyOptions options = survey_options(at, side, 2);
  const size_t spent = found.bounded - std::min(found.bounded, side.from.faces.size());
  options.upper = side.report.upper;
  options.effort = found.effort - std::min(found.effort, spent);
  options.pooled = PooledSearch{.cells = found.distribution.get(),
                                .other = &other,
                                .share = options.percentiles[0],
                                .known = at.answer.metrics->hd_p_pooled.value};
  SurveyResult more = survey_of(at, side, options);
  if (!more.distribution) {  // the cells may be lost: the figures stay as they are
    found.distribution.reset();
    return false;
  }
  join(side.report, more, side.from.faces.size());
  const bool has_split = more.cells > found.cells;
  more.bounded += found.bounded;
  more.ms += found.ms;
  more.effort = found.effort;
  more.ended = found.ended;
  found = std::move(more);
  return has_split;
}

/// Splits the cells of both meshes around the pooled percentile, which may lie far from their own
/// percentiles: first those of the mesh that has more undecided area there.
void narrow_pooled(const Finishing& at, const std::vector<Side>& sides) {
  constexpr int kMostTurns = 4;
  SurveyResult &a = *at.answer.survey_a, &b = *at.answer.survey_b;
  bool goes_on = true;
  for (int turn = 0; goes_on && turn < kMostTurns && at.observer.is_to_go_on(); ++turn) {
    const Metric& pooled = at.answer.metrics->hd_p_pooled;
    if (pooled.is_met || pooled.jump || !at.answer.metrics->asks_for("hd_p_pooled")) return;
    const bool back =
        b.distribution->undecided_area(pooled.value) > a.distribution->undecided_area(pooled.value);
    goes_on = go_on_for_pooled(at, sides[back ? 1 : 0], back ? b : a,
                               back ? *a.distribution : *b.distribution);
    if (!a.distribution || !b.distribution) return;
    compute_metrics(*at.question.metrics, at.answer);
  }
}

/// Adds the shares within each band as what is known of them without a survey: from 0 to 1.
void add_unknown_shares(const Finishing& at) {
  for (const Limit& band : bands_of(at.question, at.answer)) {
    MetricsWithin& within = at.answer.metrics->within.emplace_back();
    within.distance = typed_length({band.within, band.beyond});
    for (const NamedShare& share : kNamedShares) (within.*share.figure).value = {0, 1};
  }
}

/// Computes the metrics from both surveys, and frees what only they needed. A survey that ended
/// before it had figures leaves them unknown.
void take_metrics(const Finishing& at, const std::vector<Side>& sides) {
  SurveyResult &a = *at.answer.survey_a, &b = *at.answer.survey_b;
  if (a.distribution && b.distribution) {
    compute_metrics(*at.question.metrics, at.answer);
    narrow_pooled(at, sides);
  } else {
    add_unknown_shares(at);
  }
  a.distribution.reset();
  b.distribution.reset();
}

std::optional<Proof> prove_side(const Finishing& at, const Side& side) {
  std::optional<Proof> proof;
  if (!std::isfinite(side.report.upper)) return proof;
  try {
    const auto goes_on = [&](size_t leaves) {
      const SideCount heard{.back = side.back, .count = leaves, .faces = side.from.faces.size()};
      if (at.observer.leaves) at.observer.leaves(heard);
      return at.observer.is_to_go_on();
    };
    proof = prove(at.solver, {side.from, side.to, side.report, at.options, goes_on});
  } catch (const std::bad_alloc&) {
    note(at, NoteCode::kCertificate, "there was no memory for a certificate");
  } catch (const MemoryError&) {
    note(at, NoteCode::kCertificate, "the device had no memory for a certificate");
  }
  if (proof && at.question.asks_for_sides())
    note(at, NoteCode::kCertificate, "the certificate proves distances, not sides");
  if (proof && proof->upper > side.report.upper)
    note(at, NoteCode::kCertificate,
         "the certificate proves less: " + side.from.name + " is within " +
             shortest_decimal(proof->upper));
  return proof;
}

void verify(const Side& side) {
  if (side.report.has_witness)
    side.report.witness_check = verify_witness(side.from, side.to, side.report);
}

}  // namespace

double Observer::time_left_s() const {
  return left_s ? left_s() : std::numeric_limits<double>::infinity();
}

void finish(const Question& question, Solver& solver, const AskedMeshes& meshes,
            const Observer& observer, Answer& answer) {
  const Finishing at{question, solver, observer, solve_options(question, answer), answer};
  std::vector<Side> sides{{meshes.a, meshes.b, meshes.prepared, "A", false, answer.a_to_b}};
  if (answer.b_to_a) sides.push_back({meshes.b, meshes.a, nullptr, "B", true, *answer.b_to_a});
  for (size_t i = 0; question.asks_for_survey() && i < sides.size(); ++i)
    (i == 0 ? answer.survey_a : answer.survey_b) = survey_side(at, sides[i], sides.size() - i);
  if (question.metrics && answer.survey_a && answer.survey_b) take_metrics(at, sides);
  if (observer.found) observer.found(answer);
  for (size_t i = 0; question.certificate && i < sides.size(); ++i)
    (i == 0 ? answer.proof_a : answer.proof_b) = prove_side(at, sides[i]);
  for (size_t i = 0; question.verify && i < sides.size(); ++i) verify(sides[i]);
}

std::string certificate_text(const Answer& answer, const AskedMeshes& meshes) {
  if (!answer.proof_a || answer.b_to_a.has_value() != answer.proof_b.has_value())
    throw OutputError("the run ended before there was a certificate");
  std::optional<CertifiedDirection> back;
  if (answer.b_to_a) back.emplace(CertifiedDirection{*answer.b_to_a, *answer.proof_b});
  return certificate_of({meshes.a, answer.inputs[0].sha256}, {meshes.b, answer.inputs[1].sha256},
                        {answer.a_to_b, *answer.proof_a}, back);
}

}  // namespace vkh
