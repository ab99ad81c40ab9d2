#include "host/answer/mesh_notes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/answer/steps.h"
#include "host/base/decimal.h"
#include "vkhausdorff/place.h"

namespace vkh {

namespace {

/// A figure as people read it: rounded up, and its unit.
std::string rms_text(double rms, const Answer& answer) {
  return with_unit(decimal(rms, 3, Rounding::kUp), answer.unit);
}

}  // namespace

std::vector<Note> notes_on_units(const Mesh& a, const Units& units) {
  if (a.placed && a.placed->from != a.unit)
    return {note_of(NoteCode::kConverted, "A was converted from " + a.placed->from + " to " +
                                              a.unit + ", in which B is")};
  if (units.a == units.b) return {};
  const bool a_says = !units.a.empty();
  return {note_of(NoteCode::kUnitAssumed, std::string(a_says ? "B" : "A") +
                                              "'s file does not say what it is in: taken as " +
                                              (a_says ? units.a : units.b) + ", as " +
                                              (a_says ? "A" : "B") + " is")};
}

void add_notes_on_fit(Answer& answer) {
  if (!answer.placed || !answer.placed->fit) return;
  const FoundFit& fit = *answer.placed->fit;
  const std::string share = number_text(100 * fit.share, std::chars_format::general, 3) + " %";
  answer.notes.push_back(note_of(NoteCode::kFit,
                                 "A was moved by a fit that was found, not proven the best: " +
                                     share + " of its samples count, and lie " +
                                     rms_text(fit.rms, answer) + " from B (root mean square)",
                                 {fit.rms, answer.unit}));
  if (fit.is_poor)
    answer.notes.push_back(
        note_of(NoteCode::kPoorFit,
                "the fit is far from B, or of a part of A: look at it, or give a start by "
                "--transform"));
  if (fit.rival)
    answer.notes.push_back(note_of(NoteCode::kOtherFit,
                                   "another place of A is about as close to B (" +
                                       rms_text(*fit.rival, answer) + "): is the part symmetric?",
                                   {*fit.rival, answer.unit}));
  if (fit.mirrored)
    answer.notes.push_back(note_of(
        NoteCode::kMirrored,
        "A looks like a mirror image of B: mirrored, all of it would lie " +
            rms_text(*fit.mirrored, answer) + " from B (root mean square): was one axis reversed?",
        {*fit.mirrored, answer.unit}));
}

void add_note_on_points(const Question& question, const Mesh& a, const Mesh& b, Answer& answer) {
  const bool to_b = b.are_points && !a.are_points;
  const bool to_a = question.symmetric && a.are_points && !b.are_points;
  if (!to_a && !to_b) return;
  answer.notes.push_back(
      note_of(NoteCode::kPoints,
              std::string(to_b ? "A to B" : "B to A") +
                  " is to points: it is no less than the gaps between them, and is slow to close"));
}

void add_note_on_stretch(const Box& box, Answer& answer) {
  if (!answer.placed || !answer.placed->by.matrix) return;
  const double stretch = 1.5 * stretch_of(*answer.placed->by.matrix);
  glm::dvec3 farthest;
  for (int i = 0; i < 3; ++i) farthest[i] = std::max(std::abs(box.lo[i]), std::abs(box.hi[i]));
  const double moved = stretch * glm::length(farthest);
  if (!(moved > 0.1 * answer.a_to_b.tolerance)) return;
  if (!std::isfinite(moved)) {
    answer.notes.push_back(
        note_of(NoteCode::kStretch,
                "the matrix is no exact rotation: it stretches A by more than 1e308 %"));
    return;
  }
  answer.notes.push_back(note_of(NoteCode::kStretch,
                                 "the matrix is no exact rotation: it stretches A by up to " +
                                     decimal(100 * stretch, 3, Rounding::kUp) +
                                     " %, which moves its points by up to " +
                                     with_unit(decimal(moved, 3, Rounding::kUp), answer.unit),
                                 {moved, answer.unit}));
}

void add_memory_notes(uint64_t asked, Answer& answer) {
  const auto most = [&](uint64_t Report::*bytes) {
    return std::max(answer.a_to_b.*bytes, answer.b_to_a ? (*answer.b_to_a).*bytes : 0);
  };
  const uint64_t in_host = most(&Report::host_memory_bytes);
  if (in_host > 0) {
    answer.notes.push_back(
        note_of(NoteCode::kMemory, "the device has too little memory: it reads " +
                                       std::to_string((in_host + 0xfffff) >> 20) +
                                       " MiB from the host's, slowly"));
  }
  const uint64_t taken = most(&Report::workspace_bytes);
  if (asked > 0 && taken > asked) {
    answer.notes.push_back(
        note_of(NoteCode::kMemory, "--memory is less than a search can do with: " +
                                       std::to_string((taken + 1023) >> 10) + " KiB were taken"));
  }
}

}  // namespace vkh
