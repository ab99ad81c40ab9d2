#include "examples/renderer/chain.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "examples/renderer/view.h"

namespace example {
namespace {
#include "examples/mesh_frag.h"
#include "examples/mesh_vert.h"

constexpr float kRadius = 1;  // of the scene

// The same values as in frame.glsl, of which a plain view reads the level alone.
struct LevelChoice {
  VkDrawIndirectCommand draw;
  uint32_t level;
};

/// Reads positions and triangles: simplify writes no other faces.
ChainLevel read_obj(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  ChainLevel level;
  for (std::string line, word; std::getline(in, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      glm::vec3& p = level.points.emplace_back();
      words >> p.x >> p.y >> p.z;
    } else if (word == "f") {
      for (int i = 0; i < 3 && words >> word; ++i)
        level.corners.push_back(static_cast<uint32_t>(std::stoul(word)) - 1);
    }
    if (words.bad() || (word != "f" && words.fail() && !line.empty() && line[0] == 'v'))
      throw std::runtime_error(path.string() + ": expected numbers: " + line);
  }
  return level;
}

/// Moves all levels into the sphere by the box of the first.
void fit(std::vector<ChainLevel>& chain) {
  glm::vec3 lo = chain[0].points[0], hi = lo;
  for (const glm::vec3& p : chain[0].points) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  const glm::vec3 middle = 0.5f * (lo + hi), half = 0.5f * (hi - lo);
  const float scale = kRadius / std::max(std::sqrt(glm::dot(half, half)), 1e-30f);
  for (ChainLevel& level : chain) {
    for (glm::vec3& p : level.points) p = scale * (p - middle);
    level.error *= scale;
  }
}

/// Normals of vertices: the sum of those of their faces, by area.
std::vector<SceneVertex> vertices_of(const ChainLevel& level) {
  std::vector<glm::vec3> normals(level.points.size(), glm::vec3(0));
  for (size_t i = 0; i + 2 < level.corners.size(); i += 3) {
    const uint32_t* c = &level.corners[i];
    const glm::vec3 a = level.points[c[0]];
    const glm::vec3 normal = glm::cross(level.points[c[1]] - a, level.points[c[2]] - a);
    for (int k = 0; k < 3; ++k) normals[c[k]] += normal;
  }
  std::vector<SceneVertex> vertices;
  for (size_t v = 0; v < normals.size(); ++v) {
    const glm::vec3 &p = level.points[v], &n = normals[v];
    vertices.push_back({{p.x, p.y, p.z}, {n.x, n.y, n.z}, {}});
  }
  return vertices;
}

template <class T>
Buffer filled(Gpu& gpu, const std::vector<T>& content) {
  const Buffer made = gpu.buffer(content.size() * sizeof(T), Memory::kHost);
  std::memcpy(made.mapped, content.data(), made.size);
  return made;
}

}  // namespace

std::vector<ChainLevel> read_chain(const std::string& file) {
  std::ifstream in(file);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (json.is_discarded() || json.value("files", nlohmann::json()).empty())
    throw std::runtime_error(file + ": expected what simplify --levels --json=FILE writes");
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  std::vector<ChainLevel> chain = {read_obj(folder / json.at("input").at("path"))};
  for (const auto& level : json.at("files")) {
    chain.push_back(read_obj(folder / level.at("path")));
    chain.back().error = level.at("upper");
  }
  for (const ChainLevel& level : chain) {
    for (const uint32_t corner : level.corners)
      if (corner >= level.points.size()) throw std::runtime_error(file + ": a face is wrong");
    if (level.corners.empty()) throw std::runtime_error(file + ": a level has no faces");
  }
  fit(chain);
  return chain;
}

uint32_t coarsest_under(std::span<const ChainLevel> chain, float pixel) {
  uint32_t coarsest = 0;
  for (uint32_t k = 1; k < chain.size(); ++k)
    if (chain[k].error < pixel) coarsest = k;
  return coarsest;
}

ChainRenderer::ChainRenderer(const RendererOptions& options, std::vector<ChainLevel> chain)
    : gpu_({.validation = options.validation, .graphics = true}),
      target_(gpu_, options.width, options.height),
      chain_(std::move(chain)),
      choice_(gpu_.buffer(sizeof(LevelChoice), Memory::kHost)),
      mesh_(target_.pipeline(gpu_.shader(k_mesh_vert), gpu_.shader(k_mesh_frag), true)) {
  upload();
}

void ChainRenderer::upload() {
  std::vector<SceneVertex> vertices;
  std::vector<uint32_t> corners;
  std::vector<Level> levels;
  for (const ChainLevel& level : chain_) {
    levels.push_back(
        {static_cast<uint32_t>(vertices.size()), static_cast<uint32_t>(corners.size()), 0, 0});
    const std::vector<SceneVertex> own = vertices_of(level);
    vertices.insert(vertices.end(), own.begin(), own.end());
    corners.insert(corners.end(), level.corners.begin(), level.corners.end());
  }
  vertices_ = filled(gpu_, vertices);
  indices_ = filled(gpu_, corners);
  levels_ = filled(gpu_, levels);
}

ChainFrame ChainRenderer::frame(float angle, float camera) {
  const VkExtent2D size = target_.extent();
  const float pixel = pixel_at(camera - kRadius, size.height);
  const uint32_t drawn = coarsest_under(chain_, pixel);
  const auto corners = static_cast<uint32_t>(chain_[drawn].corners.size());
  const LevelChoice choice{.draw = {}, .level = drawn};
  std::memcpy(choice_.mapped, &choice, sizeof(choice));
  gpu_.run([&](VkCommandBuffer commands) {
    target_.begin(commands);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, mesh_);
    target_.view(commands, {{0, 0}, size});
    gpu_.bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
              {vertices_.handle, levels_.handle, choice_.handle, indices_.handle, choice_.handle,
               choice_.handle},  // no bounds, which a plain view does not read
              bytes_of(look(size, camera, kRadius, angle, kEdges)));
    vkCmdDraw(commands, corners, 1, 0, 0);
    target_.end(commands);
  });
  return {.rgba = reinterpret_cast<const uint8_t*>(target_.pixels().mapped),
          .drawn = drawn,
          .faces = corners / 3,
          .error = chain_[drawn].error,
          .pixel = pixel};
}

}  // namespace example
