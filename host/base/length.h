// Lengths as people type them, and what they are in a file's own unit.
#pragma once

#include <string>
#include <string_view>

#include "host/base/limit.h"

namespace vkh {

/// Such as "1e-6diag", "0.1%", "0.1abs" or "0.1mm".
struct Length {
  enum class Of {
    kDiagonal,  ///< a fraction of diag(A)
    kFiles,     ///< in the files' own unit, whatever it is
    kUnit,      ///< in `unit`
  };
  std::string requested;  ///< as typed
  double number = 0;      ///< of what `of` says; of a percentage its hundredth
  Of of = Of::kDiagonal;
  std::string unit = {};
};

/// Of a length that is known to lie between a limit's ends, the decimal of fifteen digits there, if
/// there is one: what was typed, as a rule. What holds at both ends holds for it.
double typed_length(const Limit& limit);
/// It, as people read it: as it was typed where that has at most twelve digits; else, as of a share
/// of a diagonal, "about" and four.
std::string length_in_words(const Limit& limit);

/// Whether a number alone is a fraction of diag(A), or refused.
enum class PlainNumber { kFraction, kRefused };

/// Throws UsageError that names `option`, what was typed and what was expected. A length is
/// positive and finite.
Length parse_length(const char* option, const std::string& text, PlainNumber plain);

/// "um", "mm", "cm", "m", "in" or "ft"; throws UsageError that names `option`.
void check_unit(const char* option, const std::string& unit);

/// The length in the files' unit: `file_unit`, or empty where nobody says which. Encloses it: in
/// exact arithmetic it is from `within` to `beyond`, which are 32 ulps apart. A share of a diagonal
/// is of that of the coordinates as they are read, whatever their delta. Throws UsageError,
/// naming `option`, where a length in millimetres meets files that are in nobody knows what.
Limit in_files(const Length& length, const char* option, const std::string& file_unit,
               double diagonal_a);

/// The same for a length that decides: also refuses a share of a diagonal that is 0 or no normal
/// double, of which nobody knows how far it is off.
Limit limit_in_files(const Length& length, const char* option, const std::string& file_unit,
                     double diagonal_a);

}  // namespace vkh
