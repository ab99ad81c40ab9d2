// An Asking: the answer of the steps, known at any time, ended by its caller, a token or its end.
#include "vkhausdorff/asking.h"

#include <doctest/doctest.h>

#include <chrono>

#include "host/answer/steps.h"
#include "tests/shapes/shapes.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using namespace vkh::test;

using Clock = std::chrono::steady_clock;

std::shared_ptr<const ReadMesh> shared(Mesh mesh) {
  return std::make_shared<const ReadMesh>(std::move(mesh));
}

struct OnDevice {
  Device device;
  Solver solver{device};
  std::shared_ptr<const ReadMesh> a = shared(translated(height_field(24, 1), {0, 0, 0.05}));
  std::shared_ptr<const ReadMesh> b = shared(height_field(24, 3));
};

/// The same by the steps themselves.
Answer by_steps(OnDevice& on, const Question& question) {
  Answer answer = unread_answer(question);
  begin_answer(question, shaped(on.a), shaped(on.b), answer);
  Solver* const solvers[] = {&on.solver};
  solve(question, solvers, {*on.a, *on.b}, {}, answer);
  finish(question, on.solver, {*on.a, *on.b}, {}, answer);
  return answer;
}

TEST_CASE("its answer is that of the steps") {
  OnDevice on;
  Question question;
  question.symmetric = true;
  question.faces = true;
  question.statistics = true;
  question.certificate = true;
  question.verify = true;
  question.budget.effort = 5000;
  Solver* const solvers[] = {&on.solver};
  const Asking asking(question, on.a, on.b, solvers);
  const Answer found = asking.answer();
  const Answer expected = by_steps(on, question);
  CHECK(found.a_to_b.lower == expected.a_to_b.lower);
  CHECK(found.a_to_b.upper == expected.a_to_b.upper);
  CHECK(found.b_to_a->upper == expected.b_to_a->upper);
  CHECK(found.survey_a->field.upper == expected.survey_a->field.upper);
  CHECK(found.survey_b->statistics->mean.lower == expected.survey_b->statistics->mean.lower);
  CHECK(found.proof_a->blocks == expected.proof_a->blocks);
  CHECK(found.a_to_b.witness_check->holds);
  CHECK(found.command == "distance");
  CHECK(asking.done().fraction == 1);
  CHECK(asking.done().upper == interval_of(found).upper);
  CHECK(asking.wait(Clock::time_point::min()));
}

/// A question that takes far longer than any test.
Question endless() {
  Question question;
  question.faces = true;
  question.face_tolerance = Length{.requested = "1e-12", .number = 1e-12};
  question.budget.effort = size_t{1} << 40;
  return question;
}

/// Waits until its survey has begun.
void wait_for_survey(const Asking& asking) {
  while (asking.done().fraction <= 0.5)
    REQUIRE(!asking.wait(Clock::now() + std::chrono::milliseconds(5)));
}

TEST_CASE("it is ended by its caller, a token or its end") {
  OnDevice on;
  Solver* const solvers[] = {&on.solver};
  const double h = by_steps(on, Question()).a_to_b.lower;
  const auto holds = [&](const Answer& answer) {
    CHECK(answer.a_to_b.upper >= h);
    CHECK(answer.a_to_b.lower <= h * (1 + 1e-6));
  };
  {
    Asking asking(endless(), on.a, on.b, solvers);
    wait_for_survey(asking);
    CHECK_FALSE(asking.wait(Clock::now()));
    holds(asking.known());
    asking.cancel();
    holds(asking.answer());
    CHECK(asking.answer().a_to_b.status == Status::kClosed);
    CHECK(asking.answer().survey_a->ended == SurveyEnd::kCancelled);
    CHECK(asking.known().survey_a.has_value());
  }
  {
    std::stop_source source;
    const Asking asking(endless(), on.a, on.b, solvers, source.get_token());
    wait_for_survey(asking);
    source.request_stop();
    holds(asking.answer());
  }
  {
    const Asking asking(endless(), on.a, on.b, solvers);
    wait_for_survey(asking);
  }  // waits for its thread
  std::stop_source stopped;
  stopped.request_stop();
  const Asking none(endless(), on.a, on.b, solvers, stopped.get_token());
  holds(none.answer());
  // A fast device may close the pair before it hears of the stop.
  const std::optional<SurveyResult> survey = none.answer().survey_a;
  CHECK((!survey || survey->ended == SurveyEnd::kCancelled));
}

TEST_CASE("limits of faces, a length's unit and a matrix are the question's") {
  OnDevice on;
  Solver* const solvers[] = {&on.solver};
  Question question;
  question.max = Length{.requested = "1abs", .number = 1, .of = Length::Of::kFiles};
  question.face_limits_a.emplace(on.a->faces.size(), Limit{0.5, 0.5});
  const Answer faces = Asking(question, on.a, on.b, solvers).answer();
  CHECK(faces.command == "gate");
  CHECK(verdict_of(faces) == Verdict::kWithin);
  CHECK(faces.max->faces_a->within == on.a->faces.size());
  Question moved;
  moved.transform = MatrixRows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 8}}};
  CHECK(Asking(moved, on.a, on.b, solvers).answer().a_to_b.lower > 7);
}

TEST_CASE("several solvers share A") {
  OnDevice on;
  Device second;
  Solver other(second);
  Solver* const solvers[] = {&on.solver, &other};
  Question question;
  question.statistics = true;
  question.budget.effort = 1000;
  const Answer two = Asking(question, on.a, on.b, solvers).answer();
  const Answer one = by_steps(on, question);
  CHECK(two.a_to_b.status == Status::kClosed);
  CHECK(two.a_to_b.lower <= one.a_to_b.upper);
  CHECK(one.a_to_b.lower <= two.a_to_b.upper);
  CHECK(two.survey_a->statistics.has_value());
  question.symmetric = true;
  const Asking refused(question, on.a, on.b, solvers);
  CHECK_THROWS_WITH_AS(refused.answer(), doctest::Contains("symmetric: over several devices"),
                       UsageError);
}

TEST_CASE("what is wrong is thrown by answer(), each time") {
  OnDevice on;
  Solver* const solvers[] = {&on.solver};
  Question question;
  question.max = Length{.requested = "1mm", .number = 1, .of = Length::Of::kUnit, .unit = "mm"};
  const Asking asking(question, on.a, on.b, solvers);
  for (int i = 0; i < 2; ++i)
    CHECK_THROWS_WITH_AS(asking.answer(), doctest::Contains("max"), UsageError);
  CHECK(asking.known().a_to_b.upper == std::numeric_limits<double>::infinity());
  CHECK_THROWS_AS(Asking(question, nullptr, on.b, solvers), UsageError);
  CHECK_THROWS_AS(Asking(question, on.a, on.b, {}), UsageError);
}

}  // namespace

TEST_CASE("what a question's engine has on stays on in its runs") {
  Question question;
  CHECK(!engine_of(question).fine);
  question.engine = {.fine = true, .cells = true, .coverage = true};
  const EngineOptions engine = engine_of(question);
  CHECK(engine.fine);
  CHECK(engine.cells);
  CHECK(engine.coverage);
}
