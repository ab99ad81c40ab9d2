// The report: one HTML file that needs no network. Verdict, a view to turn, a tolerance to drag,
// the worst places, figures, and everything that names the run.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/show/mapped_picture.h"
#include "host/show/page_mesh.h"
#include "vkhausdorff/answer.h"

namespace vkh {

/// The measured mesh of one direction. The caller owns everything that it points to.
struct PageDirection {
  std::shared_ptr<const drawing::MappedPicture> shown;  ///< by the view, as by a picture
  std::string_view picture = {};                        ///< a PNG's bytes; empty: none
};

struct PageContents {
  const Answer* answer = nullptr;
  PageDirection a_to_b;
  std::optional<PageDirection> b_to_a = {};
  std::string title = {};  ///< the page's heading; empty: the names of both files
  Up up = Up::kZ;
};

struct PageLimits {
  size_t bytes = 5'000'000;  ///< size of the file: meshes are decimated until it is no larger
  size_t faces = 150'000;    ///< for a shown mesh: more would be slow to turn without a GPU
};

/// The mesh of one direction as a page shows it.
struct PageMesh {
  PackedMesh packed;
  Place place;
  bool is_decimated = false;
  double spacing = 0;  ///< as in ShownMesh
};

/// Returns the meshes of the directions, of at most `faces` faces each. This is a page's longest
/// step, and needs no pictures.
std::vector<PageMesh> page_meshes(const PageContents& contents, size_t faces = PageLimits{}.faces);

/// Returns the whole file, which carries the answer's JSON. Its figures are the answer's and its
/// survey's, and shares of area are the survey's at every tolerance. The view has the colours and
/// places of a picture, in fewer cells of the same map. If a mesh has more faces than a page holds,
/// the view has fewer faces, and says so. `meshes`: of as many faces as the limits say.
std::string to_page(const PageContents& contents, const PageLimits& limits,
                    std::vector<PageMesh> meshes);
std::string to_page(const PageContents& contents, const PageLimits& limits = {});

}  // namespace vkh
