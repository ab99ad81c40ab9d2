// Fills in a report: what a run did, and where it found its witness.
#pragma once

#include "host/solve/run.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/report.h"

namespace vkh {

/// The report before the run, which has only the question.
Report report_on(const Mesh& a, const Mesh& b, const SolveOptions& options);
/// The status that follows from a report's interval, no matter what ended the run; nothing: it is
/// open.
std::optional<Status> reached_by(const Report& r);

/// Whether every face of A, as given, is a face of B, so that h is 0 even if a run found more. A
/// mesh that is off its exact place does not count as given. Also false if there is not enough
/// memory to find out: that must not cost the answer.
bool is_within_faces_of(const Mesh& a, const Mesh& b);

void fill_counts(const RunOutput& r, const Frame& frame, Report& out);
void fill_stages(const RunOutput& run, Report& out);
void fill_witness(const VkhReport& r, const Mesh& a, const Mesh& b, Report& out);

/// A point of A's face by its barycentrics, and the face of B whose closest point is B's witness.
struct FoundWitness {
  uint32_t face_a, face_b;
  DVec3 barycentric;
};
void fill_witness(const FoundWitness& found, const Mesh& a, const Mesh& b, Report& out);

}  // namespace vkh
