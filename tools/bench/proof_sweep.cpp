#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <map>
#include <random>

#include "tests/shapes/hard_pairs.h"
#include "tools/bench/sweep.h"
#include "vkhausdorff/certificate.h"
#include "vkhausdorff/sha256.h"
#include "vkhausdorff/solver.h"

namespace vkh::bench {
namespace {

using namespace vkh::test;

struct Totals {
  uint64_t certificates = 0, refused = 0, raised = 0;
  uint64_t leaves = 0, cut = 0, bytes = 0;
  std::map<std::string, uint64_t> ended;
};

using Count = unsigned long long;

/// OFF, which every checker reads, with as many digits as a double needs: read back as it is.
void write_off(const std::filesystem::path& path, const Mesh& mesh) {
  std::ofstream out(path);
  out << std::setprecision(17) << "OFF\n"
      << mesh.vertices.size() << ' ' << mesh.faces.size() << " 0\n";
  for (const glm::dvec3& v : mesh.vertices) out << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const glm::uvec3& f : mesh.faces) out << "3 " << f.x << ' ' << f.y << ' ' << f.z << '\n';
}

/// The options of the run of pair i.
struct Way {
  SolveOptions options;
  bool symmetric = false;
  uint64_t proof_turns = UINT64_MAX;  ///< after which the proof is cancelled
};

/// Without some switches, parts of two surfaces that are equally far everywhere are split forever.
constexpr double kMostSeconds = 10;

/// Each set of switches has pipelines of its own, which some drivers take a second to compile.
constexpr uint64_t kSets = 20;

/// Every preset, and the default without one switch. Every family meets every set.
void choose_set(SolveOptions& options, uint64_t i, size_t families) {
  const std::vector<std::string> presets = preset_names(), switches = switch_names();
  const uint64_t set = (i + i / families) % kSets;
  if (set < presets.size()) {
    options.engine.preset = presets[set];
  } else {
    options.engine.disabled = {switches[(set - presets.size()) % switches.size()]};
  }
}

Way way_of(uint64_t i, const HardPair& hard, bool is_native) {
  Way way;
  SolveOptions& o = way.options;
  o.tolerance = hard.tolerance;
  o.time_limit_s = kMostSeconds;
  if (!is_native) choose_set(o, i, family_names().size());
  if (i % 5 == 2) o.memory_bytes = 1;  // as little as will do
  if (i % 7 == 3) o.wave_limit = static_cast<uint32_t>(i / 7 % 4 + 1);
  if (i % 11 == 5) o.time_limit_s = 1e-3;
  if (i % 13 == 7) o.tolerance = 1e-9;
  if (i % 17 == 9 && hard.exact) {
    const double limit = *hard.exact * (i % 2 == 0 ? 0.7 : 1.5);
    o.limit = {limit, limit};
  }
  way.symmetric = i % 3 == 1;
  if (i % 19 == 11) way.proof_turns = i / 19 % 4;
  return way;
}

struct Files {
  std::filesystem::path a, b, certificate;
};

class Sweep {
 public:
  Sweep(Swept& swept, const SweepOptions& args, const std::filesystem::path& folder)
      : swept_(swept),
        solver_(swept.solver()),
        args_(args),
        files_{folder / "a.off", folder / "b.off", folder / "ab.vhc"},
        given_(" '" + files_.certificate.string() + "' '" + files_.a.string() + "' '" +
               files_.b.string() + "' >'" + (folder / "said").string() + "' 2>&1") {}

  void pair(uint64_t i) {
    const size_t families = family_names().size();
    const HardPair hard = hard_pair(i % families, args_.seed * 1000003 + i);
    const Way way = way_of(i, hard, swept_.is_native());
    const Mesh &a = hard.pair.a, &b = hard.pair.b;
    write_off(files_.a, a);
    write_off(files_.b, b);
    const std::string certificate =
        way.symmetric ? of_both(a, b, way) : of_one(a, b, solver_.distance(a, b, way.options), way);
    if (certificate.empty()) return;
    std::ofstream(files_.certificate, std::ios::binary) << certificate;
    ++totals_.certificates;
    totals_.bytes += certificate.size();
    for (const std::string& checker : args_.checks) {
      const int code = std::system((checker + given_).c_str());
      if (code == 0) continue;
      ++totals_.refused;
      std::printf("NOT ACCEPTED pair %llu (%s, %s), %s, code %d\n", static_cast<Count>(i),
                  family_names()[i % families].c_str(), way.symmetric ? "both ways" : "one way",
                  checker.c_str(), code);
    }
  }

  const Totals& totals() const { return totals_; }

 private:
  CertifiedMesh hashed(const Mesh& mesh, const std::filesystem::path& file) const {
    return {mesh, sha256_of(file, [] { return true; })};
  }

  Proof prove_one(const Mesh& a, const Mesh& b, const Report& report, const Way& way) {
    uint64_t turns = 0;
    Proof proof = prove(
        solver_, {a, b, report, way.options, [&](size_t) { return turns++ < way.proof_turns; }});
    ++totals_.ended[status_name(report.status)];
    totals_.leaves += proof.leaves;
    totals_.cut += proof.cut_leaves;
    totals_.raised += proof.upper > report.upper;
    proof.upper *= 1 - args_.spoil;
    return proof;
  }

  std::string of_one(const Mesh& a, const Mesh& b, const Report& report, const Way& way) {
    if (!std::isfinite(report.upper)) return {};
    const Proof proof = prove_one(a, b, report, way);
    return certificate_of(hashed(a, files_.a), hashed(b, files_.b), {report, proof}, {});
  }

  std::string of_both(const Mesh& a, const Mesh& b, const Way& way) {
    const SymmetricReport both = solver_.symmetric(a, b, way.options);
    if (!std::isfinite(both.a_to_b.upper + both.b_to_a.upper)) return {};
    const Proof there = prove_one(a, b, both.a_to_b, way);
    const Proof back = prove_one(b, a, both.b_to_a, way);
    return certificate_of(hashed(a, files_.a), hashed(b, files_.b), {both.a_to_b, there},
                          CertifiedDirection{both.b_to_a, back});
  }

  const Swept& swept_;
  Solver& solver_;
  const SweepOptions& args_;
  Files files_;
  std::string given_;  ///< to a checker: the files, and where its words go
  Totals totals_;
};

/// A folder of this process's own.
std::filesystem::path new_folder(const SweepOptions& args) {
  std::random_device random;
  for (;;) {
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() /
        ("vkh_proof_sweep_" + std::to_string(args.seed) + "_" + std::to_string(random()));
    if (std::filesystem::create_directories(folder)) return folder;
  }
}

/// Prints the progress, at most every ten seconds.
class Pulse {
 public:
  void operator()(uint64_t done, const SweepOptions& args) {
    const Clock::time_point now = Clock::now();
    if (now < last_ + std::chrono::seconds(10)) return;
    last_ = now;
    std::fprintf(stderr, "%llu of %llu pairs\n", static_cast<Count>(done),
                 static_cast<Count>(args.count));
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

int sweep_proofs(const SweepOptions& args) {
  const std::filesystem::path folder = new_folder(args);
  Swept swept(args.device);
  Solver& solver = swept.solver();
  Sweep all(swept, args, folder);
  Pulse pulse;
  for (uint64_t i = 0; i < args.count; ++i) {
    all.pair(args.first + i);
    pulse(i + 1, args);
  }
  std::filesystem::remove_all(folder);
  const Totals& t = all.totals();
  std::printf(
      "proof sweep: %llu certificates of %llu pairs (seed %llu, from %llu) on %s: %llu not "
      "accepted; %llu leaves, %llu of them cut, %llu bytes, %llu directions raised; ended",
      static_cast<Count>(t.certificates), static_cast<Count>(args.count),
      static_cast<Count>(args.seed), static_cast<Count>(args.first),
      solver.description().name.c_str(), static_cast<Count>(t.refused),
      static_cast<Count>(t.leaves), static_cast<Count>(t.cut), static_cast<Count>(t.bytes),
      static_cast<Count>(t.raised));
  for (const auto& [name, count] : t.ended)
    std::printf(" %s %llu", name.c_str(), static_cast<Count>(count));
  std::printf("\n");
  return t.refused > 0 ? 1 : 0;
}

}  // namespace vkh::bench
