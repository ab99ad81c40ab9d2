// One pair on the processor alone (host/native), as a process: what is measured against the program
// on lavapipe. Prints a line of JSON.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "host/base/parallel.h"
#include "host/native/native.h"
#include "vkhausdorff/mesh_io.h"

namespace {

const char* name_of(vkh::native::NativeStatus status) {
  switch (status) {
    case vkh::native::NativeStatus::kClosed:
      return "closed";
    case vkh::native::NativeStatus::kPrecision:
      return "precision";
    default:
      return "levels";
  }
}

void print(const vkh::native::NativeReport& r) {
  const auto number = [](uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf("{\"status\": \"%s\", \"lower\": %.17g, \"upper\": %.17g, \"tolerance\": %.17g, ",
              name_of(r.status), r.lower, r.upper, r.tolerance);
  std::printf("\"levels\": %u, \"candidates\": %llu, \"queries\": %llu, \"peak\": %llu, ", r.levels,
              number(r.candidates), number(r.queries), number(r.peak_candidates));
  std::printf(
      "\"witness\": {\"face_a\": %u, \"face_b\": %u, \"barycentric\": [%.17g, %.17g, %.17g]}",
      r.witness.face_a, r.witness.face_b, r.witness.barycentric[0], r.witness.barycentric[1],
      r.witness.barycentric[2]);
  std::printf(", \"closed\": [");
  for (size_t i = 0; i < r.closed.size(); ++i)
    std::printf("%s%llu", i > 0 ? ", " : "", number(r.closed[i]));
  std::printf("]}\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("h(A,B) on the processor alone");
  std::string a, b;
  vkh::native::NativeOptions options;
  app.add_option("A", a)->required();
  app.add_option("B", b)->required();
  app.add_option("--tolerance", options.tolerance, "of A's diagonal");
  app.add_option("--threads", options.threads);
  app.add_option("--levels", options.level_limit);
  app.add_option("--most-candidates", options.most_candidates);
  CLI11_PARSE(app, argc, argv);
  try {
    vkh::limit_threads(options.threads);
    print(vkh::native::run_pair(vkh::read_mesh(a), vkh::read_mesh(b), options));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "native_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
