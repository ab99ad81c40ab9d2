// Notes that people should know about an answer or a file. Each has a code, which programs may rely
// on, and may have the figure that its text names. docs/formats.md lists the codes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

enum class NoteCode {
  // Notes on a file.
  kPolygons,    ///< faces of more than three corners became triangles
  kAmbiguity,   ///< their corners lie in no plane, so that other triangulations are as right
  kBodies,      ///< a file holds other things than bodies, left out or included
  kShortFaces,  ///< faces of fewer than three corners were left out
  kElements,    ///< points, lines and curves were left out
  kSurfaces,    ///< free-form surfaces were left out
  kCalls,       ///< calls of other files or commands were not followed
  kUnread,      ///< text or bytes that are no part of the format were skipped
  kScene,       ///< one scene of several was read
  kRotations,   ///< quaternions of a length other than 1
  kPositions,   ///< primitives without positions were left out
  kMorph,       ///< morph targets of weight 0 were left out
  kAnimations,  ///< animations were left out
  // Notes on the pair.
  kUnits,        ///< the boxes differ by a factor between units on every axis
  kSize,         ///< A's box is much smaller or larger than B's on an axis
  kTurn,         ///< the principal axes are turned
  kApart,        ///< the boxes lie apart
  kOneWay,       ///< what A lacks of B was not asked
  kCoverage,     ///< a share of B's area is far from A
  kUnitAssumed,  ///< one file does not say its unit, and the other does
  kConverted,    ///< A was converted to B's unit
  kStretch,      ///< the matrix that places A is no exact rotation
  kFit,          ///< A lies where a fit put it, which is not proven the best
  kPoorFit,      ///< that fit is far from B, or of a part of A
  kOtherFit,     ///< another place of A is about as good
  kMirrored,     ///< A's mirror image would lie far closer to B than that fit
  kTolerance,    ///< a tolerance of 0, which hardly any interval meets
  kMemory,       ///< memory that the device or --memory lacks
  kDevices,      ///< devices that were lost
  kCertificate,  ///< a certificate is missing, or proves less than the interval
  kSurvey,       ///< statistics, a field or a picture are missing
  kPoints,       ///< the distance is to points: it is no less than the gaps between them
  kInsideOut,    ///< faces of B look inward, so that over means inside it
};

/// The code's name, such as "short-faces".
std::string_view code_name(NoteCode code);
/// The code of such a name, if it is known.
std::optional<NoteCode> code_named(std::string_view name);

struct Note {
  NoteCode code;
  std::string text;                   ///< for people, without the code
  std::optional<double> value = {};   ///< the figure that the text names, if it is one
  std::string unit = {};              ///< what the value is in or counts; empty: a ratio
  std::string file = {};              ///< the file that it is about; empty: the pair
  std::optional<uint64_t> face = {};  ///< the first face that it is about, as the file counts

  bool operator==(const Note&) const = default;
};

/// A figure of a note: a count of what `unit` names, or a length in that unit.
struct Figure {
  double value;
  std::string unit;
};
Note note_of(NoteCode code, std::string text);
Note note_of(NoteCode code, std::string text, const Figure& figure);

/// Joins the code's name and the text: "short-faces: ...".
std::string line_of(const Note& note);
std::vector<std::string> lines_of(std::span<const Note> notes);

/// Whether build servers get it too: what is measured may not be what the user meant.
bool is_for_servers(NoteCode code);

}  // namespace vkh
