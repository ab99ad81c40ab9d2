#include "vkhausdorff/note.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace vkh {
namespace {

constexpr std::array<std::string_view, 33> kCodeNames = {
    "polygons", "ambiguity",   "bodies",    "short-faces", "elements",  "surfaces",     "calls",
    "unread",   "scene",       "rotations", "positions",   "morph",     "animations",   "units",
    "size",     "turn",        "apart",     "one-way",     "coverage",  "unit-assumed", "converted",
    "stretch",  "fit",         "poor-fit",  "other-fit",   "mirrored",  "tolerance",    "memory",
    "devices",  "certificate", "survey",    "points",      "inside-out"};
static_assert(kCodeNames.size() == static_cast<size_t>(NoteCode::kInsideOut) + 1);

}  // namespace

std::string_view code_name(NoteCode code) { return kCodeNames[static_cast<size_t>(code)]; }

std::optional<NoteCode> code_named(std::string_view name) {
  const auto* const known = std::find(kCodeNames.begin(), kCodeNames.end(), name);
  if (known == kCodeNames.end()) return std::nullopt;
  return static_cast<NoteCode>(known - kCodeNames.begin());
}

Note note_of(NoteCode code, std::string text) { return {.code = code, .text = std::move(text)}; }

Note note_of(NoteCode code, std::string text, const Figure& figure) {
  return {.code = code, .text = std::move(text), .value = figure.value, .unit = figure.unit};
}

std::string line_of(const Note& note) {
  return std::string(code_name(note.code)) + ": " + note.text;
}

std::vector<std::string> lines_of(std::span<const Note> notes) {
  std::vector<std::string> lines;
  lines.reserve(notes.size());
  for (const Note& note : notes) lines.push_back(line_of(note));
  return lines;
}

bool is_for_servers(NoteCode code) {
  switch (code) {
    case NoteCode::kPolygons:
    case NoteCode::kAmbiguity:
    case NoteCode::kBodies:
    case NoteCode::kElements:
    case NoteCode::kSurfaces:
    case NoteCode::kCalls:
    case NoteCode::kUnits:
    case NoteCode::kSize:
    case NoteCode::kTurn:
    case NoteCode::kApart:
    case NoteCode::kCoverage:
    case NoteCode::kConverted:
    case NoteCode::kStretch:
    case NoteCode::kFit:
    case NoteCode::kPoorFit:
    case NoteCode::kOtherFit:
    case NoteCode::kMirrored:
    case NoteCode::kUnitAssumed:
    case NoteCode::kInsideOut:
      return true;
    default:
      return false;
  }
}

}  // namespace vkh
