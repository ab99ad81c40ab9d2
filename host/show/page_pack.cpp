// Packs a shown mesh as streams that deflate well: small differences, and equal bytes side by side.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "host/show/deflate.h"
#include "host/show/page_mesh.h"

namespace vkh {
namespace {

constexpr uint32_t kUnknown = UINT32_MAX;

/// Appends numbers as one stream for each of their bytes, the lowest first.
void append_streams(std::string& out, const std::vector<uint32_t>& numbers, int bytes) {
  size_t at = out.size();
  out.resize(at + numbers.size() * static_cast<size_t>(bytes));
  for (int i = 0; i < bytes; ++i) {
    for (const uint32_t number : numbers) out[at++] = static_cast<char>(number >> (8 * i) & 0xff);
  }
}

/// The difference of two numbers of `bits` bits, modulo 2^bits, coded so that small differences of
/// either sign are small numbers.
uint32_t difference(uint32_t to, uint32_t from, int bits) {
  const uint32_t mask = (uint32_t{1} << bits) - 1, up = (to - from) & mask;
  if (up >> (bits - 1) == 0) return 2 * up;
  return 2 * ((from - to) & mask) - 1;
}

/// Numbers vertices in the order in which faces need them: a new one is 0, a near one small.
struct CornerCodes {
  std::vector<uint32_t> codes, order;  // order: the shown mesh's vertex numbers
};
CornerCodes corners_of(const ShownMesh& shown) {
  CornerCodes out;
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

std::vector<uint32_t> positions_of(const ShownMesh& shown, const std::vector<uint32_t>& order) {
  std::vector<uint32_t> codes;
  uint32_t last[3] = {};
  for (const uint32_t v : order) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const uint32_t now = shown.vertices[v][axis];
      codes.push_back(difference(now, last[axis], 16));
      last[axis] = now;
    }
  }
  return codes;
}

// A float's upper bits keep 15 of its digits: it is rounded by a share of 2^-16 at most.
uint32_t distance_bits(double share) {
  const auto bits = std::bit_cast<uint32_t>(std::abs(static_cast<float>(share)));
  return ((bits + 0x80) >> 8) << 1 | (share < 0 ? 1 : 0);
}
constexpr double kDistanceRounding = 0x1p-15, kLeastDistance = 0x1p-120;

// A number that is no smaller than the share, with 8 of its digits.
uint32_t width_bits(double share) {
  auto rounded = static_cast<float>(share);
  if (static_cast<double>(rounded) < share)
    rounded = std::nextafter(rounded, std::numeric_limits<float>::infinity());
  return (std::bit_cast<uint32_t>(rounded) + 0x7fff) >> 15;
}

std::vector<uint32_t> distances_of(const ShownMesh& shown, double unit) {
  std::vector<uint32_t> codes, at_vertex(shown.vertices.size(), kUnknown);
  uint32_t last = 0;
  for (size_t f = 0; f < shown.faces.size(); ++f) {
    const glm::uvec3& face = shown.faces[f];
    const std::array<uint32_t, 3> corners{face.x, face.y, face.z};
    for (size_t i = 0; i < corners.size(); ++i) {
      uint32_t& before = at_vertex[corners[i]];
      const uint32_t now = distance_bits(shown.values[f].at[i] / unit);
      codes.push_back(difference(now, before == kUnknown ? last : before, 24));
      before = last = now;
    }
  }
  return codes;
}

std::vector<uint32_t> widths_of(const ShownMesh& shown, double unit) {
  std::vector<uint32_t> codes;
  uint32_t last = 0;
  for (const ShownValue& value : shown.values) {
    const double most =
        std::max({std::abs(value.at[0]), std::abs(value.at[1]), std::abs(value.at[2])}) / unit;
    const uint32_t now = width_bits(value.width / unit + most * kDistanceRounding + kLeastDistance);
    codes.push_back(difference(now, last, 16));
    last = now;
  }
  return codes;
}

std::vector<uint32_t> flags_of(const ShownMesh& shown) {
  std::vector<uint32_t> flags;
  for (const ShownValue& value : shown.values)
    flags.push_back((value.is_hatched ? 1u : 0u) | (value.is_sideless ? 2u : 0u) |
                    (value.is_left_out ? 4u : 0u));
  return flags;
}

// The largest distance; 1 if all are 0.
double farthest_of(const ShownMesh& shown) {
  double most = 0;
  for (const ShownValue& value : shown.values) {
    for (const double at : value.at) most = std::max(most, std::abs(at));
  }
  return most > 0 ? most : 1;
}

/// Whether a code for each byte makes bytes about as short as a search for what repeats, which
/// takes eight times as long. A sample tells.
bool is_noise(std::string_view bytes) {
  constexpr size_t kPieces = 16, kPiece = 4096;
  constexpr double kAbout = 1.03;
  std::string sample;
  for (size_t i = 0; i < kPieces; ++i) sample += bytes.substr(bytes.size() / kPieces * i, kPiece);
  const auto size = [&](Deflate how) {
    return static_cast<double>(deflated(std::array{DeflatePart{sample, how}}).size());
  };
  return size(Deflate::kCodes) <= kAbout * size(Deflate::kQuick);
}

/// Behind the first `alike` bytes are differences of distances, in which little repeats unless a
/// mesh does.
std::string deflated(const std::string& bytes, size_t alike) {
  if (!can_deflate()) return bytes;
  const std::string_view first = std::string_view(bytes).substr(0, alike);
  const std::string_view rest = std::string_view(bytes).substr(alike);
  if (!is_noise(rest)) return deflated(std::array{DeflatePart{bytes, Deflate::kThorough}});
  return deflated(
      std::array{DeflatePart{first, Deflate::kQuick}, DeflatePart{rest, Deflate::kCodes}});
}

}  // namespace

PackedMesh packed(const ShownMesh& shown) {
  const CornerCodes corners = corners_of(shown);
  const double unit = farthest_of(shown);
  std::string bytes;
  append_streams(bytes, corners.codes, 3);
  append_streams(bytes, positions_of(shown, corners.order), 2);
  const size_t alike = bytes.size();
  append_streams(bytes, distances_of(shown, unit), 3);
  append_streams(bytes, widths_of(shown, unit), 2);
  append_streams(bytes, flags_of(shown), 1);
  return {corners.order.size(), shown.faces.size(), unit, deflated(bytes, alike)};
}

}  // namespace vkh
