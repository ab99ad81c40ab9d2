#include "host/read/corners_hash.h"

#include <bit>

#include "vkhausdorff/sha256.h"

namespace vkh {
namespace {

void append(std::string& out, double value) {
  const uint64_t bits = value == 0 ? 0 : std::bit_cast<uint64_t>(value);
  for (int shift = 0; shift < 64; shift += 8) out += static_cast<char>(bits >> shift & 255);
}

}  // namespace

std::string sha256_of_corners(const Mesh& mesh) {
  constexpr size_t kPiece = size_t{1} << 20;
  std::string piece;
  size_t face = 0;
  return sha256_of_pieces([&]() -> std::string_view {
    piece.clear();
    for (; face < mesh.faces.size() && piece.size() < kPiece; ++face) {
      for (int i = 0; i < 9; ++i) append(piece, mesh.vertices[mesh.faces[face][i / 3]][i % 3]);
    }
    return piece;
  });
}

}  // namespace vkh
