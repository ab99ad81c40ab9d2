// Writes the report, with the certified lower bound: the smallest distance of the witness from any
// face of B, each rounded down. Every triangle is visited, so nothing rests on the BVH or on the
// traversals that found the witness. One invocation of the last workgroup to end writes. In:
// control, A, B as given. Out: report. lower: that distance, less how far the witness's 48-bit
// position can lie from the point of A that it stands for. upper: the largest u of everything that
// was closed, spilled or is still open; without bound while faces of A wait. Both as float32, and
// to more bits above the base. If an input is no mesh the status shows it, and no bound is valid.
// lower_bits, ordered bits (math/morton.h), and groups_done are kNone and 0 again.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shaders/base/invocation.glsl"
#include "shaders/math/bary.h"
#include "shaders/math/lower.h"
#include "shaders/math/morton.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer BVertices { Vertex b_vertices[]; };
layout(scalar, binding = 2) readonly buffer BFaces { uvec3 b_faces[]; };
layout(scalar, binding = 3) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 4) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 5) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 6) buffer LowerBits { uint lower_bits; };
layout(scalar, binding = 7) buffer GroupsDone { uint groups_done; };
layout(scalar, binding = 8) writeonly buffer ReportBlock { Report report; };
layout(scalar, binding = 9) readonly buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 10) readonly buffer BFault { uint b_fault; };
layout(scalar, push_constant) uniform PushBlock { ReportPush push; };

#include "shaders/base/last_group.glsl"
#include "shaders/wave/base.glsl"
#include "shaders/wave/subroot.glsl"

// A corner of B: its high part, and its low part if the run uses those.
Two3 b_corner(uint v) {
  Two3 p = two(b_vertices[v].hi);
  if (control.two_float != 0u) p.lo = b_vertices[v].lo;
  return p;
}

// The witness's root, clamped to a face of A, or a subroot, even if the coordinates were garbage.
uint root_of(Witness w) {
  uint subroots = min(control.subroots, most_subroots());
  if (is_subroot(w.root) && w.root - control.face_count < subroots) return w.root;
  return min(w.root, control.face_count - 1u);
}

// The distance of this invocation's triangle. Invocations past the end repeat the last one: each
// takes part in the subgroup's minimum.
float certified_distance() {
  uint i = min(item_index(), push.count - 1u);
  Witness w = control.witness;
  Root root = root_at(root_of(w));
  Two3 p = position_of(root, uvec2(w.j, w.k));
  uvec3 f = b_faces[i];
  Surface s = make_surface(b_corner(f.x), b_corner(f.y), b_corner(f.z),
                           View(p, norm_up(p.hi), control.base, true, false, 0.0, false));
  // A triangle farther than the steering distance by a margin does not decide the minimum.
  float enough = w.distance + 1.0e-4 * (control.base + w.distance);
  return triangle_distance_down(s, enough);
}

float witness_slack(Witness w) { return placed_corners(root_of(w), whole_root()).slack; }

// A point of a subroot, one coordinate in its face: its corners' by its place among them, in units
// of 2^-40, exact in two words.
uint coordinate_in_face(uvec3 corners, uvec2 at, out uint low) {
  uvec3 weights = uvec3(kBaryOne - at.x - at.y, at);
  uvec2 sum = uvec2(0u);  // low word, high word
  for (uint i = 0u; i < 3u; ++i) {
    uint high, word, carry;
    umulExtended(corners[i], weights[i], high, word);
    sum.x = uaddCarry(sum.x, word, carry);
    sum.y += high + carry;
  }
  low = sum.x & (kBaryOne - 1u);
  return (sum.x >> kBaryBits) | (sum.y << (32u - kBaryBits));
}

void write_witness(Witness w) {
  report.witness_low_j = 0u;
  report.witness_low_k = 0u;
  if (is_subroot(root_of(w))) {
    Candidate c = subroot_of(w.root);
    Bary3 t = unpack_corners(c.corners);
    uvec2 at = uvec2(w.j, w.k), low;
    w.j = coordinate_in_face(uvec3(t.a.x, t.b.x, t.c.x), at, low.x);
    w.k = coordinate_in_face(uvec3(t.a.y, t.b.y, t.c.y), at, low.y);
    w.root = c.root;
    report.witness_low_j = low.x;
    report.witness_low_k = low.y;
  }
  report.witness = w.position;
  report.witness_root = w.root;
  report.witness_j = w.j;
  report.witness_k = w.k;
  report.witness_face = triangles[min(w.nearest, push.count - 1u)].face;
}

// The status for a limit, if it is proven; `lower` and `upper` are above the base.
uint proven_status(float lower, float upper) {
  if (control.limit > 0.0 && control.certified != 0u) {
    if (lower > raised(control.limit_up - control.base)) return kStatusBeyond;
    if (upper <= limit_above_base()) return kStatusWithin;
  }
  return control.status == kStatusBeyond ? kStatusPrecision : control.status;
}

bool is_running() { return control.status == kStatusRunning; }

// Faces of A that no wave has bounded; the planned wave's are admitted only.
uint waiting_faces() {
  return control.face_count - control.root_cursor + (is_running() ? control.roots : 0u);
}

uint remaining() {
  bool open = control.status != kStatusDecided && control.status != kStatusPrecision;
  return (open ? control.count[kCountFrontier] : 0u) + waiting_faces();
}

float upper_bound() {
  if (waiting_faces() > 0u) return 3.0e38;
  uint bits = max(max(control.maximum[kMaxClosed], control.maximum[kMaxSpilled]),
                  control.maximum[kMaxFrontier]);
  return uintBitsToFloat(bits);
}

// The certified lower bound above the base, at least -base.
float lower_bound(Witness w) {
  float above = uintBitsToFloat(from_ordered_bits(atomicExchange(lower_bits, kNone)));
  return max(lowered(above - 2.0 * witness_slack(w)), -control.base);
}

void write_report() {
  Witness w = control.witness;
  float lower = lower_bound(w);
  float upper = max(upper_bound(), lower);
  report.base = control.base;
  report.lower_above = lower;
  report.upper_above = upper;
  report.lower = max(lowered(control.base + lower), 0.0);
  report.upper = raised(control.base + upper);
  report.status = proven_status(lower, upper);
  bool is_planned = is_running() && control.wanted == 0u;
  report.wave = is_planned ? control.wave - 1u : control.wave;
  write_witness(w);
  report.remaining = remaining();
  report.wanted = control.wanted;
}

// Writes a report without bounds: the inputs were no meshes. The faces at fault take the place of
// the witness's.
void write_fault(uint a_fault, uint fault_of_b) {
  report.base = 0.0;
  report.lower = 0.0;
  report.lower_above = 0.0;
  float infinity = uintBitsToFloat(0x7f800000u);
  report.upper = infinity;
  report.upper_above = infinity;
  report.status = kStatusInput;
  report.witness_root = a_fault;
  report.witness_face = fault_of_b;
}

// Nothing but the report is valid: no run, and no triangles. push.count names the invalid mesh: 1
// is A, 2 is B, 3 is both.
void write_unbuilt() {
  report.wave = 0u;
  report.remaining = 0u;
  report.wanted = 0u;
  report.witness = vec3(0.0);
  report.witness_j = 0u;
  report.witness_k = 0u;
  report.witness_low_j = 0u;
  report.witness_low_k = 0u;
  write_fault((push.count & 1u) != 0u ? kFaultLayout : kNone,
              (push.count & 2u) != 0u ? kFaultLayout : kNone);
}

void main() {
  if (push.is_built == 0u) {
    if (item_index() == 0u) write_unbuilt();
    return;
  }
  float smallest = subgroupMin(certified_distance());
  if (subgroupElect()) atomicMin(lower_bits, ordered_bits(floatBitsToUint(smallest)));
  if (!is_last_group()) return;
  if (gl_LocalInvocationID.x != 0u) return;
  write_report();
  if (control.input_fault != kNone || b_fault != kNone) write_fault(control.input_fault, b_fault);
}
