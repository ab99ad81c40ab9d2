// A's normal on a cell compared with those of B's closest faces: the functions of
// shaders/report/normal.h in doubles, through the boxes of native's tree.
#include <algorithm>
#include <vector>

#include "host/mesh/round_to_float.h"
#include "host/native/cell_view.h"
#include "host/native/cells.h"

namespace vkh::native {
namespace {

class ComparedCell {
 public:
  /// `normals`: of A's faces, and then of B's.
  ComparedCell(const CellView& v, const gpu::FaceNormal& own, const NormalsGiven& given)
      : v_(v), own_(own), given_(given), moved_(static_cast<double>(given.push.moved)) {}

  // Does what compared() of survey_normals.comp does.
  Agreement found(const gpu::CellBounds& b) {
    if (!find_near(b)) return any_agreement();
    Cosine all{1, 0};
    for (const NearFace& one : near_) {
      all.least = std::min(all.least, one.cosine.least);
      all.most = std::max(all.most, one.cosine.most);
    }
    Comparison compared = comparison_of(all, given_.push.limit_down, given_.push.limit_up);
    for (const NearFace& one : near_) {
      const bool is_less = one.cosine.least < all.most - kNarrowCosine;
      const double counts = is_less ? excused(one) : one.cosine.least;
      compared = with_face(compared, one.cosine, counts, one.share);
    }
    return agreement_of(compared);
  }

 private:
  struct NearFace {
    uint32_t place;
    double share;  // of the cell, on which it may be closest
    Cosine cosine;
  };

  // Finds all triangles that may be closest. Returns whether they are few enough to look at.
  bool find_near(const gpu::CellBounds& b) {
    const Above above{{b.upper_a, b.upper_b, b.upper_c}, b.highest};
    Walk walk(v_.tree, v_.cell.origin.hi);
    const float reach = cell_reach(static_cast<double>(b.highest) + 2 * moved_, v_.cell);
    for (Leaf leaf = walk.next(reach); !leaf.is_none(); leaf = walk.next(reach)) {
      for (uint32_t place = leaf.begin; place < leaf.end; ++place) {
        const double share = closest_share(v_.cell, v_.surface(place), above, moved_);
        if (share == 0) continue;
        if (near_.size() == gpu::kCellTriangles) return false;
        near_.push_back({place, share, cosine_with(normal_of(place))});
      }
    }
    return !near_.empty();
  }

  const gpu::FaceNormal& normal_of(uint32_t place) const {
    return given_.normals[given_.push.face_count + v_.tree.face(place)];
  }

  Cosine cosine_with(const gpu::FaceNormal& n) const {
    const auto in_doubles = [](const gpu::vec3& x) { return vec3(x.x, x.y, x.z); };
    return cosine_between(in_doubles(own_.along), own_.off, in_doubles(n.along), n.off);
  }

  // The least cosine that counts where this face is closest: at least its own.
  double excused(const NearFace& one) const {
    const uint32_t feature = closest_feature(v_.cell, v_.surface(one.place), moved_);
    double best = one.cosine.least;
    if (feature == 0) return best;
    const gpu::uvec3& corners = normal_of(one.place).corners;
    for (const NearFace& other : near_) {
      if (other.cosine.least > best &&
          has_corners(whole(normal_of(other.place).corners), whole(corners), feature))
        best = other.cosine.least;
    }
    return best;
  }

  static uvec3 whole(const gpu::uvec3& x) { return {x.x, x.y, x.z}; }

  const CellView& v_;
  const gpu::FaceNormal& own_;
  const NormalsGiven& given_;
  const double moved_;
  std::vector<NearFace> near_;
};

}  // namespace

gpu::CellAgreement PlacedPair::agreement(const gpu::Cell& cell, const gpu::CellBounds& bounds,
                                         const NormalsGiven& given) const {
  const CellView view(*problem_, cell);
  const Agreement found = ComparedCell(view, given.normals[cell.face], given).found(bounds);
  return {float_down(found.least), float_up(found.most), float_down(found.sure),
          float_up(found.may)};
}

}  // namespace vkh::native
