// Chooses the corner of A that is the witness of the first lower bound: the smallest face and
// corner whose distance is the maximum, so that the choice does not depend on scheduling. The last
// workgroup to end adopts it, sets the run's base and plans the first wave, which admits faces of A
// and refines nothing. Out: control; the sizes of the first wave's dispatches. groups_done is
// 0 again.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/switches.glsl"
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 1) readonly buffer VertexDistance { uint vertex_distance[]; };
layout(scalar, binding = 2) buffer ControlBlock { Control control; };
layout(scalar, binding = 3) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 4) readonly buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 5) writeonly buffer Sizes { WaveSizes sizes; };
layout(scalar, binding = 6) buffer GroupsDone { uint groups_done; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

#include "shaders/wave/base.glsl"
#include "shaders/base/last_group.glsl"
#include "shaders/wave/room.glsl"
#include "shaders/wave/sizes.glsl"

void offer_face(uint i) {
  uint lower = control.maximum[kMaxLower];  // as bits, as the distances are
  uvec3 f = faces[i];
  uint corner = vertex_distance[f.x] == lower   ? 0u
                : vertex_distance[f.y] == lower ? 1u
                : vertex_distance[f.z] == lower ? 2u
                                                : kNone;
  if (corner != kNone) atomicMin(control.seed_witness, 3u * i + corner);
}

// The corner that was chosen; none if a warm run's old witness is farther than every vertex and
// stays.
void adopt_corner() {
  uint chosen = atomicMin(control.seed_witness, kNone);
  if (chosen == kNone) return;
  uint face = chosen / 3u;
  uint corner = chosen % 3u;
  uint vertex = faces[face][corner];
  float distance = uintBitsToFloat(control.maximum[kMaxLower]);
  control.witness = Witness(vertices[vertex].hi, distance, face, corner == 1u ? kBaryOne : 0u,
                            corner == 2u ? kBaryOne : 0u, vertex_nearest[vertex]);
}

void plan_first_wave() {
  float base = base_of_run();
  control.base = base;
  control.tight = is_tight(base) ? 1u : 0u;
  // If the tolerance is so small that the base must move before anything is closed, or if the run
  // must pause, the first wave has no children. The plan at its end moves the base, and later ones
  // admit the faces.
  bool base_is_right = !needs_sharp(uintBitsToFloat(control.maximum[kMaxLower]));
  bool has_room = control.pauses == 0u || room_for_all(0u) <= control.capacity;
  bool begins = base_is_right && has_room;
  bool ends = is_beyond_limit(uintBitsToFloat(control.maximum[kMaxLower]));
  if (ends) control.status = kStatusBeyond;
  begins = begins && !ends;
  uint roots = begins ? roots_to_admit(0u, control.capacity) : 0u;
  control.roots = roots;
  control.root_cursor = roots;
  control.wave = begins ? 1u : 0u;
  write_child_sizes(roots, !ends);
  if (ends) write_refine_sizes(0u, 0u, 0u);  // no plan follows to do it: its waves are empty
}

void main() {
  uint i = item_index();
  if (i < push.count) offer_face(i);
  if (!is_last_group() || gl_LocalInvocationID.x > 0u) return;
  adopt_corner();
  plan_first_wave();
}
