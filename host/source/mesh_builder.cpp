#include "host/source/mesh_builder.h"

#include <algorithm>

#include "host/base/text_scanner.h"

namespace vkh {
namespace {

constexpr const char* kLessInput = "a smaller file, or a greater limit (--max-input)";

}  // namespace

std::string counted(uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void MeshBuilder::check_room(uint64_t vertex_count, uint64_t face_count) const {
  if (mesh_bytes(vertex_count, face_count) > limits_.max_input_bytes)
    refuse_size(vertex_count, face_count);
}

void MeshBuilder::reserve(uint64_t vertex_count, uint64_t face_count) {
  check_room(vertex_count, face_count);
  vertices_.reserve(vertex_count);
  faces_.reserve(face_count);
}

void MeshBuilder::refuse_size(uint64_t vertex_count, uint64_t face_count) const {
  const std::string place = face_count > 0 ? "face " + std::to_string(face_count - 1)
                                           : "vertex " + std::to_string(vertex_count - 1);
  reject(name_, place,
         "a mesh of " + std::to_string(vertex_count) + " vertices and " +
             counted(face_count, "face") + " takes " +
             counted(mesh_bytes(vertex_count, face_count), "byte") + ", beyond the limit of " +
             counted(limits_.max_input_bytes, "byte"),
         kLessInput);
}

void MeshBuilder::add_face(std::span<const uint32_t> corners) {
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
  // A large polygon by what it takes, not by twice what there was.
  if (faces_.capacity() - faces_.size() < count && count > faces_.size())
    faces_.reserve(faces_.size() + count);
  for (size_t i = 2; i < corners.size(); ++i) {
    faces_.emplace_back(corners[0], corners[i - 1], corners[i]);
  }
}

MeshBuilder::MeshBuilder(const MeshSource& source, std::vector<glm::dvec3> vertices,
                         std::vector<glm::uvec3> faces)
    : name_(source.name),
      limits_(source.limits),
      vertices_(std::move(vertices)),
      faces_(std::move(faces)) {
  make_room(0, 0);
}

MeshBuilder MeshBuilder::joined(const MeshSource& source, std::vector<MeshBuilder>&& blocks) {
  std::vector<size_t> vertices, faces;
  for (const MeshBuilder& block : blocks) {
    vertices.push_back(block.vertices_.size());
    faces.push_back(block.faces_.size());
  }
  MeshBuilder all(source);
  const Crew crew = crew_of(source);
  const size_t vertex_count = starts_of(vertices), face_count = starts_of(faces);
  all.make_room(vertex_count, face_count);
  resize_together(crew, all.vertices_, vertex_count);
  resize_together(crew, all.faces_, face_count);
  crew.for_each(blocks.size(), [&](size_t i) {
    const auto to = [i](auto& whole, const std::vector<size_t>& starts) {
      return whole.begin() + static_cast<std::ptrdiff_t>(starts[i]);
    };
    std::copy(blocks[i].vertices_.begin(), blocks[i].vertices_.end(), to(all.vertices_, vertices));
    std::copy(blocks[i].faces_.begin(), blocks[i].faces_.end(), to(all.faces_, faces));
    blocks[i].vertices_ = {};
    blocks[i].faces_ = {};
  });
  for (size_t i = 0; i < blocks.size(); ++i) {
    const MeshBuilder& block = blocks[i];
    all.count_faces(block.polygons_, block.short_faces_, block.file_faces_, faces[i]);
  }
  return all;
}

Mesh MeshBuilder::finish(const std::string& place, Positions positions) && {
  if (faces_.empty()) {
    reject(name_, place,
           short_faces_ == 0 ? "the file ends without a face"
                             : "the file ends without a face of three corners",
           "at least one face: a distance between no surfaces is undefined");
  }
  if (faces_.size() + short_faces_ >= UINT32_MAX)
    reject(name_, place, "too many faces", "fewer than 2^32 - 1");
  Mesh mesh = make_mesh(name_, std::move(vertices_), std::move(faces_),
                        crew_of({.name = name_, .bytes = {}, .limits = limits_}), positions);
  mesh.file_faces = std::move(file_faces_);
  mesh.counts.polygons = polygons_;
  mesh.notes = std::move(notes);
  if (polygons_ > 0) {
    mesh.notes.push_back(counted(polygons_, "polygon") +
                         " fanned into triangles from the first corner; the fan of a concave "
                         "polygon leaves its outline");
  }
  if (short_faces_ > 0) {
    mesh.notes.push_back(counted(short_faces_, "face") + " of fewer than three corners ignored");
  }
  return mesh;
}

}  // namespace vkh
