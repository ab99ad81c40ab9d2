// The notes on a pair fire where docs/formats.md says, and nowhere else.
#include "host/answer/pair_notes.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "tests/shapes/shapes.h"

namespace {

using namespace vkh;
using namespace vkh::test;

Box box(glm::dvec3 size, glm::dvec3 centre = {}) {
  return {centre - 0.5 * size, centre + 0.5 * size};
}

std::vector<Note> notes_on_boxes(const Box& a, const Box& b, const std::string& unit) {
  return notes_on_pair({a}, {b}, unit);
}

std::vector<NoteCode> codes(const std::vector<Note>& notes) {
  std::vector<NoteCode> found;
  for (const Note& note : notes) found.push_back(note.code);
  return found;
}
std::vector<NoteCode> codes(const Box& a, const Box& b) {
  return codes(notes_on_boxes(a, b, "mm"));
}

using Codes = std::vector<NoteCode>;

TEST_CASE("a pair of one size at one place has no notes") {
  CHECK(codes(box({100, 60, 10}), box({100, 60, 10})).empty());
  CHECK(codes(box({100.4, 59.7, 10.2}, {3, 0, 0}), box({100, 60, 10})).empty());
  // A flat one and its noisy scan: the third axis does not count.
  CHECK(codes(box({100, 60, 0.09}), box({100, 60, 0})).empty());
  CHECK(codes(box({0, 0, 0}), box({0, 0, 0})).empty());
}

TEST_CASE("units: a factor between units, to 2 % of the diagonal and 10 % of each axis") {
  const Box b = box({100, 60, 10});
  for (const double factor : {25.4, 10.0, 100.0, 1000.0}) {
    for (const double off : {0.985, 1.0, 1.015}) {
      CHECK(codes(box({100 * factor * off, 60 * factor, 10 * factor}), b) ==
            Codes{NoteCode::kUnits});
      CHECK(codes(box({100 / factor * off, 60 / factor, 10 / factor}), b) ==
            Codes{NoteCode::kUnits});
    }
    CHECK(codes(box({100 * factor * 1.03, 60 * factor, 10 * factor}), b) == Codes{NoteCode::kSize});
    CHECK(codes(box({100 * factor, 60, 10}), b) == Codes{NoteCode::kSize});
    // The noise of a scan makes a thin part thicker, and its place is in its unit, too.
    const DVec3 away = {500, 20, 0};
    CHECK(codes(box({100 / factor, 60 / factor, 10.8 / factor}, away / factor),
                box({100, 60, 10}, away)) == Codes{NoteCode::kUnits});
    CHECK(codes(box({100 / factor, 60 / factor, 11.2 / factor}), b) == Codes{NoteCode::kSize});
  }
  const Note note = notes_on_boxes(box({1000, 600, 100}), b, "mm")[0];
  CHECK(note.value == 10.0);
  CHECK(note.text ==
        "A is 10 times larger than B, as if A were in millimetres and B in centimetres: "
        "--unit-a mm and --unit-b cm convert A");
}

TEST_CASE("size: an extent under 0.8 or over 1.25 times B's") {
  const Box b = box({100, 60, 10});
  CHECK(codes(box({81, 60, 10}), b).empty());
  CHECK(codes(box({79, 60, 10}, {-10, 0, 0}), b) == Codes{NoteCode::kSize});
  CHECK(codes(box({124, 60, 10}), b).empty());
  CHECK(codes(box({100, 60, 12.6}), b) == Codes{NoteCode::kSize});
  const std::vector<Note> half = notes_on_boxes(box({50, 60, 10}, {-25, 0, 0}), b, "mm");
  REQUIRE(half.size() == 2);  // the centres are apart, too
  CHECK(half[0].text == "A's extent in x is 50 % of B's: does A lack something of B?");
  CHECK(half[0].value == 0.5);
  CHECK(notes_on_boxes(b, box({100, 60, 0}), "")[0].text ==
        "A has an extent in z, and B has none: does A hold more than B?");
}

TEST_CASE("apart: boxes a hundredth of B's diagonal apart, or centres a tenth") {
  const Box b = box({100, 60, 10});
  CHECK(codes(box({100, 60, 10}, {11, 0, 0}), b).empty());
  CHECK(codes(box({100, 60, 10}, {12, 0, 0}), b) == Codes{NoteCode::kApart});
  // Flat parts a hair apart, and farther: the diagonal is 116.6.
  CHECK(codes(box({100, 60, 0}, {0, 0, 1.1}), box({100, 60, 0})).empty());
  CHECK(codes(box({100, 60, 0}, {0, 0, 1.2}), box({100, 60, 0})) == Codes{NoteCode::kApart});
  const Note note = notes_on_boxes(box({100, 60, 10}, {0, 0, 11.5}), b, "mm")[0];
  CHECK(note.code == NoteCode::kApart);
  CHECK(note.value == 11.5);
  CHECK(note.unit == "mm");
  CHECK(note.text ==
        "the boxes of A and B do not meet, and their centres are 11.5 mm apart, A's by (0, 0, "
        "11.5): does A lie where B does?");
  CHECK(clause_of(note) ==
        "the boxes of A and B do not meet, and their centres are 11.5 mm apart, A's by (0, 0, "
        "11.5)");
  const Note far = notes_on_boxes(box({100, 60, 10}, {3e300, 0, 4e300}), b, "mm").back();
  CHECK(far.code == NoteCode::kApart);
  CHECK(far.value == doctest::Approx(5e300));
}

Mesh brick(const glm::dvec3& size, double degrees = 0, const glm::dvec3& axis = {0, 0, 1}) {
  Mesh straight = cube(0.5);
  for (DVec3& v : straight.vertices) v = glm::dvec3(v) * size;
  return rotated(straight, glm::normalize(axis), degrees * std::numbers::pi / 180);
}

TEST_CASE("turn: principal axes that are turned, of one shape") {
  const MeshShape b = shape_of(brick({100, 60, 10}));
  for (const double degrees : {0.3, 1.0, 5.0, 30.0, 60.0}) {
    for (const glm::dvec3 axis : {glm::dvec3{0, 0, 1}, {1, 0, 0}, {1, 2, 3}}) {
      CAPTURE(degrees);
      const std::vector<Note> notes =
          notes_on_pair(shape_of(brick({100, 60, 10}, degrees, axis)), b, "mm");
      CHECK(codes(notes) == Codes{NoteCode::kTurn});  // in place of size
      CHECK(notes[0].value.value_or(0) == doctest::Approx(degrees).epsilon(1e-9));
    }
  }
  CHECK(notes_on_pair(shape_of(brick({100, 60, 10}, 1)), b, "mm")[0].text ==
        "A is turned by about 1 degree against B, going by their principal axes: does A lie as B "
        "does?");
  CHECK(notes_on_pair(shape_of(brick({100, 60, 10}, 0.2)), b, "mm").empty());
  // After a fit, axes that are turned tell of another shape.
  CHECK(codes(notes_on_pair(shape_of(brick({100, 60, 10}, 1)), b, "mm", "--unit", true)).empty());
  // Half turns are not seen, and a square one is the same after a quarter of a turn.
  CHECK(notes_on_pair(shape_of(brick({100, 60, 10}, 180)), b, "mm").empty());
  const MeshShape square = shape_of(brick({100, 100, 10}));
  CHECK(notes_on_pair(shape_of(brick({100, 100, 10}, 10)), square, "mm").empty());
  CHECK(codes(notes_on_pair(shape_of(brick({100, 100, 10}, 10, {1, 0, 0})), square, "mm")) ==
        Codes{NoteCode::kTurn});
  CHECK(notes_on_pair(shape_of(brick({100, 100, 100}, 10)), shape_of(brick({100, 100, 100})), "mm")
            .empty());
  // A stray triangle makes the box larger, and hardly moves the axes.
  const Mesh stray = single_triangle({0, 0, 30}, {0, 0.1, 30}, {0.1, 0, 30});
  const std::vector<Note> notes =
      notes_on_pair(shape_of(joined(brick({100, 60, 10}), stray)), b, "mm");
  REQUIRE(codes(notes) == Codes{NoteCode::kSize, NoteCode::kApart});
  CHECK(notes[0].text ==
        "A's extent in z is 350 % of B's, though their surfaces are alike: has A stray faces?");
  CHECK(clause_of(notes[0]) == "A's extent in z is 350 % of B's");
  // Another shape has other axes.
  CHECK(!turn_between(principal_axes_of(brick({100, 66, 10}, 5)), b.axes));
}

}  // namespace
