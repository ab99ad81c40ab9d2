// Runs single kernels and recording files on the test device: vectors in, vectors out.
#pragma once

#include <algorithm>
#include <cstring>
#include <functional>
#include <vector>

#include "engine/record.h"
#include "engine/vkhausdorff_experimental.h"
#include "host/gpu/memory.h"
#include "tests/support/kept.h"
#include "vkhausdorff/mesh.h"

namespace vkh::test {

/// The device of this test program, made once, with the validation layer if VKH_VALIDATION is set
/// and not empty. VKH_TEST_DEVICE selects another than the best one. Contexts are byAddress if
/// VKH_TEST_BY_ADDRESS is not empty.
vkh::Device& test_device();

/// A context on the test device; `switches` has VkhContextFlagBits, too; `checks`: of its input.
VkhContextCreateInfo create_info(uint32_t switches, VkhDeviceKind kind,
                                 VkBool32 by_address = VK_FALSE, VkBool32 checks = VK_FALSE);

/// A foreign device, to be adopted.
AdoptedDevice handles_of(const Device& device);

class KernelBench {
 public:
  explicit KernelBench(uint32_t switches = gpu::kUseAll, bool wide = true);
  KernelBench(const KernelBench&) = delete;
  KernelBench& operator=(const KernelBench&) = delete;

  /// A buffer of its own that holds `content`, or one element that is zero if that is empty.
  template <class T>
  Slice<T> put(const std::vector<T>& content) {
    const T zero{};
    return reserve<T>(content.empty() ? &zero : content.data(), content.size());
  }
  /// The same with `count` elements of garbage, on which a kernel must not rely.
  template <class T>
  Slice<T> garbage(size_t count) {
    return reserve<T>(nullptr, count);
  }
  template <class T>
  std::vector<T> get(const Slice<T>& slice) const {
    std::vector<T> content(slice.size / sizeof(T));
    std::memcpy(static_cast<void*>(content.data()), mapped(slice.buffer) + slice.offset,
                content.size() * sizeof(T));
    return content;
  }

  /// Records with `record`, submits and waits. Throws if anything wrote beyond the end of a buffer.
  /// With VKH_TEST_GUARDED, a read beyond it ends the program, too (sanitize/guarded_malloc.c).
  void run(const std::function<void(Recorder&)>& record);
  VkhContext context() const { return context_; }

 private:
  static constexpr int kGarbage = 0xa5;
  // Guard bytes beyond the end of every buffer, within its allocation: a stray write is seen, not
  // lost. There are none if an allocation ends at memory that nothing may touch.
  const size_t guard_bytes_;

  template <class T>
  Slice<T> reserve(const T* content, size_t count) {
    const size_t bytes = std::max<size_t>(count, 1) * sizeof(T);
    return {reserve_bytes(content, bytes), 0, bytes};
  }
  VkBuffer reserve_bytes(const void* content, size_t bytes);
  const std::byte* mapped(VkBuffer buffer) const;
  void check_guards() const;

  Submitter submitter_;
  VkhContext context_;
  std::vector<Buffer> buffers_;
};

/// The arguments of a single kernel: its buffers and push constants.
template <class K>
struct Direct : K::Args {
  typename K::Push push;
};

/// A mesh on the bench, with low parts if a coordinate is no float32.
VkhMesh put_mesh(KernelBench& bench, const Mesh& mesh);

/// The BVH of a mesh, built; the scratch as the build left it. `limits`: the bench's, or
/// lower ones.
struct BuiltHierarchy {
  Hierarchy hierarchy;
  BuildScratch scratch;
};
BuiltHierarchy build_hierarchy(KernelBench& bench, const Mesh& mesh);
BuiltHierarchy build_hierarchy(KernelBench& bench, const Mesh& mesh, const Limits& limits);

}  // namespace vkh::test
