// Notes that people should know about an answer or a file, one line each. A line begins with a
// code, which programs may rely on: "polygons: 3 faces of more than three corners were
// triangulated". docs/guide.md lists the codes.
#pragma once

#include <string>
#include <string_view>

namespace vkh {

enum class NoteCode {
  // Notes on a file.
  kPolygons,    ///< faces of more than three corners became triangles
  kBodies,      ///< a file holds other things than bodies, left out or included
  kShortFaces,  ///< faces of fewer than three corners were left out
  kElements,    ///< points, lines and curves were left out
  kSurfaces,    ///< free-form surfaces were left out
  kCalls,       ///< calls of other files or commands were not followed
  kUnread,      ///< text or bytes that are no part of the format were read past
  kScene,       ///< one scene of several was read
  kRotations,   ///< quaternions of a length other than 1
  kPositions,   ///< primitives without positions were left out
  kMorph,       ///< morph targets of weight 0 were left out
  kAnimations,  ///< animations were left out
  // Notes on the pair.
  kUnitAssumed,  ///< one file does not say its unit, and the other does
  kUnitsDiffer,  ///< the files are in different units
  kTolerance,    ///< a tolerance of 0, which hardly any interval meets
  kMemory,       ///< memory that the device or --memory lacks
  kDevices,      ///< devices that were lost
  kCertificate,  ///< a certificate is missing, or proves less than the interval
  kSurvey,       ///< statistics, a field or a picture are missing
};

/// The code's name, such as "short-faces".
std::string_view code_name(NoteCode code);

/// Joins the code's name and the text: "short-faces: ...".
std::string note_of(NoteCode code, const std::string& text);

/// The code that a note begins with; empty where it has none.
std::string_view code_of_note(std::string_view note);

/// Whether build servers get it too: the measured surface is not all that the file holds.
bool is_about_surface(std::string_view note);

}  // namespace vkh
