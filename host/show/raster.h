// Draws faces to pixels, on the device.
#pragma once

#include <functional>
#include <vector>

#include "host/base/parallel.h"
#include "host/gpu/attachment.h"
#include "host/show/camera.h"
#include "host/show/palette.h"

namespace vkh::drawing {

/// One corner of a face, as mesh.vert reads it.
struct Corner {
  float x = 0, y = 0, z = 0;  ///< in Vulkan's clip space
  float share = 0;            ///< of the bar, with `by_share`
  uint8_t colour[4] = {};     ///< of which the shaders take three; by share the first is the light
  uint8_t hatched = 0, by_share = 0;
  uint8_t is_disc = 0;  ///< the circle inscribed in the face is drawn
  uint8_t pad = 0;

  /// The same corner at a place in clip space.
  Corner placed_at(const glm::dvec3& clip) const {
    Corner corner = *this;
    corner.x = static_cast<float>(clip.x);
    corner.y = static_cast<float>(clip.y);
    corner.z = static_cast<float>(clip.z);
    return corner;
  }
};

/// Writes the corners of `face_count` faces; one that is not to be seen has three times the same.
using FillFaces = std::function<void(size_t first_face, size_t face_count, Corner* corners)>;

/// Calls writer(face, its three corners) for each face, on several threads.
template <class Writer>
FillFaces filled_by(Writer writer) {
  return [writer](size_t first, size_t count, Corner* corners) {
    constexpr size_t kPiece = 4096;
    for_each_range_of(kPiece, count, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) writer(first + i, corners + 3 * i);
    });
  };
}

/// A part of a picture; opacity is the share of a pixel that faces cover, white is the rest.
struct Layer {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

/// Owns the passes, layout and pipeline of mesh.vert and mesh.frag, and no memory to draw into.
class RasterPipeline {
 public:
  explicit RasterPipeline(const Device& device);
  ~RasterPipeline();
  RasterPipeline(const RasterPipeline&) = delete;
  RasterPipeline& operator=(const RasterPipeline&) = delete;

  VkRenderPass clearing() const { return clearing_; }
  VkRenderPass keeping() const { return keeping_; }  ///< keeps what earlier passes drew
  VkPipelineLayout layout() const { return layout_; }
  VkPipeline pipeline() const { return pipeline_; }

 private:
  struct Empty {};
  RasterPipeline(const Device& device, Empty) : device_(device) {}
  VkRenderPass make_pass(bool clears);
  void make_layout();
  void make_pipeline();

  const Device& device_;
  VkRenderPass clearing_ = VK_NULL_HANDLE, keeping_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// Draws layers, each of up to width x height pixels, with several samples a side of a pixel.
class Raster {
 public:
  /// Throws DeviceError if the device's queue does not draw.
  Raster(const Device& device, uint32_t width, uint32_t height);
  ~Raster();
  Raster(const Raster&) = delete;
  Raster& operator=(const Raster&) = delete;

  /// `line`: the width of lines, in pixels; hatches go with it.
  Layer draw(VkExtent2D pixels, double line, size_t face_count, const FillFaces& fill);

  /// The colours of shares, from now on.
  void set_palette(const Palette& palette) { palette_ = palette; }

 private:
  struct Empty {};
  Raster(const Device& device, Empty, uint32_t width, uint32_t height);
  void make_framebuffer();
  void draw_some(VkExtent2D samples, double line, size_t face_count, bool first);
  void read_back(VkExtent2D samples);
  Layer averaged(VkExtent2D pixels) const;

  const Device& device_;
  uint32_t samples_;  ///< per side of a pixel
  VkExtent2D extent_;
  Attachment colour_, depth_;
  Submitter submitter_;
  Buffer corners_, read_;
  RasterPipeline pipeline_;
  Palette palette_;
  VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
};

}  // namespace vkh::drawing
