// The field: bounds of the distance over cells of A, beside a run and without effect on it.
#include "engine/record.h"

namespace vkh {

void record_cells(Recorder& rec, const Problem& p, const AskedCells& asked) {
  const auto scope = rec.scope("cells");
  struct Given : RunBuffers {
    Slice<gpu::Cell> cells;
    Slice<gpu::CellBounds> bounds;
    // Of a survey only.
    Slice<uint32_t> parents, faces_reached;
    Slice<gpu::CornerTriangles> near_corners;
    Slice<gpu::SurveyWave> wave;
    gpu::CellPush push;
  };
  const bool given = asked.cells.buffer != VK_NULL_HANDLE;
  const Given all{RunBuffers(p),
                  given ? asked.cells : as<gpu::Cell>(p.ws.unused),
                  asked.bounds,
                  p.ws.unused,
                  p.ws.unused,
                  as<gpu::CornerTriangles>(p.ws.unused),
                  as<gpu::SurveyWave>(p.ws.unused),
                  {.count = asked.count,
                   .given = given ? gpu::kGivenCells : gpu::kFacesOfA,
                   .first = asked.first,
                   .face_count = p.face_count,
                   .triangle_count = asked.has_run ? p.b.face_count : 0}};
  rec.run<k::CellBounds>(all, Items{asked.count});
  rec.stage("cells");
}

}  // namespace vkh
