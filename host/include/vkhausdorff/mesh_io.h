// Reads mesh files: OBJ, STL, PLY, OFF, glTF, 3MF; and files of points: PLY, OBJ, OFF, LAS, XYZ,
// PTS. The content decides the format first, the extension where content cannot.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vkhausdorff/mesh.h"
#include "vkhausdorff/note.h"
#include "vkhausdorff/read_limits.h"

namespace vkh {

/// A mesh as it was read, and notes on its file, such as polygons: 3 faces of more than three
/// corners were triangulated. It may be passed wherever a Mesh may.
struct ReadMesh : Mesh {
  ReadMesh() = default;
  ReadMesh(Mesh mesh, std::vector<Note> noted = {})
      : Mesh(std::move(mesh)), notes(std::move(noted)) {}

  std::vector<Note> notes;
};

/// Reads a mesh file. Throws InputError with one line: file, line or byte or element, what is
/// wrong, what was expected. Never allocates by a header's word alone: counts are checked against
/// the file's size first.
ReadMesh read_mesh(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Whether the path has the extension of a format that read_mesh reads, in letters of any size.
bool has_mesh_extension(const std::filesystem::path& path);

/// Whether it has that of a format that read_mesh reads with ReadLimits::points.
bool has_points_extension(const std::filesystem::path& path);

/// A file that holds numbers of a mesh file, such as a glTF document's buffer.
struct FileBeneath {
  std::string name;            ///< from the mesh file's folder, as it is opened
  std::filesystem::path path;  ///< empty: there is none that read_mesh would open
};

/// The files that read_mesh reads besides `path` itself, each once, in the order of their names.
/// They are found in the mesh file's own bytes: none is opened. Returns none if the mesh file
/// cannot be read or is refused. Throws Interrupted if limits.keep_going
/// returns false.
std::vector<FileBeneath> files_beneath(const std::filesystem::path& path,
                                       const ReadLimits& limits = {});

/// Reads the scalar property of that name for each face of a PLY file, as the file numbers them.
/// Throws InputError as read_mesh does, also if there is no such property.
std::vector<double> read_face_property(const std::filesystem::path& path, std::string_view name);

}  // namespace vkh
