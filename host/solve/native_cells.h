// The cells of a survey on the processor alone: bounded in doubles (host/native), and scored, split
// and added up by the functions of shaders/survey, in the device's floats.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "host/native/cells.h"
#include "host/solve/cells.h"
#include "shaders/math/bary.h"

namespace vkh {

/// Answers have the same bits for any number of threads.
class NativeCells : public SurveyCells {
 public:
  /// The pair and A outlive it. `most`: cells.
  NativeCells(const native::PlacedPair& pair, const Mesh& a, size_t threads, size_t most);

  /// The memory that a cell takes, while a vector of them grows.
  static constexpr size_t kBytesOfCell =
      2 * (sizeof(gpu::Cell) + sizeof(gpu::CellBounds) + sizeof(native::Nearby) +
           2 * sizeof(uint32_t) + sizeof(gpu::CellAgreement));

  void begin(std::span<const uint64_t> weights, float farthest) override;
  size_t count() const override { return cells_.size(); }
  size_t most() const override { return most_; }
  std::span<const uint32_t> score(const gpu::SurveyPlan& plan, const CellRange& some) override;
  bool split(const SurveyChoice& choice) override;
  void bound(size_t first, size_t count, bool wait) override;
  const gpu::SurveyTable& tally(const gpu::SurveyPlan& plan, int unit,
                                const CellRange& some) override;
  void find_sides(const SideSearch& search, float above, const CellRange& some) override;
  void begin_normals(const NormalSearch& search) override { normals_ = search; }
  void find_normals(const CellRange& some) override;
  std::vector<float> faces(uint32_t reached_classes, uint32_t highest_classes) override;
  CellsRead read(const CellRange& some) override;
  void write(const CellRange& some, std::span<const gpu::CellBounds> bounds) override;

  /// Bounds cells that are none of the survey's.
  void bound(const CellBatch& batch) const;

 private:
  uint32_t score_one(const gpu::SurveyPlan& plan, uint32_t place, bool& is_stuck) const;
  void list_chosen(const SurveyChoice& choice);
  lib::Root root_of(uint32_t face) const;
  void split_one(uint32_t rank);
  uint32_t place_of(size_t item) const;
  void bound_one(uint32_t place);

  const native::PlacedPair& pair_;
  const Mesh& a_;
  const size_t threads_, most_;
  std::vector<gpu::Wide> weights_;  // of faces
  std::vector<gpu::Cell> cells_;
  std::vector<gpu::CellBounds> bounds_;
  std::vector<native::Nearby> near_;
  std::vector<uint32_t> classes_;
  std::vector<gpu::CellAgreement> agreements_;  // where normals were asked for
  std::vector<uint32_t> keys_;                  // bins of scores
  std::vector<uint32_t> parents_;               // that were split last
  std::vector<uint32_t> counts_;
  std::vector<float> reached_;  // of faces
  gpu::SurveyTable table_;
  NormalSearch normals_;
  uint32_t parts_ = 1, live_ = 0;  // of each parent; the cells before
};

}  // namespace vkh
