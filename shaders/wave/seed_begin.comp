// Writes the control block's first state. It is one workgroup, of which an invocation writes all
// but the waves. In: push. Out: control, lower_bits, groups_done; in a warm run the last run's
// witness stays, for the query of A's vertices.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/switches.glsl"

layout(local_size_x = kMaxWaveRecords) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) writeonly buffer LowerBits { uint lower_bits; };
layout(scalar, binding = 2) writeonly buffer GroupsDone { uint groups_done; };
layout(scalar, push_constant) uniform PushBlock { BeginPush push; };

void begin() {
  control.input_fault = push.input_fault;
  for (int i = 0; i < 5; ++i) control.count[i] = 0u;
  for (int i = 0; i < 6; ++i) control.maximum[i] = 0u;
  for (uint i = 0u; i < kMostCulls; ++i) control.culled[i] = 0u;
  control.parity = 0u;
  control.wave = 0u;
  control.status = kStatusRunning;
  control.root_cursor = 0u;
  control.roots = 0u;
  control.parents = 0u;
  control.deferred = 0u;
  control.select_largest = 0u;
  control.sort_from = push.sort_from;
  control.sorted = 0u;
  control.spilled = 0u;
  control.subroots = 0u;
  control.pauses = push.pauses;
  control.wanted = 0u;
  control.split_twice = 0u;
  control.measuring = 0u;
  control.seed_witness = kNone;
  control.offer_key = kNone;
  control.offer_count = 0u;
  control.cull_tolerance = push.cull_tolerance;
  control.known_lower = push.known_lower;
  control.limit = push.limit;
  control.limit_up = max(push.limit, push.limit_up);
  control.base = 0.0;
  control.rebase_hi = 0.0;
  control.rebase_lo = 0.0;
  control.certified = (kSwitches & kUseUncertified) == 0u ? 1u : 0u;
  control.two_float = push.two_float;
  control.tight = 0u;
  if (push.warm == 0u) control.witness = Witness(vec3(0.0), -1.0, kNone, 0u, 0u, kNone);
  control.capacity = push.capacity;
  control.face_count = push.face_count;
  control.candidate_total = 0u;
  control.query_total = 0u;
  control.peak_frontier = 0u;
  lower_bits = kNone;
  groups_done = 0u;
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  control.waves[lane] = WaveRecord(0u, 0u, 0u, 0u, 0u, 0.0, 0.0);
  if (lane == 0u) begin();
}
