// The agreement of A's normals with those of B's closest faces, cell by cell; docs/certificate.md
// has the argument.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/mesh/triangle_tree.h"
#include "host/survey/estimate.h"
#include "host/survey/goals.h"
#include "host/survey/measured.h"
#include "host/survey/stoppable.h"

namespace vkh {

/// A face's unit normal to within `off`, in length; a face without area has none: `off` is 1.
struct UnitNormal {
  glm::dvec3 along{};
  double off = 1;
};
UnitNormal unit_normal(const Corners3& face);

/// Encloses |cos| of the angle between two normals; [0, 1] where one is not known.
Enclosure cosine_of(const UnitNormal& x, const UnitNormal& y);

/// Encloses the cosine of an angle from 0 to 90 degrees.
Enclosure cosine_of_degrees(double degrees);

/// Encloses c(x) over all points x of a cell: the largest |cos| between A's normal and that of a
/// face of B that is closest to x.
class Normals {
 public:
  /// Keeps references to the pair's meshes, which are surfaces.
  explicit Normals(const SurveyedPair& pair);

  /// Encloses c(x) over a cell with these bounds.
  Enclosure of(const gpu::Cell& cell, const gpu::CellBounds& bounds) const;
  /// |cos| between the cell's normal and that of one face of B, which proves nothing.
  double likely(const gpu::Cell& cell, uint32_t face) const;

 private:
  struct NearFace {
    uint32_t face;
    Enclosure cosine;
  };

  Corners3 corners_of_a(uint32_t face) const;
  double distance_up(const glm::dvec3& p, uint32_t hint) const;
  bool find_near(const gpu::Cell& cell, const gpu::CellBounds& bounds,
                 std::vector<NearFace>& found) const;
  double excused(const PlacedCell& at, const NearFace& one, const std::vector<NearFace>& all) const;
  bool has_corners(uint32_t face, const std::array<bool, 3>& which, uint32_t of) const;

  const Mesh& a_;
  const Mesh& b_;
  const double displacement_;
  std::vector<glm::dvec3> vertices_;  // A's, scaled
  std::vector<Corners3> faces_;       // B's, scaled
  TriangleTree tree_;
  std::vector<UnitNormal> normals_of_a_, normals_of_b_;
};

/// Below the distance between any point of a cell and any point of a triangle. `centre`: any point,
/// the cell's best.
double separation(const PlacedCell& at, const glm::dvec3& centre, const Corners3& triangle);

/// The corners of a triangle on which its closest point lies for all points of a cell: one corner,
/// or an edge's two; none, if that is not certain.
std::array<bool, 3> closest_feature(const PlacedCell& at, const Corners3& triangle);

/// The cosines of a survey's cells, which are found when they are asked for, and kept.
class NormalCells {
 public:
  NormalCells(const SurveyedPair& pair, const SurveyOptions& options, const Areas& areas,
              GoesOn goes_on);

  /// The goals: agreeing shares first, then the mean cosine.
  void add_goals(std::vector<Goal>& goals);
  /// Adds the agreeing shares to the bands, and the mean cosine.
  void add_figures(const CellStore& cells, const Estimates& estimates, Statistics& statistics);

 private:
  struct Known {
    Enclosure cosine{0, 1};
    gpu::uvec4 corners{};  ///< of the cell that was looked at
    bool is_known = false;
  };

  bool look_at(const CellStore& cells);
  Enclosure agreeing(const CellStore& cells, size_t i, const Threshold& at) const;
  Enclosure mean(const CellStore& cells) const;
  Scores score_shares(const CellStore& cells);
  Scores score_mean(const CellStore& cells);

  const SurveyedPair pair_;
  const SurveyOptions& options_;
  const Areas& areas_;
  const GoesOn goes_on_;
  const Normals normals_;
  const Enclosure limit_;  // the cosine of the angle
  std::vector<Known> known_;
};

}  // namespace vkh
