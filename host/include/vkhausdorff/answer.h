// An answer: in words, as a table for people, as one versioned JSON object for programs, and in the
// formats of build servers (JUnit XML, GitHub's workflow commands).
#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/length.h"
#include "vkhausdorff/metrics.h"
#include "vkhausdorff/note.h"
#include "vkhausdorff/prover.h"
#include "vkhausdorff/question.h"
#include "vkhausdorff/report.h"
#include "vkhausdorff/sha256.h"
#include "vkhausdorff/survey.h"

namespace vkh {

const char* program_version();

/// A mesh of the question. Before it is read, only its path is known.
struct Input {
  std::string path;
  bool is_read = false;
  bool are_points = false;  ///< it has no surface: its faces are points
  MeshCounts counts = {};
  MeshAccuracy place = {};
  std::string sha256 = {};           ///< the file's hash in hexadecimal digits; empty: not known
  std::vector<FileHash> files = {};  ///< the other files read (files_beneath), if known
  std::vector<Note> notes = {};      ///< the notes that people should know
  std::optional<Box> box = {};       ///< of its corners
};

/// Where a user put A, and by what.
struct PlacedInput {
  MeshTransform by;
  std::string from;                  ///< the unit that A's file was in; empty: unknown
  std::string file = {};             ///< the matrix's; empty: it came in no file
  std::string sha256 = {};           ///< that file's hash, if known
  std::optional<FoundFit> fit = {};  ///< the matrix was found, from the file's or from none
};

/// The limits and the outcome for a mesh whose faces have limits of their own.
struct FaceLimits {
  std::string path;                ///< the file that holds the limits
  std::string sha256 = {};         ///< the hash of that file; empty: not known
  uint64_t within = 0, faces = 0;  ///< faces proven to be within their limits; all faces
  uint64_t runs = 0;
  Limit limit = {};  ///< the limit of the witness's face, if that is beyond it
  Verdict verdict = Verdict::kUndecided;
};

/// Limits that differ by side of B.
struct AskedSides {
  Length over, under;
  SidedLimits limits;
};

/// The question about a limit (`gate`).
struct Asked {
  Length length;
  Limit limit;  ///< the same length in the files' unit
  std::optional<FaceLimits> faces_a = {}, faces_b = {};
  /// The share of a mesh's area that has to be within, in [0, 1]; none: every point has to be.
  std::optional<double> area = {};
  std::string area_requested = {};       ///< the share as the user typed it
  std::optional<AskedSides> sides = {};  ///< if set, `length` and `limit` are the larger ones
  bool worst = false;  ///< the search went on to the farthest point once the verdict was certain
};

/// The times that a user waited, in milliseconds; parts that ran side by side overlap.
struct Waits {
  double read = 0;   ///< files to meshes
  double start = 0;  ///< instance, device and pipelines
  double total = 0;  ///< from the process's start to the answer
};

/// The question about a pair of meshes, and its answer.
struct Answer : Stated {
  std::string version = program_version();
  std::string started, host;               ///< UTC in ISO 8601; the machine's name
  std::array<Input, 2> inputs;             ///< A, B
  std::optional<PlacedInput> placed = {};  ///< A is elsewhere than its file has it
  std::vector<Note> notes;                 ///< the notes on the pair
  std::string unit;  ///< the unit of every length; empty: that of the files, which is not known
  std::optional<Asked> max;
  uint64_t parts = 0;  ///< the number of parts whose answers are merged in it; 0: it is no merge
  Report a_to_b;
  std::optional<Report> b_to_a;                    ///< set for a symmetric run
  std::optional<SurveyResult> survey_a, survey_b;  ///< A's; B's in the reverse direction
  std::optional<Proof> proof_a, proof_b;           ///< the same two for a certificate
  std::optional<Metrics> metrics;                  ///< of both directions, if they were asked for
  Waits waits;
  /// in_words() as it was read from JSON, which has no limits of single faces; empty otherwise.
  std::string first_line = {};
};

/// Whether both meshes were read, so that lengths are known in their unit.
inline bool are_read(const Answer& answer) {
  return answer.inputs[0].is_read && answer.inputs[1].is_read;
}

/// The whole answer's interval.
CertifiedInterval interval_of(const Answer& answer);
/// A's diagonal, once the meshes are read.
Diagonal diagonal_of_a(const Answer& answer);
/// The verdict on one direction, and on all, of an answer with `max`.
Verdict verdict_of(const Answer& answer, bool back);
Verdict verdict_of(const Answer& answer);

/// The share of a mesh's area that is within the limit, for an answer with `area`.
Enclosure share_within(const Answer& answer, bool back);

/// The sides of a mesh, where its survey found them.
const SignedFigures* sides_of(const Answer& answer, bool back);

/// The summary of a survey's field, by the limits that were asked about.
FieldSummary summary_of(const Answer& answer, const SurveyResult& survey);

/// One sentence for each status; of an answer's, it says whether the search went on.
const char* stop_reason(Status status);
const char* stop_reason(const Answer& answer, Status status);

/// The notes on the pair, including the ones that its verdict brings.
std::vector<Note> notes_of(const Answer& answer);

/// The answer's first line: the verdict, or what the interval means.
std::string in_words(const Answer& answer);

/// The ends of an interval as they are printed: "0.0443813 mm", rounded outward to the digits that
/// matter.
std::string length_down(const Answer& answer, double length, double gap);
std::string length_up(const Answer& answer, double length, double gap);

/// Whether an interval is narrow enough for people to call its lower end the farthest point's
/// distance: to a thousandth, or two.
inline bool is_farthest_known(double lower, double upper) {
  return lower > 0 && upper - lower <= 2e-3 * lower;
}

/// Whether the upper end of an interval of the answer was sought. After a FAIL it was not, and
/// would mislead people. A question about a share of the area seeks it after any verdict.
bool is_upper_sought(const Answer& answer, double lower, double upper);

/// The gap that an interval's ends are rounded to in print: its width, or less, so that neither end
/// is printed on the other side of the limit.
double gap_as_printed(const Answer& answer, double lower, double upper);

/// A file's name as a terminal may show it: control characters are written as \xNN.
std::string printable(const std::string& text);

// junit_github.cpp defines this one.

/// Picks the notes that build servers get too (is_for_servers): "size: ...", "A: polygons: ...".
std::vector<std::string> server_notes(const Answer& answer);

// json.cpp defines these.

/// One line of JSON, without a newline at its end, of docs/schema/answer.schema.json.
std::string to_json(const Answer& answer);
/// Reads such a line back, so that to_json() returns it again, byte for byte. Throws InputError
/// without a file's name: for another schema or an error, a member that is missing or of another
/// type, a bound that is another number in hexadecimal than in decimal, and an interval, gap,
/// status or verdict that the rest of it does not imply. Corners of a field and leaves of a
/// certificate are not in JSON: only their summaries are read.
Answer answer_from_json(std::string_view text);

/// An error instead of an answer, as the same kind of line. `code`: the exit code; `file`: empty if
/// it is no input's fault; `place`: a line, byte or element of it, or empty.
struct Failure {
  int code;
  std::string message, file, place;
};
Failure failure_of(const Error& error);
std::string to_json(const Failure& failure);
Failure failure_from_json(std::string_view text);

// table.cpp defines these.

/// Prints the words, and ten to fifteen lines; `verbose` adds switches, stages, waves and the cull
/// histogram.
void print_table(std::ostream& out, const Answer& answer, bool verbose);
/// Prints one line of such a table.
void print_row(std::ostream& out, const char* label, const std::string& text);

// survey_rows.cpp defines these.

/// A survey's results as rows of that table.
struct TableRow {
  std::string label, text;
};
std::vector<TableRow> survey_rows(const Answer& answer, const SurveyResult& survey);
/// The first line, and the rows, of an answer that has metrics.
std::string metrics_in_words(const Answer& answer);
std::vector<TableRow> metrics_rows(const Answer& answer);

/// The outcomes of a pair, the worst first.
enum class Outcome {
  kBeyond,    ///< beyond its limit
  kNoAnswer,  ///< a failure
  kOpen,      ///< undecided, or not closed
  kClosed,    ///< an interval, since there was no limit
  kWithin,    ///< within its limit
};
/// The outcome by the exit code: rank.cpp.
Outcome outcome_of(const Answer& answer);

// junit_github.cpp defines these: the formats that build servers read.

/// One JUnit test case.
struct JunitCase {
  std::string command, name, words;
  Outcome outcome = Outcome::kWithin;
  double seconds = 0;
  std::vector<std::string> notes = {};  ///< see server_notes
};
/// A test suite in JUnit's XML, as build servers read it. `started` empty: without it and the host.
std::string to_junit(std::span<const JunitCase> cases, const std::string& host,
                     const std::string& started);
std::string to_junit(const Answer& answer);
/// `name`: pair_name(), so that a case has the same name for every outcome.
std::string to_junit(const Failure& failure, const std::string& name);
/// "a.stl -> b.stl within 0.1mm". `max`: as it was typed, or empty.
std::string pair_name(const std::string& a, const std::string& b, bool both,
                      const std::string& max);

/// A remark that GitHub shows beside a file.
struct GithubAnnotation {
  Outcome outcome;   ///< an error, a warning or a notice
  std::string file;  ///< empty: none
  std::string title, words;
  std::vector<std::string> notes = {};  ///< see server_notes
};
/// A line that GitHub's runner turns into an annotation.
std::string github_line(const GithubAnnotation& annotation);
/// The mark of an outcome in Markdown: ":x:".
const char* github_mark(Outcome outcome);
/// The text between backticks, for a cell of a table in Markdown.
std::string github_code(const std::string& text);

/// The same for an answer or an error, and the text that GitHub shows on the run's page.
std::string github_annotation(const Answer& answer);
std::string github_annotation(const Failure& failure);
std::string github_summary(const Answer& answer);

}  // namespace vkh
