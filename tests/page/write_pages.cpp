// Writes pages for people and browsers to look at: write_pages FOLDER [MESH MESH_B], of a torus and
// a sphere if no mesh is named. Their fields are invented, and the answers fit them.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "host/batch/index.h"
#include "host/show/page.h"
#include "host/survey/area_figures.h"
#include "tests/page/invented.h"
#include "tests/shapes/shapes.h"
#include "vkhausdorff/mesh_io.h"

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

vkh::IndexRow index_row(const std::string& id, vkh::ExitCode code, vkh::Enclosure deviation) {
  vkh::Result result;
  result.name.id = id;
  result.code = code;
  vkh::Answer& answer = result.answer;
  answer.a_to_b.lower = deviation.lower;
  answer.a_to_b.upper = deviation.upper;
  answer.a_to_b.diagonal_a = 100;
  answer.max = vkh::Asked{.length = {}, .limit = {0.1, 0.1}};
  answer.unit = "mm";
  answer.first_line = "UNDECIDED  the limit 0.1 mm lies in [0.09, 0.2] mm; ask for more --time";
  return {.result = result, .pictures = {}, .report = id + ".html"};
}

// A batch of four pairs with names as long as they come, in an order that is not the right one.
void write_batch_index(const std::string& path) {
  const std::string results = "results.jsonl";
  const vkh::PictureStyle look;
  const std::string name(90, 'n');
  vkh::IndexContents contents{.rows = {}, .results = results, .look = look, .has_limit = true};
  contents.has_reports = true;
  contents.rows = {index_row("good", vkh::kExitClosed, {0.03125, 0.09375}),
                   index_row("open", vkh::kExitNotClosed, {0.09, 0.2}),
                   index_row("bad", vkh::kExitBeyond, {0.2, 900}),
                   index_row(name, vkh::kExitBeyond, {0.3, 0.4})};
  write(path, vkh::to_index(contents));
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
  // With estimates beside their ends, rows are as wide as they come.
  vkh::add_middles(false, *pair.answer.survey_a->statistics);
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
  pair.set_sides();
  write_page(folder + "signed.html", pair);
  pair.map_a.has_sides = false;
  pair.name_oddly();
  pair.picture = bytes_of(folder + "picture.png");
  write_page(folder + "odd.html", pair);
  pair = Invented(a, b);
  pair.set_upper(0);
  write_page(folder + "zero.html", pair);
  pair.set_upper(std::numeric_limits<double>::infinity());
  write_page(folder + "unbounded.html", pair);
  write_batch_index(folder + "index.html");
  return 0;
}
