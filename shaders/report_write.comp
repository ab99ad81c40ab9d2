// What: the report. One workgroup, of which an invocation writes all but the waves. In: control,
// lower_bits from report_lower. Out: report. lower: the witness's certified distance, less how far
// its 48-bit position can lie from the point of A that it stands for. upper: the largest u of
// everything that was dropped, spilled or is still open; without bound while faces of A wait. Both
// as float32, and to more bits above the base.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"

layout(local_size_x = kMaxWaveRecords) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer LowerBits { uint lower_bits[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 4) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 5) writeonly buffer ReportBlock { Report report; };

#include "shaders/lib/root.glsl"
#include "shaders/lib/morton.h"

float witness_slack(Witness w) { return place_corners(load_root(w.root), whole_root()).slack; }

bool is_running() { return control.status == kStatusRunning; }

// Faces of A that no wave has bounded; the planned wave's are admitted only.
uint waiting_faces() {
  return control.face_count - control.root_cursor + (is_running() ? control.roots : 0u);
}

uint remaining() {
  bool open = is_running() || control.status == kStatusMemory;
  return (open ? control.count[kCountFrontier] : 0u) + waiting_faces();
}

float upper_bound() {
  if (waiting_faces() > 0u) return 3.0e38;
  uint bits = max(max(control.maximum[kMaxDropped], control.maximum[kMaxSpilled]),
                  control.maximum[kMaxFrontier]);
  return uintBitsToFloat(bits);
}

// What the certified lower bound is above the base, at least -base.
float lower_bound(Witness w) {
  float above = uintBitsToFloat(from_ordered_bits(lower_bits[0]));
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
  report.status = control.status;
  report.wave = is_running() ? control.wave - 1u : control.wave;  // one is planned
  report.witness = w;
  report.witness.distance = control.base + w.distance;
  report.witness_face = triangles[w.nearest].face;
  report.remaining = remaining();
  report.candidate_total = control.candidate_total;
  report.query_total = control.query_total;
  report.peak_frontier = control.peak_frontier;
  for (int i = 0; i < 8; ++i) report.culled[i] = control.culled[i];
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  report.waves[lane] = control.waves[lane];
  if (lane == 0u) write_report();
}
