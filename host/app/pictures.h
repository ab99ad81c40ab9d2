// The outputs about all of A: its field, a picture, the report, a certificate.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/answer/request.h"
#include "host/base/output_file.h"
#include "host/show/draw_answer.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh {

/// Pictures that are checked before the run and written after it: a symmetric run has two files
/// each of field and picture, the reverse direction's with -b before its ending.
class Pictures {
 public:
  /// Throws UsageError if a file cannot be written, is one of `inputs`, or has an unknown ending.
  Pictures(const Outputs& asked, bool symmetric, const std::vector<std::string>& inputs);

  /// Returns what could not be written, and why; empty if nothing. `a` and `b`: the meshes as they
  /// were measured; null where the run was ended before it had all that they show.
  using MeshPointer = std::shared_ptr<const ReadMesh>;
  std::string write(const Answer& answer, const MeshPointer& a, const MeshPointer& b) const;

 private:
  struct Files {
    std::optional<OutputFile> there, back;
  };
  void write_tables(const Measured& measured) const;
  /// Writes pictures and the report.
  void draw(const Measured& measured) const;
  static void open(Files& files, const char* option, const std::optional<std::string>& path,
                   bool symmetric, const std::vector<std::string>& inputs);

  Outputs asked_;
  PictureStyle style_;
  Files field_, image_;
  std::optional<OutputFile> report_, certificate_, figures_, points_;
};

}  // namespace vkh
