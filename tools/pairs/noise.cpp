// Writes a noisy surface of any size, row by row, the same bytes on every machine.
//
//   vkh_noise --faces N --seed S --out FILE.ply [--shape torus] [--noise 0.001]
//
// Two seeds, or two numbers of faces, make a pair. Exit code 2 for a wrong command, 6 for a failed
// write.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tools/pairs/noisy_torus.h"
#include "vkhausdorff/error.h"

int main(int argc, char** argv) {
  uint64_t faces = 0, seed = 0;
  double noise = 0.001;
  std::string out, shape = "torus";
  CLI::App app("A noisy surface of any size.", "vkh_noise");
  app.add_option("--faces", faces, "The most faces; about as many are made")->required();
  app.add_option("--seed", seed, "Of the noise")->required();
  app.add_option("--shape", shape, "The surface")->check(CLI::IsMember({"torus"}));
  app.add_option("--noise", noise, "Most that a vertex lies off, of the tube's radius")
      ->check(CLI::Range(0.0, 0.5));
  app.add_option("--out", out, "Binary PLY")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    const vkh::pairs::NoisyTorus torus(faces, seed, noise);
    torus.write(out);
    std::printf("%s\n", vkh::pairs::summary(out, torus.shape()).c_str());
    return 0;
  } catch (const vkh::UsageError& error) {
    std::fprintf(stderr, "vkh_noise: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vkh_noise: %s\n", error.what());
    return 6;
  }
}
