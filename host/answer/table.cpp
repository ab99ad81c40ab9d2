#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <ostream>

#include "host/answer/pair_notes.h"
#include "host/base/decimal.h"
#include "host/base/rounding.h"
#include "host/base/system.h"
#include "vkhausdorff/answer.h"

namespace vkh {
namespace {

[[gnu::format(printf, 1, 2)]] std::string printed(const char* format, ...) {
  va_list args;
  va_start(args, format);
  char buffer[512];
  std::vsnprintf(buffer, sizeof buffer, format, args);
  va_end(args);
  return buffer;
}

}  // namespace

void print_row(std::ostream& out, const char* label, const std::string& text) {
  out << printed("  %-10s ", label) << text << '\n';
}

namespace {

using Count = unsigned long long;

std::string counted(uint64_t n, const char* what) {
  return printed("%llu ", static_cast<Count>(n)) + what + (n == 1 ? "" : "s");
}

std::string megabytes(uint64_t bytes) {
  return printed("%.4g MiB", static_cast<double>(bytes) / 0x1p20);
}

// GCC 12 warns of an overlap in "literal" + temporary that is not there (its bug 105651), so
// strings grow by append where it does.
std::string bounds(double lower, double upper, double gap) {
  std::string text = "[";
  text += decimal(lower, digits_that_matter(lower, gap), Rounding::kDown);
  text += ", ";
  text += decimal(upper, digits_that_matter(upper, gap), Rounding::kUp);
  return text + "]";
}

/// The reason why a run ended with kPrecision: the wider of both surfaces' deltas, or the
/// arithmetic.
std::string reason(const Answer& answer, Status status) {
  const double delta = std::max(answer.inputs[0].place.delta, answer.inputs[1].place.delta);
  if (status != Status::kPrecision || !(2 * delta > answer.a_to_b.tolerance))
    return stop_reason(answer, status);
  return "a surface is known to within " + decimal(delta, 3, Rounding::kUp) +
         ", which no smaller --tol narrows";
}

std::string ending(const Answer& answer, Status status) {
  if (status == Status::kPruned || status == Status::kLimit)
    return std::string(status == Status::kPruned ? "pruned: " : "decided: ") +
           stop_reason(answer, status);
  return std::string(status == Status::kClosed ? "closed" : "NOT CLOSED (") +
         (status == Status::kClosed ? "" : std::string(status_name(status)) + ")") + ": " +
         reason(answer, status);
}

std::string at(const SurfacePoint& p, bool is_point) {
  return (is_point ? "point " : "face ") + printed("%llu at (%.9g, %.9g, %.9g)",
                                                   static_cast<Count>(p.file_face), p.point.x,
                                                   p.point.y, p.point.z);
}

void print_input(std::ostream& out, const char* label, const Input& input) {
  const MeshCounts& counts = input.counts;
  std::string text = printable(input.path) + ": ";
  if (!input.is_read) return print_row(out, label, text + "not read");
  if (input.are_points) {
    text += counted(counts.faces, "point");
  } else {
    text += counted(counts.faces, "face") + ", " + printed("%llu", Count{counts.vertices}) +
            (counts.vertices == 1 ? " vertex" : " vertices");
  }
  const auto also = [&](uint64_t n, const char* what) {
    if (n > 0) text += printed(", %llu %s", static_cast<Count>(n), what);
  };
  also(counts.unreferenced, "unreferenced (dropped)");
  also(input.are_points ? 0 : counts.degenerate, "degenerate (kept)");
  also(counts.duplicate, "duplicate (kept)");
  if (!input.place.unit.empty()) text += ", in " + input.place.unit;
  print_row(out, label, text);
  if (input.place.delta > 0) {
    print_row(out, "",
              "the surface is known to within " + decimal(input.place.delta, 3, Rounding::kUp) +
                  ": the interval is wider by it");
  }
  for (const Note& note : input.notes)
    print_row(out, "note", std::string(label) + ": " + printable(line_of(note)));
}

std::string entry(double number) { return number_text(number, std::chars_format::general, 6); }

std::string matrix_source(const PlacedInput& placed) {
  const std::string file = printable(placed.file);
  if (!placed.fit) return file.empty() ? "" : ", " + file;
  return " that a fit found" + (file.empty() ? "" : " from " + file);
}

void print_placed(std::ostream& out, const Answer& answer) {
  if (!answer.placed) return;
  const MeshTransform& by = answer.placed->by;
  std::string text;
  if (by.numerator != by.denominator)
    text = "from " + answer.placed->from + " to " + answer.unit + ": times " +
           entry(by.numerator / by.denominator);
  if (by.matrix && !text.empty()) text += "; ";
  if (by.matrix)
    text += "by a matrix" + matrix_source(*answer.placed) + ", that moves the origin to (" +
            entry((*by.matrix)[0][3]) + ", " + entry((*by.matrix)[1][3]) + ", " +
            entry((*by.matrix)[2][3]) + ")";
  print_row(out, "A placed", text);
}

std::string unit_text(const Answer& answer) {
  return answer.unit.empty() ? "in the files' unit" : answer.unit;
}

// Writes the length as it was asked for, and its value in the files' unit once the files are read.
std::string length_text(const Answer& answer, const Length& asked, double resolved) {
  const bool is_share = asked.of == Length::Of::kDiagonal;
  if (!are_read(answer))
    return asked.requested + (!is_share                           ? ""
                              : asked.requested.ends_with("diag") ? "(A)"
                                                                  : " of diag(A)");
  if (asked.of == Length::Of::kFiles ||
      (asked.of == Length::Of::kUnit && asked.unit == answer.unit))
    return printed("%.6g ", resolved) + unit_text(answer);
  std::string text = asked.requested;
  if (is_share) {
    text += text.ends_with("diag") ? "(A)" : " of diag(A)";
    text += printed(" = %.9g", answer.a_to_b.diagonal_a);
  }
  return text + printed(": %.6g ", resolved) + unit_text(answer);
}

std::string device_text(const DeviceDescription& d) {
  if (d.type == kNative) return d.name;
  const std::string type = d.type == "cpu" ? "a CPU device, no GPU" : d.type;
  return d.name + " (" + type + "), driver " + d.driver + ", Vulkan " + d.api_version;
}

std::string verified_text(const WitnessCheck& check) {
  return "the witness is " +
         bounds(check.distance_lower, check.distance_upper,
                check.distance_upper - check.distance_lower) +
         " from " + "the other mesh, by brute force: lower " +
         (check.holds ? "holds" : "DOES NOT HOLD");
}

std::string coverage_text(const CoverageCheck& c) {
  return printed("%llu faces whole, %llu waiting, %llu not accounted for: ", Count{c.whole},
                 Count{c.waiting}, Count{c.wrong}) +
         (c.holds ? "nothing is lost" : "SOMETHING IS LOST");
}

void print_search(std::ostream& out, const Answer& answer, bool back) {
  const Report& r = back ? *answer.b_to_a : answer.a_to_b;
  const auto place = [&](const SurfacePoint& p, bool of_b) {
    return (of_b ? "B " : "A ") + at(p, answer.inputs[of_b ? 1 : 0].are_points);
  };
  if (r.has_witness) {
    print_row(out, "witness", place(r.witness_a, back));
    print_row(out, "", place(r.witness_b, !back));
  }
  if (r.witness_check) print_row(out, "verified", verified_text(*r.witness_check));
  if (r.coverage_check) print_row(out, "", coverage_text(*r.coverage_check));
  if (r.waves == 0) return;  // there was no search
  print_row(out, "work",
            counted(r.waves, "wave") + ", " + counted(r.candidates, "candidate") +
                printed(" (at most %llu at once), ", static_cast<Count>(r.peak_frontier)) +
                printed("%llu queries, workspace ", static_cast<Count>(r.queries)) +
                megabytes(r.workspace_bytes));
}

void print_survey(std::ostream& out, const Answer& answer,
                  const std::optional<SurveyResult>& survey) {
  if (!survey) return;
  for (const TableRow& one : survey_rows(answer, *survey))
    print_row(out, one.label.c_str(), one.text);
}

std::string seconds(double ms) { return printed("%.3g s", ms / 1000); }

void print_proof(std::ostream& out, const std::optional<Proof>& proof) {
  if (!proof) return;
  print_row(out, "certificate",
            printed("%llu leaves, %llu of them cut, %llu bytes, in ", Count{proof->leaves},
                    Count{proof->cut_leaves}, Count{proof->bytes}) +
                seconds(proof->ms));
}

std::string times_text(const Answer& answer) {
  double upload = 0, hierarchy = 0, solve = 0;
  for (const Report* r : {&answer.a_to_b, answer.b_to_a ? &*answer.b_to_a : nullptr}) {
    if (r == nullptr) continue;
    upload += r->times.upload_ms;
    hierarchy += r->times.hierarchy_ms;
    solve += r->times.solve_ms;
  }
  const Waits& w = answer.waits;
  return seconds(w.total) + " in all: read " + seconds(w.read) + " beside start " +
         seconds(w.start) + ", upload " + seconds(upload) + ", hierarchy " + seconds(hierarchy) +
         ", search " + seconds(solve);
}

void print_stages(std::ostream& out, const std::vector<StageStats>& stages) {
  if (stages.empty()) return;
  out << printed("\n  %-24s %12s %12s\n", "stage", "GPU ms", "times");
  for (const StageStats& s : stages) {
    out << "  " << s.name << std::string(s.name.size() < 24 ? 24 - s.name.size() : 0, ' ')
        << printed(" %12.4f %12llu\n", s.gpu_ms, static_cast<Count>(s.times));
  }
}

void print_waves(std::ostream& out, const std::vector<WaveStats>& waves) {
  if (waves.empty()) return;
  out << printed("\n  %4s %12s %12s %12s %12s %12s  %-14s %-14s\n", "wave", "parents", "candidates",
                 "queries", "survivors", "deferred", "lower (approx)", "upper (approx)");
  for (const WaveStats& w : waves) {
    out << printed("  %4u %12llu %12llu %12llu %12llu %12llu  %-14.9g %-14.9g\n", w.wave,
                   static_cast<Count>(w.parents), static_cast<Count>(w.candidates),
                   static_cast<Count>(w.queries), static_cast<Count>(w.survivors),
                   static_cast<Count>(w.deferred), w.lower, w.upper);
  }
}

void print_culled(std::ostream& out, const std::vector<CullCount>& culled) {
  out << "\n  candidates closed by\n";
  for (const CullCount& c : culled)
    out << printed("  %-14s %14llu\n", c.name.c_str(), static_cast<Count>(c.candidates));
}

void print_details(std::ostream& out, const Report& r) {
  print_stages(out, r.stages);
  print_waves(out, r.wave_stats);
  print_culled(out, r.culled);
}

void print_names(std::ostream& out, const char* label, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  print_row(out, label, text);
}

void print_part(std::ostream& out, const Answer& answer) {
  print_row(
      out, "part",
      printed("%llu of %llu, from 0: h(A,B) is the largest of all parts'",
              static_cast<Count>(answer.part->index), static_cast<Count>(answer.part->count)));
  const double known = answer.a_to_b.known_lower;
  // Prints the given number with the digits that it was given with: it is no bound of h.
  if (known > 0) print_row(out, "known", printed("%.9g ", known) + unit_text(answer));
}

/// Whether the note is printed with the sizes, or in the first line.
bool is_said_first(NoteCode code) {
  return is_odd_pair(code) || code == NoteCode::kOneWay || code == NoteCode::kCoverage ||
         code == NoteCode::kConverted || code == NoteCode::kInsideOut;
}

/// Prints the boxes' sizes, and notes on them.
void print_sizes(std::ostream& out, const Answer& answer) {
  if (!answer.inputs[0].box || !answer.inputs[1].box) return;
  const auto sized = [&](const char* name, const Input& input) {
    return name + with_unit(size_text(*input.box), answer.unit) + " (" +
           printable(file_name_of(input.path)) + ")";
  };
  print_row(out, "boxes", sized("A ", answer.inputs[0]) + ", " + sized("B ", answer.inputs[1]));
  for (const Note& note : answer.notes) {
    if (is_said_first(note.code) && note.code != NoteCode::kOneWay)
      print_row(out, "note", printable(line_of(note)));
  }
}

std::string enclosed(const Answer& answer, double lower, double upper, Status status) {
  const double gap = gap_as_printed(answer, lower, upper);
  return (is_upper_sought(answer, lower, upper) ? bounds(lower, upper, gap)
                                                : "at least " + length_down(answer, lower, gap)) +
         "  " + ending(answer, status);
}

void print_interval(std::ostream& out, const Answer& answer) {
  const CertifiedInterval whole = interval_of(answer);
  const bool is_sought = is_upper_sought(answer, whole.lower, whole.upper);
  const bool has_worst =
      answer.max && !answer.max->faces_a && !answer.max->faces_b && !answer.max->worst;
  print_row(out, is_sought ? "interval" : "distance",
            enclosed(answer, whole.lower, whole.upper, whole.status) +
                (is_sought || !has_worst ? "" : "; --worst goes on to the farthest point"));
  if (!is_sought || !std::isfinite(whole.upper)) return;
  print_row(out, "known to",
            decimal(width_up(whole.lower, whole.upper), 3, Rounding::kUp) + " " +
                unit_text(answer) +
                (answer.a_to_b.diagonal_a > 0
                     ? ", " + decimal(whole.gap, 3, Rounding::kUp) + " of diag(A)"
                     : ""));
}

void print_summary(std::ostream& out, const Answer& answer) {
  const Report& r = answer.a_to_b;
  print_sizes(out, answer);
  print_interval(out, answer);
  if (answer.max)
    print_row(out, "max", length_text(answer, answer.max->length, answer.max->limit.within));
  print_row(out, "tolerance", length_text(answer, answer.tolerance, r.tolerance));
  if (answer.part) print_part(out, answer);
  print_input(out, "A", answer.inputs[0]);
  print_input(out, "B", answer.inputs[1]);
  print_placed(out, answer);
  for (const Note& note : answer.notes) {
    if (!is_said_first(note.code)) print_row(out, "note", printable(line_of(note)));
  }
  if (!r.device.name.empty()) print_row(out, "device", device_text(r.device));
  for (const DeviceDescription& device : r.more_devices) print_row(out, "and", device_text(device));
  if (r.preset != "default") print_row(out, "preset", r.preset);
}

void print_metrics(std::ostream& out, const Answer& answer) {
  for (const TableRow& row : metrics_rows(answer))
    out << printed("  %-12s ", row.label.c_str()) << row.text << '\n';
}

void print_direction(std::ostream& out, const Answer& answer, bool back, bool verbose) {
  const Report& r = back ? *answer.b_to_a : answer.a_to_b;
  if (answer.b_to_a)
    print_row(out, back ? "h(B,A)" : "h(A,B)", enclosed(answer, r.lower, r.upper, r.status));
  print_search(out, answer, back);
  print_survey(out, answer, back ? answer.survey_b : answer.survey_a);
  print_proof(out, back ? answer.proof_b : answer.proof_a);
  if (verbose) print_details(out, r);
}

}  // namespace

void print_table(std::ostream& out, const Answer& answer, bool verbose) {
  out << in_words(answer) << '\n';
  if (answer.metrics) print_metrics(out, answer);
  print_summary(out, answer);
  if (verbose) print_names(out, "off", answer.a_to_b.switched_off);
  print_direction(out, answer, false, verbose);
  if (answer.b_to_a) print_direction(out, answer, true, verbose);
  print_row(out, "times", times_text(answer));
}

}  // namespace vkh
