// Lengths as people type them, and their values in a file's own unit.
#pragma once

#include <string>
#include <string_view>

#include "vkhausdorff/error.h"
#include "vkhausdorff/limit.h"

namespace vkh {

/// A length such as "1e-6diag", "0.1%", "0.1abs" or "0.1mm".
struct Length {
  enum class Of {
    kDiagonal,  ///< a fraction of diag(A)
    kFiles,     ///< in the files' unit, known or not
    kUnit,      ///< in `unit`
  };
  std::string requested;  ///< the text as the user typed it
  double number = 0;      ///< in terms of `of`; a percentage's hundredth
  Of of = Of::kDiagonal;
  std::string unit = {};
  bool is_double = false;  ///< `number` was given as this very double, and not as a decimal text
};

/// Returns, for a length known to lie between a limit's ends, the decimal of fifteen digits there,
/// if there is one: usually the typed number. A statement that holds at both ends holds for it.
double typed_length(const Limit& limit);
/// Writes the limit for people: as it was typed if that has at most twelve digits; otherwise, for
/// example for a share of a diagonal, "about" and four digits.
std::string length_in_words(const Limit& limit);
/// The length as it was typed, for people: "0.1 mm", "0.1 % of A's diagonal".
std::string typed_in_words(const Length& length, const std::string& file_unit);
/// "0.1 mm": a number with its unit, where there is one.
std::string with_unit(std::string number, const std::string& unit);

/// Whether a number alone is a fraction of diag(A), or that only up to a thousandth, since 0.01 may
/// be meant as a length, or refused.
enum class PlainNumber { kFraction, kSmallFraction, kRefused };

/// Throws UsageError that names `option`, the typed text and the expected form. A length is
/// positive and finite.
Length parse_length(const char* option, const std::string& text, PlainNumber plain);

/// Accepts "um", "mm", "cm", "m", "in", "ft", "mil" or "thou"; throws UsageError that names
/// `option`.
void check_unit(const char* option, const std::string& unit);

/// A quotient of positive whole numbers, in lowest terms.
struct UnitRatio {
  double numerator = 1, denominator = 1;
};
/// The exact factor from a length in the unit `from` to the same length in `to`, both known units.
UnitRatio unit_ratio(const std::string& from, const std::string& to);

/// Converts a length for comparison, rounded to nearest; one of an unknown unit stays as it is.
double in_millimetres(double length, const std::string& unit);

/// A's diagonal, of which a length in % or diag is a share. Whoever makes one says how far A's
/// coordinates are off, since the exact diagonal is off with them.
class Diagonal {
 public:
  /// `held`: of the coordinates as the mesh holds them, rounded to nearest. `delta`: Mesh::delta.
  Diagonal(double held, double delta) : held_(held), delta_(delta) {}

  double held() const { return held_; }
  /// Bounds of the exact diagonal, except for the rounding of held(). With a delta of 0 both are
  /// held().
  double least() const;
  double most() const;

 private:
  double held_, delta_;
};

/// Encloses the length in the files' unit, `file_unit`, which is empty if it is unknown: in exact
/// arithmetic it is from `within` to `beyond`. These are 32 ulps apart, or both the number itself
/// where that was given as a double in the files' unit. A share of a diagonal is one of A's exact
/// diagonal: its ends are farther apart where A has a delta. Throws UsageError, naming `option`, if
/// a length in millimetres meets files of an unknown unit.
Limit in_files(const Length& length, const char* option, const std::string& file_unit,
               const Diagonal& of_a);

/// The same for a length that decides: also refuses a share of a diagonal of which too little is
/// known: it is 0, or no normal double, or may be less than half of what it seems.
Limit limit_in_files(const Length& length, const char* option, const std::string& file_unit,
                     const Diagonal& of_a);

}  // namespace vkh
