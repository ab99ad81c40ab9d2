// Times the reading of mesh files, without Vulkan: per file and number of threads the least and the
// median of some alternating runs, bytes per second, the process's peak memory (Linux), and the
// longest time between two of a reader's checks whether to go on. Every run has to give the same
// mesh. With --together all files are read at once, as the program reads A and B.
//
//   vkh_bench read FILE... [--threads 1,2,4,8,16] [--runs 5] [--together]
//   vkh_bench read --make FORMAT --faces N FILE    a wavy grid, as ply, ply-ascii, stl, stl-ascii,
//                                                  obj or off
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/hash_index.h"
#include "tools/bench/bench.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh::bench {
namespace {

struct Arguments {
  std::vector<std::string> files;
  std::vector<size_t> threads = {0};
  int runs = 5;
  bool together = false;
  std::string format;
  uint64_t faces = 1'000'000;
};

// Vertices and faces of a square grid, each a function of its number, so that any size streams.
class Grid {
 public:
  explicit Grid(uint64_t faces)
      : side_(static_cast<uint64_t>(std::sqrt(static_cast<double>(faces) / 2))) {}

  uint64_t vertex_count() const { return (side_ + 1) * (side_ + 1); }
  uint64_t face_count() const { return 2 * side_ * side_; }

  glm::vec3 vertex(uint64_t v) const {
    const double n = static_cast<double>(side_);
    const double x = static_cast<double>(v % (side_ + 1)) / n;
    const uint64_t row = v / (side_ + 1);
    const double y = static_cast<double>(row) / n;
    return {x, y, 0.05 * std::sin(37 * x) * std::cos(23 * y)};
  }

  std::array<uint32_t, 3> face(uint64_t f) const {
    const uint64_t cell = f / 2, v = cell / side_ * (side_ + 1) + cell % side_;
    const auto at = [&](uint64_t right, uint64_t up) {
      return static_cast<uint32_t>(v + right + up * (side_ + 1));
    };
    if (f % 2 == 0) return {at(0, 0), at(1, 0), at(1, 1)};
    return {at(0, 0), at(1, 1), at(0, 1)};
  }

 private:
  uint64_t side_;
};

// Collects its input and writes it in large blocks.
class Out {
 public:
  explicit Out(const std::string& file) : file_(file, std::ios::binary) {}
  ~Out() { flush(); }
  Out(const Out&) = delete;
  Out& operator=(const Out&) = delete;

  void print(std::string_view text) { add(text.data(), text.size()); }
  template <class First, class... Values>
  void print(const char* format, First first, Values... values) {
    std::array<char, 256> line;
    const int size = std::snprintf(line.data(), line.size(), format, first, values...);
    add(line.data(), static_cast<size_t>(size));
  }
  template <class T>
  void store(const T& value) {
    add(reinterpret_cast<const char*>(&value), sizeof(value));
  }

 private:
  void add(const char* bytes, size_t size) {
    constexpr size_t kMost = size_t{1} << 22;
    bytes_.append(bytes, size);
    if (bytes_.size() > kMost) flush();
  }
  void flush() {
    file_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    bytes_.clear();
  }

  std::ofstream file_;
  std::string bytes_;
};

void write_point(Out& out, const char* before, const glm::vec3& p) {
  out.print("%s%.9g %.9g %.9g\n", before, static_cast<double>(p.x), static_cast<double>(p.y),
            static_cast<double>(p.z));
}

void write_ply_header(Out& out, const Grid& grid, const char* format) {
  out.print("ply\nformat %s 1.0\nelement vertex %llu\n", format,
            static_cast<unsigned long long>(grid.vertex_count()));
  out.print("property float x\nproperty float y\nproperty float z\nelement face %llu\n",
            static_cast<unsigned long long>(grid.face_count()));
  out.print("property list uchar int vertex_indices\nend_header\n");
}

void write_ply(Out& out, const Grid& grid) {
  write_ply_header(out, grid, "binary_little_endian");
  for (uint64_t v = 0; v < grid.vertex_count(); ++v) out.store(grid.vertex(v));
  for (uint64_t f = 0; f < grid.face_count(); ++f) {
    out.store(uint8_t{3});
    out.store(grid.face(f));
  }
}

void write_rows(Out& out, const Grid& grid) {
  for (uint64_t v = 0; v < grid.vertex_count(); ++v) write_point(out, "", grid.vertex(v));
  for (uint64_t f = 0; f < grid.face_count(); ++f) {
    const auto [i, j, k] = grid.face(f);
    out.print("3 %u %u %u\n", i, j, k);
  }
}

void write_ply_ascii(Out& out, const Grid& grid) {
  write_ply_header(out, grid, "ascii");
  write_rows(out, grid);
}

void write_off(Out& out, const Grid& grid) {
  out.print("OFF\n%llu %llu 0\n", static_cast<unsigned long long>(grid.vertex_count()),
            static_cast<unsigned long long>(grid.face_count()));
  write_rows(out, grid);
}

void write_obj(Out& out, const Grid& grid) {
  for (uint64_t v = 0; v < grid.vertex_count(); ++v) write_point(out, "v ", grid.vertex(v));
  for (uint64_t f = 0; f < grid.face_count(); ++f) {
    const auto [i, j, k] = grid.face(f);
    out.print("f %u %u %u\n", i + 1, j + 1, k + 1);
  }
}

void write_stl(Out& out, const Grid& grid) {
  out.store(std::array<char, 80>{});
  out.store(static_cast<uint32_t>(grid.face_count()));
  for (uint64_t f = 0; f < grid.face_count(); ++f) {
    out.store(glm::vec3(0, 0, 1));
    for (const uint32_t v : grid.face(f)) out.store(grid.vertex(v));
    out.store(uint16_t{0});
  }
}

void write_stl_ascii(Out& out, const Grid& grid) {
  out.print("solid grid\n");
  for (uint64_t f = 0; f < grid.face_count(); ++f) {
    out.print("  facet normal 0 0 1\n    outer loop\n");
    for (const uint32_t v : grid.face(f)) write_point(out, "      vertex ", grid.vertex(v));
    out.print("    endloop\n  endfacet\n");
  }
  out.print("endsolid grid\n");
}

void make_file(const Arguments& arguments) {
  static const std::map<std::string, void (*)(Out&, const Grid&)> kWriters = {
      {"ply", write_ply}, {"ply-ascii", write_ply_ascii}, {"stl", write_stl},
      {"obj", write_obj}, {"stl-ascii", write_stl_ascii}, {"off", write_off}};
  const auto writer = kWriters.find(arguments.format);
  if (writer == kWriters.end()) throw UsageError("--make " + arguments.format + ": no such format");
  Out out(arguments.files.at(0));
  writer->second(out, Grid(arguments.faces));
}

/// The process's largest resident memory since the last reset, in bytes; 0 if it is not known.
uint64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    uint64_t kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return 1024 * kilobytes;
  }
  return 0;
}

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// A hash of everything that readers promise to be the same.
uint64_t fingerprint(const Mesh& mesh) {
  uint64_t all = 0;
  const auto add = [&all](uint64_t word) { all = keyed_hash({1, 2}, std::array{all, word}); };
  for (const glm::dvec3& p : mesh.vertices) add(hash_position({3, 4}, p));
  for (const glm::uvec3& f : mesh.faces)
    add(keyed_hash({5, 6}, std::array<uint64_t, 3>{f.x, f.y, f.z}));
  for (const uint64_t count : {mesh.counts.unreferenced, mesh.counts.degenerate,
                               mesh.counts.duplicate, mesh.counts.polygons})
    add(count);
  return all;
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The longest time between two checks of one reader.
class Silence {
 public:
  void ask() {
    longest_ = std::max(longest_, seconds_since(last_));
    last_ = Clock::now();
  }
  double longest() const { return longest_; }

 private:
  Clock::time_point last_ = Clock::now();
  double longest_ = 0;
};

struct Run {
  double seconds = 0;
  double silence = 0;
  uint64_t peak = 0;
  uint64_t fingerprint = 0;
};

Run read_once(const std::vector<std::string>& files, size_t threads) {
  Run run;
  reset_peak_memory();
  const auto start = Clock::now();
  std::vector<std::future<Mesh>> reading;
  std::deque<Silence> silences(files.size());
  for (size_t i = 0; i < files.size(); ++i) {
    const auto policy = files.size() > 1 ? std::launch::async : std::launch::deferred;
    reading.push_back(std::async(policy, [&file = files[i], &silence = silences[i], threads] {
      const auto ask = [&silence] {
        silence.ask();
        return true;
      };
      Mesh mesh = read_mesh(file, {.keep_going = ask, .threads = threads});
      silence.ask();
      return mesh;
    }));
  }
  std::vector<Mesh> meshes;
  meshes.reserve(files.size());
  for (std::future<Mesh>& one : reading) meshes.push_back(one.get());
  run.seconds = seconds_since(start);
  for (const Silence& silence : silences) run.silence = std::max(run.silence, silence.longest());
  run.peak = peak_memory();
  for (const Mesh& mesh : meshes) run.fingerprint = 3 * run.fingerprint + fingerprint(mesh);
  return run;
}

/// Returns false if two runs gave different meshes.
bool time_files(const std::vector<std::string>& files, const Arguments& arguments) {
  double bytes = 0;
  for (const std::string& file : files)
    bytes += static_cast<double>(std::filesystem::file_size(file));
  std::map<size_t, std::vector<Run>> runs;
  for (int i = 0; i < arguments.runs; ++i) {
    for (const size_t threads : arguments.threads)
      runs[threads].push_back(read_once(files, threads));
  }
  bool same = true;
  for (auto& [threads, of_threads] : runs) {
    uint64_t peak = 0;
    double silence = 0;
    for (const Run& run : of_threads) {
      silence = std::max(silence, run.silence);
      same = same && run.fingerprint == runs.begin()->second[0].fingerprint;
      peak = std::max(peak, run.peak);
    }
    std::sort(of_threads.begin(), of_threads.end(),
              [](const Run& a, const Run& b) { return a.seconds < b.seconds; });
    const double least = of_threads.front().seconds,
                 median = of_threads[of_threads.size() / 2].seconds;
    std::printf("%s%s,%zu,%.0f,%.4f,%.4f,%.1f,%.2f,%.0f\n", files[0].c_str(),
                files.size() > 1 ? " and others" : "", threads, bytes, least, median,
                bytes / least / 1e6, static_cast<double>(peak) / bytes, 1000 * silence);
    std::fflush(stdout);
  }
  if (!same) std::fprintf(stderr, "vkh_bench: two runs gave different meshes\n");
  return same;
}

int run(const Arguments& arguments) {
  if (!arguments.format.empty()) {
    make_file(arguments);
    return 0;
  }
  std::printf("file,threads,bytes,least_s,median_s,mb_per_s,peak_over_bytes,silence_ms\n");
  if (arguments.together) return time_files(arguments.files, arguments) ? 0 : 1;
  bool same = true;
  for (const std::string& file : arguments.files) same = time_files({file}, arguments) && same;
  return same ? 0 : 1;
}

}  // namespace

Measure add_read(CLI::App& app) {
  const auto args = std::make_shared<Arguments>();
  app.add_option("FILE", args->files)->required();
  app.add_option("--threads", args->threads, "numbers of threads; 0: one a core")->delimiter(',');
  app.add_option("--runs", args->runs)->check(CLI::PositiveNumber);
  app.add_flag("--together", args->together, "all files at once");
  app.add_option("--make", args->format, "write a file of this format instead");
  app.add_option("--faces", args->faces, "of the file that is written");
  return [args] { return run(*args); };
}

}  // namespace vkh::bench
