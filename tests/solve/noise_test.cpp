// Noisy surfaces: the same bytes everywhere, as many faces as asked, closed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/program.h"
#include "tools/pairs/noisy_torus.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

using namespace vkh;
using namespace vkh::test;
using vkh::pairs::NoisyTorus;
using vkh::pairs::sine_cosine;

namespace {

/// FNV-1a, 64 bits.
uint64_t hash_of(const std::string& bytes) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

std::string written(uint64_t faces, uint64_t seed, double noise) {
  const std::string path = folder() / "torus.ply";
  NoisyTorus(faces, seed, noise).write(path);
  return read_file(path);
}

}  // namespace

TEST_CASE("sine and cosine are within two roundings of the truth") {
  const long double pi = std::acos(-1.0L);  // libc++'s pi_v<long double> is a double
  for (const uint32_t of : {3u, 4u, 7u, 8u, 1000u, 46341u}) {
    double worst = 0;
    for (uint32_t i = 0; i < of; ++i) {
      const auto angle = static_cast<long double>(i) / of * 2 * pi;
      const auto [sine, cosine] = sine_cosine(i, of);
      worst = std::max({worst, static_cast<double>(std::abs(sine - std::sin(angle))),
                        static_cast<double>(std::abs(cosine - std::cos(angle)))});
    }
    CHECK(worst <= 0x1p-52);
  }
}

// The hashes are those of x86-64 with g++ 12; any other machine must give them, too.
TEST_CASE("the bytes are the same on every machine") {
  CHECK(hash_of(written(1000, 1, 0.001)) == 16739280312035686138u);
  CHECK(hash_of(written(100'000, 0x123456789abcdef0u, 0.25)) == 5086378313195402205u);
  CHECK(written(1000, 2, 0.001) != written(1000, 1, 0.001));
  CHECK(written(1000, 1, 0.002) != written(1000, 1, 0.001));
}

TEST_CASE("a torus of about as many faces as asked, closed, within its noise") {
  for (const uint64_t faces : {18u, 19u, 100u, 999u, 12'345u, 64'000u}) {
    CAPTURE(faces);
    written(faces, 5, 0.25);
    const Mesh mesh = read_mesh(folder() / "torus.ply");
    CHECK(mesh.faces.size() <= faces);
    CHECK(static_cast<double>(mesh.faces.size()) >= static_cast<double>(faces) * 0.6);
    CHECK(2 * mesh.vertices.size() == mesh.faces.size());
    CHECK(mesh.counts.degenerate == 0);
    std::set<std::pair<uint32_t, uint32_t>> sides;  // each once, and once the other way
    for (const glm::uvec3& f : mesh.faces)
      for (int c = 0; c < 3; ++c) sides.insert({f[c], f[(c + 1) % 3]});
    CHECK(sides.size() == 3 * mesh.faces.size());
    for (const auto& [i, j] : sides) REQUIRE(sides.count({j, i}) == 1);
    double least = 1, greatest = 0;
    for (const glm::dvec3& v : mesh.vertices) {
      const double off = std::hypot(std::hypot(v.x, v.y) - 1, v.z) / 0.375 - 1;
      least = std::min(least, off);
      greatest = std::max(greatest, off);
    }
    CHECK(least >= -0.2500001);
    CHECK(greatest <= 0.2500001);
    CHECK(greatest - least > 0.2);
  }
  CHECK(NoisyTorus(64'000'000, 1, 0.001).shape().face_count == 64'000'000);
  CHECK_THROWS_AS(NoisyTorus(17, 1, 0), UsageError);
  CHECK_THROWS_AS(NoisyTorus(uint64_t{1} << 32, 1, 0), UsageError);
}

TEST_CASE("a disk that is full is said, and a refused command writes nothing") {
  const Outcome full = run({"--faces", "1000000", "--seed", "1", "--out", "/dev/full"});
  CHECK(full.exit_code == 6);
  CHECK(full.err.find("cannot be written: No space") != std::string::npos);
  CHECK(std::filesystem::is_character_file("/dev/full"));
  const std::string path = folder() / "never.ply";
  CHECK(run({"--faces", "5", "--seed", "1", "--out", path}).exit_code == 2);
  CHECK(!std::filesystem::exists(path));
  const Outcome good = run({"--faces", "1000", "--seed", "1", "--out", path});
  CHECK(good.exit_code == 0);
  CHECK(read_file(path) == written(1000, 1, 0.001));
}
