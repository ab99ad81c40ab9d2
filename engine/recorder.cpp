#include "engine/recorder.h"

#include "engine/checks.h"

namespace vkh {

Recorder::Recorder(const VkhContext_T& context, VkCommandBuffer commands, VkhProfile* profile)
    : context_(context), binder_(context, commands), profile_(profile) {
  stage(nullptr);
}

void Recorder::begin_label(const char* name) {
  if (track_ != nullptr || context_.vk.CmdBeginDebugUtilsLabelEXT == nullptr) return;
  VkDebugUtilsLabelEXT label{};
  label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
  label.pLabelName = name;
  context_.vk.CmdBeginDebugUtilsLabelEXT(binder_.commands(), &label);
}

void Recorder::end_label() {
  if (track_ == nullptr && context_.vk.CmdEndDebugUtilsLabelEXT != nullptr)
    context_.vk.CmdEndDebugUtilsLabelEXT(binder_.commands());
}

void Recorder::stage(const char* name) {
  if (profile_ == nullptr || profile_->count == profile_->capacity) return;
  context_.vk.CmdWriteTimestamp2(binder_.commands(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                 profile_->pool, profile_->count);
  profile_->names[profile_->count++] = name;
}

}  // namespace vkh
