// Scenes that take the most for their size: about `size` bytes each, all of one kind.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/files/gltf_document.h"
#include "tests/files/stored_zip.h"

namespace vkh::test {

/// Names and bytes.
using SceneFiles = std::vector<std::pair<std::string, std::string>>;

inline std::string times(const std::string& text, size_t count) {
  std::string all;
  for (all.reserve(text.size() * count); count > 0; --count) all += text;
  return all;
}

/// A triangle, and before it a list of that name with `size` entries.
inline std::string with_list(const std::string& name, const std::string& entry, size_t size) {
  const std::string text = triangle_document().text();
  return "{\"" + name + "\":[" + times(entry + ",", size / (entry.size() + 1)) + entry + "]," +
         text.substr(1);
}

/// The same, but in the place of the list that is there, behind its entries.
inline std::string with_more(const std::string& name, const std::string& entry, size_t size) {
  std::string text = triangle_document().text();
  const size_t list = text.find("\"" + name + "\":[") + name.size() + 4;
  size_t end = list;
  int depth = 1;
  for (; depth > 0; ++end) depth += text[end] == '[' ? 1 : text[end] == ']' ? -1 : 0;
  return text.insert(end - 1, times("," + entry, size / (entry.size() + 1)));
}

inline std::string grid_document(size_t size, bool is_glb) {
  Document document;
  const size_t count = size / 24;
  std::vector<float> xyz;
  for (size_t i = 0; i < 3 * count; ++i) xyz.push_back(static_cast<float>(i % 1000));
  std::vector<uint32_t> corners;
  for (uint32_t i = 0; i < 3 * count; ++i) corners.push_back(i % static_cast<uint32_t>(count));
  const size_t positions = document.add_positions(xyz);
  document.add_mesh(positions, {{"indices", document.add_indices(corners)}});
  return is_glb ? document.glb() : document.text();
}

/// Bytes for coordinates, so that a vertex is eight times as large as its text.
inline std::string byte_document(size_t size) {
  Document document;
  std::string rows;
  for (size_t i = 0; i < size / 9 * 9; ++i) rows += static_cast<char>(i % 120);
  const size_t view = document.add_view(rows);
  document.add_mesh(document.add_accessor({{"bufferView", view},
                                           {"componentType", kByteType},
                                           {"count", rows.size() / 3},
                                           {"type", "VEC3"}}));
  return document.glb();
}

/// A mesh at every node.
inline std::string instance_document(size_t size) {
  Document document = triangle_document();
  for (size_t i = 1; i < size / 14; ++i) {
    document.json["nodes"].push_back({{"mesh", 0}});
    document.json["scenes"][0]["nodes"].push_back(i);
  }
  return document.text();
}

/// A mesh of many primitives without triangles, and many nodes that have it.
inline std::string line_document(size_t size) {
  Document document;
  Json& primitives =
      document.add_mesh(document.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0}))["primitives"];
  for (size_t i = 0; i < size / 80; ++i)
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", i % 4}});
  for (size_t i = 1; i < size / 28; ++i) {
    document.json["nodes"].push_back({{"mesh", 0}});
    document.json["scenes"][0]["nodes"].push_back(i);
  }
  return document.text();
}

inline SceneFiles worst_gltf(size_t size) {
  const std::string accessor = "{\"componentType\":5126,\"count\":1,\"type\":\"VEC3\"}";
  return {
      {"grid.gltf", grid_document(size, false)},
      {"grid.glb", grid_document(size, true)},
      {"bytes.glb", byte_document(size)},
      {"instances.gltf", instance_document(size)},
      {"lines.gltf", line_document(size)},
      {"nodes.gltf", with_more("nodes", "{}", size)},
      {"placed.gltf", with_more("nodes", "{\"scale\":[1,1,1]}", size)},
      {"meshed.gltf", with_more("nodes", "{\"mesh\":0}", size)},
      {"scenes.gltf", with_more("scenes", "{}", size)},
      {"roots.gltf", with_more("scenes", "{\"nodes\":[" + times("0,", size / 2) + "0]}", 40)},
      {"meshes.gltf", with_more("meshes", "{\"primitives\":[{\"attributes\":{}}]}", size)},
      {"accessors.gltf", with_more("accessors", accessor, size)},
      {"views.gltf", with_more("bufferViews", "{\"buffer\":0,\"byteLength\":1}", size)},
      {"buffers.gltf", with_more("buffers", "{\"byteLength\":1}", size)},
      {"data.gltf", with_more("buffers", "{\"byteLength\":1,\"uri\":\"data:;base64,AA\"}", size)},
      {"numbers.gltf", with_list("extras", "0", size)},
      {"deep.gltf", "{\"extras\":" + std::string(size / 2, '[') + std::string(size / 2, ']') + "," +
                        triangle_document().text().substr(1)},
      {"text.gltf", with_list("extras", "\"" + std::string(1500, 'x') + "\"", size)},
      {"long.gltf", with_list("extras", "\"" + std::string(size, 'x') + "\"", 1)},
      {"digits.gltf", with_list("extras", std::string(size, '1'), 1)},
      {"blank.gltf", std::string(size, ' ') + triangle_document().text()}};
}

/// The parts are stored, so that the file is as large as its contents.
inline SceneFiles worst_3mf(size_t size) {
  const auto package = [](const std::string& resources, const std::string& build) {
    return package_of(
        model_of(object_of("1", kTriangleMesh) + resources, "<item objectid=\"1\"/>" + build));
  };
  const auto rows = [&](const std::string& row) { return times(row, size / row.size()); };
  const std::string vertex = "<vertex x=\"0\" y=\"1\" z=\"2\"/>",
                    triangle = "<triangle v1=\"0\" v2=\"0\" v3=\"0\"/>",
                    component = "<component objectid=\"1\"/>";
  std::string objects;
  for (size_t i = 2; objects.size() < size; ++i)
    objects += object_of(std::to_string(i), "<components>" + component + "</components>");
  const std::string support = object_of("2", kTriangleMesh, "type=\"support\"");
  std::string others, volumes;
  for (size_t i = 3; others.size() < size; ++i)
    others += object_of(std::to_string(i), "<components><component objectid=\"2\"/></components>");
  for (size_t i = 0; volumes.size() < size; ++i) {
    const std::string face = "=\"" + std::to_string(i) + "\"";
    volumes += "<volume firstid" + face + " lastid" + face + "/>";
  }
  return {
      {"others.3mf", package(support + others, "")},
      {"supports.3mf",
       package(object_of("2", mesh_of(vertex, times(triangle, size / 70)), "type=\"support\""),
               times("<item objectid=\"2\"/>", size / 42))},
      {"volumes.3mf", package_of(model_of(object_of("1", kTriangleMesh), "<item objectid=\"1\"/>"),
                                 {{"Metadata/Slic3r_PE_model.config",
                                   "<config><object id=\"1\">" + volumes + "</object></config>"}})},
      {"vertices.3mf", package(object_of("2", mesh_of(rows(vertex), "")), "")},
      {"triangles.3mf",
       package(object_of("2", mesh_of(vertex, rows(triangle))), "<item objectid=\"2\"/>")},
      {"components.3mf", package(object_of("2", "<components>" + rows(component) + "</components>"),
                                 "<item objectid=\"2\"/>")},
      {"unused_components.3mf",
       package(object_of("2", "<components>" + rows(component) + "</components>"), "")},
      {"empty_components.3mf",
       package(object_of("2", "<mesh/>") +
                   object_of("3", "<components>" + component +
                                      times("<component objectid=\"2\"/>", size / 52) +
                                      "</components>"),
               times("<item objectid=\"3\"/>", size / 42))},
      {"items.3mf", package("", rows("<item objectid=\"1\"/>"))},
      {"objects.3mf", package(objects, "")},
      {"blank.3mf", package(std::string(size, ' '), "")},
      {"foreign.3mf", package(rows("<a/>"), "")},
      {"deep.3mf", package(times("<a>", size / 7) + times("</a>", size / 7), "")}};
}

}  // namespace vkh::test
