// Times the solver over a manifest of pairs in one live context: a warm-up, then repeats; one CSV
// row a pair and preset with medians. Correctness first: a pair that does not close, or whose
// repeats disagree, is marked and makes the exit code 1.
//
//   vkh_bench MANIFEST.csv [--filter TEXT] [--repeat N] [--tol T] [--device D] [--disable a,b]
//   [--max-faces N]
//             [--memory BYTES] [--time SECONDS] [--enable a,b] [--plain]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "host/mesh_io.h"
#include "host/solver.h"

namespace {

struct Row {
  std::string pair, file_a, file_b;
  uint64_t faces_a = 0;
};

struct Arguments {
  std::string manifest, filter, device;
  std::vector<std::string> disabled, enabled;
  bool plain = false;
  int repeat = 5;
  double tolerance = 1e-6, time_limit_s = 60;
  uint64_t max_faces = UINT64_MAX, memory_bytes = 0;
};

// One line of CSV; a quoted field may hold commas.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

std::vector<Row> read_manifest(const Arguments& args) {
  std::ifstream file(args.manifest);
  if (!file) throw std::runtime_error(args.manifest + ": cannot be opened");
  std::string line;
  std::getline(file, line);
  std::map<std::string, size_t> column;
  const std::vector<std::string> names = fields_of(line);
  for (size_t i = 0; i < names.size(); ++i) column[names[i]] = i;
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> f = fields_of(line);
    Row row{f.at(column.at("pair")), f.at(column.at("file_a")), f.at(column.at("file_b")),
            std::stoull(f.at(column.at("faces_a")))};
    if (row.faces_a <= args.max_faces && row.pair.find(args.filter) != std::string::npos)
      rows.push_back(row);
  }
  return rows;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

template <class F>
double median_of(const std::vector<vkh::Report>& reports, F value) {
  std::vector<double> values;
  for (const vkh::Report& r : reports) values.push_back(value(r));
  return median(values);
}

double stage_ms(const vkh::Report& r, const std::string& name) {
  for (const vkh::StageStats& s : r.stages) {
    if (s.name == name) return s.gpu_ms;
  }
  return 0;
}

constexpr const char* kStages[] = {"morton", "sort",   "hierarchy", "seed",    "plan",  "subdivide",
                                   "query",  "filter", "bound",     "witness", "report"};

void print_header(const vkh::Device& device, const Arguments& args) {
  std::printf("# device %s, driver %s, tolerance %g, repeat %d, disabled",
              device.description().name.c_str(), device.description().driver.c_str(),
              args.tolerance, args.repeat);
  for (const std::string& name : args.disabled) std::printf(" %s", name.c_str());
  std::printf("; enabled");
  for (const std::string& name : args.enabled) std::printf(" %s", name.c_str());
  if (args.plain) std::printf("; NOT CERTIFIED");
  std::printf(
      "\npair,faces_a,faces_b,status,lower,upper,gap,waves,candidates,queries,peak,load_ms,upload_"
      "ms,"
      "hierarchy_ms,solve_ms,gpu_ms,wall_ms");
  for (const char* stage : kStages) std::printf(",%s_ms", stage);
  std::printf("\n");
}

bool print_row(const Row& row, const std::vector<vkh::Report>& reports, double load_ms) {
  const vkh::Report& r = reports.back();
  bool same = true;
  for (const vkh::Report& other : reports)
    same = same && other.lower == r.lower && other.upper == r.upper;
  const double hierarchy =
      median_of(reports, [](const vkh::Report& x) { return x.times.hierarchy_ms; });
  const double solve = median_of(reports, [](const vkh::Report& x) { return x.times.solve_ms; });
  std::printf(
      "%s,%llu,%llu,%s%s,%.17g,%.17g,%.3g,%u,%llu,%llu,%llu,%.3f,%.3f,%.4f,%.4f,%.4f,%.3f",
      row.pair.c_str(), static_cast<unsigned long long>(r.mesh_a.faces),
      static_cast<unsigned long long>(r.mesh_b.faces), vkh::status_name(r.status),
      same ? "" : " UNREPEATABLE", r.lower, r.upper, r.gap(), r.waves,
      static_cast<unsigned long long>(r.candidates), static_cast<unsigned long long>(r.queries),
      static_cast<unsigned long long>(r.peak_frontier), load_ms,
      median_of(reports, [](const vkh::Report& x) { return x.times.upload_ms; }), hierarchy, solve,
      hierarchy + solve, median_of(reports, [](const vkh::Report& x) { return x.times.wall_ms; }));
  for (const char* stage : kStages) {
    std::printf(",%.4f",
                median_of(reports, [&](const vkh::Report& x) { return stage_ms(x, stage); }));
  }
  std::printf("\n");
  std::fflush(stdout);
  return same && r.status == vkh::Status::kClosed;
}

bool run_pair(vkh::Solver& solver, const Arguments& args, const Row& row) {
  const std::filesystem::path folder = std::filesystem::path(args.manifest).parent_path();
  const auto start = std::chrono::steady_clock::now();
  const vkh::Mesh a = vkh::read_mesh(folder / row.file_a);
  const vkh::Mesh b = vkh::read_mesh(folder / row.file_b);
  const double load_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  vkh::SolveOptions options;
  options.tolerance = args.tolerance;
  options.disabled = args.disabled;
  options.enabled = args.enabled;
  options.certified = !args.plain;
  options.time_limit_s = args.time_limit_s;
  options.memory_bytes = args.memory_bytes;
  solver.distance(a, b, options);  // warm-up
  std::vector<vkh::Report> reports;
  for (int i = 0; i < args.repeat; ++i) reports.push_back(solver.distance(a, b, options));
  return print_row(row, reports, load_ms);
}

int run(const Arguments& args) {
  vkh::Device device({.selector = args.device, .validation = false});
  vkh::Solver solver(device);
  print_header(device, args);
  int bad = 0;
  for (const Row& row : read_manifest(args)) bad += run_pair(solver, args, row) ? 0 : 1;
  std::printf("# %d pairs not closed or not repeatable\n", bad);
  return bad == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("vkh_bench: the solver's times over a manifest of pairs");
  Arguments args;
  app.add_option("manifest", args.manifest)->required();
  app.add_option("--filter", args.filter);
  app.add_option("--repeat", args.repeat)->check(CLI::PositiveNumber);
  app.add_option("--tol", args.tolerance);
  app.add_option("--device", args.device);
  app.add_option("--disable", args.disabled)->delimiter(',');
  app.add_option("--enable", args.enabled)->delimiter(',');
  app.add_flag("--plain", args.plain, "nothing certified: what the certificate costs");
  app.add_option("--max-faces", args.max_faces);
  app.add_option("--memory", args.memory_bytes);
  app.add_option("--time", args.time_limit_s);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(args);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "vkh_bench: %s\n", e.what());
    return 2;
  }
}
