#include "host/read/file_mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <iterator>
#include <limits>
#include <mutex>

#include "host/base/decimal.h"
#include "host/base/hypot3.h"
#include "host/base/reject.h"
#include "vkhausdorff/note.h"
#include "vkhausdorff/polygon.h"

namespace vkh {
namespace {

// Completes "an outline that".
std::string what_is_odd(PolygonKind kind) {
  if (kind == PolygonKind::kNoArea) return "encloses no area";
  if (kind == PolygonKind::kIntricate) return "is too intricate to be triangulated in time";
  return "crosses itself";
}

Triangulation of_face(uint64_t face, uint32_t triangles, PolygonResult& result) {
  Triangulation out{.face = face, .corners = triangles + 2};
  if (has_only_fan(result.kind)) return out;
  out.axis = result.axis;
  out.triangles = std::move(result.triangles);
  return out;
}

// Counts a polygon and keeps its triangles, if they are not the fan of a convex one.
void add_polygon(uint64_t face, uint32_t triangles, PolygonResult& result, Polygons& all) {
  if (result.kind != PolygonKind::kFan)
    all.triangulations.push_back(of_face(face, triangles, result));
  if (result.kind == PolygonKind::kClipped) ++all.clipped;
  if (has_only_fan(result.kind) && all.fanned++ == 0) {
    all.first_fanned = face;
    all.first_kind = result.kind;
  }
  if (result.ambiguity > all.ambiguity) {
    all.ambiguity = result.ambiguity;
    all.ambiguous_face = face;
  }
}

}  // namespace

std::string counted(uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void FileMeshBuilder::check_room(uint64_t vertex_count, uint64_t face_count) const {
  if (mesh_bytes(vertex_count, face_count) > limits_.max_input_bytes)
    refuse_size(vertex_count, face_count);
}

void FileMeshBuilder::reserve(uint64_t vertex_count, uint64_t face_count) {
  check_room(vertex_count, face_count);
  vertices_.reserve(vertex_count);
  faces_.reserve(face_count);
}

void FileMeshBuilder::refuse_size(uint64_t vertex_count, uint64_t face_count) const {
  const std::string place = face_count > 0 ? "face " + std::to_string(face_count - 1)
                                           : "vertex " + std::to_string(vertex_count - 1);
  reject(name_, place,
         "a mesh of " + std::to_string(vertex_count) + " vertices and " +
             counted(face_count, "face") + " takes " +
             counted(mesh_bytes(vertex_count, face_count), "byte") + ", beyond the limit of " +
             counted(limits_.max_input_bytes, "byte"),
         kLessInput);
}

void FileMeshBuilder::add_face(std::span<const uint32_t> corners) {
  if (corners.size() < 3) {
    ++short_faces_;
    file_faces_.add(faces_.size(), 0);
    return;
  }
  const size_t count = corners.size() - 2;
  if (count > 1) {
    ++polygons_;
    file_faces_.add(faces_.size(), count);
  }
  make_room(0, count);
  // Reserves exactly what a large polygon takes, and not twice the present size.
  if (faces_.capacity() - faces_.size() < count && count > faces_.size())
    faces_.reserve(faces_.size() + count);
  for (size_t i = 2; i < corners.size(); ++i) {
    faces_.emplace_back(corners[0], corners[i - 1], corners[i]);
  }
}

FileMeshBuilder::FileMeshBuilder(const MeshSource& source, std::vector<glm::dvec3> vertices,
                                 std::vector<glm::uvec3> faces)
    : name_(source.name),
      limits_(source.limits),
      vertices_(std::move(vertices)),
      faces_(std::move(faces)) {
  make_room(0, 0);
}

FileMeshBuilder FileMeshBuilder::joined(const MeshSource& source,
                                        std::vector<FileMeshBuilder>&& blocks) {
  std::vector<size_t> vertices, faces;
  for (const FileMeshBuilder& block : blocks) {
    vertices.push_back(block.vertices_.size());
    faces.push_back(block.faces_.size());
  }
  FileMeshBuilder all(source);
  const ThreadPool pool = pool_of(source);
  const size_t vertex_count = starts_of(vertices), face_count = starts_of(faces);
  all.make_room(vertex_count, face_count);
  resize_together(pool, all.vertices_, vertex_count);
  resize_together(pool, all.faces_, face_count);
  pool.for_each(blocks.size(), [&](size_t i) {
    const auto to = [i](auto& whole, const std::vector<size_t>& starts) {
      return whole.begin() + static_cast<std::ptrdiff_t>(starts[i]);
    };
    std::copy(blocks[i].vertices_.begin(), blocks[i].vertices_.end(), to(all.vertices_, vertices));
    std::copy(blocks[i].faces_.begin(), blocks[i].faces_.end(), to(all.faces_, faces));
    blocks[i].vertices_ = {};
    blocks[i].faces_ = {};
  });
  for (size_t i = 0; i < blocks.size(); ++i) {
    const FileMeshBuilder& block = blocks[i];
    all.count_faces(block.polygons_, block.short_faces_, block.file_faces_, faces[i]);
  }
  return all;
}

// Returns false for faces that make_mesh refuses.
bool FileMeshBuilder::is_measurable(std::span<const glm::uvec3> faces) const {
  return std::all_of(faces.begin(), faces.end(), [&](const glm::uvec3& face) {
    for (int k = 0; k < 3; ++k) {
      if (face[k] >= vertices_.size()) return false;
      const glm::dvec3& p = vertices_[face[k]];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
    }
    return true;
  });
}

// If an outline crosses itself, or encloses nothing, and is no wider than this, the rounding of its
// corners is the cause: writers give six digits or decimals. Its fan is as near to any filling.
class FileMeshBuilder::SliverWidth {
 public:
  explicit SliverWidth(const std::vector<glm::dvec3>& vertices) : vertices_(vertices) {}

  bool holds(double width) const {
    constexpr double kOfDiagonal = 1e-4;
    std::call_once(once_, [this] { diagonal_ = diagonal(); });
    return width <= kOfDiagonal * diagonal_;
  }

 private:
  double diagonal() const {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::dvec3& p : vertices_) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    return hypot3(high.x - low.x, high.y - low.y, high.z - low.z);
  }

  const std::vector<glm::dvec3>& vertices_;
  mutable std::once_flag once_;
  mutable double diagonal_ = 0;
};

void FileMeshBuilder::Triangulated::append(Triangulated&& part) {
  Polygons& all = polygons;
  Polygons& more = part.polygons;
  std::move(more.triangulations.begin(), more.triangulations.end(),
            std::back_inserter(all.triangulations));
  if (all.fanned == 0) {
    all.first_fanned = more.first_fanned;
    all.first_kind = more.first_kind;
  }
  all.clipped += more.clipped;
  all.fanned += more.fanned;
  if (more.ambiguity > all.ambiguity) {
    all.ambiguity = more.ambiguity;
    all.ambiguous_face = more.ambiguous_face;
  }
  if (odd == 0) {
    first_odd = part.first_odd;
    odd_kind = part.odd_kind;
  }
  odd += part.odd;
}

// Triangulates from one face to another, with as many triangles each.
FileMeshBuilder::Triangulated FileMeshBuilder::triangulate(const FileFaces::Run& begin,
                                                           const FileFaces::Run& end,
                                                           const SliverWidth& sliver) {
  const uint32_t each = (end.triangles - begin.triangles) / (end.faces - begin.faces);
  Triangulated all;
  for (uint32_t i = 0; i < end.faces - begin.faces; ++i) {
    const std::span fan(&faces_[begin.triangles + size_t{i} * each], each);
    if (!is_measurable(fan)) continue;
    const uint64_t face = begin.faces + i;
    PolygonResult result = limits_.triangulate ? limits_.triangulate(face, vertices_, fan)
                                               : triangulate_fan(vertices_, fan);
    const bool is_odd = has_only_fan(result.kind) && !sliver.holds(result.ambiguity);
    if (is_odd && all.odd++ == 0) {
      all.first_odd = face;
      all.odd_kind = result.kind;
    }
    if (is_odd) result.ambiguity = 0;
    add_polygon(face, each, result, all.polygons);
  }
  return all;
}

FileMeshBuilder::Triangulated FileMeshBuilder::triangulate(const ThreadPool& pool) {
  constexpr uint32_t kTriangles = 1 << 15;  // about 3 ms
  std::vector<std::pair<FileFaces::Run, FileFaces::Run>> parts;
  FileFaces::Run before;
  for (const FileFaces::Run& run : file_faces_.runs()) {
    const uint32_t each = (run.triangles - before.triangles) / (run.faces - before.faces);
    const uint32_t step = each > 1 ? std::max(1U, kTriangles / each) : 0;
    while (each > 1 && before.faces < run.faces) {
      const uint32_t count = std::min(step, run.faces - before.faces);
      const FileFaces::Run end = {before.triangles + count * each, before.faces + count};
      parts.emplace_back(before, end);
      before = end;
    }
    before = run;
  }
  const SliverWidth sliver(vertices_);
  std::vector<Triangulated> found(parts.size());
  pool.for_each(parts.size(),
                [&](size_t i) { found[i] = triangulate(parts[i].first, parts[i].second, sliver); });
  Triangulated all;
  for (Triangulated& part : found) all.append(std::move(part));
  return all;
}

void FileMeshBuilder::note_polygons(const Polygons& polygons) {
  std::string note = counted(polygons_, "face") + " of more than three corners " +
                     (polygons_ == 1 ? "was" : "were") + " triangulated";
  if (polygons.clipped > 0) note += ", " + std::to_string(polygons.clipped) + " of them not convex";
  notes.push_back(note_of(NoteCode::kPolygons, note, {static_cast<double>(polygons_), "faces"}));
  if (polygons.ambiguity > 0) {
    notes.push_back(note_on_ambiguity(polygons));
  }
  if (polygons.fanned == 0) return;
  notes.push_back(
      note_of(NoteCode::kPolygons,
              "fanned: " + counted(polygons.fanned, "face") + " without a triangulation of " +
                  (polygons.fanned == 1 ? "its" : "their") +
                  " outline; what is measured may leave it; at face " +
                  std::to_string(polygons.first_fanned) + " it " + what_is_odd(polygons.first_kind),
              {static_cast<double>(polygons.fanned), "faces"}));
  notes.back().face = polygons.first_fanned;
}

void FileMeshBuilder::refuse_odd(const Triangulated& found) const {
  if (found.odd == 0 || limits_.odd_polygons == OddPolygons::kFanned) return;
  std::string what = "an outline that " + what_is_odd(found.odd_kind);
  if (found.odd > 1) what += ", the first of " + counted(found.odd, "such face");
  reject(name_, "face " + std::to_string(found.first_odd), what,
         "a polygon that does not cross itself, or --polygons fan, which measures the fan of its "
         "corners");
}

void FileMeshBuilder::refuse_no_face(const std::string& place) const {
  if (short_faces_ == 0 && !vertices_.empty())
    reject(name_, place, counted(vertices_.size(), "point") + " and no face", kAMesh);
  reject(name_, place,
         short_faces_ == 0 ? "the file ends without a face"
                           : "the file ends without a face of three corners",
         "at least one face: a distance between no surfaces is undefined");
}

ReadMesh FileMeshBuilder::finish_points(const std::string& place) && {
  if (const uint64_t faces = faces_.size() + short_faces_; faces > 0)
    reject(name_, place, counted(faces, "face") + " in a file of points", kPointsAlone);
  if (vertices_.empty())
    reject(name_, place, "the file ends without a point", "at least one point");
  if (vertices_.size() >= UINT32_MAX)
    reject(name_, place, "too many points", "fewer than 2^32 - 1");
  check_room(vertices_.size(), vertices_.size());
  const ThreadPool pool = pool_of({.name = name_, .bytes = {}, .limits = limits_});
  return {make_points(name_, std::move(vertices_), pool), std::move(notes)};
}

ReadMesh FileMeshBuilder::finish(const std::string& place, Positions positions) && {
  if (limits_.points) return std::move(*this).finish_points(place);
  if (faces_.empty()) refuse_no_face(place);
  if (faces_.size() + short_faces_ >= UINT32_MAX)
    reject(name_, place, "too many faces", "fewer than 2^32 - 1");
  const ThreadPool pool = pool_of({.name = name_, .bytes = {}, .limits = limits_});
  Triangulated found = triangulate(pool);
  refuse_odd(found);
  Polygons polygons = std::move(found.polygons);
  Mesh mesh = make_mesh(name_, std::move(vertices_), std::move(faces_), pool, positions);
  mesh.file_faces = std::move(file_faces_);
  mesh.counts.polygons = polygons_;
  polygons.any_triangulation = limits_.any_triangulation;
  if (polygons_ > 0) note_polygons(polygons);
  mesh.polygons = std::move(polygons);
  if (limits_.any_triangulation) mesh.delta = mesh.polygons.ambiguity;
  if (short_faces_ > 0) {
    notes.push_back(note_of(NoteCode::kShortFaces,
                            counted(short_faces_, "face") + " of fewer than three corners ignored",
                            {static_cast<double>(short_faces_), "faces"}));
  }
  return {std::move(mesh), std::move(notes)};
}

}  // namespace vkh
