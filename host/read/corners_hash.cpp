#include "host/read/corners_hash.h"

#include <algorithm>
#include <bit>

#include "vkhausdorff/sha256.h"

namespace vkh {
namespace {

void append(std::string& out, double value) {
  const uint64_t bits = value == 0 ? 0 : std::bit_cast<uint64_t>(value);
  for (int shift = 0; shift < 64; shift += 8) out += static_cast<char>(bits >> shift & 255);
}

}  // namespace

std::string corner_bytes(const Mesh& mesh, size_t first, size_t faces) {
  const size_t end = first + std::min(faces, mesh.faces.size() - first);
  std::string out;
  out.reserve((end - first) * 9 * sizeof(double));
  for (size_t face = first; face < end; ++face) {
    for (int i = 0; i < 9; ++i) append(out, mesh.vertices[mesh.faces[face][i / 3]][i % 3]);
  }
  return out;
}

std::string sha256_of_corners(const Mesh& mesh) {
  constexpr size_t kPiece = size_t{1} << 14;  // faces
  std::string piece;
  size_t face = 0;
  return sha256_of_pieces([&]() -> std::string_view {
    piece = corner_bytes(mesh, face, kPiece);
    face += std::min(kPiece, mesh.faces.size() - face);
    return piece;
  });
}

}  // namespace vkh
