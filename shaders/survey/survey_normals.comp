// Compares A's normals with those of B's closest faces on cells where that was not done
// (report/normal.h). In: cells, bounds, normals: of A's faces, and then of B's as given; A and B's
// BVH. Out: classes, agreements. Each result depends on its cell alone. An invocation for each
// cell.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 2) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 3) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 4) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 5) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 6) readonly buffer Cells { Cell cells[]; };
layout(scalar, binding = 7) readonly buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 8) readonly buffer Normals { FaceNormal normals[]; };
layout(scalar, binding = 9) buffer Classes { uint classes[]; };
layout(scalar, binding = 10) writeonly buffer Agreements { CellAgreement agreements[]; };
layout(scalar, push_constant) uniform PushBlock { SurveyNormalsPush push; };

#include "shaders/base/root.glsl"
#include "shaders/base/surface.glsl"
#include "shaders/report/cell_search.glsl"
#include "shaders/report/normal.h"

Above above;
uint near[kCellTriangles];     // triangles that may be closest,
float shares[kCellTriangles];  // and on how much of the cell
uint near_count;

bool look_at(uint triangle, Search s, CellFrame t) {
  float share = closest_share(t, load_surface(triangle, cell_view(t)), above, push.moved);
  if (share == 0.0) return true;
  if (near_count < kCellTriangles) {
    near[near_count] = triangle;
    shares[near_count] = share;
  }
  ++near_count;
  return near_count <= kCellTriangles;
}

FaceNormal normal_of(uint triangle) {
  uint face = triangles[kTriangleWords * min(triangle, push.triangle_count - 1u)].w;
  return normals[push.face_count + face];
}

Cosine cosine_with(FaceNormal m, uint triangle) {
  FaceNormal n = normal_of(triangle);
  return cosine_between(m.along, m.off, n.along, n.off);
}

// The least cosine that counts where this face is closest: at least its own.
float excused(CellFrame t, FaceNormal m, uint triangle) {
  float best = cosine_with(m, triangle).least;
  uint feature = closest_feature(t, load_surface(triangle, cell_view(t)), push.moved);
  if (feature == 0u) return best;
  uvec3 corners = normal_of(triangle).corners;
  for (uint k = 0u; k < near_count; ++k) {
    float other = cosine_with(m, near[k]).least;
    if (other > best && has_corners(normal_of(near[k]).corners, corners, feature)) best = other;
  }
  return best;
}

// Drivers may end a loop early (docs/certificate.md): the work is counted by its results, which no
// compiler can foresee.
Agreement compared(CellFrame t, FaceNormal m) {
  Cosine all = Cosine(1.0, 0.0);
  uint seen = 0u;
  for (uint k = 0u; k < near_count; ++k) {
    Cosine c = cosine_with(m, near[k]);
    all = Cosine(min(all.least, c.least), max(all.most, c.most));
    seen += c.most >= c.least ? 1u : 0u;
  }
  Comparison found = comparison_of(all, push.limit_down, push.limit_up);
  for (uint k = 0u; k < near_count; ++k) {
    Cosine c = cosine_with(m, near[k]);
    float counts = c.least < all.most - kNarrowCosine ? excused(t, m, near[k]) : c.least;
    found = with_face(found, c, counts, shares[k]);
    seen += counts >= c.least ? 1u : 0u;
  }
  if (seen != 2u * near_count) return any_agreement();
  return agreement_of(found);
}

void main() {
  uint i = push.first + item_index();
  if (i >= push.end || classes[i] == kClassCompared) return;
  CellBounds b = bounds[i];
  Cell cell = cells[i];
  uint face = min(cell.face, push.face_count - 1u);
  CellFrame t = make_cell(load_root(face), unpack_corners(cell.corners));
  above = Above(vec3(b.upper_a, b.upper_b, b.upper_c), b.highest);
  near_count = 0u;
  bool are_all = look_through(search_near(t, b.highest, push.moved), t) == kSeenAll;
  Agreement found = any_agreement();
  if (are_all && near_count > 0u) found = compared(t, normals[face]);
  agreements[i] = CellAgreement(found.least, found.most, found.sure, found.may);
  classes[i] = kClassCompared;
}
