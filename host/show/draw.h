// A picture of A for a report, drawn by the host: by cells in the colours of estimated distances.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "vkhausdorff/cell_map.h"
#include "vkhausdorff/colour_map.h"
#include "vkhausdorff/field.h"

namespace vkh {

/// Rows from the top, four bytes a pixel: red, green and blue as sRGB has them, and 255.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

/// The point of A that proves the lower bound, and its closest point on B.
struct Witness {
  SurfacePoint on_a, on_b;
  /// The largest distance; its upper end is infinite where it was not sought.
  Enclosure distance = {0, std::numeric_limits<double>::infinity()};
};

/// The input of a picture: a mesh with bounds for each of its faces, its map, and its texts.
struct Picture {
  const Mesh& mesh;
  const Field& field;
  Enclosure interval;               ///< encloses the largest distance over the mesh
  std::optional<Limit> limit = {};  ///< the limit that was asked about
  std::string limit_as = {};        ///< as the user typed it; empty: by its number
  std::optional<Verdict> verdict =
      {};  ///< of the whole question; otherwise it follows from interval and limit
  std::optional<Witness> witness = {};    ///< it is one of the worst places
  std::string unit = {};                  ///< of lengths; empty: the files' units
  std::string name = {}, against = {};    ///< names of both meshes, as people know them
  bool back = false;                      ///< the mesh is B, and was measured against A
  std::vector<std::string> caption = {};  ///< lines below the picture
  /// The mesh by cells; null: no survey gave one, and the bounds of faces stand in.
  const CellMap* map = nullptr;
  const Statistics* statistics = nullptr;  ///< figures; null: none were asked for
  std::optional<SidedLimits> sided = {};   ///< limits that differ by side
  /// The survey's shares and bar; null: limits, map and options decide the bar.
  const MapShares* shares = nullptr;
  std::string unfinished = {};  ///< why the survey was cut short; empty: it was not
};

/// The view of the mesh.
struct View {
  enum class Kind {
    kIso,        ///< from above a corner of the box
    kSix,        ///< along each axis, in one picture, without views that see nothing
    kDirection,  ///< from `direction`
  };
  Kind kind = Kind::kIso;
  glm::dvec3 direction{};  ///< from the mesh to the viewer, of any length
};

/// The axis that points up in a picture.
enum class Up { kZ, kY };

struct PictureOptions {
  uint32_t width = 1600, height = 1000;
  View view = {};
  Up up = Up::kZ;
  ColourMap map = ColourMap::kViridis;
  /// The lengths at the ends of the colour bar, the same for all pictures of a batch; otherwise
  /// from 0 to one and a half times the limit, or else to CellMap::bar.
  std::optional<Enclosure> range = {};
  uint32_t bands = 0;  ///< number of steps of colour; 0: as smooth as the map
};

inline constexpr uint32_t kLeastPictureWidth = 640, kLeastPictureHeight = 400,
                          kMostPictureSide = 8192;

/// Reads "iso", "six" or "x,y,z"; "1600x1000". Each throws UsageError that names `option`.
View parse_view(const char* option, const std::string& text);
void parse_picture_size(const char* option, const std::string& text, PictureOptions& options);

/// Throws UsageError if the options make no sense.
void check_picture(const Picture& picture, const PictureOptions& options);

/// Throws what check_picture() throws, and UsageError if the build has no stb. The same bytes on
/// every machine.
Image draw(const Picture& picture, const PictureOptions& options = {});

/// The bytes of a PNG file.
std::string encode_png(const Image& image);

}  // namespace vkh
