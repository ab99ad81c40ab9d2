// XYZ and PTS: a point a row, as x y z and perhaps further columns, which are not read. PTS has the
// count of its rows in a row of its own before them. Blanks and tabs are between columns; a decimal
// comma, or columns that commas separate, cannot be told apart and are refused. '#', '//' and ';'
// begin comments. A first row of words alone is a heading.
#include <algorithm>
#include <cctype>
#include <optional>

#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/read/readers.h"
#include "host/read/text_blocks.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace {

/// The rows of one block, or of the whole text.
struct XyzRows {
  std::optional<uint64_t> announced;  ///< a count before the first row
  uint64_t columns = 0;               ///< of each row; 0: there is none
  bool has_heading = false;
};

class XyzReader {
 public:
  XyzReader(const MeshSource& source, const TextBlock& block, FileMeshBuilder& builder)
      : source_(source),
        block_(block),
        builder_(builder),
        scanner_(block.scanner(source.name, '#')) {}

  void read() {
    if (const size_t zero = block_.text.find('\0'); zero != std::string_view::npos)
      reject(source_.name, "byte " + std::to_string(zero), "a zero byte", "text, as XYZ is");
    bool is_first = block_.is_first;
    while (scanner_.next_full_line()) {
      if (is_comment()) continue;
      if (is_first && read_head()) continue;
      is_first = false;
      read_row();
    }
  }

  const XyzRows& rows() const { return rows_; }
  std::string place() const { return scanner_.place(); }

 private:
  bool is_comment() const {
    TextScanner ahead = scanner_;
    const std::string_view word = ahead.word();
    return word.starts_with("//") || word.starts_with(';');
  }

  // Reads a heading or a count, each once.
  bool read_head() {
    TextScanner ahead = scanner_;
    const std::string_view word = ahead.word();
    if (!rows_.has_heading && !rows_.announced && is_heading(word)) return rows_.has_heading = true;
    uint64_t count = 0;
    if (rows_.announced || !ahead.word().empty() || !parse_number(word, count)) return false;
    rows_.announced = count;
    return true;
  }

  // A heading begins with a letter, perhaps quoted; nan and inf are values.
  static bool is_heading(std::string_view word) {
    if (word.starts_with('"')) word.remove_prefix(1);
    if (word.empty() || std::isalpha(static_cast<unsigned char>(word.front())) == 0) return false;
    std::string lower(word.substr(0, 3));
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower != "nan" && lower != "inf";
  }

  void refuse_commas() const {
    TextScanner ahead = scanner_;
    const std::string_view word = ahead.word();
    if (word.find_first_of(",;") != std::string_view::npos)
      ahead.fail("a comma or a semicolon in " + quoted(word),
                 "blanks between columns, and points in decimals: x y z");
  }

  // Rows differ in length where one lost a coordinate.
  void read_row() {
    if (rows_.columns == 0) refuse_commas();
    glm::dvec3 p{};
    for (int axis = 0; axis < 3; ++axis) p[axis] = scanner_.number<double>("coordinate");
    builder_.add_vertex(p);
    uint64_t columns = 3;
    while (!scanner_.word().empty()) ++columns;
    if (rows_.columns == 0) rows_.columns = columns;
    if (columns != rows_.columns)
      scanner_.fail(counted(columns, "column"),
                    std::to_string(rows_.columns) + ", as in the first");
  }

  const MeshSource& source_;
  const TextBlock block_;
  FileMeshBuilder& builder_;
  TextScanner scanner_;
  XyzRows rows_;
};

void check_count(const MeshSource& source, const std::string& place, const XyzRows& rows,
                 uint64_t count) {
  if (!rows.announced || *rows.announced == count) return;
  reject(
      source.name, place,
      counted(count, "point") + " where the first row announces " + std::to_string(*rows.announced),
      "as many, in one scan");
}

void note_heading(const XyzRows& rows, FileMeshBuilder& builder) {
  if (rows.has_heading)
    builder.notes.push_back(note_of(NoteCode::kUnread, "a heading before the points ignored"));
}

ReadMesh read_xyz_whole(const MeshSource& source) {
  FileMeshBuilder builder(source);
  XyzReader reader(source, whole_text(source), builder);
  reader.read();
  check_count(source, reader.place(), reader.rows(), builder.vertices().size());
  note_heading(reader.rows(), builder);
  return std::move(builder).finish(reader.place());
}

ReadMesh read_xyz_by_blocks(const MeshSource& source) {
  TextBlocks blocks(source, 0, Cut::kLine);
  std::vector<FileMeshBuilder> builders = blocks.builders();
  std::vector<XyzRows> read(blocks.count());
  blocks.for_each(pool_of(source), [&](size_t i, const TextBlock& block) {
    XyzReader reader(blocks.source(), block, builders[i]);
    reader.read();
    read[i] = reader.rows();
  });
  uint64_t columns = 0;
  for (const XyzRows& rows : read) {
    if (columns == 0) columns = rows.columns;
    if (rows.columns != 0 && rows.columns != columns)
      reject(source.name, "byte 0", "rows of different lengths", "one length");
  }
  FileMeshBuilder all = FileMeshBuilder::joined(source, std::move(builders));
  check_count(source, "byte 0", read.front(), all.vertices().size());
  note_heading(read.front(), all);
  return std::move(all).finish("byte 0");
}

}  // namespace

ReadMesh parse_xyz(const MeshSource& given) {
  MeshSource source = given;
  source.limits.points = true;
  return by_blocks_or_whole(source, read_xyz_by_blocks, read_xyz_whole);
}

}  // namespace vkh
