// Finds which columns of a text of points are x, y and z, by its heading or comments.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vkh {

/// The format of the rows of a text of points.
struct PointColumns {
  char separator = ' ';        ///< a blank stands for blanks and tabs
  size_t count = 0;            ///< of each row
  bool may_be_longer = false;  ///< rows end in a list, as COLMAP's do
  bool may_be_quoted = false;  ///< cells may be between quotes
  bool are_named = false;  ///< every column has a name, so that whether the first one is x is known
  std::array<size_t, 3> axes = {0, 1, 2};
};

/// The columns of one row, from left to right. Cells in quotes may hold separators.
class PointCells {
 public:
  /// A separator that is a blank cuts at any blank space. A comment by # ends the row.
  PointCells(std::string_view row, char separator);
  /// Returns the next cell without blanks and quotes around it; nothing at the row's end. An empty
  /// cell at the end does not count: writers end rows with a separator.
  std::optional<std::string_view> next();
  size_t count_rest();

 private:
  std::string_view rest_;
  char separator_;
};

/// Returns the line without the comment's sign, if it is a comment: #, // or ;.
std::optional<std::string_view> comment_in(std::string_view line);

/// A line before the rows that may name columns.
class ColumnNames {
 public:
  enum class From { kHeading, kComment };
  ColumnNames(std::string_view text, From from, size_t line);

  size_t line() const { return line_; }
  bool is_heading() const { return from_ == From::kHeading; }
  /// Whether x, y and z are among its names.
  bool has_axes() const;
  /// Whether both lines have the same names.
  bool is_like(const ColumnNames& other) const {
    return from_ == other.from_ && separator_ == other.separator_ && names_ == other.names_;
  }
  /// One word or two that name no axis.
  bool is_title() const;
  /// A comma, a semicolon or a tab that separates the names, or a blank.
  char separator() const { return separator_; }
  /// Whether it names each of `count` columns, including x, y and z.
  bool names_each_of(size_t count) const { return has_axes() && names_.size() == count; }
  /// The places of x, y and z in rows of `count` columns, if the line says so. Throws
  /// UnclearColumns.
  std::optional<PointColumns> columns(size_t count) const;
  /// Whether it names other coordinates, such as longitude and latitude.
  bool names_others() const;

 private:
  enum class Name : uint8_t { kX, kY, kZ, kKnown, kUnknown, kPlace, kNumber, kList };
  using Names = std::vector<Name>;
  /// A reading of a line: places of x, y and z.
  struct Readings {
    std::optional<std::array<size_t, 3>> first;
    bool are_several = false;

    void add(const std::array<size_t, 3>& axes);
  };

  static bool is_axis_name(Name name);
  static Name name_of(std::string_view text);
  static Names names_between(std::string_view text, char separator);
  bool has_neighbouring_axes() const;
  static void add_readings(std::span<const Name> names, size_t count, Readings& readings);
  PointColumns columns_before_list(size_t list, size_t count) const;

  From from_;
  size_t line_;
  char separator_ = ' ';
  Names names_;
};

/// Thrown by columns(): none or several readings of the names are right.
struct UnclearColumns {};

/// An example of a heading for this many columns.
std::string example_heading(size_t columns, char separator, bool with_number);

}  // namespace vkh
