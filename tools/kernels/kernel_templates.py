"""The output of embed_shaders.py for a kernel, for str.format."""

HEADER = """\
// Made by tools/kernels/embed_shaders.py from shaders/{name}.comp; edit that one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "engine/slice.h"
#include "shaders/stages.h"

namespace vkh::k {{

struct {type} {{
  static constexpr const char* kName = "{name}";
  static constexpr uint32_t kLocalSize[3] = {{{local_size}}};  // defaults, where specialised
  static std::span<const uint32_t> words();
  static std::span<const uint32_t> words_for_cpu();  // not wide: kWide is false
  // Edits of either that give large buffers by address (engine/by_address.h).
  static std::span<const uint32_t> edits();
  static std::span<const uint32_t> edits_for_cpu();
  static uint32_t fingerprint();                     // of the words
  static constexpr uint32_t kByAddress = {by_address:#x};  // bindings, as bits, that those edits replace
  static constexpr uint32_t kSharedBytes = {shared_bytes};  // of a workgroup, the most over all switches

  struct Args {{
{args}
  }};
  static constexpr Binding kBindings[] = {{
{bindings}
  }};
  using Push = {push};

  // The members of `from`, any struct, that are called as the kernel's buffers are.
  template <class Names>
  static Args named(const Names& from) {{
    return {{
{named}
    }};
  }}

  // The buffers in binding order, as a descriptor write takes them.
  static std::array<VkDescriptorBufferInfo, {count}> descriptors(const Args& args) {{
    return {{
{descriptors}
    }};
  }}
}};

static_assert(kAddressOffset == {address_offset} && kMaxAddresses == {most_addresses});
{asserts}

}}  // namespace vkh::k
"""

SOURCE = """\
// Made by tools/kernels/embed_shaders.py from shaders/{name}.comp; edit that one.
#include "kernels/{name}.h"

namespace vkh::k {{
namespace of_{name} {{  // a name of its own: kernels may share a translation unit

constexpr uint32_t kWords[] = {{
{words}
}};
{cpu_words}{edits}}}  // namespace of_{name}

std::span<const uint32_t> {type}::words() {{ return of_{name}::kWords; }}
std::span<const uint32_t> {type}::words_for_cpu() {{ return of_{name}::{cpu_name}; }}
std::span<const uint32_t> {type}::edits() {{ return {edits_name}; }}
std::span<const uint32_t> {type}::edits_for_cpu() {{ return {cpu_edits_name}; }}
uint32_t {type}::fingerprint() {{ return {fingerprint:#010x}; }}

}}  // namespace vkh::k
"""
