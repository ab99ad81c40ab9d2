// The builder with which a reader makes its mesh, within the source's limits.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/mesh/make_mesh.h"
#include "host/read/source.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh {

/// Ends an error about a file without faces: what was expected, and the option for points.
inline constexpr const char* kAMesh =
    "a mesh of triangles (STL, OBJ, PLY); in distance, gate and batch, --points a measures points, "
    "b those of the second file, both those of both";
/// Ends an error about faces in a file of points.
inline constexpr const char* kPointsAlone =
    "points alone; a mesh is measured without --points, which never drops its faces";

/// Returns "1 face", "2 faces": for notes and errors.
std::string counted(uint64_t count, const std::string& noun);

/// Collects a file's vertices and faces, within the source's limits.
class FileMeshBuilder {
 public:
  explicit FileMeshBuilder(const MeshSource& source) : name_(source.name), limits_(source.limits) {}

  /// Joins the blocks of a file, in order. Throws InputError if together they break the limits.
  static FileMeshBuilder joined(const MeshSource& source, std::vector<FileMeshBuilder>&& blocks);
  /// Takes a mesh that was read without a builder.
  FileMeshBuilder(const MeshSource& source, std::vector<glm::dvec3> vertices,
                  std::vector<glm::uvec3> faces);

  const std::string& name() const { return name_; }
  const std::vector<glm::dvec3>& vertices() const { return vertices_; }
  size_t face_count() const { return faces_.size(); }
  /// A corner by its number, three a face.
  uint32_t& corner(size_t number) { return faces_[number / 3][static_cast<int>(number % 3)]; }

  std::vector<Note> notes;

  /// Checks what a header announces against the limits before anything is allocated.
  void check_room(uint64_t vertex_count, uint64_t face_count) const;
  void reserve(uint64_t vertex_count, uint64_t face_count);
  void add_vertex(const glm::dvec3& position) {
    make_room(1, 0);
    vertices_.push_back(position);
  }
  /// Drops the vertex that was added last.
  void drop_vertex() { vertices_.pop_back(); }
  void add_triangle(const glm::uvec3& face) {
    make_room(0, 1);
    faces_.push_back(face);
  }
  /// Fans a polygon from its first corner, until finish() triangulates it; one of fewer than three
  /// corners is ignored and noted.
  void add_face(std::span<const uint32_t> corners);
  /// Counts faces that were added by other means, from the triangle `first` on.
  void count_faces(uint64_t polygons, uint64_t short_faces, const FileFaces& faces, size_t first) {
    polygons_ += polygons;
    short_faces_ += short_faces;
    file_faces_.append(faces, first);
  }
  /// `place` is where the file ended, for the error if no face was there.
  ReadMesh finish(const std::string& place, Positions positions = Positions::kAny) &&;

 private:
  /// Makes room for this many more vertices and faces.
  void make_room(size_t vertex_count, size_t face_count) {
    constexpr uint64_t kRowsOfTick = 1 << 14;  // about 1 ms
    if (mesh_bytes(vertices_.size() + vertex_count, faces_.size() + face_count) >
        limits_.max_input_bytes) {
      refuse_size(vertices_.size() + vertex_count, faces_.size() + face_count);
    }
    if (++rows_ % kRowsOfTick == 0) check_going(name_, limits_);
  }
  class SliverWidth;
  /// The triangulated polygons, and the number of the ones that have only a fan and are no slivers.
  struct Triangulated {
    Polygons polygons;
    uint64_t odd = 0, first_odd = 0;
    PolygonKind odd_kind = PolygonKind::kFan;

    void append(Triangulated&& part);
  };
  Triangulated triangulate(const ThreadPool& pool);
  Triangulated triangulate(const FileFaces::Run& begin, const FileFaces::Run& end,
                           const SliverWidth& sliver);
  bool is_measurable(std::span<const glm::uvec3> faces) const;
  void note_polygons(const Polygons& polygons);
  void refuse_odd(const Triangulated& found) const;
  ReadMesh finish_points(const std::string& place) &&;
  [[noreturn]] void refuse_no_face(const std::string& place) const;
  [[noreturn]] void refuse_size(uint64_t vertex_count, uint64_t face_count) const;

  std::string name_;
  const ReadLimits& limits_;
  std::vector<glm::dvec3> vertices_;
  std::vector<glm::uvec3> faces_;
  FileFaces file_faces_;
  uint64_t rows_ = 0;
  uint64_t polygons_ = 0;
  uint64_t short_faces_ = 0;
};

}  // namespace vkh
