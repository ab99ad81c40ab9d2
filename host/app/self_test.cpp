// The device's side of the self-test: one kernel with a pipeline of its own, so that no other run
// pays for it.
#include "host/app/self_test.h"

#include <array>
#include <cstring>

#include "host/gpu/memory.h"
#include "host/gpu/vulkan_api.h"
#include "kernels/self_test.h"

namespace vkh {
namespace {

constexpr uint32_t kItems = 1u << 18;
constexpr uint32_t kRounds = 4;
constexpr uint32_t kComposed = kItems / 16;  // judged in Float128, which takes longer
constexpr uint32_t kGrouped = kItems / 16;

class SelfTestKernel {
 public:
  // Delegates: the objects made so far are destroyed if a later step throws.
  explicit SelfTestKernel(const Device& device) : SelfTestKernel(device, Empty{}) { create(); }
  ~SelfTestKernel() {
    const VulkanApi& vk = device_.vk();
    vk.DestroyPipeline(device_.handle(), pipeline_, nullptr);
    vk.DestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vk.DestroyDescriptorPool(device_.handle(), pool_, nullptr);
    vk.DestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
    vk.DestroyShaderModule(device_.handle(), shader_, nullptr);
  }
  SelfTestKernel(const SelfTestKernel&) = delete;
  SelfTestKernel& operator=(const SelfTestKernel&) = delete;

  // Requires that earlier recordings have run.
  void record(VkCommandBuffer commands, const k::SelfTest::Args& args, uint32_t items) const {
    bind(args);
    const VulkanApi& vk = device_.vk();
    vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0,
                             nullptr);
    vk.CmdDispatch(commands, items / gpu::kGroupSize, 1, 1);
  }

 private:
  static constexpr uint32_t kBuffers = 6;
  static_assert(sizeof(k::SelfTest::kBindings) == kBuffers * sizeof(Binding));

  void bind(const k::SelfTest::Args& args) const {
    const auto buffers = k::SelfTest::descriptors(args);
    std::array<VkWriteDescriptorSet, kBuffers> writes{};
    for (uint32_t i = 0; i < kBuffers; ++i) {
      writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
      writes[i].dstSet = set_;
      writes[i].dstBinding = i;
      writes[i].descriptorCount = 1;
      writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
      writes[i].pBufferInfo = &buffers[i];
    }
    device_.vk().UpdateDescriptorSets(device_.handle(), kBuffers, writes.data(), 0, nullptr);
  }

  struct Empty {};
  SelfTestKernel(const Device& device, Empty) : device_(device) {}

  void create() {
    create_layouts();
    create_set();
    const VulkanApi& vk = device_.vk();
    VkShaderModuleCreateInfo code{};
    code.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    code.codeSize = k::SelfTest::words().size_bytes();
    code.pCode = k::SelfTest::words().data();
    check_made(vk.CreateShaderModule(device_.handle(), &code, nullptr, &shader_), shader_,
               "the self-test's shader");
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader_;
    info.stage.pName = "main";
    info.layout = layout_;
    check_made(
        vk.CreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_),
        pipeline_, "the self-test's pipeline");
  }

  void create_layouts() {
    const VulkanApi& vk = device_.vk();
    std::array<VkDescriptorSetLayoutBinding, kBuffers> bindings{};
    for (uint32_t i = 0; i < kBuffers; ++i) {
      bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = kBuffers;
    set.pBindings = bindings.data();
    check_made(vk.CreateDescriptorSetLayout(device_.handle(), &set, nullptr, &set_layout_),
               set_layout_, "the self-test's buffers");
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout_;
    check_made(vk.CreatePipelineLayout(device_.handle(), &layout, nullptr, &layout_), layout_,
               "the self-test's layout");
  }

  void create_set() {
    const VulkanApi& vk = device_.vk();
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kBuffers};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    check_made(vk.CreateDescriptorPool(device_.handle(), &pool, nullptr, &pool_), pool_,
               "the self-test's descriptor pool");
    VkDescriptorSetAllocateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set.descriptorPool = pool_;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &set_layout_;
    check(vk.AllocateDescriptorSets(device_.handle(), &set, &set_), "the self-test's descriptors");
  }

  const Device& device_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkShaderModule shader_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

template <class T>
Buffer shared_buffer(const Device& device, const T* content, size_t count) {
  Buffer buffer(device, count * sizeof(T), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                Placement::kReadback);
  if (content != nullptr) std::memcpy(buffer.mapped(), content, count * sizeof(T));
  return buffer;
}

template <class T>
Slice<T> whole(const Buffer& buffer) {
  return {buffer.handle(), 0, VK_WHOLE_SIZE};
}

void host_barrier(const Device& device, VkCommandBuffer commands) {
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  device.vk().CmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                 VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0,
                                 nullptr);
}

}  // namespace

void compile_self_test(const Device& device) { const SelfTestKernel kernel(device); }

SelfTestResult run_self_test(const Device& device) {
  const SelfTestKernel kernel(device);
  Submitter submitter(device);
  SelfTestResult result;
  for (uint32_t round = 0; round < kRounds; ++round) {
    const std::vector<gpu::SelfTestQuestion> asked = self_test_questions(round, kItems);
    const gpu::SelfTestTotals before = {
        .highest = 0, .lowest = UINT32_MAX, .items = 0, .subgroups = 0};
    const Buffer questions = shared_buffer(device, asked.data(), asked.size());
    const Buffer answers = shared_buffer<gpu::SelfTestAnswer>(device, nullptr, kItems);
    const Buffer totals = shared_buffer(device, &before, 1);
    const std::vector<gpu::SelfTestOperands> given = composed_questions(round, kComposed);
    const Buffer operands = shared_buffer(device, given.data(), given.size());
    const Buffer results = shared_buffer<gpu::SelfTestComposed>(device, nullptr, kComposed);
    const Buffer groups = shared_buffer<gpu::SelfTestGroups>(device, nullptr, kGrouped);
    const VkCommandBuffer commands = submitter.begin();
    kernel.record(commands,
                  {.questions = whole<gpu::SelfTestQuestion>(questions),
                   .answers = whole<gpu::SelfTestAnswer>(answers),
                   .totals = whole<gpu::SelfTestTotals>(totals),
                   .operands = whole<gpu::SelfTestOperands>(operands),
                   .results = whole<gpu::SelfTestComposed>(results),
                   .groups = whole<gpu::SelfTestGroups>(groups)},
                  kItems);
    host_barrier(device, commands);
    submitter.submit_and_wait({});
    gpu::SelfTestTotals after{};
    std::memcpy(&after, totals.mapped(), sizeof after);
    const auto* read = reinterpret_cast<const gpu::SelfTestAnswer*>(answers.mapped());
    judge_self_test(asked, {read, kItems}, after, result);
    const auto* seen = reinterpret_cast<const gpu::SelfTestGroups*>(groups.mapped());
    judge_groups(asked, {seen, kGrouped}, result);
    const auto* found = reinterpret_cast<const gpu::SelfTestComposed*>(results.mapped());
    judge_composed(given, {found, kComposed}, result);
  }
  return result;
}

}  // namespace vkh
