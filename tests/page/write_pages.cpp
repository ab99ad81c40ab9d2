// Writes pages for people and browsers to look at: write_pages FOLDER [MESH MESH_B], of a torus and
// a sphere if no mesh is named. Their fields are invented, and the answers fit them.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "host/read/mesh_io.h"
#include "host/show/page.h"
#include "tests/page/invented.h"
#include "tests/shapes/shapes.h"

namespace {

using vkh::test::Invented;

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

vkh::Mesh mesh_of(int count, char** words, int at) {
  if (count > at) return vkh::read_mesh(words[at]);
  return at == 2 ? vkh::test::torus(20, 6, 120, 48) : vkh::test::uv_sphere(18, 60, 90);
}

void write_page(const std::string& path, const Invented& pair, const vkh::PageLimits& limits = {}) {
  const auto start = std::chrono::steady_clock::now();
  const std::string page = vkh::to_page(pair.contents(), limits);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  write(path, page);
  std::printf("%s: %zu bytes, %.2f s\n", path.c_str(), page.size(), took.count());
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) {
    std::fputs("usage: write_pages FOLDER [MESH MESH_B]\n", stderr);
    return 2;
  }
  const std::string folder = std::string(words[1]) + "/";
  const vkh::Mesh a = mesh_of(count, words, 2), b = mesh_of(count, words, 3);
  Invented pair(a, b);
  pair.ask(1.2);
  write_page(folder + "pass.html", pair);
  pair.ask(0.5);
  write_page(folder + "fail.html", pair);
  pair.ask(pair.middle());
  write_page(folder + "undecided.html", pair);
  pair.ask(0);
  pair.answer.b_to_a.reset();
  write_page(folder + "plain.html", pair);
  write_page(folder + "decimated.html", pair, {.faces = a.faces.size() / 4});
  pair.name_oddly();
  pair.picture = bytes_of(folder + "picture.png");
  write_page(folder + "odd.html", pair);
  pair = Invented(a, b);
  pair.set_upper(0);
  write_page(folder + "zero.html", pair);
  pair.set_upper(std::numeric_limits<double>::infinity());
  write_page(folder + "unbounded.html", pair);
  return 0;
}
