#include "host/answer/steps.h"

#include <algorithm>

#include "host/solve/switches.h"

namespace vkh {

EngineOptions engine_of(const Question& question) {
  const Length& tolerance = question.tolerance;
  EngineOptions engine = question.engine;
  const bool is_fine = tolerance.of == Length::Of::kDiagonal && tolerance.number < kFineTolerance;
  engine.fine = engine.fine || is_fine;
  engine.cells = engine.cells || question.asks_for_cells();
  engine.closest = engine.closest || question.align;
  engine.coverage = engine.coverage || question.verify;
  return engine;
}

SolveOptions run_options(const Question& question) {
  return {.time_limit_s = question.budget.time_limit_s,
          .wave_limit = question.budget.wave_limit,
          .memory_bytes = question.budget.memory_bytes,
          .engine = question.engine};
}

SolveOptions solve_options(const Question& question, const Answer& known) {
  SolveOptions options = run_options(question);
  options.engine = engine_of(question);
  options.tolerance_is_absolute = question.tolerance.of != Length::Of::kDiagonal;
  options.tolerance =
      options.tolerance_is_absolute ? known.a_to_b.tolerance : question.tolerance.number;
  // The survey decides a question about area.
  if (known.max && !known.max->area) options.limit = known.max->limit;
  // The surveys bound each distance: a search would narrow the largest one alone.
  if (question.metrics && !question.metrics->asks_for({"hausdorff"}))
    options.wave_limit = std::min(options.wave_limit, 1u);
  if (question.known_lower)
    options.known_lower =
        limit_in_files(*question.known_lower, question.option("known-lower").c_str(), known.unit,
                       diagonal_of_a(known))
            .within;
  return options;
}

void take_reports(const Question& question, StreamResult&& result, Answer& answer) {
  answer.a_to_b = std::move(result.a_to_b);
  answer.b_to_a = std::move(result.b_to_a);
  add_memory_notes(question.budget.memory_bytes, answer);
  answer.waits.total = answer.waits.read + answer.a_to_b.times.wall_ms +
                       (answer.b_to_a ? answer.b_to_a->times.wall_ms : 0);
}

bool is_cancelled(const Answer& answer) {
  return answer.a_to_b.status == Status::kCancelled ||
         (answer.b_to_a && answer.b_to_a->status == Status::kCancelled);
}

}  // namespace vkh
