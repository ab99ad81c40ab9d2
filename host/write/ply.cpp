#include <cstdint>
#include <vector>

#include "host/base/decimal.h"
#include "host/write/bytes.h"
#include "host/write/rounded.h"

namespace vkh {
namespace {

void add_colour(const Rgb& colour, Bytes& out) {
  out.add(colour.red);
  out.add(colour.green);
  out.add(colour.blue);
}

// Removes line ends, which a file's name may hold.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

std::string signed_header(const FieldFile& file) {
  if (file.sides == nullptr) return "";
  return "property float signed_lower\nproperty float signed_upper\nproperty char side\n";
}

std::string header_of(const FieldFile& file) {
  const std::string unit = file.unit.empty() ? "the file's own unit" : file.unit;
  const bool are_triangles = file.mesh.file_faces.are_triangles();
  return "ply\nformat binary_little_endian 1.0\n"
         "comment VkHausdorff: the largest distance of each face from " +
         one_line(file.against) + "\ncomment lower <= it <= upper, certified, in " + unit +
         "\ncomment over all faces it is in [" +
         decimal(file.interval.lower, kJsonDigits, Rounding::kDown) + ", " +
         decimal(file.interval.upper, kJsonDigits, Rounding::kUp) + "]\n" + "element vertex " +
         std::to_string(file.mesh.vertices.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nproperty float quality\n" +
         (file.sides == nullptr ? "" : "property float signed\n") +
         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
         "element face " +
         std::to_string(file.mesh.faces.size()) +
         "\nproperty list uchar int vertex_indices\nproperty float lower\nproperty float upper\n"
         "property float quality\n" +
         signed_header(file) + "property uchar red\nproperty uchar green\nproperty uchar blue\n" +
         (are_triangles ? "" : "property uint file_face\n") + "end_header\n";
}

std::vector<double> quality_of_vertices(const FieldFile& file) {
  std::vector<double> quality(file.mesh.vertices.size(), 0.0);
  for (size_t f = 0; f < file.mesh.faces.size(); ++f) {
    const glm::uvec3& face = file.mesh.faces[f];
    for (const uint32_t v : {face.x, face.y, face.z})
      quality[v] = std::max(quality[v], file.field.upper[f]);
  }
  return quality;
}

// Rounds away from 0, as bounds of a signed distance are.
float float_away(double x) { return x < 0 ? float_down(x) : float_up(x); }

double farther(double x, double y) { return std::abs(y) > std::abs(x) ? y : x; }

// The figures of vertices are for viewers that read none of faces.
std::vector<double> signed_of_vertices(const FieldFile& file) {
  std::vector<double> at(file.mesh.vertices.size(), 0.0);
  if (file.sides == nullptr) return at;
  for (size_t f = 0; f < file.mesh.faces.size(); ++f) {
    const glm::uvec3& face = file.mesh.faces[f];
    const Enclosure& d = sided_face(*file.sides, f).distances;
    for (const uint32_t v : {face.x, face.y, face.z})
      at[v] = farther(at[v], farther(d.upper, d.lower));
  }
  return at;
}

void add_sides(const FieldFile& file, size_t f, Bytes& out) {
  if (file.sides == nullptr) return;
  const SidedFace face = sided_face(*file.sides, f);
  out.add(float_down(face.distances.lower));
  out.add(float_up(face.distances.upper));
  out.add(static_cast<int8_t>(face.side));
}

std::string header_of_points(const FieldFile& file) {
  const std::string unit = file.unit.empty() ? "the file's own unit" : file.unit;
  return "ply\nformat binary_little_endian 1.0\n"
         "comment VkHausdorff: the distance of each point from " +
         one_line(file.against) +
         "\ncomment lower <= it <= upper, certified; distance is the middle of both; in " + unit +
         "\ncomment the largest is in [" +
         decimal(file.interval.lower, kJsonDigits, Rounding::kDown) + ", " +
         decimal(file.interval.upper, kJsonDigits, Rounding::kUp) + "]\nelement vertex " +
         std::to_string(file.mesh.vertices.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nproperty float distance\n"
         "property float lower\nproperty float upper\n" +
         signed_header(file) + "property uchar red\nproperty uchar green\nproperty uchar blue\n" +
         (file.mesh.file_faces.are_triangles() ? "" : "property uint file_point\n") +
         "end_header\n";
}

// Writes points: face i of the mesh is point i.
std::string to_points_ply(const FieldFile& file) {
  const double largest = largest_upper(file.field);
  const FileFaces& file_points = file.mesh.file_faces;
  Bytes out;
  out.text = header_of_points(file);
  for (size_t i = 0; i < file.mesh.vertices.size(); ++i) {
    const glm::dvec3& p = file.mesh.vertices[i];
    const double lower = file.field.lower[i], upper = file.field.upper[i];
    for (const double x : {p.x, p.y, p.z}) out.add(x);
    out.add(static_cast<float>(lower + (upper - lower) / 2));
    out.add(float_down(lower));
    out.add(float_up(upper));
    add_sides(file, i, out);
    out.add(colour_of(file, upper, largest));
    if (!file_points.are_triangles()) out.add(static_cast<uint32_t>(file_points.of(i)));
  }
  return std::move(out.text);
}

}  // namespace

SidedFace sided_face(const SignedFigures& sides, size_t face) {
  const double over = sides.over_of_faces.upper[face], under = sides.under_of_faces.upper[face];
  const bool is_over = over > 0 && under == 0, is_under = under > 0 && over == 0;
  return {.distances = {under > 0 ? -under : 0, over}, .side = is_over ? 1 : is_under ? -1 : 0};
}

std::string to_ply(const FieldFile& file) {
  check_sizes(file);
  if (file.mesh.are_points) return to_points_ply(file);
  const double largest = largest_upper(file.field);
  const std::vector<double> quality = quality_of_vertices(file);
  const std::vector<double> signs = signed_of_vertices(file);
  Bytes out;
  out.text = header_of(file);
  for (size_t v = 0; v < file.mesh.vertices.size(); ++v) {
    const glm::dvec3& p = file.mesh.vertices[v];
    out.add(p.x);
    out.add(p.y);
    out.add(p.z);
    out.add(float_up(quality[v]));
    if (file.sides != nullptr) out.add(float_away(signs[v]));
    add_colour(colour_of(file, quality[v], largest), out);
  }
  const FileFaces& file_faces = file.mesh.file_faces;
  for (size_t f = 0; f < file.mesh.faces.size(); ++f) {
    const glm::uvec3& face = file.mesh.faces[f];
    out.add(uint8_t{3});
    for (const uint32_t v : {face.x, face.y, face.z}) out.add(static_cast<int32_t>(v));
    const float upper = float_up(file.field.upper[f]);
    out.add(float_down(file.field.lower[f]));
    out.add(upper);
    out.add(upper);
    add_sides(file, f, out);
    add_colour(colour_of(file, file.field.upper[f], largest), out);
    if (!file_faces.are_triangles()) out.add(static_cast<uint32_t>(file_faces.of(f)));
  }
  return std::move(out.text);
}

}  // namespace vkh
