// Writes the pair that `vkhausdorff demo` measures as two OFF files, for
// tools/docs/answer_picture.py. usage: vkh_demo_pair A.off B.off
#include <cstdio>

#include "host/demo/default_pair.h"

namespace {

bool write_off(const vkh::Mesh& mesh, const char* path) {
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) return false;
  std::fprintf(file, "OFF\n%zu %zu 0\n", mesh.vertices.size(), mesh.faces.size());
  for (const glm::dvec3& v : mesh.vertices)
    std::fprintf(file, "%.17g %.17g %.17g\n", v.x, v.y, v.z);
  for (const glm::uvec3& f : mesh.faces) std::fprintf(file, "3 %u %u %u\n", f.x, f.y, f.z);
  const bool written = std::ferror(file) == 0;
  return std::fclose(file) == 0 && written;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: vkh_demo_pair A.off B.off\n");
    return 2;
  }
  const vkh::MeshPair pair = vkh::default_pair();
  if (write_off(pair.a, argv[1]) && write_off(pair.b, argv[2])) return 0;
  std::fprintf(stderr, "vkh_demo_pair: cannot write %s or %s\n", argv[1], argv[2]);
  return 1;
}
