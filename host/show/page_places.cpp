// Regions grow from their peaks down, as water that falls leaves islands that join.
#include "host/show/page_places.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "host/show/page_words.h"

namespace vkh {
namespace {

constexpr uint32_t kNoRegion = UINT32_MAX;
constexpr double kSaddle = 0.5;  // share of the lower peak above which two regions are one

class Regions {
 public:
  Regions(const Mesh& mesh, const Field& field, const PlaceOptions& options)
      : mesh_(mesh),
        field_(field),
        options_(options),
        at_vertex_(mesh.vertices.size(), kNoRegion) {}

  std::vector<WorstPlace> worst() {
    for (const uint32_t face : falling()) add(face);
    std::vector<WorstPlace> places;
    for (uint32_t r = 0; r < regions_.size() && places.size() < options_.most; ++r) {
      if (regions_[r].above == r) add_place(r, places);
    }
    return places;
  }

 private:
  struct Region {
    uint32_t peak;   // a face
    uint32_t above;  // the region that this one is a part of; itself if it is none's
    uint64_t faces;
  };

  double level_of(uint32_t face) const {
    const double known = field_.lower[face];
    const bool is_found = options_.found && options_.found->face == face;
    return is_found ? std::max(known, options_.found->distance.lower) : known;
  }

  // The faces above 0, by their level, then by their upper bound, then by their number.
  std::vector<uint32_t> falling() const {
    std::vector<uint32_t> order;
    for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      if (level_of(f) > 0) order.push_back(f);
    }
    std::sort(order.begin(), order.end(), [&](uint32_t f, uint32_t g) {
      const double level_f = level_of(f), level_g = level_of(g);
      if (level_f != level_g) return level_f > level_g;
      if (field_.upper[f] != field_.upper[g]) return field_.upper[f] > field_.upper[g];
      return f < g;
    });
    return order;
  }

  uint32_t whole(uint32_t region) {
    while (regions_[region].above != region) {
      regions_[region].above = regions_[regions_[region].above].above;
      region = regions_[region].above;
    }
    return region;
  }

  // Regions are numbered by falling peaks: of two, the one of the smaller number is the higher.
  void add(uint32_t face) {
    const glm::uvec3 corners = mesh_.faces[face];
    uint32_t highest = kNoRegion;
    for (const uint32_t v : {corners.x, corners.y, corners.z}) {
      if (at_vertex_[v] != kNoRegion) highest = std::min(highest, whole(at_vertex_[v]));
    }
    if (highest == kNoRegion) {
      highest = static_cast<uint32_t>(regions_.size());
      regions_.push_back({face, highest, 0});
    }
    for (const uint32_t v : {corners.x, corners.y, corners.z}) {
      if (at_vertex_[v] != kNoRegion) join(whole(at_vertex_[v]), highest, level_of(face));
      if (at_vertex_[v] == kNoRegion) at_vertex_[v] = highest;
    }
    ++regions_[highest].faces;
  }

  void join(uint32_t lower, uint32_t higher, double saddle) {
    if (lower == higher || saddle < kSaddle * level_of(regions_[lower].peak)) return;
    regions_[lower].above = higher;
    regions_[higher].faces += regions_[lower].faces;
  }

  void add_place(uint32_t region, std::vector<WorstPlace>& places) const {
    const uint32_t face = regions_[region].peak;
    const glm::uvec3 f = mesh_.faces[face];
    const glm::dvec3 a = mesh_.vertices[f.x], b = mesh_.vertices[f.y], c = mesh_.vertices[f.z];
    const glm::dvec3 across = cross(b - a, c - a);
    const double area = length(across);
    WorstPlace place{.face = face,
                     .file_face = mesh_.file_faces.of(face),
                     .distance = field_.of(face),
                     .point = a / 3.0 + b / 3.0 + c / 3.0,
                     .normal = area > 0 ? across / area : glm::dvec3(0),
                     .faces = regions_[region].faces};
    if (options_.found && options_.found->face == face) {
      place.point = options_.found->point;
      place.distance = options_.found->distance;
    }
    const auto is_near = [&](const WorstPlace& known) {
      return distance(known.point, place.point) < options_.apart;
    };
    if (std::none_of(places.begin(), places.end(), is_near)) places.push_back(place);
  }

  const Mesh& mesh_;
  const Field& field_;
  const PlaceOptions& options_;
  std::vector<uint32_t> at_vertex_;  // the first region that reached each vertex
  std::vector<Region> regions_;
};

}  // namespace

PlaceOptions place_options(const Answer& answer, const Report& report) {
  constexpr double kApart = 1.0 / 20;
  PlaceOptions options{.apart = kApart * report.diagonal_a};
  if (report.has_witness)
    options.found =
        FoundPoint{report.witness_a.face, report.witness_a.point, deviation_of(answer, report)};
  return options;
}

std::vector<WorstPlace> worst_places(const Mesh& mesh, const Field& field,
                                     const PlaceOptions& options) {
  return Regions(mesh, field, options).worst();
}

}  // namespace vkh
