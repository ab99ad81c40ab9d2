// A picture of A for a report, drawn off screen: each face in the colour of its certified upper
// bound, or of its verdict where a limit was asked about.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/gpu/device.h"
#include "host/survey/field.h"
#include "host/write/colour_map.h"

namespace vkh {

/// Rows from the top, four bytes a pixel: red, green and blue as sRGB has them, and 255.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

/// The point of A that proves lower, and its closest point on B.
struct Witness {
  SurfacePoint on_a, on_b;
};

/// What is drawn: a mesh with bounds for each of its faces, and what is said of them.
struct Picture {
  const Mesh& mesh;
  const Field& field;
  Enclosure interval;                     ///< of the largest distance over the mesh
  std::optional<Limit> limit = {};        ///< faces get verdicts in place of lengths
  std::string limit_as = {};              ///< as it was typed; empty: by its number
  std::optional<Verdict> verdict = {};    ///< of all that was asked; else by interval and limit
  std::optional<Witness> witness = {};    ///< else the face of the largest upper is magnified
  std::string unit = {};                  ///< of lengths; empty: the files' units
  std::string name = {}, against = {};    ///< of both meshes, as people know them
  bool back = false;                      ///< the mesh is B, and was measured against A
  std::vector<std::string> caption = {};  ///< lines below the picture
};

/// From where the mesh is seen.
struct View {
  enum class Kind {
    kIso,        ///< from a corner of the box, the first from which the witness is seen
    kSix,        ///< along each axis, in one picture
    kDirection,  ///< from `direction`
  };
  Kind kind = Kind::kIso;
  glm::dvec3 direction{};  ///< from the mesh to the viewer, of any length
};

/// Which axis points up in a picture.
enum class Up { kZ, kY };

struct PictureOptions {
  uint32_t width = 1600, height = 1000;
  View view = {};
  Up up = Up::kZ;
  ColourMap map = ColourMap::kViridis;
  /// Lengths at the ends of the colour bar, the same for all pictures of a batch; else from 0 to
  /// the largest upper that is finite.
  std::optional<Enclosure> range = {};
  uint32_t bands = 0;  ///< so many steps of colour; 0: as smooth as the map
};

inline constexpr uint32_t kLeastPictureWidth = 640, kLeastPictureHeight = 400,
                          kMostPictureSide = 8192;

/// "iso", "six" or "x,y,z"; "1600x1000". Each throws UsageError that names `option`.
View parse_view(const char* option, const std::string& text);
void parse_picture_size(const char* option, const std::string& text, PictureOptions& options);

/// Throws UsageError where the options make no sense, or the build has no stb; DeviceError where
/// the device's queue does not draw; MemoryError where it lacks memory for the size.
Image draw(const Device& device, const Picture& picture, const PictureOptions& options = {});

/// The bytes of a PNG file.
std::string encode_png(const Image& image);

}  // namespace vkh
