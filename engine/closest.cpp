// Points alone: the face of B that is closest to each.
#include "engine/record.h"

namespace vkh {

void record_closest(Recorder& rec, const Hierarchy& b, const AskedPoints& points) {
  const auto scope = rec.scope("closest");
  struct Given {
    Slice<gpu::Node> nodes;
    Slice<gpu::Triangle> triangles;
    Slice<gpu::TriangleLow> triangle_lows;
    Slice<uint32_t> b_fault;
    Slice<gpu::Vertex> asked;
    Slice<gpu::ClosestFace> found;
    gpu::ClosestPush push;
  };
  const Given all{b.nodes,
                  b.triangles,
                  b.triangle_lows,
                  b.fault,
                  points.asked,
                  points.found,
                  {.count = points.count,
                   .triangle_count = b.face_count,
                   .two_float = points.two_float ? 1u : 0u}};
  rec.run<k::ClosestFaces>(all, Items{points.count});
  rec.stage("closest");
}

}  // namespace vkh
