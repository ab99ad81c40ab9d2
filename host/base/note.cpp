#include "host/base/note.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace vkh {
namespace {

constexpr std::array<std::string_view, 19> kCodeNames = {
    "polygons", "bodies",     "short-faces",  "elements",     "surfaces",
    "calls",    "unread",     "scene",        "rotations",    "positions",
    "morph",    "animations", "unit-assumed", "units-differ", "tolerance",
    "memory",   "devices",    "certificate",  "survey"};
static_assert(kCodeNames.size() == static_cast<size_t>(NoteCode::kSurvey) + 1);

}  // namespace

std::string_view code_name(NoteCode code) { return kCodeNames[static_cast<size_t>(code)]; }

std::string note_of(NoteCode code, const std::string& text) {
  return std::string(code_name(code)) + ": " + text;
}

std::string_view code_of_note(std::string_view note) {
  const std::string_view word = note.substr(0, std::min(note.find(": "), note.size()));
  const auto* const known = std::find(kCodeNames.begin(), kCodeNames.end(), word);
  return known == kCodeNames.end() ? std::string_view() : *known;
}

bool is_about_surface(std::string_view note) {
  const std::string_view code = code_of_note(note);
  return code == code_name(NoteCode::kPolygons) || code == code_name(NoteCode::kBodies);
}

}  // namespace vkh
