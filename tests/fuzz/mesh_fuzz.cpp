// libFuzzer entry: whatever the bytes, every reader gives a valid mesh or one InputError line.
//
// By hand, from the repository's root, with a folder of files to start from:
//   clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -I.
//     tests/fuzz/mesh_fuzz.cpp host/mesh/mesh.cpp host/read/*.cpp host/base/*.cpp -o mesh_fuzz
//   ./mesh_fuzz -max_len=4096 -malloc_limit_mb=64 -max_total_time=120 corpus out/malformed
#include <cmath>
#include <cstdlib>

#include "host/base/error.h"
#include "host/read/readers.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void require_valid(const vkh::Mesh& mesh) {
  require(!mesh.faces.empty() && mesh.counts.faces == mesh.faces.size());
  require(mesh.counts.vertices == mesh.vertices.size());
  require(mesh.counts.degenerate <= mesh.faces.size());
  require(mesh.counts.duplicate < mesh.faces.size());
  std::vector<bool> used(mesh.vertices.size());
  for (const glm::uvec3& face : mesh.faces) {
    for (int i = 0; i < 3; ++i) used.at(face[i]) = true;
  }
  for (size_t v = 0; v < used.size(); ++v) {
    const glm::dvec3& p = mesh.vertices[v];
    require(used[v] && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const vkh::MeshSource source{.name = "fuzz",
                               .bytes = {reinterpret_cast<const char*>(data), size}};
  for (const auto parse :
       {vkh::parse_mesh, vkh::parse_obj, vkh::parse_stl, vkh::parse_ply, vkh::parse_off}) {
    try {
      require_valid(parse(source));
    } catch (const vkh::InputError& error) {
      const std::string line = error.what();
      require(line.starts_with("fuzz: ") && line.find("; expected ") != std::string::npos);
      require(line.find('\n') == std::string::npos);
    }
  }
  return 0;
}
