// Many pairs whose distances are known, from few: each is one of LIST's, moved exactly.
//
//   vkh_moved LIST --count N --out FOLDER [--seed S]
//
// FOLDER gets the meshes (binary PLY), list.jsonl for `vkhausdorff batch`, and moves.csv: id, the
// id of the pair that was moved, and the exponent of the power of two that its distance is
// multiplied by. tools/bench/generated.py --what moved holds results against those of LIST. A shift
// that would not be exact is left out. Exit code 2 for a wrong command or list, 6 for a failed
// write.
#include "tools/pairs/moved.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/base/parallel.h"
#include "host/base/system.h"
#include "host/batch/list.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/mesh_io.h"

namespace {

using namespace vkh;

struct Base {
  std::string id;
  Mesh a, b;
  double size = 1;  // the power of two at or above all coordinates
};

std::vector<Base> read_bases(const std::string& list) {
  const PairList pairs = read_list(list);
  std::vector<Base> bases(pairs.entries.size());
  for_each_index(bases.size(), [&](size_t i) {
    const Entry& entry = pairs.entries[i];
    Base& base = bases[i];
    base = {entry.id, read_mesh(path_of(entry.file_a)), read_mesh(path_of(entry.file_b))};
    const Box box = join(bounding_box(base.a), bounding_box(base.b));
    double most = 0;
    for (int axis = 0; axis < 3; ++axis)
      most = std::max({most, std::abs(box.lo[axis]), std::abs(box.hi[axis])});
    base.size = most > 0 ? std::exp2(std::ceil(std::log2(most))) : 1;
  });
  return bases;
}

bool moved(Mesh& a, Mesh& b, const pairs::Move& move) {
  return pairs::move_exactly(a, move) && pairs::move_exactly(b, move);
}

std::string id_of(size_t number) {
  char text[32];
  std::snprintf(text, sizeof text, "%06zu", number);
  return text;
}

// Returns the exponent.
int write_pair(const Base& base, uint64_t number, const std::string& id,
               const std::filesystem::path& folder) {
  pairs::Move move = pairs::draw_move(number, base.size);
  Mesh a = base.a, b = base.b;
  if (!moved(a, b, move)) {
    move.shift = {};
    a = base.a;
    b = base.b;
    if (!moved(a, b, move)) throw InputError(base.id + ": too small or large for 2^20");
  }
  pairs::write_ply(a, name_of(folder / (id + "_a.ply")));
  pairs::write_ply(b, name_of(folder / (id + "_b.ply")));
  return move.exponent;
}

void write_all(const std::string& list, const std::filesystem::path& folder, size_t count,
               uint64_t seed) {
  const std::vector<Base> bases = read_bases(list);
  std::filesystem::create_directories(folder);
  std::vector<int> exponents(count);
  for_each_index(count, [&](size_t i) {
    exponents[i] = write_pair(bases[i % bases.size()], seed * 1'000'003 + i, id_of(i), folder);
  });
  std::ofstream pairs(folder / "list.jsonl", std::ios::binary);
  std::ofstream moves(folder / "moves.csv", std::ios::binary);
  moves << "id,base,exponent\n";
  for (size_t i = 0; i < count; ++i) {
    const std::string id = id_of(i);
    pairs << nlohmann::json{{"id", id}, {"a", id + "_a.ply"}, {"b", id + "_b.ply"}}.dump() << '\n';
    moves << id << ',' << bases[i % bases.size()].id << ',' << exponents[i] << '\n';
  }
  if (!pairs.flush() || !moves.flush()) throw OutputError("the lists cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  std::string list, out;
  size_t count = 0;
  uint64_t seed = 1;
  CLI::App app("Pairs whose distances are known: moved exactly.", "vkh_moved");
  app.add_option("LIST", list, "Pairs, as `vkhausdorff batch` takes them")->required();
  app.add_option("--count", count, "How many")->required();
  app.add_option("--out", out, "A folder")->required();
  app.add_option("--seed", seed, "Of the moves");
  CLI11_PARSE(app, argc, argv);
  try {
    write_all(list, vkh::path_of(out), count, seed);
    std::printf("%zu pairs in %s\n", count, out.c_str());
    return 0;
  } catch (const vkh::OutputError& error) {
    std::fprintf(stderr, "vkh_moved: %s\n", error.what());
    return 6;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vkh_moved: %s\n", error.what());
    return 2;
  }
}
