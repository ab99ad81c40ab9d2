// Checks a certificate file against the two meshes that it is about, in exact arithmetic.
// docs/certificate-file.md has the statement and the proof. In the order of the argument:
//   exact.h        squared distances of points to triangles, as fractions of integers
//   certificate.h  the file's bytes: faces of X, halved to leaves, and a triangle of Y for each
//   polygons.h     how the corners came from the file, where it has polygons
//   placing.h      where the corners were put: another unit, a matrix
//   proof.h        upper: every corner of a leaf is near enough; lower: the witness is far enough
//   this file      whether the meshes are those of the certificate; what is printed
#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "check/polygons.h"
#include "host/base/decimal.h"
#include "host/base/input_file.h"
#include "host/base/output_file.h"
#include "host/base/system.h"
#include "host/read/corners_hash.h"
#include "host/read/file_mesh_builder.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/sha256.h"

namespace vkh::check {
namespace {

enum Exit { kProven = 0, kRefused = 1, kUsage = 2, kBroken = 4, kNotWritten = 6 };
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string certificate, mesh[2];
  std::vector<std::string> corners;  ///< the files to write them to: A's and B's, or none
  size_t threads = thread_count();
  bool is_quiet = false;
};

std::vector<unsigned char> read_file(const std::string& name) {
  const InputFile input(path_of(name));
  if (!input.is_open()) throw Broken("cannot be read");
  std::vector<unsigned char> out(input.size());
  if (input.read(0, reinterpret_cast<char*>(out.data()), out.size()) != out.size())
    throw Broken("cannot be read to its end");
  return out;
}

/// Whether the reader's delta, as long as it is where the mesh was put, is within the
/// certificate's.
bool is_as_exact(const Certificate& certificate, size_t which, const Mesh& mesh) {
  const double delta = certificate.delta[which];
  const int e = std::min({exponent_of(mesh.delta), exponent_of(delta), 0});
  const Z is = integer(mesh.delta, e), allowed = integer(delta, e);
  const Fraction growth = PlacedMesh(mesh, certificate.read[which].placement).squared_growth();
  return is * is * growth.numerator <= allowed * allowed * growth.denominator;
}

/// Reads the mesh, if it is the certificate's.
Mesh read(const Certificate& certificate, size_t which, const std::string& name) {
  const auto expect = [&](bool is_so, const char* otherwise) {
    if (!is_so) throw Refused(name + otherwise);
  };
  // Version 1 does not state how polygons became triangles: the hash of their corners shows it.
  ReadLimits limits{.odd_polygons = OddPolygons::kFanned};
  const Description& how = certificate.read[which];
  if (certificate.version > 1) limits.triangulate = GivenPolygons(how.polygons, name);
  if (how.has_all_bodies) limits.bodies = Bodies::kAll;
  limits.points = how.are_points;
  const auto expect_file = [&] {
    const std::string& file = certificate.file[which];
    expect(file.empty() || sha256_of(path_of(name), [] { return true; }) == file,
           ": is another file (SHA-256)");
  };
  const auto read_it = [&] {
    try {
      return read_mesh(path_of(name), limits);
    } catch (const Refused&) {  // over polygons, but another file has others
      expect_file();
      throw;
    }
  };
  Mesh mesh = read_it();
  expect(certificate.version == 1 || mesh.polygons.triangulations.size() == how.polygons.size(),
         ": has no such polygons");
  expect(mesh.faces.size() == certificate.faces[which], ": has another number of faces");
  expect_file();
  expect(sha256_of_corners(mesh) == certificate.corners[which], ": has other corners (SHA-256)");
  expect(is_as_exact(certificate, which, mesh), ": is read less exactly than delta says");
  return mesh;
}

/// Prints the progress, every ten seconds.
class Progress {
 public:
  Progress(uint64_t faces, bool is_quiet) : faces_(faces), is_quiet_(is_quiet) {}
  void face_done() {
    const uint64_t done = ++done_;
    const int64_t now = (Clock::now() - start_) / std::chrono::seconds(10);
    int64_t told = told_;
    if (is_quiet_ || now <= told || !told_.compare_exchange_strong(told, now)) return;
    std::fprintf(stderr, "%.1f %%\n",
                 100 * static_cast<double>(done) / static_cast<double>(faces_));
  }

 private:
  const uint64_t faces_;
  const bool is_quiet_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<uint64_t> done_ = 0;
  std::atomic<int64_t> told_ = 0;
};

/// The square root as a decimal of some twenty digits, rounded up or down.
std::string root(Fraction square, bool is_up) {
  if (square.numerator == 0) return "0";
  const auto bits = [](const Z& z) {
    return static_cast<int64_t>(mpz_sizeinbase(z.get_mpz_t(), 2));
  };
  const int64_t places = 20 - (bits(square.numerator) - bits(square.denominator)) * 3 / 20;
  Z power;
  mpz_ui_pow_ui(power.get_mpz_t(), 100, static_cast<unsigned long>(std::abs(places)));
  (places > 0 ? square.numerator : square.denominator) *= power;
  const Z whole = square.numerator / square.denominator;
  Z digits_root = sqrt(whole);
  const bool is_exact = digits_root * digits_root * square.denominator == square.numerator;
  if (is_up && !is_exact) ++digits_root;
  std::string digits = digits_root.get_str();
  const int64_t exponent = static_cast<int64_t>(digits.size()) - 1 - places;
  digits.erase(digits.find_last_not_of('0') + 1);
  return digits.insert(1, digits.size() > 1 ? "." : "") + "e" + std::to_string(exponent);
}

/// A squared distance in the answer's unit.
Fraction length(Fraction square, const Question& question) {
  square.denominator *= question.scale * question.scale;
  return scaled(std::move(square), question.unit);
}

/// Throws Refused, or returns what was proven: the answer, and how.
std::array<std::string, 2> check_direction(const Question& question,
                                           const std::array<double, 2>& delta,
                                           const std::string& name) {
  const Direction& claim = question.claim;
  const Fraction most = squared_claim(claim.upper, -1, delta, question);
  const Fraction least = squared_claim(claim.lower, 1, delta, question);
  const Fraction upper = largest_of_leaves(question, most);
  Fraction lower;
  if (claim.lower > 0) {
    uint64_t nearest = 0;
    lower = distance_of_witness(question, nearest);
    if (lower < least)
      throw Refused("the witness is nearer than lower to triangle " + std::to_string(nearest));
  }
  std::string how = "  at best, of the corners as given: " + root(length(lower, question), false) +
                    " <= " + name + " <= " + root(length(upper, question), true) + "\n";
  how += "  " + std::to_string(question.x.faces()) + " faces, " + std::to_string(claim.leaves) +
         " leaves, " + std::to_string(claim.cut) + " of them cut\n";
  return {"proven: " + decimal(claim.lower, kJsonDigits, Rounding::kDown) + " <= " + name +
              " <= " + decimal(claim.upper, kJsonDigits, Rounding::kUp) + "\n",
          how};
}

/// Prints for people where a mesh was put. The matrix is part of what is proven.
std::string described(const std::string& name, const Placement& placement) {
  std::string out;
  if (placement.numerator != placement.denominator)
    out += name + "in another unit, times " + shortest_decimal(placement.numerator) + "/" +
           shortest_decimal(placement.denominator) + "\n";
  for (size_t i = 0; i < 3 && placement.has_matrix; ++i) {
    out += name + "by the matrix's row";
    for (const double entry : placement.matrix[i]) out += " " + shortest_decimal(entry);
    out += "\n";
  }
  return out;
}

/// Prints for people how a mesh was read: placement, bodies, polygons, ambiguity.
std::string described(const Certificate& certificate, size_t which) {
  const Description& read = certificate.read[which];
  const auto fans = static_cast<size_t>(
      std::count_if(read.polygons.begin(), read.polygons.end(),
                    [](const Triangulation& t) { return t.axis == Triangulation::kOnlyFan; }));
  const std::string name = which == 0 ? "  A: " : "  B: ";
  std::string out;
  out += described(name, read.placement);
  if (read.are_points) out += name + "points alone, no surface\n";
  if (read.has_all_bodies) out += name + "all shapes of a scene, whether they are printed or not\n";
  if (read.polygons.size() > fans)
    out += name + counted(read.polygons.size() - fans, "polygon") + ", tiled by triangles\n";
  if (fans > 0)
    out += name + counted(fans, "polygon") + " as a fan of corners, whatever that covers\n";
  if (read.ambiguity > 0) {
    out += name + "stated, not proven: another triangulation is at most " +
           decimal(read.ambiguity, kJsonDigits, Rounding::kUp) + " away, at face " +
           std::to_string(read.ambiguous_face) + "\n";
  }
  return out;
}

/// Writes the corners of both meshes for check/proofs, whose theorem begins with them.
void write_corners(const Arguments& arguments, const Mesh* mesh) {
  const std::vector<std::string> inputs = {arguments.certificate, arguments.mesh[0],
                                           arguments.mesh[1]};
  for (const size_t which : {0U, 1U}) {
    const OutputFile output("--corners", arguments.corners[which], inputs);
    output.write(corner_bytes(mesh[which], 0, mesh[which].faces.size()));
  }
  std::printf("corners written; nothing is proven yet\n");
}

void check_all(const Arguments& arguments) {
  const Clock::time_point start = Clock::now();
  const std::vector<unsigned char> file = read_file(arguments.certificate);
  const Certificate certificate = read_certificate(file);
  const Mesh mesh[] = {read(certificate, 0, arguments.mesh[0]),
                       read(certificate, 1, arguments.mesh[1])};
  if (!arguments.corners.empty()) return write_corners(arguments, mesh);
  const PlacedMesh placed[] = {{mesh[0], certificate.read[0].placement},
                               {mesh[1], certificate.read[1].placement}};
  const int unit = std::min(placed[0].exponent(), placed[1].exponent());
  const Z scale = placed[0].denominator() * placed[1].denominator();
  std::string answer, how;
  for (size_t x = 0; x < certificate.directions.size(); ++x) {
    const std::string name = x == 0 ? "h(A,B)" : "h(B,A)";
    Progress progress(certificate.faces[x], arguments.is_quiet);
    const Question question{file,
                            certificate.directions[x],
                            placed[x],
                            placed[1 - x],
                            unit,
                            scale,
                            arguments.threads,
                            [&] { progress.face_done(); }};
    try {
      const auto proven = check_direction(question, certificate.delta, name);
      answer += proven[0];
      how += proven[1];
    } catch (const Refused& refused) {
      throw Refused(name + ": " + refused.what());
    }
  }
  std::printf("%s", answer.c_str());
  if (arguments.is_quiet) return;
  const auto spent = std::chrono::duration<double>(Clock::now() - start).count();
  for (const size_t which : {0U, 1U}) how += described(certificate, which);
  std::printf("%s  %zu bytes checked in %.2f s\n", how.c_str(), file.size(), spent);
  std::printf("  trusted: the readers of meshes, GMP %s, SHA-256, the compiler, this program\n",
              gmp_version);
}

int complain(const std::string& what, Exit code) {
  std::string line = what;
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::fprintf(stderr, "vkh_check: %s\n", line.c_str());
  return code;
}

int run(const std::vector<std::string>& words) {
  Arguments arguments;
  CLI::App app("Checks a certificate of the distance of two meshes, exactly.", "vkh_check");
  app.add_option("CERTIFICATE", arguments.certificate)->required();
  app.add_option("A", arguments.mesh[0])->required();
  app.add_option("B", arguments.mesh[1])->required();
  app.add_option("--corners", arguments.corners,
                 "Only write the corners of A and B to these two files, for vkh_check_proven")
      ->expected(2);
  app.add_option("--threads", arguments.threads, "One a core")->check(CLI::Range(1, 1024));
  app.add_flag("--quiet", arguments.is_quiet, "The answer alone, and no progress");
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    check_all(arguments);
    return std::fflush(stdout) == 0 ? kProven : complain("cannot write the answer", kNotWritten);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return complain(error.what() + std::string("; --help says more"), kUsage);
  } catch (const Refused& refused) {
    return complain(std::string("refused: ") + refused.what(), kRefused);
  } catch (const Broken& broken) {
    return complain(arguments.certificate + ": " + broken.what(), kBroken);
  } catch (const UsageError& error) {  // over --corners
    return complain(error.what(), kUsage);
  } catch (const OutputError& error) {
    return complain(error.what(), kNotWritten);
  } catch (const std::exception& error) {  // an error in a mesh, mostly, or no memory
    return complain(error.what(), kBroken);
  }
}

}  // namespace
}  // namespace vkh::check

int main(int argc, char** argv) {
  const vkh::Console console;
  return vkh::check::run(vkh::command_line(argc, argv));
}
