// OFF as Geomview writes it: the keyword is optional, '#' begins a comment, a vertex's first three
// numbers are its position, and what follows a face's corners is its colour.
#include <charconv>

#include "host/base/text_scanner.h"
#include "host/read/readers.h"

namespace vkh {
namespace {

struct Counts {
  uint64_t vertices = 0, faces = 0;
};

// ST, C and N announce texture coordinates, colours and normals after the position on a vertex's
// line; 4 and n announce other dimensions.
bool is_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

uint64_t read_count(TextScanner& scanner, const char* what) {
  const auto count = scanner.number<int64_t>(what);
  if (count < 0) scanner.fail(std::to_string(count) + " as " + what, "a count of 0 or more");
  return static_cast<uint64_t>(count);
}

Counts read_counts(TextScanner& scanner) {
  const Counts counts{.vertices = read_count(scanner, "vertex count"),
                      .faces = read_count(scanner, "face count")};
  read_count(scanner, "edge count");
  if (const auto word = scanner.word(); !word.empty()) {
    scanner.fail(quoted(word) + " after the counts", "the end of the line");
  }
  // The shortest vertex is "0 0 0\n" and the shortest face "0\n"; the last line may lack its end.
  const uint64_t room = scanner.bytes_left() + 1;
  if (counts.vertices > room / 6 || counts.faces > (room - 6 * counts.vertices) / 2) {
    scanner.fail(std::to_string(counts.vertices) + " vertices and " + std::to_string(counts.faces) +
                     " faces announced in a file with " + std::to_string(scanner.bytes_left()) +
                     " bytes left",
                 "counts that fit the file");
  }
  if (counts.vertices >= UINT32_MAX) scanner.fail("too many vertices", "fewer than 2^32 - 1");
  return counts;
}

Counts read_header(TextScanner& scanner) {
  if (!scanner.next_full_line()) scanner.fail("the file holds no word", "OFF or three counts");
  TextScanner ahead = scanner;
  const std::string_view word = ahead.word();
  if (is_keyword(word)) {
    scanner.word();
    ahead = scanner;
    const std::string_view next = ahead.word();
    if (next == "BINARY") scanner.fail("binary OFF, which is not read", "ASCII OFF");
    if (next.empty() && !scanner.next_full_line()) {
      scanner.fail("the file ends after " + quoted(word), "counts of vertices, faces and edges");
    }
  } else if (uint64_t count = 0; !parse_number(word, count)) {
    scanner.fail("the file begins with " + quoted(word),
                 "OFF, COFF, NOFF or STOFF, or the vertex count");
  }
  return read_counts(scanner);
}

void next_element(TextScanner& scanner, const char* what, uint64_t number, uint64_t count) {
  if (scanner.next_full_line()) return;
  scanner.fail("the file ends at " + std::string(what) + " " + std::to_string(number),
               std::to_string(count) + " of them");
}

// What follows a position is its colour, normal or texture, alike in all rows. A row of another
// length is a face that a wrong count makes a vertex, and with as wrong a count of faces it would
// be lost in silence.
void read_vertices(TextScanner& scanner, const Counts& counts, MeshBuilder& builder) {
  builder.reserve(counts.vertices, counts.faces);
  uint64_t words_of_first = 0;
  for (uint64_t v = 0; v < counts.vertices; ++v) {
    next_element(scanner, "vertex", v, counts.vertices);
    glm::dvec3 p{};
    for (int axis = 0; axis < 3; ++axis) p[axis] = scanner.number<double>("coordinate");
    builder.add_vertex(p);
    uint64_t words = 3;
    while (!scanner.word().empty()) ++words;
    if (v == 0) words_of_first = words;
    if (words != words_of_first) {
      scanner.fail(std::to_string(words) + " words in vertex " + std::to_string(v),
                   std::to_string(words_of_first) + ", as in the first");
    }
  }
}

uint32_t read_index(TextScanner& scanner, uint64_t vertex_count) {
  const auto index = scanner.number<int64_t>("vertex index");
  if (index < 0 || static_cast<uint64_t>(index) >= vertex_count) {
    scanner.fail(
        "index " + std::to_string(index) + " of " + std::to_string(vertex_count) + " vertices",
        "0 or more and below that count");
  }
  return static_cast<uint32_t>(index);
}

}  // namespace

Mesh parse_off(const MeshSource& source) {
  TextScanner scanner(source.bytes, source.name, '#');
  MeshBuilder builder(source);
  const Counts counts = read_header(scanner);
  read_vertices(scanner, counts, builder);
  std::vector<uint32_t> corners;
  for (uint64_t f = 0; f < counts.faces; ++f) {
    next_element(scanner, "face", f, counts.faces);
    corners.clear();
    for (uint64_t left = read_count(scanner, "corner count"); left > 0; --left) {
      corners.push_back(read_index(scanner, counts.vertices));
    }
    builder.add_face(corners);
  }
  const std::string place = scanner.place();
  note_rest(scanner, builder.notes);
  return std::move(builder).finish(place);
}

}  // namespace vkh
