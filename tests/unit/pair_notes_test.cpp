// The notes on a pair's boxes fire where docs/guide.md says, and nowhere else.
#include "host/answer/pair_notes.h"

#include <doctest/doctest.h>

namespace {

using namespace vkh;

Box box(glm::dvec3 size, glm::dvec3 centre = {}) {
  return {centre - 0.5 * size, centre + 0.5 * size};
}

std::vector<NoteCode> codes(const Box& a, const Box& b) {
  std::vector<NoteCode> found;
  for (const Note& note : notes_on_boxes(a, b, "mm")) found.push_back(note.code);
  return found;
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
        "A is 10 times larger than B, as centimetres and millimetres are: are both in "
        "one unit? --unit-a mm with --unit-b cm converts A");
}

TEST_CASE("size: an extent under 0.8 or over 1.25 times B's") {
  const Box b = box({100, 60, 10});
  CHECK(codes(box({81, 60, 10}), b).empty());
  CHECK(codes(box({79, 60, 10}, {-10, 0, 0}), b) == Codes{NoteCode::kSize});
  CHECK(codes(box({124, 60, 10}), b).empty());
  CHECK(codes(box({100, 60, 12.6}), b) == Codes{NoteCode::kSize});
  const std::vector<Note> half = notes_on_boxes(box({50, 60, 10}, {-25, 0, 0}), b, "mm");
  REQUIRE(half.size() == 2);  // the centres are apart, too
  CHECK(half[0].text == "A's extent in x is 50 % of B's: is one a part of the other?");
  CHECK(half[0].value == 0.5);
  CHECK(notes_on_boxes(b, box({100, 60, 0}), "")[0].text ==
        "A has an extent in z, and B has none: is one a part of the other?");
}

TEST_CASE("apart: boxes that do not meet, or centres a tenth of B's diagonal apart") {
  const Box b = box({100, 60, 10});
  CHECK(codes(box({100, 60, 10}, {11, 0, 0}), b).empty());
  CHECK(codes(box({100, 60, 10}, {12, 0, 0}), b) == Codes{NoteCode::kApart});
  const Note note = notes_on_boxes(box({100, 60, 10}, {0, 0, 10.5}), b, "mm")[0];
  CHECK(note.code == NoteCode::kApart);
  CHECK(note.value == 10.5);
  CHECK(note.unit == "mm");
  CHECK(note.text ==
        "the boxes of A and B do not meet: their centres are 10.5 mm apart: does A lie where B "
        "does?");
}

}  // namespace
