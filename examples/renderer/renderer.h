// A headless renderer on a device of its own: a mesh deforms on the device, the engine certifies
// how far it is from each level of detail, as a whole and face by face, and shaders colour the
// faces by that and draw the coarsest level that is off by less than a pixel on every face. The
// host only records.
#pragma once

#include <array>
#include <string>

#include "examples/renderer/target.h"
#include "examples/scene.h"

namespace example {

constexpr uint32_t kLevels = 4;  // the finest is level 0
constexpr uint32_t kRows = 4;    // of the caption
constexpr uint32_t kColumns = 52;

struct RendererOptions {
  uint32_t width = 960, height = 640;
  uint32_t cells_u = 192, cells_v = 96;  // multiples of 8
  uint32_t waves = 4;                    // a frame's budget for each level
  bool validation = false;
};

struct RenderedFrame {
  const uint8_t* rgba;                         ///< until the next frame
  std::array<VkhReport, kLevels - 1> reports;  ///< of levels 1, 2, 3 against level 0
  uint32_t drawn;                              ///< the level that the device chose
  float pixel;                                 ///< the size of a pixel at the nearest part
  std::array<std::string, kRows> caption;      ///< as the device wrote it
};

class Renderer {
 public:
  explicit Renderer(const RendererOptions& options);

  /// Call with 0, 1, 2, ..; `camera` is its distance, at least 2.2.
  RenderedFrame frame(uint32_t number, float time, float camera);
  /// A level's positions as the engine saw them in the last frame.
  std::vector<SceneVertex> vertices(uint32_t level);
  /// How far each face of the mesh is from a level, 1 or more, as the last frame's shaders saw it:
  /// some point of each is at least so far, then for each what none exceeds.
  std::vector<float> errors(uint32_t level);
  const Scene& scene() const { return scene_; }
  Gpu& gpu() { return gpu_; }
  /// The place of the caption in the picture, and the pixels of one of its dots.
  VkRect2D caption_part() const;
  uint32_t text_scale() const;

 private:
  void certify(VkCommandBuffer commands, uint32_t number, float pixel);
  void choose(VkCommandBuffer commands, uint32_t number, float angle, float camera);
  void draw(VkCommandBuffer commands, float angle, float camera);
  void draw_mesh(VkCommandBuffer commands, VkRect2D part, float camera, float angle, uint32_t mode);
  void draw_caption(VkCommandBuffer commands);
  void read_back(VkCommandBuffer commands);
  VkRect2D large_part() const;
  float pixel(float distance) const;     // the size of one, in the camera's view
  VkDeviceSize bytes_of_errors() const;  // of a level
  template <class T>
  std::vector<T> read(const Buffer& from, VkDeviceSize offset, size_t count);

  RendererOptions options_;
  Gpu gpu_;
  Scene scene_;
  std::array<Pair, kLevels - 1> pairs_;
  Target target_;
  Buffer reports_, errors_, levels_, choice_, font_, readback_;
  VkhSurvey survey_;
  VkPipeline choose_, measure_, mesh_, caption_;
};

}  // namespace example
