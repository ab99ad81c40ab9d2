// OFF as Geomview writes it: the keyword is optional, '#' begins a comment, a vertex's first three
// numbers are its position, and a face's corners are followed by its colour. As others write it,
// the first count is glued to the keyword, that of edges is missing, and rows go on in the next
// line.
#include <algorithm>
#include <functional>
#include <optional>

#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/read/readers.h"
#include "host/read/text_blocks.h"

namespace vkh {
namespace {

struct Counts {
  uint64_t vertices = 0, faces = 0;
};

// ST, C and N announce texture coordinates, colours and normals after the position on a vertex's
// line; 4 and n announce other dimensions. Returns what follows the keyword in its word, all digits
// (ModelNet40's files lack a line end there), or nothing if the word is another.
std::optional<std::string_view> after_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  if (!word.starts_with("OFF")) return std::nullopt;
  word.remove_prefix(3);
  if (word.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  return word;
}

uint64_t count_in(const TextScanner& scanner, std::string_view word, const char* what) {
  const auto count = scanner.number_in<int64_t>(word, what);
  if (count < 0) scanner.fail(std::to_string(count) + " as " + what, "a count of 0 or more");
  return static_cast<uint64_t>(count);
}

// Edges are not read, and may not be counted.
Counts read_counts(TextScanner& scanner, std::string_view glued, uint64_t file_bytes) {
  const std::string_view first = glued.empty() ? scanner.word() : glued;
  const Counts counts{.vertices = count_in(scanner, first, "vertex count"),
                      .faces = count_in(scanner, scanner.word(), "face count")};
  if (const auto edges = scanner.word(); !edges.empty()) count_in(scanner, edges, "edge count");
  if (const auto word = scanner.word(); !word.empty()) {
    scanner.fail(quoted(word) + " after the counts", "the end of the line");
  }
  // The shortest vertex is "0 0 0\n" and the shortest face "0\n"; the last line may lack its end.
  const uint64_t left = file_bytes - scanner.offset();
  const uint64_t room = left + 1;
  if (counts.vertices > room / 6 || counts.faces > (room - 6 * counts.vertices) / 2) {
    scanner.fail(std::to_string(counts.vertices) + " vertices and " + std::to_string(counts.faces) +
                     " faces announced in a file with " + std::to_string(left) + " bytes left",
                 "counts that fit the file");
  }
  if (counts.vertices >= UINT32_MAX) scanner.fail("too many vertices", "fewer than 2^32 - 1");
  return counts;
}

Counts read_off_header(TextScanner& scanner, uint64_t file_bytes) {
  if (!scanner.next_full_line()) scanner.fail("the file holds no word", "OFF or three counts");
  TextScanner ahead = scanner;
  const std::string_view word = ahead.word();
  std::string_view glued;
  if (const auto after = after_keyword(word)) {
    scanner.word();
    glued = *after;
    ahead = scanner;
    const std::string_view next = ahead.word();
    if (next == "BINARY") scanner.fail("binary OFF, which is not read", "ASCII OFF");
    if (glued.empty() && next.empty() && !scanner.next_full_line()) {
      scanner.fail("the file ends after " + quoted(word), "counts of vertices, faces and edges");
    }
  } else if (uint64_t count = 0; !parse_number(word, count)) {
    scanner.fail("the file begins with " + quoted(word),
                 "OFF, COFF, NOFF or STOFF, or the vertex count");
  }
  return read_counts(scanner, glued, file_bytes);
}

void next_element(TextScanner& scanner, const char* what, uint64_t number, uint64_t count) {
  if (scanner.next_full_line()) return;
  scanner.fail("the file ends at " + std::string(what) + " " + std::to_string(number),
               std::to_string(count) + " of them");
}

uint32_t index_in(const TextScanner& scanner, std::string_view word, uint64_t vertex_count) {
  const auto index = scanner.number_in<int64_t>(word, "vertex index");
  if (index < 0 || static_cast<uint64_t>(index) >= vertex_count) {
    scanner.fail(
        "index " + std::to_string(index) + " of " + std::to_string(vertex_count) + " vertices",
        "0 or more and below that count");
  }
  return static_cast<uint32_t>(index);
}

class RowReader {
 public:
  RowReader(TextScanner& scanner, const Counts& counts, FileMeshBuilder& builder)
      : scanner_(scanner), counts_(counts), builder_(builder) {}

  /// Vertices and faces are counted as one.
  void read(uint64_t begin, uint64_t end) {
    for (uint64_t row = begin; row < end; ++row) {
      if (row < counts_.vertices) {
        read_vertex(row);
      } else {
        read_face(row - counts_.vertices);
      }
    }
  }

  /// Words of the first vertex that was read; 0 if none was.
  uint64_t words_of_vertex() const { return words_of_first_; }

 private:
  // A position is followed by its colour, normal or texture, alike in all rows. A row of another
  // length is a face that a wrong count makes a vertex, and with as wrong a count of faces it would
  // be lost in silence.
  void read_vertex(uint64_t v) {
    begin_row("vertex", v, counts_.vertices);
    glm::dvec3 p{};
    for (int axis = 0; axis < 3; ++axis) p[axis] = scanner_.coordinate_in(next_word());
    builder_.add_vertex(p);
    check_wrapped("vertex", v);
    uint64_t words = 3;
    while (!scanner_.word().empty()) ++words;
    if (words_of_first_ == 0) words_of_first_ = words;
    if (words != words_of_first_) {
      scanner_.fail(std::to_string(words) + " words in vertex " + std::to_string(v),
                    std::to_string(words_of_first_) + ", as in the first");
    }
  }

  void read_face(uint64_t f) {
    begin_row("face", f, counts_.faces);
    corners_.clear();
    for (uint64_t left = count_in(scanner_, scanner_.word(), "corner count"); left > 0; --left)
      corners_.push_back(index_in(scanner_, next_word(), counts_.vertices));
    check_wrapped("face", f);
    builder_.add_face(corners_);
  }

  void begin_row(const char* what, uint64_t number, uint64_t count) {
    next_element(scanner_, what, number, count);
    line_ = scanner_.line_number();
  }

  // A row may go on in the next line.
  std::string_view next_word() {
    const std::string_view word = scanner_.word();
    return word.empty() ? scanner_.word_across_lines() : word;
  }

  // Nothing may follow a row of several lines on its last line: otherwise rows that lack a word
  // would be read as other rows.
  void check_wrapped(const char* what, uint64_t number) {
    if (scanner_.line_number() == line_) return;
    if (const auto word = scanner_.word(); !word.empty()) {
      scanner_.fail(quoted(word) + " behind " + what + " " + std::to_string(number) +
                        ", which begins in line " + std::to_string(line_),
                    "as many words as the row needs");
    }
  }

  TextScanner& scanner_;
  const Counts& counts_;
  FileMeshBuilder& builder_;
  std::vector<uint32_t> corners_;
  size_t line_ = 0;  ///< the line in which the row begins
  uint64_t words_of_first_ = 0;
};

ReadMesh read_off_whole(const MeshSource& source) {
  TextScanner scanner(source.bytes, source.name, '#');
  FileMeshBuilder builder(source);
  const Counts counts = read_off_header(scanner, source.size());
  builder.reserve(counts.vertices, counts.faces);
  {
    RowReader rows(scanner, counts, builder);
    rows.read(0, counts.vertices + counts.faces);
  }  // its memory is free before more is taken
  const std::string place = scanner.place();
  note_rest(scanner, builder.notes);
  return std::move(builder).finish(place);
}

ReadMesh read_off_by_blocks(const MeshSource& source) {
  Windows windows(source);
  Windows::Window window(windows);
  const auto head = window.read(0, std::min(kTextHeader, source.size()));
  TextScanner header(head, source.name, '#');
  const Counts counts = read_off_header(header, source.size());
  check_header_ends(header, source);
  FileMeshBuilder(source).check_room(counts.vertices, counts.faces);
  RowBlocks blocks(source, header.offset(), '#');
  std::vector<FileMeshBuilder> builders = blocks.builders();
  std::vector<uint64_t> words(builders.size());
  blocks.for_each(counts.vertices + counts.faces, [&](size_t i, const Rows& rows) {
    RowReader reader(rows.scanner, counts, builders[i]);
    reader.read(rows.begin, rows.end);
    words[i] = reader.words_of_vertex();
  });
  words.erase(std::remove(words.begin(), words.end(), 0), words.end());
  if (std::adjacent_find(words.begin(), words.end(), std::not_equal_to()) != words.end())
    reject(source.name, "byte 0", "vertices of different lengths", "one length");
  return FileMeshBuilder::joined(source, std::move(builders)).finish("byte 0");
}

}  // namespace

ReadMesh parse_off(const MeshSource& source) {
  return by_blocks_or_whole(source, read_off_by_blocks, read_off_whole);
}

}  // namespace vkh
