#include "host/native/levels.h"

#include <algorithm>
#include <tuple>

#include "host/native/cascade.h"

namespace vkh::native {
namespace {

// Few enough that pieces cost about the same, and enough that fetching a piece costs nothing.
constexpr size_t kParentsOfPiece = 64;
constexpr size_t kFacesAtOnce = 256;
constexpr size_t kVerticesOfPiece = 256;

std::array<uint32_t, 3> three(const uvec3& v) { return {v.x, v.y, v.z}; }

// Returns the area of a part of a face, in units of 1 / kWholeArea of the face: exact, since a step
// is at most 2^30 in size.
uint64_t area_of(const Bary3& t) {
  const auto step = [](uint from, uint to) { return int64_t{to} - int64_t{from}; };
  const int64_t area = step(t.a.x, t.b.x) * step(t.a.y, t.c.y) -  //
                       step(t.a.y, t.b.y) * step(t.a.x, t.c.x);
  return static_cast<uint64_t>(area < 0 ? -area : area);
}
static_assert(kWholeArea == uint64_t{kOne} * kOne);

// The smallest u first; of equal ones the smallest in area, whose parts come before their equals.
bool is_sooner(const Candidate& p, const Candidate& q) {
  const auto key = [](const Candidate& c) {
    return std::make_tuple(c.upper, area_of(c.at), c.face, c.at.a.x, c.at.a.y, c.at.b.x, c.at.b.y,
                           c.at.c.x, c.at.c.y);
  };
  return key(p) < key(q);
}

}  // namespace

Levels::Levels(const Problem& problem, const Goal& goal, const NativeOptions& options,
               std::function<bool()> keep_going)
    : problem_(problem),
      goal_(goal),
      most_(std::max<size_t>(options.memory_bytes / kBytesOfCandidate, 1)),
      pool_(options.threads, std::move(keep_going), "the run was ended"),
      closed_areas_(options.coverage ? problem.a.faces.size() : 0) {}

std::vector<uint64_t> Levels::areas() const {
  std::vector<uint64_t> areas = closed_areas_;
  areas.resize(2 * closed_areas_.size());
  if (areas.empty()) return areas;
  for (const Candidate& c : open_) areas[closed_areas_.size() + c.face] += area_of(c.at);
  return areas;
}

void Levels::close(Piece& piece, uint32_t face, const Bary3& at, double upper, Close by) const {
  piece.gain.close(upper, by);
  if (!closed_areas_.empty()) piece.closed.push_back({face, area_of(at)});
}

// A candidate that was given up keeps the upper end from falling: no candidate below it needs
// refining.
double Levels::threshold() const {
  const double near = max(total_.best.distance, goal_.known_lower) + goal_.tolerance;
  return max(max(near, goal_.within), given_up_);
}

template <class Work>
std::vector<Levels::Piece> Levels::in_pieces(size_t count, size_t size, const Work& work) {
  std::vector<Piece> pieces((count + size - 1) / size);
  pool_.for_each(pieces.size(),
                 [&](size_t i) { work(pieces[i], i * size, std::min((i + 1) * size, count)); });
  return pieces;
}

void Levels::join_pieces(const std::vector<Piece>& pieces) {
  for (const Piece& piece : pieces) {
    total_.add(piece.gain);
    for (const Closed& c : piece.closed) closed_areas_[c.face] += c.area;
    open_.insert(open_.end(), piece.open.begin(), piece.open.end());
  }
  peak_ = std::max(peak_, open_.size());
}

void Levels::end_level() {
  upper_ = total_.largest_closed;
  for (const Candidate& c : open_) upper_ = max(upper_, c.upper);
  ++levels_;
}

// Vertices that follow each other in a file are mostly close: a search starts from the triangle of
// the vertex before.
void Levels::query_vertices(Piece& piece, size_t begin, size_t end) {
  uint32_t before = 0;
  for (size_t v = begin; v < end; ++v) {
    const vec3& p = problem_.placed_a.at[v];
    Nearest start;
    problem_.tree.try_triangle(p, before, start);
    of_vertex_[v] = problem_.tree.nearest(p, start);
    before = of_vertex_[v].place;
    ++piece.gain.queries;
  }
}

void Levels::ask_vertices() {
  of_vertex_.resize(problem_.placed_a.at.size());
  join_pieces(
      in_pieces(of_vertex_.size(), kVerticesOfPiece,
                [&](Piece& p, size_t begin, size_t end) { query_vertices(p, begin, end); }));
  const std::vector<UVec3>& faces = problem_.a.faces;
  for (uint32_t f = 0; f < faces.size(); ++f) {
    const Bary3 corner = whole_face();
    const auto offer = [&](uint32_t v, const uvec2& at) {
      const Nearest& near = of_vertex_[v];
      total_.offer({root(near.distance2), f, at, near.place});
    };
    offer(faces[f].x, corner.a);
    offer(faces[f].y, corner.b);
    offer(faces[f].z, corner.c);
  }
}

void Levels::bound_faces() {
  const size_t count = problem_.a.faces.size();
  join_pieces(in_pieces(count, kFacesAtOnce, [&](Piece& piece, size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) bound_face(piece, static_cast<uint32_t>(f));
  }));
  end_level();
}

void Levels::bound_face(Piece& piece, uint32_t f) const {
  const UVec3& v = problem_.a.faces[f];
  const Face face = problem_.face_of_a(f);
  const Bary3 whole = whole_face();
  const std::array<Nearest, 3> near{of_vertex_[v.x], of_vertex_[v.y], of_vertex_[v.z]};
  Family family(problem_, face, kNone);
  family.add_point(whole.a, near[0].place);
  family.add_point(whole.b, near[1].place);
  family.add_point(whole.c, near[2].place);
  const bool on_b = near[0].distance2 + near[1].distance2 + near[2].distance2 == 0;
  if (on_b && family.is_shared(v, piece.gain)) return close(piece, f, whole, 0, kByExact);
  const Child child{whole, {0, 1, 2}};
  const Verdict verdict = family.bound(child, 1e30, threshold(), piece.gain);
  if (verdict.upper <= threshold()) return close(piece, f, whole, verdict.upper, verdict.by);
  piece.open.push_back(
      {whole, f, {near[0].place, near[1].place, near[2].place}, verdict.centre, verdict.upper});
}

// Frees half of the room if less than a quarter is left. The candidates with the smallest u are
// given up: the others may still bring the upper end down to them.
void Levels::give_up() {
  if (open_.size() <= most_ - most_ / 4) return;
  const auto kept = open_.end() - static_cast<std::ptrdiff_t>(most_ / 2);
  if (kept < open_.end()) std::nth_element(open_.begin(), kept, open_.end(), is_sooner);
  for (auto c = open_.begin(); c < kept; ++c) {
    given_up_ = max(given_up_, c->upper);
    if (!closed_areas_.empty()) closed_areas_[c->face] += area_of(c->at);
  }
  total_.largest_closed = max(total_.largest_closed, given_up_);
  open_.erase(open_.begin(), kept);
}

// Brings the candidates that the level refines to the front of open_, and returns how many: each
// may become four.
size_t Levels::choose_refined() {
  const size_t held = open_.size();
  const size_t room = std::max<size_t>((most_ - held) / 3, 1);
  if (held <= room) return held;
  const auto cut = open_.begin() + static_cast<std::ptrdiff_t>(room);
  std::nth_element(open_.begin(), cut, open_.end(), is_sooner);
  return room;
}

// The code of the candidate's split; kSplitNone if its bits have run out, or if it is so small that
// rounding holds u up.
uint32_t Levels::choose_split(const Candidate& c, const Face& face) const {
  const Corners t = local_corners(face, c.at);
  const vec3 ab = t.b - t.a, ac = t.c - t.a;
  const double tiny = 0.0625 * goal_.tolerance;
  if (max(dot3(ab, ab), dot3(ac, ac)) < tiny * tiny) return kSplitNone;
  if (quality(t) < kThinQuality) {
    const uint x = opposite_longest(t);
    const Halves h = halves_of(c.at, x, middle_opposite(c.at, x));
    const uint y = opposite_longest(local_corners(face, h.first));
    const uint z = opposite_longest(local_corners(face, h.second));
    const uint code = bisection_code(x, y, z);
    if (can_split(c.at, code)) return code;
  }
  return can_split(c.at, kSplitMidpoint) ? kSplitMidpoint : kSplitNone;
}

void Levels::split(Piece& piece, uint32_t number) const {
  const Candidate& c = open_[number];
  if (c.upper <= threshold()) return close(piece, c.face, c.at, c.upper, kByRisen);
  const Face face = problem_.face_of_a(c.face);
  Split s{.parent = number, .code = choose_split(c, face), .nearest = {}};
  if (s.code == kSplitNone) return close(piece, c.face, c.at, c.upper, kByPrecision);
  const Bary6 points = split_points(c.at, s.code);
  for (uint i = 0; i < 3; ++i) {
    const uvec2 at = corner_of(points.fresh, i);
    const vec3 p = near_position(face, at);
    Nearest start;
    for (const uint32_t place : c.nearest) problem_.tree.try_triangle(p, place, start);
    if (c.centre != kNone) problem_.tree.try_triangle(p, c.centre, start);
    const Nearest found = problem_.tree.nearest(p, start);
    s.nearest[i] = found.place;
    piece.gain.offer({root(found.distance2), c.face, at, found.place});
    ++piece.gain.queries;
  }
  piece.splits.push_back(s);
}

void Levels::bound_children(Piece& piece, const Split& s) const {
  const Candidate& parent = open_[s.parent];
  const Face face = problem_.face_of_a(parent.face);
  const Bary6 points = split_points(parent.at, s.code);
  Family family(problem_, face, parent.centre);
  std::array<uint32_t, 6> near;
  for (uint i = 0; i < 6; ++i) {
    near[i] = i < 3 ? parent.nearest[i] : s.nearest[i - 3];
    family.add_point(point_of(points, i), near[i]);
  }
  for (uint which = 0; which < 4; ++which) {
    const uvec3 corner = child_points(s.code, which);
    const Child child{child_of(points, corner), three(corner)};
    const Verdict v = family.bound(child, parent.upper, threshold(), piece.gain);
    if (v.upper <= threshold()) {
      close(piece, parent.face, child.at, v.upper, v.by);
    } else {
      piece.open.push_back({child.at,
                            parent.face,
                            {near[corner.x], near[corner.y], near[corner.z]},
                            v.centre,
                            v.upper});
    }
  }
}

void Levels::advance() {
  give_up();
  const size_t refined = choose_refined();
  std::vector<Piece> pieces =
      in_pieces(refined, kParentsOfPiece, [&](Piece& piece, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) split(piece, static_cast<uint32_t>(i));
      });
  for (const Piece& piece : pieces) total_.add(piece.gain);
  for (Piece& piece : pieces) piece.gain = {};
  pool_.for_each(pieces.size(), [&](size_t i) {
    for (const Split& s : pieces[i].splits) bound_children(pieces[i], s);
  });
  open_.erase(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(refined));
  join_pieces(pieces);
  end_level();
}

}  // namespace vkh::native
