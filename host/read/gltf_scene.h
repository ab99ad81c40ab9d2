// A glTF document's scene: its nodes, each with its place in the world.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "host/read/gltf_model.h"
#include "host/read/transform.h"

namespace vkh::gltf {

/// A mesh at a node, and the map from its coordinates into the scene's.
struct Instance {
  uint32_t node = 0;
  const NodeDetail* detail = nullptr;
  scene::Affine map;
};

/// The scene that is read: the default one, or the first.
class Scene {
 public:
  /// Rejects a document without a scene, and nodes that are no trees.
  Scene(const MeshSource& source, const Model& model);

  /// Calls use() for each node with a mesh that is not left out, a parent before its children, in
  /// the order of the file.
  void for_each(const std::function<void(const Instance&)>& use) const;
  /// The notes for people about it.
  const std::vector<Note>& notes() const { return notes_; }

 private:
  struct Level {
    Range nodes;
    uint32_t next = 0;
    scene::Affine map;
  };

  void choose();
  void check_trees();
  void check_rotations();
  void note_hidden();
  const NodeDetail* detail_of(uint32_t node) const;
  bool is_hidden(uint32_t node) const;
  bool is_all() const { return source_.limits.bodies == Bodies::kAll; }
  scene::Affine map_of(uint32_t node) const;
  /// Calls enter(node, level) for each, which returns whether to go on to its children.
  template <class Enter>
  void walk(const Enter& enter) const;
  [[noreturn]] void fail(uint32_t node, const std::string& what, const std::string& expected) const;

  const MeshSource& source_;
  const Model& model_;
  Range roots_;
  std::vector<Note> notes_;
};

}  // namespace vkh::gltf
