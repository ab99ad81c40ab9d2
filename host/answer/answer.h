// An answer: in words, as a table for people, as one versioned JSON object for programs, and as
// what build servers take (JUnit XML, GitHub's workflow commands).
#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/length.h"
#include "host/base/sha256.h"
#include "host/solve/report.h"
#include "host/survey/prover.h"
#include "host/survey/survey.h"

namespace vkh {

const char* program_version();

/// A mesh that was given. Before it is read, only its path is known.
struct Input {
  std::string path;
  bool is_read = false;
  MeshCounts counts = {};
  MeshPlace place = {};
  std::string sha256 = {};              ///< of the file, in hexadecimal digits; empty: not known
  std::vector<FileHash> files = {};     ///< read besides it (files_beneath), where that is known
  std::vector<std::string> notes = {};  ///< what people should know about it
};

/// Of a mesh whose faces have limits of their own.
struct FaceLimits {
  std::string path;                ///< the file that says which
  std::string sha256 = {};         ///< of that file; empty: not known
  uint64_t within = 0, faces = 0;  ///< faces that are proven to be within theirs; of how many
  uint64_t runs = 0;
  Limit limit = {};  ///< of the face of the witness, where it is beyond
  Verdict verdict = Verdict::kUndecided;
};

/// What was asked about a limit (`gate`).
struct Asked {
  Length length;
  Limit limit;  ///< that, in the files' unit
  std::optional<FaceLimits> faces_a = {}, faces_b = {};
  /// The share of its area that is to be within, in [0, 1]; none: all of it, every point.
  std::optional<double> area = {};
  std::string area_requested = {};  ///< as typed
};

/// Which part of A's faces an answer is of: `index` from 0. It never passes for the whole.
struct PartOf {
  uint64_t index = 0, count = 1;
};

/// What a user waited for, in milliseconds; parts that ran side by side overlap.
struct Waits {
  double read = 0;   ///< files to meshes
  double start = 0;  ///< instance, device and pipelines
  double total = 0;  ///< from the process's start to the answer
};

/// What was asked about a pair of meshes and what came out of it.
struct Answer {
  std::string command;             ///< "distance", "gate" or "demo"
  std::vector<std::string> words;  ///< as typed after the program's name
  std::string started, host;       ///< UTC, as ISO 8601 has it; the machine's name
  std::array<Input, 2> inputs;     ///< A, B
  std::vector<std::string> notes;  ///< on the pair
  std::string unit;                ///< of every length; empty: the files' own, whatever it is
  Length tolerance;                ///< a fraction is of A's diagonal in both directions
  std::optional<Asked> max;
  std::optional<PartOf> part;  ///< a_to_b is of that alone
  Report a_to_b;
  std::optional<Report> b_to_a;                    ///< there for a symmetric run
  std::optional<SurveyResult> survey_a, survey_b;  ///< of A, and of B on the way back
  std::optional<Proof> proof_a, proof_b;           ///< likewise, for a certificate
  Waits waits;
};

/// The whole answer's interval.
CertifiedInterval interval_of(const Answer& answer);
/// Of an answer with `max`: of one direction, and of all.
Verdict verdict_of(const Answer& answer, bool back);
Verdict verdict_of(const Answer& answer);

/// With `area`: what share of a mesh's area is within the limit.
Enclosure share_within(const Answer& answer, bool back);

/// One sentence for each status.
const char* stop_reason(Status status);

/// The answer's first line: the verdict, or what the interval means.
std::string in_words(const Answer& answer);

/// Lengths of an interval as they are printed: "0.0443813 mm", rounded outward to the digits that
/// matter.
std::string length_down(const Answer& answer, double length, double gap);
std::string length_up(const Answer& answer, double length, double gap);

/// What an interval's ends are rounded to as they are printed: its width, or less, so that neither
/// end is printed on the other side of the limit.
double gap_as_printed(const Answer& answer, double lower, double upper);

/// A file's name as a terminal may see it: control characters are written as \xNN.
std::string printable(const std::string& text);

/// Picks the notes on the inputs' surfaces, which build servers are told, too: "A: polygons: ...".
std::vector<std::string> surface_notes(const std::vector<std::string>& notes_a,
                                       const std::vector<std::string>& notes_b);

/// One line of JSON, without a newline at its end, of docs/schema/answer.schema.json.
std::string to_json(const Answer& answer);

/// What went wrong instead of an answer, likewise. `code`: the exit code; `file`: empty if it is no
/// file's fault; `place`: a line, byte or element of it, or empty.
struct Failure {
  int code;
  std::string message, file, place;
};
std::string to_json(const Failure& failure);

/// The words, and ten to fifteen lines; `verbose` adds switches, stages, waves and the cull
/// histogram.
void print_table(std::ostream& out, const Answer& answer, bool verbose);
/// One line of such a table.
void print_row(std::ostream& out, const char* label, const std::string& text);

/// What a survey says, as rows of that table.
struct TableRow {
  std::string label, text;
};
std::vector<TableRow> survey_rows(const Answer& answer, const SurveyResult& survey);

/// A test case of JUnit's as it ended; `element` empty: it passed.
struct JunitCase {
  std::string command, name, words;
  double seconds = 0;
  std::string element = {}, type = {};
  std::vector<std::string> notes = {};  ///< see surface_notes
};
/// A test suite: JUnit's XML, as build servers read it. `started` empty: without it and the host.
std::string to_junit(std::span<const JunitCase> cases, const std::string& host,
                     const std::string& started);
std::string to_junit(const Answer& answer);
std::string to_junit(const Failure& failure);

/// A line that GitHub's runner makes an annotation of, and what it shows on the run's page.
std::string github_annotation(const Answer& answer);
std::string github_annotation(const Failure& failure);
std::string github_summary(const Answer& answer);

}  // namespace vkh
