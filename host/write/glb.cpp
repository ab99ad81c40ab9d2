#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "host/write/bytes.h"
#include "host/write/rounded.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/length.h"

namespace vkh {
namespace {

using Json = nlohmann::ordered_json;

constexpr uint32_t kFloat = 5126, kUnsignedShort = 5123;  // glTF 2.0, section 3.6.2
constexpr uint32_t kArrayBuffer = 34962;

// One binary chunk with its views and accessors.
class Binary {
 public:
  template <class T>
  uint32_t add(const std::vector<T>& values, const Json& accessor) {
    const size_t bytes = values.size() * sizeof(T), offset = data_.size();
    data_.resize((offset + bytes + 3) / 4 * 4, '\0');
    std::memcpy(data_.data() + offset, values.data(), bytes);
    views_.push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}, {"target", kArrayBuffer}});
    Json described = accessor;
    described["bufferView"] = views_.size() - 1;
    accessors_.push_back(described);
    return static_cast<uint32_t>(accessors_.size() - 1);
  }
  const std::string& data() const { return data_; }
  const Json& views() const { return views_; }
  const Json& accessors() const { return accessors_; }

 private:
  std::string data_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

glm::dvec3 middle_of(const Mesh& mesh) {
  glm::dvec3 lo = mesh.vertices[0], hi = lo;
  for (const glm::dvec3& v : mesh.vertices) {
    lo = glm::dvec3(std::min(lo.x, v.x), std::min(lo.y, v.y), std::min(lo.z, v.z));
    hi = glm::dvec3(std::max(hi.x, v.x), std::max(hi.y, v.y), std::max(hi.z, v.z));
  }
  return 0.5 * lo + 0.5 * hi;
}

// Inverts sRGB's transfer function, IEC 61966-2-1, since glTF's vertex colours are linear (3.9.2).
// A byte would make one of a dozen dark colours.
uint16_t linear(uint8_t srgb) {
  const double s = srgb / 255.0;
  const double light = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  return static_cast<uint16_t>(std::lround(65535 * light));
}

struct CornerArrays {
  std::vector<float> positions, lower, upper, signed_lower, signed_upper, side;
  std::vector<uint16_t> colours;
  glm::vec3 lo{3e38f}, hi{-3e38f};
};

void add_sided_face(const SidedFace& face, CornerArrays& out) {
  out.signed_lower.push_back(float_down(face.distances.lower));
  out.signed_upper.push_back(float_up(face.distances.upper));
  out.side.push_back(static_cast<float>(face.side));
}

void add_face(const FieldFile& file, size_t f, const glm::dvec3& middle, double largest,
              CornerArrays& out) {
  const glm::uvec3& face = file.mesh.faces[f];
  const Rgb shown = colour_of(file, file.field.upper[f], largest);
  const std::array colour = {linear(shown.red), linear(shown.green), linear(shown.blue),
                             uint16_t{UINT16_MAX}};
  for (const uint32_t v : {face.x, face.y, face.z}) {
    const glm::vec3 p(file.mesh.vertices[v] - middle);
    for (int axis = 0; axis < 3; ++axis) {
      out.positions.push_back(p[axis]);
      out.lo[axis] = std::min(out.lo[axis], p[axis]);
      out.hi[axis] = std::max(out.hi[axis], p[axis]);
    }
    out.lower.push_back(float_down(file.field.lower[f]));
    out.upper.push_back(float_up(file.field.upper[f]));
    if (file.sides != nullptr) add_sided_face(sided_face(*file.sides, f), out);
    out.colours.insert(out.colours.end(), colour.begin(), colour.end());
  }
}

// If the unit is known, turns coordinates into metres by a node's scale, which keeps their bits. In
// glTF y is up, but a mesh's file does not say which axis is: axes stay.
Json nodes_of(const FieldFile& file, const glm::dvec3& middle) {
  const Json mesh = {{"mesh", 0}, {"translation", {middle.x, middle.y, middle.z}}};
  if (file.unit.empty() || file.unit == "m") return Json::array({mesh});
  const UnitRatio ratio = unit_ratio(file.unit, "m");
  const double scale = ratio.numerator / ratio.denominator;
  return Json::array({{{"children", {1}}, {"scale", {scale, scale, scale}}}, mesh});
}

Json document(const FieldFile& file, const CornerArrays& corners, const glm::dvec3& middle,
              Binary& binary) {
  const size_t count = corners.lower.size();
  const auto scalar = [&](uint32_t type, const char* shape) {
    return Json{{"componentType", type}, {"count", count}, {"type", shape}};
  };
  Json position = scalar(kFloat, "VEC3");
  position["min"] = {corners.lo.x, corners.lo.y, corners.lo.z};
  position["max"] = {corners.hi.x, corners.hi.y, corners.hi.z};
  Json colour = scalar(kUnsignedShort, "VEC4");
  colour["normalized"] = true;
  Json attributes = {{"POSITION", binary.add(corners.positions, position)},
                     {"COLOR_0", binary.add(corners.colours, colour)},
                     {"_LOWER", binary.add(corners.lower, scalar(kFloat, "SCALAR"))},
                     {"_UPPER", binary.add(corners.upper, scalar(kFloat, "SCALAR"))}};
  const auto add_signed = [&](const char* name, const std::vector<float>& values) {
    if (file.sides != nullptr) attributes[name] = binary.add(values, scalar(kFloat, "SCALAR"));
  };
  add_signed("_SIGNED_LOWER", corners.signed_lower);
  add_signed("_SIGNED_UPPER", corners.signed_upper);
  add_signed("_SIDE", corners.side);
  return {{"asset", {{"version", "2.0"}, {"generator", "VkHausdorff"}}},
          {"scene", 0},
          {"scenes", {{{"nodes", {0}}}}},
          {"nodes", nodes_of(file, middle)},
          {"materials",
           {{{"doubleSided", true},
             {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}}}}},
          {"meshes",
           {{{"primitives", {{{"attributes", attributes}, {"material", 0}}}},
             {"extras",
              {{"against", file.against},
               {"unit", file.unit.empty() ? Json() : Json(file.unit)},
               {"lower", file.interval.lower},
               {"upper", file.interval.upper}}}}}},
          {"buffers", {{{"byteLength", binary.data().size()}}}},
          {"bufferViews", binary.views()},
          {"accessors", binary.accessors()}};
}

}  // namespace

std::string to_glb(const FieldFile& file) {
  check_sizes(file);
  const glm::dvec3 middle = middle_of(file.mesh);
  const double largest = largest_upper(file.field);
  CornerArrays corners;
  for (size_t f = 0; f < file.mesh.faces.size(); ++f) add_face(file, f, middle, largest, corners);
  Binary binary;
  std::string json =
      document(file, corners, middle, binary).dump(-1, ' ', false, Json::error_handler_t::replace);
  return glb_of(std::move(json), binary.data());
}

std::string glb_of(std::string json, std::string_view binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const size_t total = 12 + 8 + json.size() + 8 + binary.size();
  if (total > UINT32_MAX) throw OutputError("a GLB holds 4 GiB at most: write a .ply");
  Bytes out;
  out.text = "glTF";
  const auto add_words = [&out](std::initializer_list<size_t> words) {
    for (const size_t word : words) out.add(static_cast<uint32_t>(word));
  };
  add_words({2, total, json.size(), 0x4e4f534a});
  out.text += json;
  add_words({binary.size(), 0x004e4942});
  return std::move(out.text) + std::string(binary);
}

}  // namespace vkh
