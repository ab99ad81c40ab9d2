// The outputs about all of A: its field, a picture, the report, a certificate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/answer/ask_files.h"
#include "host/base/output_file.h"
#include "host/batch/picture_folders.h"
#include "host/show/draw_answer.h"

namespace CLI {
class App;
}

namespace vkh {

/// The options as the user typed them.
struct TypedPictures {
  std::string field, image, report, certificate, figures, points, title;
  std::optional<std::string> image_folder, report_folder;  ///< the folders for many pairs
  std::optional<std::string> view, size, map, up;
  std::vector<std::string> range;
  std::optional<uint32_t> steps;

  bool any() const { return shows_cells() || !certificate.empty(); }
  bool shows_cells() const {
    return !field.empty() || !image.empty() || !report.empty() || !figures.empty() ||
           !points.empty();
  }
  bool draws_surface() const {
    return !image.empty() || !report.empty() || !figures.empty() || !points.empty() ||
           image_folder || report_folder;
  }
  bool is_of_triangles() const {
    return !report.empty() || report_folder || !certificate.empty() || !figures.empty();
  }
};
void add_picture_options(CLI::App& command, TypedPictures& typed);
void add_certificate_option(CLI::App& command, TypedPictures& typed);
void add_folder_options(CLI::App& command, TypedPictures& typed);

/// The outputs that the user asked for.
struct PicturesAsked {
  std::optional<std::string> field, image, report, certificate, figures, points;  ///< files
  std::string title;  ///< the report's heading; empty: the names of the files
  PictureStyle look;

  bool any() const { return of_cells() || certificate; }
  bool of_cells() const { return field || image || report || figures || points; }
  bool of_statistics() const { return report || figures; }
};
/// Throw UsageError.
PicturesAsked asked_of(const TypedPictures& typed);
FoldersAsked folders_of(const TypedPictures& typed);

/// Pictures that are checked before the run and written after it: a symmetric run has two files
/// each of field and picture, the reverse direction's with -b before its ending.
class Pictures {
 public:
  /// Throws UsageError if a file cannot be written, is one of `inputs`, or has an unknown ending.
  Pictures(const PicturesAsked& asked, bool symmetric, const std::vector<std::string>& inputs);

  /// Returns what could not be written, and why; empty if nothing.
  std::string write(const Answered& done) const;

 private:
  struct Files {
    std::optional<OutputFile> there, back;
  };
  void write_tables(const Measured& measured) const;
  static void open(Files& files, const char* option, const std::optional<std::string>& path,
                   bool symmetric, const std::vector<std::string>& inputs);

  PicturesAsked asked_;
  Files field_, image_;
  std::optional<OutputFile> report_, certificate_, figures_, points_;
};

}  // namespace vkh
