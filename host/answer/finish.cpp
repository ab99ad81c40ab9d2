// The steps after a distance is enclosed: surveys of all of A, certificates, the host's own check.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>

#include "host/answer/steps.h"
#include "host/base/decimal.h"
#include "host/survey/map_shares.h"
#include "host/survey/metrics_of.h"
#include "host/survey/survey_with.h"
#include "host/survey/surveying.h"
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

/// A direction, and what to find for the mesh that it begins at.
struct Side {
  const Mesh& from;
  const Mesh& to;
  PairView view;
  const char* name;
  bool back;
  Report& report;
};

std::optional<Enclosure> map_range(const Finishing& at) {
  if (!at.question.map_range) return {};
  return range_in_files(*at.question.map_range, at.answer);
}

// Adds the shares that a picture of the map prints beside its colours. Its colour bar ends at the
// larger limit, or where the map says.
void add_shares(const Finishing& at, double upper, SurveyResult& survey) {
  if (!survey.map || survey.map->cells.empty()) return;
  BarOptions options{.upper = upper, .range = map_range(at)};
  if (at.answer.max) options.limit = at.answer.max->limit;
  if (at.answer.max && at.answer.max->sides) options.sided = at.answer.max->sides->limits;
  survey.shares = shares_of(*survey.map, bar_of(*survey.map, options));
}

// The colours of a picture end at one and a half times the limit, unless the user names the end.
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
}

// `left`: the number of surveys still to do, including this one.
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
  if (!has_figures) {  // only a share of area is asked for
    options.narrows_mean = options.narrows_rms = false;
    options.signed_tolerance = options.signed_floor = 1;
  }
  options.map = map_options(at);
  options.time_limit_s = survey_time(at, left);
  if (question.budget.effort) options.effort = *question.budget.effort;
  const bool on_cpu = at.solver.description().is_processor();
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

/// Calls `work`, which surveys. If there is no memory for it, adds a note.
template <class Work>
void survey_or_note(const Finishing& at, const std::string& name, SurveyEnd& ended,
                    const Work& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    ended = SurveyEnd::kMemory;
    note(at, NoteCode::kSurvey, "there was no memory to survey " + name);
  } catch (const MemoryError&) {
    ended = SurveyEnd::kMemory;
    note(at, NoteCode::kSurvey, "the device had no memory to survey " + name);
  }
}

SolveOptions survey_run(const Finishing& at) {
  SolveOptions run = at.options;
  run.progress = [&at](const Progress&) { return at.observer.is_to_go_on(); };
  return run;
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
void note_coverage(const Finishing& at, double beyond, Statistics& statistics) {
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

// The second survey uses the first one's shares to compute how narrow f1 is: its own shares need
// only be narrow enough for that.
void use_shares_of_a(const Finishing& at, const Side& side, SurveyOptions& options) {
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

/// The options of a survey after the search, and after the first survey where it is the second.
SurveyOptions options_for(const Finishing& at, const Side& side, size_t left) {
  SurveyOptions options = survey_options(at, side, left);
  use_shares_of_a(at, side, options);
  options.upper = side.report.upper;
  const std::optional<double> beyond = uncovered_beyond(at, side);
  if (beyond) options.bands.insert(options.bands.end(), 2, *beyond);
  return options;
}

/// Joins what a survey found to the report and the notes.
void join_survey(const Finishing& at, const Side& side, const SurveyOptions& options,
                 SurveyResult& result) {
  if (result.ended == SurveyEnd::kCancelled && at.observer.time_left_s() <= 0)
    result.ended = SurveyEnd::kTime;
  const std::optional<double> beyond = uncovered_beyond(at, side);
  join(side.report, result, side.from.faces.size());
  add_shares(at, side.report.upper, result);
  note_inside_out(at, side, result);
  if (beyond && result.statistics) note_coverage(at, *beyond, *result.statistics);
  if (options.statistics && !result.statistics)
    note(at, NoteCode::kSurvey, std::string("there are no statistics of ") + side.name);
}

void survey_side(const Finishing& at, const Side& side, size_t left, SurveyResult& result) {
  const SurveyOptions options = options_for(at, side, left);
  survey_or_note(at, side.name, result.ended, [&] {
    if (at.observer.is_to_go_on())
      hold_pair(at.solver, side.view, survey_run(at), survey_with(options, result));
  });
  join_survey(at, side, options, result);
}

/// Both surveys of a pair that has metrics, while both meshes lie on the device: the pooled
/// percentile goes on with the cells of either.
class Measuring {
 public:
  Measuring(const Finishing& at, const std::vector<Side>& sides)
      : at_(at),
        sides_(sides),
        results_{&at.answer.survey_a.emplace(), &at.answer.survey_b.emplace()} {}

  void run() {
    SurveyEnd ended = SurveyEnd::kCancelled;
    survey_or_note(at_, "both meshes", ended, [&] {
      const std::array<PairView, 2> views{sides_[0].view, sides_[1].view};
      if (at_.observer.is_to_go_on())
        hold_pairs(at_.solver, views, survey_run(at_), [&](std::span<const SurveyedPair> pairs) {
          measure(pairs);
          for (std::optional<Surveying>& survey : surveys_) survey.reset();
        });
    });
    for (size_t i = taken_; i < 2; ++i) {  // there was no memory for both, or no time
      results_[i]->ended = ended;
      take(i);
    }
    if (!has_both()) add_unknown_shares();
  }

 private:
  void measure(std::span<const SurveyedPair> pairs) {
    for (size_t i = 0; i < 2; ++i) {
      options_[i] = options_for(at_, sides_[i], 2 - i);
      survey_or_note(at_, sides_[i].name, results_[i]->ended, [&] {
        if (at_.observer.is_to_go_on())
          surveys_[i].emplace(pairs[i], options_[i]).run(*results_[i]);
      });
      take(i);
    }
    if (!has_both()) return;
    compute();
    narrow_pooled();
  }

  void take(size_t i) {
    join_survey(at_, sides_[i], options_[i], *results_[i]);
    ++taken_;
  }

  bool has_both() const { return results_[0]->statistics && results_[1]->statistics; }

  void compute() {
    const Distribution of_a = surveys_[0]->distribution(), of_b = surveys_[1]->distribution();
    at_.answer.metrics =
        metrics_of(*at_.question.metrics, {at_.answer.a_to_b, *results_[0]->statistics, of_a},
                   {*at_.answer.b_to_a, *results_[1]->statistics, of_b});
  }

  /// Splits the cells of both meshes around the pooled percentile, which may lie far from their own
  /// percentiles. The mesh that has more undecided area there comes first.
  void narrow_pooled() {
    constexpr int kMostTurns = 4;
    for (int turn = 0; turn < kMostTurns && at_.observer.is_to_go_on(); ++turn) {
      const Metric& pooled = at_.answer.metrics->hd_p_pooled;
      if (pooled.is_met || pooled.jump || !at_.answer.metrics->asks_for("hd_p_pooled")) return;
      const Distribution of_a = surveys_[0]->distribution(), of_b = surveys_[1]->distribution();
      const bool back = of_b.undecided_area(pooled.value) > of_a.undecided_area(pooled.value);
      if (!narrow(back ? 1 : 0, {.other = back ? &of_a : &of_b, .known = pooled.value})) return;
      compute();
    }
  }

  bool narrow(size_t i, PooledSearch search) {
    search.share = options_[i].percentiles[0];
    bool has_split = false;
    survey_or_note(at_, sides_[i].name, results_[i]->ended, [&] {
      has_split = surveys_[i]->narrow(search, survey_time(at_, 2), *results_[i]);
    });
    return has_split;
  }

  /// Adds the shares within each band as what is known of them without a survey: from 0 to 1.
  void add_unknown_shares() {
    for (const Limit& band : bands_of(at_.question, at_.answer)) {
      MetricsWithin& within = at_.answer.metrics->within.emplace_back();
      within.distance = typed_length({band.within, band.beyond});
      for (const NamedShare& share : kNamedShares) (within.*share.figure).value = {0, 1};
    }
  }

  const Finishing& at_;
  const std::vector<Side>& sides_;
  const std::array<SurveyResult*, 2> results_;
  std::array<SurveyOptions, 2> options_;
  std::array<std::optional<Surveying>, 2> surveys_;
  size_t taken_ = 0;
};

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
  std::vector<Side> sides{{meshes.a, meshes.b, meshes.view(), "A", false, answer.a_to_b}};
  if (answer.b_to_a)
    sides.push_back({meshes.b, meshes.a, meshes.view(true), "B", true, *answer.b_to_a});
  if (question.metrics && sides.size() == 2) {
    Measuring(at, sides).run();
  } else if (question.asks_for_survey()) {
    for (size_t i = 0; i < sides.size(); ++i)
      survey_side(at, sides[i], sides.size() - i,
                  (i == 0 ? answer.survey_a : answer.survey_b).emplace());
  }
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
