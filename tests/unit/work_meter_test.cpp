// A WorkMeter's fraction never falls, its interval never widens, and 1 comes with the answer.
#include "vkhausdorff/work_meter.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <vector>

namespace {

using namespace vkh;

Answer known_answer(bool symmetric) {
  Answer answer;
  answer.a_to_b.upper = 8;
  answer.a_to_b.tolerance = 1e-3;
  if (symmetric) answer.b_to_a = answer.a_to_b;
  return answer;
}

Answer found_answer(bool symmetric) {
  Answer answer = known_answer(symmetric);
  answer.a_to_b.lower = 1;
  answer.a_to_b.upper = 1.0005;
  if (symmetric) answer.b_to_a->lower = 2;
  if (symmetric) answer.b_to_a->upper = 2.0005;
  return answer;
}

/// Checks each step against the one before.
struct Checked {
  Checked(const Question& question, bool symmetric)
      : meter(question, known_answer(symmetric)), last(meter.done()) {}
  void check() {
    CHECK(meter.done().fraction >= last.fraction);
    CHECK(meter.done().lower >= last.lower);
    CHECK(meter.done().upper <= last.upper);
    last = meter.done();
  }
  void search(double lower, double upper, bool back = false) {
    meter.hear({.lower = lower, .upper = upper, .back = back});
    check();
  }
  void take(bool symmetric) {
    meter.take(found_answer(symmetric));
    check();
  }

  WorkMeter meter;
  WorkDone last;
};

TEST_CASE("one direction is one step") {
  Checked one(Question(), false);
  CHECK(one.last.fraction == 0);
  CHECK(one.last.upper == 8);
  one.search(0, 8);
  CHECK(one.last.fraction == 0);
  one.search(0.5, 1.5);
  CHECK(one.last.fraction > 0.2);
  CHECK(one.last.fraction < 0.3);  // log(8) / log(8000)
  one.search(0.2, 4);              // of another search: what is known stays
  CHECK(one.last.lower == 0.5);
  CHECK(one.last.upper == 1.5);
  one.take(false);
  CHECK(one.last.fraction == 1);
  CHECK(one.last.lower == 1);
  CHECK(one.last.upper == 1.0005);
}

TEST_CASE("both directions, surveys and certificates count the same") {
  Question question;
  question.symmetric = true;
  question.statistics = true;
  question.certificate = true;
  Checked all(question, true);
  all.search(1, 1.5);
  CHECK(all.last.upper == 8);  // of B to A nothing is known yet
  CHECK(all.last.fraction < 1.0 / 6);
  all.search(2, 2.5, true);
  CHECK(all.last.upper == 2.5);
  CHECK(all.last.lower == 2);
  CHECK(all.last.fraction > 1.0 / 6);
  all.take(true);
  all.take(true);
  CHECK(all.last.fraction == doctest::Approx(2.0 / 6));
  for (const bool back : {false, true}) {
    for (const size_t count : std::initializer_list<size_t>{1, 50, 100, 1000, 10100}) {
      all.meter.hear_cells({.back = back, .count = count, .faces = 100, .effort = 10000});
      all.check();
    }
    CHECK(all.last.fraction == doctest::Approx(back ? 4.0 / 6 : 3.0 / 6));
  }
  all.take(true);
  for (const size_t count : std::initializer_list<size_t>{0, 100, 100000}) {
    all.meter.hear_leaves({.count = count, .faces = 100});
    all.check();
    CHECK(all.last.fraction < 5.0 / 6);
  }
  all.meter.hear_leaves({.back = true, .count = 100, .faces = 100});
  all.check();
  CHECK(all.last.fraction == doctest::Approx(5.5 / 6));
  all.meter.end(found_answer(true));
  all.check();
  CHECK(all.last.fraction == 1);
  CHECK(all.last.upper == 2.0005);
}

TEST_CASE("the search for the worst point is a step of its own") {
  Question question;
  question.max = Length{.requested = "0.1", .number = 0.1};
  question.worst = true;
  Checked worst(question, false);
  worst.search(0.2, 8);
  worst.take(false);
  CHECK(worst.last.fraction == 0.5);
  worst.search(0, 8);
  CHECK(worst.last.fraction == 0.5);
  worst.search(1, 1.001);
  CHECK(worst.last.fraction > 0.9);
  worst.take(false);
  CHECK(worst.last.fraction == 1);
}

TEST_CASE("limits by face bound nothing before they are decided") {
  Question question;
  question.face_limits_a.emplace();
  Checked faces(question, false);
  faces.search(1, 1.001);
  CHECK(faces.last.fraction == 0);
  CHECK(faces.last.upper == 8);
}

TEST_CASE("a point, a tolerance of 0 and unbounded meshes have a fraction") {
  Answer point = known_answer(false);
  point.a_to_b.upper = 0;
  point.a_to_b.tolerance = 0;
  WorkMeter of_point(Question(), point);
  of_point.hear({.lower = 0, .upper = 0});
  CHECK(of_point.done().fraction == 1);
  Answer wide = known_answer(false);
  wide.a_to_b.upper = std::numeric_limits<double>::infinity();
  WorkMeter of_wide(Question(), wide);
  of_wide.hear({.lower = 1, .upper = 2});
  CHECK(of_wide.done().fraction == 0);
  CHECK(of_wide.done().upper == 2);
}

}  // namespace
