#include "host/answer/pair_notes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "host/base/decimal.h"
#include "host/base/hypot3.h"

namespace vkh {
namespace {

constexpr double kNoExtent = 1e-3;  // of the smaller diagonal
constexpr double kSmaller = 0.8, kLarger = 1.25;
constexpr double kAlike = 0.01;      // of the largest variance
constexpr double kUnitError = 0.02;  // of the diagonals' ratio
constexpr double kAxisError = 0.1;   // of an axis's: a scan of a thin part is thicker by its noise
constexpr double kApart = 0.1;       // of B's diagonal, between the centres
constexpr double kDisjoint = 0.01;   // of B's diagonal, between the boxes

std::string number(double value) { return number_text(value, std::chars_format::general, 4); }

std::string short_number(double value) { return number_text(value, std::chars_format::general, 3); }

/// A's extent over B's on each axis that counts.
struct Ratio {
  char axis;
  double of_extents;
};

std::vector<Ratio> ratios(const Box& a, const Box& b) {
  const double least = kNoExtent * std::min(diagonal(a), diagonal(b));
  std::vector<Ratio> all;
  for (int i = 0; i < 3; ++i) {
    const double from_a = a.hi[i] - a.lo[i], from_b = b.hi[i] - b.lo[i];
    if (std::max(from_a, from_b) > least) all.push_back({"xyz"[i], from_a / from_b});
  }
  return all;
}

/// The factor between two units by which the diagonals differ, and about by which each extent does.
std::optional<double> unit_factor(const Box& a, const Box& b, const std::vector<Ratio>& all) {
  const double of_diagonals = diagonal(a) / diagonal(b);
  const auto is_near = [](double ratio, double factor, double error) {
    return std::abs(ratio / factor - 1) <= error;
  };
  for (const double factor : {25.4, 10.0, 100.0, 1000.0}) {
    for (const double ratio : {factor, 1 / factor}) {
      const bool are_alike = std::all_of(all.begin(), all.end(), [&](const Ratio& r) {
        return is_near(r.of_extents, ratio, kAxisError);
      });
      if (are_alike && is_near(of_diagonals, ratio, kUnitError)) return ratio;
    }
  }
  return std::nullopt;
}

/// The units that differ by such a factor, the larger one first.
struct UnitPair {
  const char *larger, *smaller;  ///< as options name them
  const char *in_words_larger, *in_words_smaller;
};

UnitPair units_by(double times) {
  if (times == 25.4) return {"in", "mm", "inches", "millimetres"};
  if (times == 10) return {"cm", "mm", "centimetres", "millimetres"};
  if (times == 100) return {"m", "cm", "metres", "centimetres"};
  return {"m", "mm", "metres", "millimetres"};
}

/// A's numbers are the smaller ones where its unit is the larger.
Note note_on_units(double factor, const std::string& option) {
  const bool is_larger = factor > 1;
  const double times = is_larger ? factor : 1 / factor;
  const UnitPair units = units_by(times);
  const char* const words_a = is_larger ? units.in_words_smaller : units.in_words_larger;
  const char* const words_b = is_larger ? units.in_words_larger : units.in_words_smaller;
  const std::string text = "A is " + number(times) + " times " +
                           (is_larger ? "larger" : "smaller") + " than B, as if A were in " +
                           words_a + " and B in " + words_b + ": " + option + "-a " +
                           (is_larger ? units.smaller : units.larger) + " and " + option + "-b " +
                           (is_larger ? units.larger : units.smaller) + " convert A";
  return note_of(NoteCode::kUnits, text, {factor, ""});
}

/// Asks about stray points if the surfaces are alike except for their boxes, and otherwise about
/// parts.
std::string question_on_size(const Ratio& worst, bool is_alike) {
  const bool is_larger = worst.of_extents > 1;
  if (is_alike)
    return std::string(", though their surfaces are alike: has ") + (is_larger ? "A" : "B") +
           " stray faces?";
  return is_larger ? ": does A hold more than B?" : ": does A lack something of B?";
}

std::optional<Note> note_on_size(const std::vector<Ratio>& all, bool is_alike) {
  const Ratio* worst = nullptr;
  const auto how_odd = [](const Ratio& r) { return std::abs(std::log(r.of_extents)); };
  for (const Ratio& r : all) {
    const bool is_odd = r.of_extents < kSmaller || r.of_extents > kLarger;
    if (is_odd && (worst == nullptr || how_odd(r) > how_odd(*worst))) worst = &r;
  }
  if (worst == nullptr) return std::nullopt;
  const std::string text =
      std::isfinite(worst->of_extents)
          ? "A's extent in " + std::string(1, worst->axis) + " is " +
                number(100 * worst->of_extents) + " % of B's"
          : "A has an extent in " + std::string(1, worst->axis) + ", and B has none";
  Note note = note_of(NoteCode::kSize, text + question_on_size(*worst, is_alike));
  if (std::isfinite(worst->of_extents)) note.value = worst->of_extents;
  return note;
}

/// Flat parts that lie a hair apart do not count.
bool are_disjoint(const Box& a, const Box& b) {
  const double least = kDisjoint * diagonal(b);
  for (int i = 0; i < 3; ++i) {
    if (a.lo[i] - b.hi[i] > least || b.lo[i] - a.hi[i] > least) return true;
  }
  return false;
}

std::optional<Note> note_on_turn(const PrincipalAxes& a, const PrincipalAxes& b) {
  const std::optional<double> turn = turn_between(a, b);
  if (!turn) return std::nullopt;
  const std::string degrees = number_text(*turn, std::chars_format::general, 2);
  return note_of(NoteCode::kTurn,
                 "A is turned by about " + degrees + (degrees == "1" ? " degree" : " degrees") +
                     " against B, going by their principal axes: does A lie as B does?",
                 {*turn, "degree"});
}

std::optional<Note> note_on_place(const Box& a, const Box& b, const std::string& unit) {
  const glm::dvec3 shift = (0.5 * a.lo + 0.5 * a.hi) - (0.5 * b.lo + 0.5 * b.hi);
  const double centres = hypot3(shift.x, shift.y, shift.z);
  const bool apart = are_disjoint(a, b);
  if (!apart && !(centres > kApart * diagonal(b))) return std::nullopt;
  return note_of(NoteCode::kApart,
                 std::string(apart ? "the boxes of A and B do not meet, and their" : "the boxes'") +
                     " centres are " + with_unit(number(centres), unit) + " apart, A's by (" +
                     short_number(shift.x) + ", " + short_number(shift.y) + ", " +
                     short_number(shift.z) + "): does A lie where B does?",
                 {centres, unit});
}

}  // namespace

MeshShape shape_of(const Mesh& mesh) { return {bounding_box(mesh), principal_axes_of(mesh)}; }

std::vector<Note> notes_on_pair(const MeshShape& shape_a, const MeshShape& shape_b,
                                const std::string& unit, const std::string& unit_option,
                                bool is_fitted) {
  const Box &a = shape_a.box, &b = shape_b.box;
  std::vector<Note> notes;
  const std::vector<Ratio> all = ratios(a, b);
  const std::optional<double> factor = unit_factor(a, b, all);
  std::optional<Note> turn;
  if (!is_fitted) turn = note_on_turn(shape_a.axes, shape_b.axes);
  if (factor) {
    notes.push_back(note_on_units(*factor, unit_option));
  } else if (turn) {
    notes.push_back(std::move(*turn));
  } else if (std::optional<Note> note =
                 note_on_size(all, difference_in_shape(shape_a.axes, shape_b.axes) <= kAlike)) {
    notes.push_back(std::move(*note));
  }
  // In another unit A lies elsewhere, too.
  const Box in_unit = factor ? Box{a.lo / *factor, a.hi / *factor} : a;
  if (std::optional<Note> note = note_on_place(in_unit, b, unit)) notes.push_back(std::move(*note));
  return notes;
}

bool is_odd_pair(NoteCode code) {
  return code == NoteCode::kUnits || code == NoteCode::kSize || code == NoteCode::kTurn ||
         code == NoteCode::kApart || code == NoteCode::kMirrored;
}

std::string clause_of(const Note& note) {
  const size_t end = std::min(note.text.find(": "), note.text.find(", though"));
  return note.text.substr(0, end);
}

std::string size_text(const Box& box) {
  const glm::dvec3 size = box.hi - box.lo;
  return number(size.x) + " x " + number(size.y) + " x " + number(size.z);
}

}  // namespace vkh
