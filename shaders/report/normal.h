// How A's normal on a cell T agrees with those of the faces of B that are closest to it: c(x) is
// |cos| of the angle to the best of the faces that are closest to x.
//
// A face S may be closest on a share of T alone, where an affine function that is not above d(x, S)
// is no more than another that is not below d(x, B). Let K(x) be the faces that may be at x, with
// cosines in [l, u], and `low` and `high` ends of all. Then c(x) is at least the least l of K(x),
// and so at least high less the sum of high - l over all of K(x); it is at most low and the sum of
// u - low. Means over T have each face's share for its part of these sums. Likewise normals agree
// on all of T but the shares of those faces that may not agree.
//
// A face S of a small cosine may count with a better one's where the closest point of S is one
// corner, or on one edge, for all of T: any other face that has this corner, or this edge, is as
// close.
//
// All of it holds wherever vertices may be up to `moved`, those of both meshes together, from where
// they are stored. docs/certificate.md adds up the errors.
#ifndef VKH_SHADERS_REPORT_NORMAL_H
#define VKH_SHADERS_REPORT_NORMAL_H

#include "shaders/report/side.h"

VKH_LIB_BEGIN

struct Cosine {
  float least, most;
};

VKH_FN Cosine any_cosine() {
  Cosine c;
  c.least = 0.0f;
  c.most = 1.0f;
  return c;
}

// |m.n| of unit normals, each `off` at most from its vector here: m.n is off by m_off and by
// (1 + m_off) n_off, and their product rounds by 3 kUlp of both lengths. With offs up to 1/4 that
// is under 5 kUlp; 6 are taken.
VKH_FN Cosine cosine_between(vec3 m, float m_off, vec3 n, float n_off) {
  if (max(m_off, n_off) > 0.25f) return any_cosine();
  float cosine = abs(dot3(m, n));
  float off = round_up((m_off + (1.0f + m_off) * n_off) + 6.0f * kUlp, 4.0f);
  Cosine c;
  c.least = max(lowered(cosine - off), 0.0f);
  c.most = min(raised(cosine + off), 1.0f);
  return c;
}

// Steers: a face whose cosine is less than the largest by no more than this needs no excuse.
VKH_CONST float kNarrowCosine = 1e-3f;

// The sign of (p - s).(u - s), where it is more than the error. All points may be `off`, and so
// both differences 2 off. Rounding, in units of kUlp: differences 1 each, the product 3; 6 are
// taken.
VKH_FN int sign_along(vec3 p, vec3 s, vec3 u, float off) {
  vec3 d = p - s;
  vec3 e = u - s;
  float far = norm_up(d);
  float length = norm_up(e);
  float turned = 2.0f * off * (far + length + 2.0f * off);
  return sign_of(dot3(d, e), turned + 6.0f * kUlp * far * length);
}

// Whether p lies surely beyond the edge from s to u, seen from v, in the plane of the three: with
// e = u - s and f = v - s, where (p - s).(e x (e x f)) is positive. All points may be `off`, so
// each of the four factors 2 off: one after the other is replaced by the exact one, among longer
// ones. Rounding, in units of kUlp: differences 1 each, a cross product 3 of both lengths, since
// its components are differences of products, and the last product 3: 13; 16 are taken.
VKH_FN bool is_over_edge(vec3 p, vec3 s, vec3 u, vec3 v, float off) {
  vec3 d = p - s;
  vec3 e = u - s;
  vec3 f = v - s;
  float height = dot3(d, cross3(e, cross3(e, f)));
  float far = norm_up(d);
  float length = norm_up(e);
  float width = norm_up(f);
  float rounding = 16.0f * kUlp * far * length * length * width;
  float by = 2.0f * off;
  float most_far = far + by;
  float most_length = length + by;
  float most_width = width + by;
  float turned = by * most_length *
                 (most_length * most_width + 2.0f * most_far * most_width + most_far * most_length);
  return sign_of(height, round_up(rounding + turned, 16.0f)) > 0;
}

// The same for all of T, by its corners: 0 where they do not agree.
VKH_FN int cell_along(CellFrame t, vec3 s, vec3 u, float off) {
  int first = sign_along(t.at.a, s, u, off);
  if (first == 0 || sign_along(t.at.b, s, u, off) != first) return 0;
  if (sign_along(t.at.c, s, u, off) != first) return 0;
  return first;
}

VKH_FN bool is_cell_over_edge(CellFrame t, vec3 s, vec3 u, vec3 v, float off) {
  if (!is_over_edge(t.at.a, s, u, v, off)) return false;
  if (!is_over_edge(t.at.b, s, u, v, off)) return false;
  return is_over_edge(t.at.c, s, u, v, off);
}

// The corners of S on which its closest point lies for all of T, a bit for each: one corner, or an
// edge's two; 0 where that is not sure. Each sign is of an affine function, so T's corners tell of
// all of it. At a corner: where T is behind it, seen from both others. On an edge: where T's feet
// are between its ends, and T is over it.
VKH_FN uint closest_feature(CellFrame t, Surface s, float moved) {
  float off = round_up(s.slack + t.slack + moved, 2.0f);
  for (uint i = 0u; i < 3u; ++i) {
    uint j = (i + 1u) % 3u;
    vec3 p = corner_of(s.at, i);
    vec3 q = corner_of(s.at, j);
    vec3 r = corner_of(s.at, (i + 2u) % 3u);
    int to_next = cell_along(t, p, q, off);
    if (to_next < 0 && cell_along(t, p, r, off) < 0) return 1u << i;
    bool is_between = to_next > 0 && cell_along(t, q, p, off) > 0;
    if (is_between && is_cell_over_edge(t, p, q, r, off)) return (1u << i) | (1u << j);
  }
  return 0u;
}

// Whether a face with these corners has those of `one` that are named.
VKH_FN bool has_corners(uvec3 corners, uvec3 one, uint named) {
  bool has_a = either(either((named & 1u) == 0u, one.x == corners.x),
                      either(one.x == corners.y, one.x == corners.z));
  bool has_b = either(either((named & 2u) == 0u, one.y == corners.x),
                      either(one.y == corners.y, one.y == corners.z));
  bool has_c = either(either((named & 4u) == 0u, one.z == corners.x),
                      either(one.z == corners.y, one.z == corners.z));
  return both(has_a, both(has_b, has_c));
}

// The share of T on which S may be closest; 0: on none.
VKH_FN float closest_share(CellFrame t, Surface s, Above above, float moved) {
  Beyond e = beyond_of(t, s, above, moved);
  if (e.is_far) return 0.0f;
  vec3 x = e.at_corners;
  return share_within(spread_of(vec3(lowered(x.x), lowered(x.y), lowered(x.z))), 0.0f).up;
}

// Sums over faces that may be closest. Each addition is rounded up by itself.
struct Comparison {
  float limit_down, limit_up;  // normals agree from a cosine between them on
  float low, high;             // no cosine of a face is less, or more
  float least;                 // of those that count
  float loss, gain;            // of the mean, from `high` and from `low`
  float doubtful, fine;        // shares of faces that may not agree, and of those that may
};

VKH_FN Comparison comparison_of(Cosine all, float limit_down, float limit_up) {
  Comparison c;
  c.limit_down = limit_down;
  c.limit_up = limit_up;
  c.low = all.least;
  c.high = all.most;
  c.least = 1.0f;
  c.loss = 0.0f;
  c.gain = 0.0f;
  c.doubtful = 0.0f;
  c.fine = 0.0f;
  return c;
}

// x and a share of `value`, from above.
VKH_FN float more_by(float x, float share, float value) {
  return raised(x + raised(share * raised(value)));
}

// Adds a face. `counts`: the least cosine that counts where it is closest, at least its own.
VKH_FN Comparison with_face(Comparison c, Cosine of, float counts, float share) {
  c.least = min(c.least, counts);
  c.loss = more_by(c.loss, share, max(c.high - counts, 0.0f));
  c.gain = more_by(c.gain, share, of.most - c.low);
  if (counts < c.limit_up) c.doubtful = more_by(c.doubtful, share, 1.0f);
  if (of.most >= c.limit_down) c.fine = more_by(c.fine, share, 1.0f);
  return c;
}

// The same members as CellAgreement.
struct Agreement {
  float least, most, sure, may;
};

VKH_FN Agreement agreement_of(Comparison c) {
  Agreement a;
  a.least = max(max(c.least, lowered(c.high - c.loss)), 0.0f);
  a.most = min(min(c.high, raised(c.low + c.gain)), 1.0f);
  a.sure = choose(c.doubtful > 0.0f, max(lowered(1.0f - c.doubtful), 0.0f), 1.0f);
  a.may = min(c.fine, 1.0f);
  return a;
}

VKH_FN Agreement any_agreement() {
  Agreement a;
  a.least = 0.0f;
  a.most = 1.0f;
  a.sure = 0.0f;
  a.may = 1.0f;
  return a;
}

VKH_LIB_END
#endif
