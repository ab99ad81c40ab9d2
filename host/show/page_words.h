// The figures and sentences of a page, in the words of quality control. One of these functions
// writes each figure, so that it reads the same everywhere.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/answer/figures.h"
#include "vkhausdorff/answer.h"

namespace vkh {

/// Writes an enclosed length: "0.352" if both ends have the same three or four digits, rounded to
/// nearest; otherwise "0.0084 to 0.0111", rounded outward; "at least 0.3", "at most 0.2" or "not
/// known" if an end is unknown. No figure is rounded across `limit`; 0: there is no limit.
std::string figure_text(const Enclosure& length, const Limit& limit = {});
/// The same with the answer's unit, and its limit.
std::string length_text(const Answer& answer, const Enclosure& length);

/// Writes a length that is estimated: to four digits, or as many as keep it between its ends and on
/// its side of `limit`.
std::string estimate_text(double length, const Enclosure& ends, const Limit& limit = {});

/// Writes a share in percent, with two decimals, rounded outward: "98.87 to 98.90 %". 0 % and 100 %
/// are exact. Uses more decimals if rounding would cross `asked`, in [0, 1].
std::string share_text(const Enclosure& share, double asked = -1);

/// A point in a file's coordinates, to a hundred-thousandth of `size`: "(29.86, 12.005, 9.648)".
std::string point_text(const glm::dvec3& point, double size);

/// The limit as it was asked: "0.1 mm", "0.1 % of A's diagonal".
std::string limit_text(const Answer& answer);

/// Whether a share within that distance is the limit's own.
bool is_limit(const Answer& answer, double distance);
/// A band's distance with its unit: "0.3 mm"; of the limit's, the limit as it was asked.
std::string band_text(const Answer& answer, double distance);

/// The verdict and the text beside it.
struct Headline {
  std::string word;   ///< PASS, FAIL, UNDECIDED or DISTANCE
  std::string style;  ///< pass, fail, undecided or plain: a class of style.css
  std::string sentence;
};
Headline headline_of(const Answer& answer);

/// Warns, in a sentence each, of an odd pair, of a single direction, and of a search or a survey
/// that was cut short.
std::vector<std::string> warnings_of(const Answer& answer);

/// The unit of all lengths, and where it comes from: "mm, by --unit".
std::string unit_text(const Answer& answer);

}  // namespace vkh
