// XYZ and PTS: a point a row, whose columns blanks, tabs, commas or semicolons separate. A heading
// or a comment names the columns (host/read/point_columns.h); unnamed, the first three are x, y and
// z. PTS has the count of its rows in a row of its own before them, and may hold several scans. A
// decimal comma is refused, and so are commas that may be decimal ones. '#', '//' and ';' begin
// comments.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/read/point_columns.h"
#include "host/read/readers.h"
#include "host/read/text_blocks.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace {

/// The first column of rows that follow each other: integers that increase may be the points'
/// numbers.
struct FirstColumn {
  uint64_t rows = 0;
  double first = 0, last = 0;
  bool increases = true;       ///< by integers
  bool is_consecutive = true;  ///< by 1
  bool has_fractions = false;  ///< in the two columns behind it

  void add(const glm::dvec3& row) {
    if (!increases) return;
    has_fractions = has_fractions || row.y != std::trunc(row.y) || row.z != std::trunc(row.z);
    append({.rows = 1, .first = row.x, .last = row.x, .increases = row.x == std::trunc(row.x)});
  }
  void append(const FirstColumn& next) {
    if (next.rows == 0) return;
    if (rows == 0) first = next.first;
    increases = increases && next.increases && (rows == 0 || next.first > last);
    is_consecutive = is_consecutive && next.is_consecutive && (rows == 0 || next.first == last + 1);
    has_fractions = has_fractions || next.has_fractions;
    last = next.last;
    rows += next.rows;
  }
  bool may_be_numbers() const { return rows > 1 && increases && (is_consecutive || has_fractions); }
};

/// The text before the rows.
struct XyzHead {
  std::vector<ColumnNames> names;
  std::optional<uint64_t> announced;  ///< a count of rows
  bool has_title = false, has_rows = false;
  size_t begin = 0;  ///< the byte before the first row
};

[[noreturn]] void refuse_names(const MeshSource& source, const ColumnNames& names, size_t count) {
  reject(source.name, "line " + std::to_string(names.line()),
         std::string(names.is_heading() ? "a heading" : "a comment") +
             " that does not tell which of " + counted(count, "column") + " are x, y and z",
         "a name for each, such as " + example_heading(count, ' ', false));
}

std::optional<PointColumns> named_columns(const MeshSource& source, const ColumnNames& names,
                                          size_t count) {
  try {
    return names.columns(count);
  } catch (const UnclearColumns&) {
    refuse_names(source, names, count);
  }
}

double coordinate(const TextScanner& scanner, std::string_view word) {
  double value = 0;
  if (parse_number(word, value)) return value;
  if (word.find_first_of(", \t") != std::string_view::npos)
    scanner.fail("a comma or a blank in " + quoted(word),
                 "decimal points, and one separator between all columns");
  return scanner.number_in<double>(word, "coordinate");
}

/// The integer that is alone in a line.
std::optional<uint64_t> lone_count(const TextScanner& scanner) {
  PointCells cells(scanner.rest(), ' ');
  const auto word = cells.next();
  uint64_t count = 0;
  if (!word || cells.next() || !parse_number(*word, count)) return std::nullopt;
  return count;
}

// A heading begins with a letter, perhaps quoted; nan and inf are values.
bool is_heading(std::string_view word) {
  if (word.starts_with('"')) word.remove_prefix(1);
  if (word.empty() || std::isalpha(static_cast<unsigned char>(word.front())) == 0) return false;
  std::string lower(word.substr(0, 3));
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower != "nan" && lower != "inf";
}

// Keeps what names columns, each way once. The limit keeps a file of nothing else from taking more
// memory than its bytes.
void keep_names(const TextScanner& scanner, const ColumnNames& names, XyzHead& head) {
  constexpr size_t kMost = 16;
  if (names.names_others())
    scanner.fail("names of other coordinates, such as longitude or easting",
                 "columns named x, y and z");
  const auto is_like = [&](const ColumnNames& kept) { return kept.is_like(names); };
  if (!names.has_axes() && !names.is_heading()) return;
  if (std::any_of(head.names.begin(), head.names.end(), is_like)) return;
  if (head.names.size() == kMost)
    scanner.fail("one more of " + std::to_string(kMost) + " lines that name columns", "one line");
  head.names.push_back(names);
}

/// Reads a line before the first row; returns false at that row.
bool read_head_line(const TextScanner& scanner, XyzHead& head, bool& has_heading) {
  const size_t line = scanner.line_number();
  TextScanner ahead = scanner;
  if (const auto comment = comment_in(scanner.rest())) {
    keep_names(scanner, {*comment, ColumnNames::From::kComment, line}, head);
  } else if (const auto count = lone_count(scanner); count && !head.announced) {
    head.announced = count;
  } else if (!has_heading && is_heading(ahead.word())) {
    has_heading = true;
    const ColumnNames names(scanner.rest(), ColumnNames::From::kHeading, line);
    head.has_title = names.is_title();
    if (!head.has_title) keep_names(scanner, names, head);
  } else {
    return false;
  }
  return true;
}

/// Reads to the first row, and stays there.
XyzHead read_head(TextScanner& scanner) {
  XyzHead head;
  bool has_heading = false;
  for (head.begin = scanner.offset(); scanner.next_full_line(); head.begin = scanner.offset()) {
    head.has_rows = !read_head_line(scanner, head, has_heading);
    if (head.has_rows) break;
  }
  return head;
}

// The separator of a heading, if the row has it, too; otherwise the character after the first
// number.
char separator_of(const TextScanner& scanner, const std::vector<ColumnNames>& lines) {
  const std::string_view row = scanner.rest();
  for (const ColumnNames& names : lines) {
    const char separator = names.separator();
    const bool is_there = separator != ' ' && row.find(separator) != std::string_view::npos;
    if (is_there &&
        (separator != '\t' || names.names_each_of(PointCells(row, separator).count_rest())))
      return separator;
  }
  TextScanner ahead = scanner;
  const std::string_view first = ahead.word(), second = ahead.word();
  for (const char separator : {';', ','}) {
    if (first.find(separator) != std::string_view::npos || second.starts_with(separator))
      return separator;
  }
  return ' ';
}

// Blanks between numbers separate them: a comma there is a decimal one. So may the commas be
// between digits alone, unless there are too few for that.
void refuse_decimal_commas(const TextScanner& scanner, size_t columns) {
  PointCells cells(scanner.rest(), ',');
  bool has_point = false;
  while (const auto cell = cells.next()) {
    PointCells words(*cell, ' ');
    double number = 0;
    const auto first = words.next(), second = words.next();
    if (first && second && parse_number(*first, number) && parse_number(*second, number))
      scanner.fail("decimal commas, as in " + quoted(*cell), "decimal points");
    has_point = has_point || (parse_number(*cell, number) && cell->find('.') != cell->npos);
  }
  if (columns > 3 && !has_point)
    scanner.fail(std::to_string(columns) + " columns between commas that may be decimal ones",
                 "decimal points, or a heading such as " + example_heading(columns, ',', false));
}

/// Finds the columns by the first row, the current line.
PointColumns columns_of_row(const TextScanner& scanner, const MeshSource& source,
                            const std::vector<ColumnNames>& lines) {
  PointColumns columns{.separator = separator_of(scanner, lines)};
  const std::string_view row = scanner.rest();
  const size_t count = PointCells(row, columns.separator).count_rest();
  columns.count = count;
  const auto names_each = [&](const ColumnNames& names) { return names.names_each_of(count); };
  if (columns.separator == ',' && std::none_of(lines.begin(), lines.end(), names_each))
    refuse_decimal_commas(scanner, count);
  bool is_known = false;
  for (const ColumnNames& names : lines) {
    const auto named = named_columns(source, names, count);
    if (!named) continue;
    if (is_known && named->axes != columns.axes) refuse_names(source, names, count);
    if (!is_known || named->are_named) {
      const char separator = columns.separator;
      columns = *named;
      columns.separator = separator;
    }
    is_known = true;
  }
  columns.may_be_quoted = columns.separator != ' ' || row.find('"') != std::string_view::npos;
  return columns;
}

/// Reads rows of known columns, as many as a scan has, or a block.
class XyzRows {
 public:
  XyzRows(TextScanner& scanner, const PointColumns& columns, FileMeshBuilder& builder)
      : scanner_(scanner), columns_(columns), builder_(builder) {}

  /// Reads from the current line to the end, or, after `announced` rows, to the count of another
  /// scan.
  void read(std::optional<uint64_t> announced) {
    do {
      if (const auto comment = comment_in_line()) {
        check_comment(*comment);
        continue;
      }
      if (announced == rows_ && (next_count_ = lone_count(scanner_))) return;
      read_row();
      ++rows_;
    } while (scanner_.next_full_line());
  }

  uint64_t count() const { return rows_; }
  const std::optional<uint64_t>& next_count() const { return next_count_; }
  const FirstColumn& first_column() const { return first_; }

 private:
  std::optional<std::string_view> comment_in_line() const {
    const char first = scanner_.peek();
    if (first != '#' && first != '/' && first != ';') return std::nullopt;
    return comment_in(scanner_.rest());
  }

  // A comment between rows may be the heading of further rows, if files were joined.
  void check_comment(std::string_view comment) const {
    const ColumnNames names(comment, ColumnNames::From::kComment, scanner_.line_number());
    try {
      const auto named = names.columns(columns_.count);
      if (named && named->axes != columns_.axes)
        scanner_.fail("a comment that names other columns than those of the rows before",
                      "one order of columns");
    } catch (const UnclearColumns&) {  // NOLINT(bugprone-empty-catch): a sentence among rows
    }
  }

  void read_row() {
    glm::dvec3 p{};
    size_t count = 0, found = 0;
    const auto take = [&](std::string_view word) {
      for (size_t axis = 0; axis < 3; ++axis) {
        if (columns_.axes[axis] != count) continue;
        p[static_cast<int>(axis)] = coordinate(scanner_, word);
        ++found;
      }
      ++count;
    };
    if (columns_.may_be_quoted) {
      PointCells cells(scanner_.rest(), columns_.separator);
      while (const auto cell = cells.next()) take(*cell);
    } else {
      for (std::string_view word = scanner_.word(); !word.empty() && word.front() != '#';
           word = scanner_.word())
        take(word);
    }
    if (found < 3) coordinate(scanner_, {});
    check_length(count);
    if (columns_.count > 3 && !columns_.are_named) first_.add(p);
    builder_.add_vertex(p);
  }

  // Rows differ in length where one lost a coordinate.
  void check_length(size_t count) const {
    if (count == columns_.count || (columns_.may_be_longer && count > columns_.count)) return;
    scanner_.fail(counted(count, "column"),
                  std::to_string(columns_.count) + ", as in the first row");
  }

  TextScanner& scanner_;
  const PointColumns columns_;
  FileMeshBuilder& builder_;
  uint64_t rows_ = 0;
  std::optional<uint64_t> next_count_;
  FirstColumn first_;
};

/// Goes to the next line that holds more than a comment.
bool next_row(TextScanner& scanner) {
  while (scanner.next_full_line()) {
    if (!comment_in(scanner.rest())) return true;
  }
  return false;
}

void check_first_column(const MeshSource& source, const std::string& place,
                        const PointColumns& columns, const FirstColumn& first) {
  if (!first.may_be_numbers()) return;
  const char separator = columns.separator == '\t' ? ' ' : columns.separator;
  reject(source.name, place,
         "a first column of increasing integers, which may be the points' numbers or x",
         "a heading that says which: " + example_heading(columns.count, separator, true) + " or " +
             example_heading(columns.count, separator, false));
}

void check_count(const MeshSource& source, const std::string& place,
                 std::optional<uint64_t> announced, uint64_t count) {
  if (!announced || *announced == count) return;
  reject(source.name, place,
         counted(count, "point") + " where the row before them announces " +
             std::to_string(*announced),
         "as many in each scan");
}

void note_head(const XyzHead& head, const PointColumns& columns, size_t scans,
               FileMeshBuilder& builder) {
  const auto note = [&](const std::string& text) {
    builder.notes.push_back(note_of(NoteCode::kUnread, text));
  };
  if (head.has_title) note("a title before the points ignored");
  const auto& [x, y, z] = columns.axes;
  if (columns.axes != PointColumns().axes)
    note("x, y and z are columns " + std::to_string(x + 1) + ", " + std::to_string(y + 1) +
         " and " + std::to_string(z + 1) + ", as they are named; others ignored");
  if (scans > 1) note(std::to_string(scans) + " scans, all of which are read");
}

void refuse_zero_byte(const MeshSource& source, std::string_view text) {
  if (const size_t zero = text.find('\0'); zero != std::string_view::npos)
    reject(source.name, "byte " + std::to_string(zero), "a zero byte", "text, as XYZ is");
}

ReadMesh read_xyz_whole(const MeshSource& source) {
  refuse_zero_byte(source, source.bytes);
  TextScanner scanner = whole_text(source).scanner(source.name);
  const XyzHead head = read_head(scanner);
  FileMeshBuilder builder(source);
  PointColumns columns;
  std::optional<uint64_t> announced = head.announced;
  size_t scans = 0;
  for (bool goes_on = head.has_rows; goes_on; ++scans) {
    columns = columns_of_row(scanner, source, head.names);
    const std::string begin = scanner.place();
    XyzRows rows(scanner, columns, builder);
    rows.read(announced);
    check_count(source, scanner.place(), announced, rows.count());
    check_first_column(source, begin, columns, rows.first_column());
    announced = rows.next_count();
    goes_on = announced && next_row(scanner);
  }
  if (announced) check_count(source, scanner.place(), announced, 0);
  note_head(head, columns, scans, builder);
  return std::move(builder).finish(scanner.place());
}

ReadMesh read_xyz_by_blocks(const MeshSource& source) {
  Windows windows(source);
  Windows::Window window(windows);
  const std::string_view text = window.read(0, std::min(kTextHeader, source.size()));
  TextScanner scanner(text, source.name);
  const XyzHead head = read_head(scanner);
  refuse_zero_byte(source, text.substr(0, head.begin));
  check_header_ends(scanner, source);
  const PointColumns columns = columns_of_row(scanner, source, head.names);
  TextBlocks blocks(source, head.begin, Cut::kLine);
  std::vector<FileMeshBuilder> builders = blocks.builders();
  std::vector<FirstColumn> first_columns(blocks.count());
  blocks.for_each(pool_of(source), [&](size_t i, const TextBlock& block) {
    refuse_zero_byte(source, block.text);
    TextScanner lines = block.scanner(source.name);
    if (!lines.next_full_line()) return;
    XyzRows rows(lines, columns, builders[i]);
    rows.read(std::nullopt);
    first_columns[i] = rows.first_column();
  });
  FirstColumn first;
  for (const FirstColumn& block : first_columns) first.append(block);
  check_first_column(source, "byte 0", columns, first);
  FileMeshBuilder all = FileMeshBuilder::joined(source, std::move(builders));
  check_count(source, "byte 0", head.announced, all.vertices().size());
  note_head(head, columns, 1, all);
  return std::move(all).finish("byte 0");
}

}  // namespace

ReadMesh parse_xyz(const MeshSource& given) {
  MeshSource source = given;
  source.limits.points = true;
  return by_blocks_or_whole(source, read_xyz_by_blocks, read_xyz_whole);
}

bool looks_like_xyz(std::string_view head) {
  TextScanner scanner(head, "", '\0', MixedLineEnds::kIgnored);
  bool has_heading = false;
  while (scanner.next_full_line()) {
    if (comment_in(scanner.rest())) continue;
    const std::string_view word =
        PointCells(scanner.rest(), ' ').next().value_or(std::string_view());
    double number = 0;
    if (parse_number(word.substr(0, word.find_first_of(",;\"")), number)) return true;
    if (has_heading || !is_heading(word)) return false;
    has_heading = true;
    if (ColumnNames(scanner.rest(), ColumnNames::From::kHeading, 1).is_title()) return false;
  }
  return false;
}

}  // namespace vkh
