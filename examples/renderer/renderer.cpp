#include "examples/renderer/renderer.h"

#include <cstring>

#include "examples/renderer/font.h"
#include "examples/renderer/view.h"

namespace example {
namespace {
#include "examples/caption_frag.h"
#include "examples/caption_vert.h"
#include "examples/choose_comp.h"
#include "examples/mesh_frag.h"
#include "examples/mesh_vert.h"
#include "examples/pixels_comp.h"

constexpr VkDeviceSize kReportStride = (sizeof(VkhReport) + 255) / 256 * 256;
constexpr uint32_t kReportWords = kReportStride / 4;
constexpr float kExtent = 1.75f;  // no part of the mesh is farther from the origin

// The same values as in frame.glsl.
struct Choice {
  VkDrawIndirectCommand draw;
  uint32_t level;
  float pixels[kLevels - 1];
  uint32_t text[kRows * kColumns];
};

struct ChoosePush {
  uint32_t report_words, frame;
  float camera, pixel;
};
struct PixelsPush {
  glm::vec3 to_eye;
  float camera, pixel;
};
struct CaptionPush {
  uint32_t x, y, scale;
};

template <class T>
Buffer filled(Gpu& gpu, const T& content) {
  const Buffer made = gpu.buffer(content.size() * sizeof(content[0]), Memory::kHost);
  std::memcpy(made.mapped, content.data(), made.size);
  return made;
}

/// Memory for a mesh's cells, for one level after the other, with room for a wave that splits all.
VkhSurvey survey_of(Gpu& gpu, uint32_t faces) {
  const uint32_t capacity = std::min(4 * faces, vkhGetSurveyCapacity(gpu.context()));
  const VkDeviceSize size = vkhGetSurveySize(gpu.context(), faces, capacity);
  return {.size = sizeof(VkhSurvey),
          .memory = {gpu.buffer(size, Memory::kDevice).handle, 0, size},
          .capacity = capacity,
          .faceWidth = 0,
          .faceLimit = 0};
}

}  // namespace

Renderer::Renderer(const RendererOptions& options)
    : options_(options),
      gpu_({.validation = options.validation, .graphics = true, .flags = VKH_CONTEXT_CELLS}),
      scene_(gpu_, options.cells_u, options.cells_v, kLevels),
      pairs_{{{gpu_, scene_, 0, 1}, {gpu_, scene_, 0, 2}, {gpu_, scene_, 0, 3}}},
      target_(gpu_, options.width, options.height),
      reports_(gpu_.buffer(kReportStride * (kLevels - 1), Memory::kDevice)),
      errors_(gpu_.buffer(bytes_of_errors() * (kLevels - 1), Memory::kDevice)),
      levels_(filled(gpu_, scene_.levels())),
      choice_(gpu_.buffer(sizeof(Choice), Memory::kDevice)),
      font_(filled(gpu_, font_columns())),
      readback_(gpu_.buffer(reports_.size + sizeof(Choice), Memory::kHost)),
      survey_(survey_of(gpu_, scene_.levels()[0].face_count())),
      choose_(gpu_.compute_pipeline(k_choose_comp)),
      measure_(gpu_.compute_pipeline(k_pixels_comp)),
      mesh_(target_.pipeline(gpu_.shader(k_mesh_vert), gpu_.shader(k_mesh_frag), true)),
      caption_(target_.pipeline(gpu_.shader(k_caption_vert), gpu_.shader(k_caption_frag), false)) {}

uint32_t Renderer::text_scale() const { return std::max(options_.width / (9 * kColumns), 1u); }

VkRect2D Renderer::caption_part() const {
  const uint32_t height = 10 * kRows * text_scale() + 4;
  return {{0, static_cast<int32_t>(options_.height - height)}, {options_.width, height}};
}

// The camera's view is left, two thirds wide. The close-ups stand beside it.
VkRect2D Renderer::large_part() const {
  const uint32_t height = options_.height - caption_part().extent.height;
  return {{0, 0}, {options_.width - height / 2, height}};
}

float Renderer::pixel(float distance) const {
  return pixel_at(distance, large_part().extent.height);
}

// A multiple of 256, as the engine needs it: faces are a multiple of 128.
VkDeviceSize Renderer::bytes_of_errors() const {
  return 2 * sizeof(float) * VkDeviceSize{scene_.levels()[0].face_count()};
}

RenderedFrame Renderer::frame(uint32_t number, float time, float camera) {
  const float nearest = pixel(camera - kExtent), angle = 0.6f + 0.1f * time;
  gpu_.run([&](VkCommandBuffer commands) {
    scene_.deform(commands, time);
    certify(commands, number, nearest);
    choose(commands, number, angle, camera);
    draw(commands, angle, camera);
    read_back(commands);
  });
  RenderedFrame result{};
  result.rgba = reinterpret_cast<const uint8_t*>(target_.pixels().mapped);
  result.pixel = nearest;
  for (uint32_t k = 0; k + 1 < kLevels; ++k)
    std::memcpy(&result.reports[k], readback_.mapped + k * kReportStride, sizeof(VkhReport));
  Choice choice;
  std::memcpy(&choice, readback_.mapped + reports_.size, sizeof(choice));
  result.drawn = choice.level;
  for (uint32_t i = 0; i < kRows * kColumns; ++i)
    result.caption[i / kColumns] += static_cast<char>(choice.text[i]);
  return result;
}

// The first frame builds and starts cold; later ones refit, and start from the frame before. An
// eighth of a pixel decides between levels well enough, and tells a face's colour. The survey
// splits faces that are not known to that once.
void Renderer::certify(VkCommandBuffer commands, uint32_t number, float pixel) {
  const auto hierarchy = number == 0 ? Pair::Hierarchy::kBuild : Pair::Hierarchy::kRefit;
  survey_.faceWidth = 0.125f * pixel;
  for (uint32_t k = 0; k + 1 < kLevels; ++k) {
    pairs_[k].certify(commands, hierarchy, number > 0, options_.waves, 0.125f * pixel);
    pairs_[k].write_report(commands, reports_, k * kReportStride);
    pairs_[k].write_face_errors(commands, survey_, 1, errors_, k * bytes_of_errors());
  }
}

void Renderer::choose(VkCommandBuffer commands, uint32_t number, float angle, float camera) {
  constexpr VkPipelineStageFlags compute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
  constexpr VkAccessFlags reads_writes = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
  vkCmdFillBuffer(commands, choice_.handle, offsetof(Choice, pixels), sizeof(Choice::pixels), 0);
  // This barrier is all that it takes from the engine's reports and errors of faces to our shaders.
  barrier(commands, compute | VK_PIPELINE_STAGE_TRANSFER_BIT,
          VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
          compute | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, reads_writes);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, measure_);
  gpu_.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
            {scene_.vertices().handle, levels_.handle, choice_.handle, scene_.index_buffer().handle,
             errors_.handle},
            bytes_of(PixelsPush{to_eye(angle), camera, pixel(1)}));
  vkCmdDispatch(commands, (scene_.levels()[0].face_count() + 63) / 64, kLevels - 1, 1);
  barrier(commands, compute, VK_ACCESS_SHADER_WRITE_BIT, compute, reads_writes);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, choose_);
  gpu_.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
            {reports_.handle, levels_.handle, choice_.handle},
            bytes_of(ChoosePush{kReportWords, number, camera, pixel(camera - kExtent)}));
  vkCmdDispatch(commands, 1, 1, 1);
  barrier(commands, compute, VK_ACCESS_SHADER_WRITE_BIT,
          VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
              VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
          VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT |
              VK_ACCESS_TRANSFER_READ_BIT);
}

void Renderer::draw(VkCommandBuffer commands, float angle, float camera) {
  const VkRect2D large = large_part();
  const uint32_t side = large.extent.height / 2;
  const auto x = static_cast<int32_t>(large.extent.width);
  target_.begin(commands);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, mesh_);
  draw_mesh(commands, large, camera, angle, kPlain);
  draw_mesh(commands, {{x, 0}, {side, side}}, 3.9f, angle, kErrors);
  draw_mesh(commands, {{x, static_cast<int32_t>(side)}, {side, side}}, 3.9f, angle, kEdges);
  draw_caption(commands);
  target_.end(commands);
}

void Renderer::draw_mesh(VkCommandBuffer commands, VkRect2D part, float camera, float angle,
                         uint32_t mode) {
  MeshPush push = look(part.extent, camera, kExtent, angle, mode);
  push.report_words = kReportWords;
  target_.view(commands, part);
  gpu_.bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
            {scene_.vertices().handle, levels_.handle, choice_.handle, scene_.index_buffer().handle,
             reports_.handle, errors_.handle},
            bytes_of(push));
  if (mode == kErrors) {
    vkCmdDraw(commands, 3 * scene_.levels()[0].face_count(), 1, 0, 0);
  } else {
    vkCmdDrawIndirect(commands, choice_.handle, offsetof(Choice, draw), 1, 0);
  }
}

void Renderer::draw_caption(VkCommandBuffer commands) {
  const VkRect2D part = caption_part();
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, caption_);
  target_.view(commands, part);
  const CaptionPush push{(part.extent.width - 6 * kColumns * text_scale()) / 2,
                         static_cast<uint32_t>(part.offset.y) + 2, text_scale()};
  gpu_.bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
            {scene_.vertices().handle, levels_.handle, choice_.handle, scene_.index_buffer().handle,
             reports_.handle, font_.handle},
            bytes_of(push));
  vkCmdDraw(commands, 3, 1, 0, 0);
}

// This is only for the host: the device has used all of it already.
void Renderer::read_back(VkCommandBuffer commands) {
  const VkBufferCopy reports{0, 0, reports_.size};
  const VkBufferCopy choice{0, reports_.size, sizeof(Choice)};
  vkCmdCopyBuffer(commands, reports_.handle, readback_.handle, 1, &reports);
  vkCmdCopyBuffer(commands, choice_.handle, readback_.handle, 1, &choice);
  barrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
          VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

template <class T>
std::vector<T> Renderer::read(const Buffer& from, VkDeviceSize offset, size_t count) {
  std::vector<T> result(count);
  const Buffer host = gpu_.buffer(count * sizeof(T), Memory::kHost);
  gpu_.run([&](VkCommandBuffer commands) {
    const VkBufferCopy copy{offset, 0, host.size};
    vkCmdCopyBuffer(commands, from.handle, host.handle, 1, &copy);
    barrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
            VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
  });
  std::memcpy(result.data(), host.mapped, host.size);
  return result;
}

std::vector<SceneVertex> Renderer::vertices(uint32_t level) {
  const Level& l = scene_.levels()[level];
  return read<SceneVertex>(scene_.vertices(), l.first_vertex * sizeof(SceneVertex),
                           l.vertex_count());
}

std::vector<float> Renderer::errors(uint32_t level) {
  return read<float>(errors_, (level - 1) * bytes_of_errors(), bytes_of_errors() / sizeof(float));
}

}  // namespace example
