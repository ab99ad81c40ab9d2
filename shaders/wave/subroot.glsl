// Roots: faces of A and, in tight runs, subroots. A candidate whose barycentric bits run out
// becomes a root of its own, with 20 bits more: it is kept behind the frontier's halves, and names
// itself for good, by its face and its corners in that. Its geometry is worked out from them
// whenever it is needed. No subroot has subroots: 2^-40 of a face is under what 48 bits of
// coordinates tell apart. The kernel declares `control`, `frontier`, `vertices`, `faces`.
#ifndef VKH_SHADERS_WAVE_SUBROOT_GLSL
#define VKH_SHADERS_WAVE_SUBROOT_GLSL

#include "shaders/base/root.glsl"
#include "shaders/base/switches.glsl"
#include "shaders/math/hash.h"

bool is_subroot(uint root) { return has_subroots() && root >= control.face_count; }

uint most_subroots() { return min(control.capacity / 4u, kMostSubroots); }

uint subroot_place(uint i) { return 2u * control.capacity + i; }

Candidate subroot_of(uint root) { return frontier[subroot_place(root - control.face_count)]; }

uint face_of(uint root) { return is_subroot(root) ? subroot_of(root).root : root; }

// The root of a subroot: its corner is off by 8 kUlp2 of its face's coordinates, its edges by 4.5.
Root root_at(uint root) {
  if (!is_subroot(root)) return load_root(root);
  Candidate c = subroot_of(root);
  Root face = load_root(c.root);
  Bary3 t = unpack_corners(c.corners);
  Root r;
  r.origin = position_of(face, t.a);
  r.ab = step_between(t.a, t.b, face);
  r.ac = step_between(t.a, t.c, face);
  return r;
}

// A candidate's corners. A subroot itself lies within its face's slack, 24 kUlp2 of the face's
// coordinates, of where it should be: half of that would do.
LocalCorners placed_corners(uint root, Bary3 t) {
  LocalCorners p = local_corners(root_at(root), t);
  if (is_subroot(root)) {
    float slack = local_corners(load_root(face_of(root)), whole_root()).slack;
    p.slack = round_up(p.slack + slack, 1.0);
  }
  return p;
}

// The result does not depend on the subroot's place.
uint root_hash(uint root) {
  if (!is_subroot(root)) return mixed(0u, root);
  Candidate c = subroot_of(root);
  uint hash = mixed(mixed(mixed(0u, c.root), c.corners.x), c.corners.y);
  return mixed(mixed(hash, c.corners.z), c.corners.w);
}

#endif
