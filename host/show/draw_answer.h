// Draws an answer once its faces have bounds: pictures, and the report as a page.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/answer/request.h"
#include "host/show/mapped_picture.h"
#include "vkhausdorff/answer.h"

namespace vkh {

/// The look of pictures.
struct PictureStyle {
  PictureOptions options;
  std::optional<std::array<Length, 2>> range;  ///< range of colours; none: each picture has its own
  bool is_plain = false;  ///< distances have signs only where the question asks for sides
};

/// Throws UsageError for an invalid view, axis, size or map.
PictureStyle style_of(const Look& look);

/// An answer with its surveys and its inputs.
struct Measured {
  const Answer& answer;
  const Mesh& a;
  const Mesh& b;
};

/// One direction of an answer, and its survey.
struct Side {
  const Mesh& mesh;
  const Report& report;
  const SurveyResult& survey;
  bool back;
};

/// Adds to the question what such a picture shows: a map by cells.
void ask_for(const PictureStyle& look, Question& question);

/// Returns one, or both of a symmetric answer. Throws OutputError if nothing was surveyed.
std::vector<Side> sides_of(const Measured& measured);

/// The name of a mesh as people know it: its file's name without the folder.
std::string label_of(const Answer& answer, bool back);

Enclosure interval_of(const Side& side);

/// The data of a picture of a side, and of a page and a table of its places. It refers to the side
/// and the answer.
Picture drawn_of(const Side& side, const Answer& answer);

/// An answer as its pictures and its page show it: data that both need are computed once.
class ShownAnswer {
 public:
  /// Refers to what is measured. Throws what sides_of() and check_picture() throw, and UsageError
  /// for a range that the files' units do not resolve.
  ShownAnswer(const Measured& measured, const PictureStyle& look);

  /// Returns the bytes of a PNG for each side. A page shows them if there is no WebGL.
  std::vector<std::string> pictures() const;

  struct Page {
    std::vector<std::string> pictures;
    std::string text;
  };
  /// Returns the pictures, and a page with them and their colours. `title`: its heading; empty: the
  /// names of both files.
  Page page(const std::string& title = {}) const;

 private:
  const Answer& answer_;
  const PictureOptions options_;
  std::vector<std::shared_ptr<const drawing::MappedPicture>> sides_;
};

}  // namespace vkh
