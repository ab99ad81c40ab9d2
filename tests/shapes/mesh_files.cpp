#include "tests/shapes/mesh_files.h"

#include <algorithm>
#include <cstdint>

#include "host/base/thread_pool.h"

namespace vkh::test {
namespace {

template <class T>
void store(std::string& bytes, T value, bool big) {
  std::string stored(reinterpret_cast<const char*>(&value), sizeof(value));
  if (big) std::reverse(stored.begin(), stored.end());
  bytes += stored;
}

/// A file of triangles, of quads, or of both and more, with other columns before, between and
/// behind.
File binary_ply(size_t n, bool big, size_t least, size_t kinds) {
  std::string vertices, faces;
  for (size_t v = 0; v < n; ++v) {
    store<uint8_t>(vertices, 7, big);
    store<double>(vertices, static_cast<double>(v % 10), big);
    store<float>(vertices, 0.1f * static_cast<float>(v), big);
    store<int16_t>(vertices, static_cast<int16_t>(v * v % 29), big);
  }
  for (size_t f = 0; f < n; ++f) {
    const size_t corners = least + f % kinds;
    store<uint8_t>(faces, static_cast<uint8_t>(f % 2), big);
    for (size_t k = 0; k < f % 2; ++k) store<float>(faces, 1, big);
    store<uint16_t>(faces, static_cast<uint16_t>(corners), big);
    for (size_t k = 0; k < corners; ++k)
      store<uint32_t>(faces, static_cast<uint32_t>((f + k * k) % n), big);
    store<uint8_t>(faces, 255, big);
  }
  const std::string count = std::to_string(n);
  std::string odd;
  for (size_t i = 0; i < 3; ++i) {
    store<uint8_t>(odd, static_cast<uint8_t>(i), big);
    odd.append(i, 'x');
  }
  return {"binary.ply",
          std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" +
              "element vertex " + count +
              "\nproperty uchar a\nproperty double x\nproperty float y\nproperty short z\n" +
              "element odd 3\nproperty list uchar char b\nelement face " + count +
              "\nproperty list uchar float t\nproperty list ushort uint vertex_index\n" +
              "property uchar flags\nend_header\n" + vertices + odd + faces};
}

File binary_stl(size_t triangles) {
  std::string bytes(80, ' ');
  store<uint32_t>(bytes, static_cast<uint32_t>(triangles), false);
  for (size_t t = 0; t < triangles; ++t) {
    for (size_t i = 0; i < 12; ++i) {
      const auto value = static_cast<float>((t * 7 + i * i) % 23) - 11;
      store<float>(bytes, value == 0 && t % 2 == 1 ? -0.0f : value, false);
    }
    store<uint16_t>(bytes, 0, false);
  }
  return {"binary.stl", bytes};
}

/// Rows of bytes that are 3, one of them shorter, and another byte behind: wherever a row is
/// thought to begin, it looks like a triangle.
File even_odd_ply() {
  const size_t n = 1000;
  std::string rows;
  for (size_t f = 0; f < n; ++f) {
    const size_t corners = f == 5 ? 2 : 3;
    rows += static_cast<char>(corners) + std::string(corners, '\3');
  }
  return {"even_odd.ply",
          "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty uchar x\n"
          "property uchar y\nproperty uchar z\nelement face " +
              std::to_string(n) +
              "\nproperty list uchar uchar vertex_indices\nend_header\n0123456789ab" + rows + "\3"};
}

}  // namespace

std::vector<File> good_files(size_t n) {
  const auto number = [n](size_t x, size_t y) { return y * (n + 1) + x; };
  std::string points, rows, obj, relative, stl = "solid grid\n", body;
  size_t vertices = (n + 1) * (n + 1);
  const auto point = [n](size_t v) {
    return std::to_string(v % (n + 1)) + " " + std::to_string(v / (n + 1)) + " " +
           std::to_string(static_cast<double>(v * v % 17) / 7);
  };
  for (size_t v = 0; v < vertices; ++v) {
    points += point(v) + "\n";
    obj += "v " + point(v) + "\n";
  }
  relative = obj;
  size_t faces = 0;
  for (size_t c = 0; c < n * n; ++c, ++faces) {
    const size_t x = c % n, y = c / n;
    std::vector<size_t> corners = {number(x, y), number(x + 1, y), number(x + 1, y + 1),
                                   number(x, y + 1)};
    corners.resize(c % 3 == 0 ? 4 : 3);
    rows += std::to_string(corners.size());
    for (const size_t v : corners) rows += " " + std::to_string(v);
    rows += "\n";
    obj += c % 5 == 0 ? "usemtl a\\b\nf" : "f";
    relative += "f";
    for (const size_t v : corners) {
      obj += " " + std::to_string(v + 1) + (c % 2 == 0 ? "" : "//1");
      relative += c % 7 == 0 ? " \\\n " : " ";
      relative += std::to_string(static_cast<int64_t>(v) - static_cast<int64_t>(vertices));
    }
    obj += "\n";
    relative += "\n";
    if (c % 11 == 0) {
      relative += "v 5 5 5\n";
      ++vertices;
    }
    stl += "facet normal 0 0 1\n outer loop\n";
    for (size_t i = 0; i < 3; ++i) stl += "  vertex " + point(corners[i]) + "\n";
    stl += " endloop\nendfacet\n";
    if (c % 20 == 19) stl += "endsolid grid\nsolid another\n";
  }
  vertices = (n + 1) * (n + 1);
  const std::string counts = std::to_string(vertices) + " " + std::to_string(faces);
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
  return {{"grid.obj", obj},
          {"relative.obj", relative},
          {"grid.off", "OFF # a grid\n" + counts + " 0\n" + points + rows},
          {"grid.ply", header + points + rows},
          {"grid.stl", stl + "endsolid\n"}};
}

File mirrored_stl(size_t triangles) {
  std::string bytes(80, ' ');
  store<uint32_t>(bytes, static_cast<uint32_t>(triangles), false);
  for (size_t t = 0; t < triangles; ++t) {
    bytes.append(12, '\0');
    for (size_t c = 3 * t; c < 3 * t + 3; ++c) {
      const size_t part = c / ThreadPool::kPart, i = c % ThreadPool::kPart;
      store<float>(bytes, static_cast<float>(part % 2 == 0 ? i : ThreadPool::kPart - 1 - i), false);
      store<float>(bytes, static_cast<float>(part / 2), false);
      store<float>(bytes, 1, false);
    }
    bytes.append(2, '\0');
  }
  return {"mirrored.stl", bytes};
}

std::vector<File> all_good_files() {
  std::vector<File> files = good_files(40);
  for (const bool big : {false, true}) {
    files.push_back(binary_ply(1000, big, 3, 1));
    files.push_back(binary_ply(1000, big, 4, 1));
    files.push_back(binary_ply(1000, big, 1, 6));
  }
  files.push_back(even_odd_ply());
  files.push_back(binary_stl(900));
  files.push_back(binary_stl(900));
  files.back().bytes += "made by a program";
  return files;
}

}  // namespace vkh::test
