#include "host/survey/sides.h"

#include <algorithm>

#include "host/base/rounding.h"
#include "host/mesh/round_to_float.h"
#include "host/survey/measured.h"

namespace vkh {

const char* doubt_name(Doubt doubt) {
  switch (doubt) {
    case Doubt::kNone:
      return "none";
    case Doubt::kMeets:
      return "meets";
    case Doubt::kEdge:
      return "edge";
    case Doubt::kDegenerate:
      return "degenerate";
    case Doubt::kTwoSided:
      return "two-sided";
    case Doubt::kMany:
      return "many";
    case Doubt::kEnded:
      return "ended";
  }
  return "";
}

Sides::Sides(const SurveyedPair& pair, const GoesOn& goes_on)
    : a_(pair.a),
      b_(pair.b),
      frame_(pair.frame),
      displacement_(pair.displacement),
      shells_(scaled(pair.b, pair.frame, is_exact_), pair.b.faces, goes_on) {
  for (uint32_t f = 0; f < pair.b.faces.size(); ++f) {
    face_kinds_.push_back((shells_.is_covered(f) ? gpu::kFaceCovered : 0) |
                          (shells_.is_bare(f) ? gpu::kFaceBare : 0) |
                          (shells_.is_two_sided(f) ? gpu::kFaceTwoSided : 0));
  }
}

SideSearch Sides::search() const {
  return {face_kinds_, is_solid(), shells_.front(), float_up(displacement_), 0};
}

CellSide side_of_class(uint32_t of_class) {
  switch (of_class) {
    case gpu::kClassOver:
      return {SurfaceSide::kOver, Doubt::kNone};
    case gpu::kClassUnder:
      return {SurfaceSide::kUnder, Doubt::kNone};
    case gpu::kClassMeets:
      return {SurfaceSide::kUnsigned, Doubt::kMeets};
    case gpu::kClassEdge:
      return {SurfaceSide::kUnsigned, Doubt::kEdge};
    case gpu::kClassDegenerate:
      return {SurfaceSide::kUnsigned, Doubt::kDegenerate};
    case gpu::kClassTwoSided:
      return {SurfaceSide::kUnsigned, Doubt::kTwoSided};
    case gpu::kClassMany:
      return {SurfaceSide::kUnsigned, Doubt::kMany};
    default:
      return {SurfaceSide::kUnsigned, Doubt::kEnded};
  }
}

double Sides::distance_down(const glm::dvec3& p, uint32_t hint) const {
  return distance_below(
      p, shells_.tree(), static_cast<uint32_t>(b_.faces.size()),
      [&](uint32_t face) { return shells_.corners(face); }, hint);
}

// The corner lies within 2 `off` of the double that stands for it, which is more than sqrt(3) off.
// Sides are of the meshes as they are held, and so is this distance: the deltas are subtracted.
SidedPoint Sides::farthest_corner(const gpu::Cell& cell, uint32_t hint) const {
  const UVec3& f = a_.faces[cell.face];
  const auto vertex = [&](uint32_t v) {
    const DVec3& p = a_.vertices[v];
    return glm::dvec3(frame_.to_frame(p.x), frame_.to_frame(p.y), frame_.to_frame(p.z));
  };
  const PlacedCell at = placed_cell({vertex(f.x), vertex(f.y), vertex(f.z)}, cell);
  const lib::Bary3 weights = corners_of(cell);
  const std::array<glm::dvec3, 3> of_corners = {weights_of(weights.a), weights_of(weights.b),
                                                weights_of(weights.c)};
  Frame back;
  back.exponent = -frame_.exponent;
  const double delta = add_up(a_.delta, b_.delta);
  SidedPoint best;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3& p = at.corners[i];
    const double down = add_down(distance_down(p, hint), -2 * at.off);
    const double lower = std::max(add_down(frame_.length_down(std::max(down, 0.0)), -delta), 0.0);
    if (i > 0 && lower <= best.lower) continue;
    best.lower = lower;
    best.at.set_face(a_, cell.face);
    best.at.barycentric = of_corners[i] * 0x1p-20;
    best.at.point = {back.to_frame(p.x), back.to_frame(p.y), back.to_frame(p.z)};
  }
  return best;
}

}  // namespace vkh
