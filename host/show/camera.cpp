#include "host/show/camera.h"

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "host/base/from_chars.h"
#include "vkhausdorff/error.h"

namespace vkh::drawing {
namespace {

// A million points, at even steps of the file's order, are enough to find where a surface is.
constexpr size_t kMostSampled = size_t{1} << 20;

/// Counts the boxes of a grid of `along` boxes a side that have a point.
size_t boxes_with_points(const Mesh& mesh, const Box& box, double side, size_t along) {
  std::vector<bool> has(along * along * along);
  const size_t stride = (mesh.vertices.size() + kMostSampled - 1) / kMostSampled;
  size_t count = 0;
  for (size_t i = 0; i < mesh.vertices.size(); i += stride) {
    const glm::dvec3 at = (glm::dvec3(mesh.vertices[i]) - box.lo) / side;
    size_t number = 0;
    for (const double x : {at.x, at.y, at.z}) {
      const double last = static_cast<double>(along - 1);
      number = number * along +
               static_cast<size_t>(std::clamp(x * static_cast<double>(along), 0.0, last));
    }
    if (has[number]) continue;
    has[number] = true;
    ++count;
  }
  return count;
}

}  // namespace

// Boxes that have four points on average lie on the surface, and each has about one side of it.
// With fewer a box, most boxes on the surface have none.
double spacing_of(const Mesh& mesh) {
  constexpr size_t kFinest = 128, kPointsOfBox = 4;
  if (!mesh.are_points) return 0;
  const Box box = box_of(mesh);
  const glm::dvec3 size = box.hi - box.lo;
  const double side = std::max({size.x, size.y, size.z, 1e-300});
  const auto count = static_cast<double>(mesh.vertices.size());
  const size_t samples = std::min(mesh.vertices.size(), kMostSampled);
  for (size_t along = kFinest;; along /= 2) {
    const size_t boxes = boxes_with_points(mesh, box, side, along);
    if (along > 1 && boxes * kPointsOfBox > samples) continue;
    return side / static_cast<double>(along) * std::sqrt(static_cast<double>(boxes) / count);
  }
}

Panel Views::view_from(glm::dvec3 direction, const Area& area) const {
  Panel panel{fitted(picture_.mesh, axes_of(direction, options_.up), area)};
  Camera& camera = panel.camera;
  camera.spacing = spacing_;
  if (spacing_ > 0)  // whole discs
    camera.scale *= 1 - 2 * camera.disc() / std::min(area.width, area.height);
  return panel;
}

// The direction does not depend on the answer: pictures of one part can be compared.
Panel Views::corner_view(const Area& area) const {
  const glm::dvec3 z_up(0.72, -1, 0.85);
  return view_from(options_.up == Up::kZ ? z_up : glm::dvec3(z_up.x, z_up.z, -z_up.y), area);
}

// The directions along the axes from which the mesh is more than a line.
std::vector<size_t> Views::seeing_directions() const {
  constexpr double kLeast = 0.005;
  const Box box = box_of(picture_.mesh);
  std::array<double, 3> size{};
  for (size_t i = 0; i < size.size(); ++i) {
    const auto axis = static_cast<glm::length_t>(i);
    size[i] = box.hi[axis] - box.lo[axis];
  }
  std::vector<size_t> directions;
  for (size_t i = 0; i < 6; ++i) {
    if (std::min(size[(i / 2 + 1) % 3], size[(i / 2 + 2) % 3]) > kLeast * diagonal_)
      directions.push_back(i);
  }
  return directions.empty() ? std::vector<size_t>{4, 5} : directions;
}

std::vector<Panel> Views::six_views(const Area& area) const {
  const std::vector<size_t> directions = seeing_directions();
  const size_t most = area.width >= area.height ? 3 : 2;
  const size_t columns = directions.size() < 4 ? 4 - most : most;
  const size_t rows = (directions.size() + columns - 1) / columns;
  const double width = std::floor(area.width / static_cast<double>(columns));
  const double height = std::floor(area.height / static_cast<double>(rows));
  std::vector<Panel> panels;
  for (size_t n = 0; n < directions.size(); ++n) {
    const size_t i = directions[n];
    glm::dvec3 direction(0);
    direction[static_cast<glm::length_t>(i / 2)] = i % 2 == 0 ? 1 : -1;
    const size_t row_number = n / columns;
    const auto column = static_cast<double>(n % columns), row = static_cast<double>(row_number);
    const Area cell{area.x + column * width, area.y + row * height, width, height};
    panels.push_back(view_from(direction, cell.inner(std::round(26 * unit_))));
    panels.back().label = std::string("from ") + (i % 2 == 0 ? "+" : "\u2212") + "xyz"[i / 2];
  }
  double scale = panels[0].camera.scale;
  for (const Panel& panel : panels) scale = std::min(scale, panel.camera.scale);
  for (Panel& panel : panels) panel.camera.scale = scale;
  return panels;
}

std::vector<Panel> Views::panels_in(const Area& area) const {
  const double strip = std::round(64 * unit_);  // for axes and ruler
  Area above = area;
  above.height -= strip;
  if (options_.view.kind == View::Kind::kSix) return six_views(above);
  const Area inner = above.inner(std::round(24 * unit_));
  if (options_.view.kind == View::Kind::kIso) return {corner_view(inner)};
  return {view_from(options_.view.direction, inner)};
}

}  // namespace vkh::drawing

namespace vkh {
namespace {

[[noreturn]] void refuse(const char* option, const std::string& text, const char* expected) {
  throw UsageError(std::string(option) + " '" + text + "': expected " + expected);
}

/// All numbers of "1,2,3" or "1600x1000"; empty if there is anything else.
template <class Number>
std::vector<Number> numbers_of(const std::string& text, char between) {
  std::vector<Number> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    Number number{};
    // from_chars, because a locale must not decide whether 0.5 is a number.
    const std::from_chars_result read = number_from_chars(at, end, number);
    if (read.ec != std::errc()) return {};
    numbers.push_back(number);
    if (read.ptr == end) return numbers;
    if (*read.ptr != between) return {};
    at = read.ptr + 1;
  }
}

}  // namespace

View parse_view(const char* option, const std::string& text) {
  if (text == "iso") return {};
  if (text == "six") return {View::Kind::kSix};
  const std::vector<double> numbers = numbers_of<double>(text, ',');
  if (numbers.size() != 3) refuse(option, text, "iso, six or a direction such as 1,-1,0.5");
  const View view{View::Kind::kDirection, {numbers[0], numbers[1], numbers[2]}};
  const double length = glm::length(view.direction);
  if (!std::isfinite(length) || !(length > 1e-100))
    refuse(option, text, "a direction that is not 0,0,0");
  return view;
}

void parse_picture_size(const char* option, const std::string& text, PictureOptions& options) {
  const std::vector<uint32_t> sides = numbers_of<uint32_t>(text, 'x');
  const bool fits = sides.size() == 2 && sides[0] >= kLeastPictureWidth &&
                    sides[1] >= kLeastPictureHeight &&
                    std::max(sides[0], sides[1]) <= kMostPictureSide;
  if (!fits) refuse(option, text, "a size from 640x400 to 8192x8192, such as 1600x1000");
  options.width = sides[0];
  options.height = sides[1];
}

}  // namespace vkh
