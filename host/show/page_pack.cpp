// Packs a shown mesh as streams that deflate well: small differences, and equal bytes side by side.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#ifdef VKH_HAS_ZLIB
#include <zlib.h>
#endif

#include "host/show/page_mesh.h"

namespace vkh {
namespace {

constexpr uint32_t kUnknown = UINT32_MAX;

/// Appends numbers as one stream for each of their bytes, the lowest first.
void append_streams(std::string& out, const std::vector<uint32_t>& numbers, int bytes) {
  for (int i = 0; i < bytes; ++i) {
    for (const uint32_t number : numbers) out += static_cast<char>(number >> (8 * i) & 0xff);
  }
}

/// A difference of two 16-bit numbers, modulo 2^16; small ones of either sign are small numbers.
uint32_t difference(uint32_t to, uint32_t from) {
  const auto signed_difference = static_cast<int16_t>(static_cast<uint16_t>(to - from));
  const int wide = signed_difference;
  return static_cast<uint32_t>(wide < 0 ? -2 * wide - 1 : 2 * wide);
}

/// Numbers vertices in the order in which faces need them: a new one is 0, a near one small.
struct Corners {
  std::vector<uint32_t> codes, order;  // order: the shown mesh's vertex numbers
};
Corners corners_of(const Shown& shown) {
  Corners out;
  std::vector<uint32_t> known(shown.vertices.size(), kUnknown);
  for (const glm::uvec3& face : shown.faces) {
    for (const uint32_t v : {face.x, face.y, face.z}) {
      const auto next = static_cast<uint32_t>(out.order.size());
      if (known[v] == kUnknown) {
        known[v] = next;
        out.order.push_back(v);
      }
      out.codes.push_back(next - known[v]);
    }
  }
  return out;
}

std::vector<uint32_t> positions_of(const Shown& shown, const std::vector<uint32_t>& order) {
  std::vector<uint32_t> codes;
  uint32_t last[3] = {};
  for (const uint32_t v : order) {
    for (int axis = 0; axis < 3; ++axis) {
      const double at = std::clamp(shown.vertices[v][axis], 0.0, 1.0);
      const auto now = static_cast<uint32_t>(std::lround(at * 65535));
      codes.push_back(difference(now, last[axis]));
      last[axis] = now;
    }
  }
  return codes;
}

std::string deflated(std::string bytes) {
#ifdef VKH_HAS_ZLIB
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int result =
      compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 6);
  if (result != Z_OK) throw std::bad_alloc();  // sizes exclude all other errors
  out.resize(size);
  return out;
#else
  return bytes;
#endif
}

}  // namespace

bool can_deflate() {
#ifdef VKH_HAS_ZLIB
  return true;
#else
  return false;
#endif
}

PackedMesh packed(const Shown& shown, const Field& field, const std::vector<Step>& steps) {
  const Corners corners = corners_of(shown);
  std::vector<uint32_t> within, gaps;
  uint32_t last = 0;
  for (size_t f = 0; f < shown.faces.size(); ++f) {
    const FaceSteps at = steps_of(field.of(f), steps);
    within.push_back(difference(at.within, last));
    gaps.push_back(at.within - std::min(at.beyond, at.within));
    last = at.within;
  }
  std::string bytes;
  append_streams(bytes, corners.codes, 3);
  append_streams(bytes, positions_of(shown, corners.order), 2);
  append_streams(bytes, within, 2);
  append_streams(bytes, gaps, 2);
  return {corners.order.size(), shown.faces.size(), deflated(std::move(bytes))};
}

}  // namespace vkh
