// Doubles as decimals that are rounded exactly, in the given direction.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>

namespace vkh {

enum class Rounding { kDown, kUp };  ///< towards minus or plus infinity

inline constexpr int kJsonDigits = 18;  ///< rounded outward, and read back as the same double

/// Writes `value` with at most `digits` (>= 1) significant digits, as a JSON number without
/// trailing zeros. Exact: the printed decimal is <= value (kDown) or >= value (kUp), by less than
/// one unit of its last digit, and equal where it can be. "inf", "-inf" or "nan" for a value that
/// is no number.
std::string decimal(double value, int digits, Rounding rounding);

/// Writes `value`, which lies in [lower, upper], as a number that is neither a lower nor an upper
/// bound: the decimal of the fewest digits, `digits` or more, that lies in [lower, upper], too. Of
/// the two that are next to `value` it is the nearer one, if it is inside. Where both ends are one
/// double that has more than 17 digits, it is the shortest decimal that is read back as that
/// double.
std::string decimal_inside(double value, double lower, double upper, int digits);

/// The decimal of the fewest digits that is read back as `value` and lies between the ends as JSON
/// has them: rounded outward to kJsonDigits.
std::string decimal_between(double value, double lower, double upper);

/// Writes the text of printf with %.{digits}f, e or g in the C locale. printf itself takes the
/// program's locale, whose decimal point may be a comma.
std::string number_text(double value, std::chars_format format, int digits);

/// "x, y, z" in nine digits, for people.
std::string coordinates_text(double x, double y, double z);

/// The shortest decimal, of six digits or more, that is read back as the same double.
std::string shortest_decimal(double value);

/// A count with its thousands between commas: "34,834".
std::string grouped(uint64_t count);

/// The double itself, readable by strtod and by Python's float.fromhex: "0x1.8p-3".
std::string hex_float(double value);

/// The number of significant digits of `value` that matter beside an uncertainty of `gap`: up to
/// two past gap's first digit, 3 to 17 in all.
int digits_that_matter(double value, double gap);

}  // namespace vkh
