// Checks a certificate file against the two meshes that it is about, in exact arithmetic. What is
// proven, and why this proves it, is in docs/certificate-file.md. In the order of the argument:
//   exact.h        squared distances of points to triangles, as fractions of integers
//   certificate.h  the file's bytes: faces of X, halved to leaves, and a triangle of Y for each
//   proof.h        upper: every corner of a leaf is near enough; lower: the witness is far enough
//   this page      whether the meshes are those that the file is of; what is printed
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "check/proof.h"
#include "host/base/decimal.h"
#include "host/read/mesh_io.h"
#include "host/system/input_file.h"
#include "host/system/sha256.h"
#include "host/system/system.h"

namespace vkh::check {
namespace {

enum Exit { kProven = 0, kRefused = 1, kUsage = 2, kBroken = 4, kNotWritten = 6 };
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string certificate, mesh[2];
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

/// SHA-256 of nine doubles a face, little-endian.
std::string hash_of_corners(const Mesh& mesh) {
  std::vector<char> piece;
  size_t face = 0;
  return sha256_of_pieces([&] {
    piece.clear();
    for (; face < mesh.faces.size() && piece.size() < size_t{1} << 20; ++face) {
      for (int i = 0; i < 9; ++i) {
        const double value = mesh.vertices[mesh.faces[face][i / 3]][i % 3];
        const auto bits = value == 0 ? 0 : std::bit_cast<uint64_t>(value);
        for (int byte = 0; byte < 8; ++byte)
          piece.push_back(static_cast<char>(bits >> (8 * byte) & 255));
      }
    }
    return std::string_view(piece.data(), piece.size());
  });
}

/// The mesh, if it is that which the certificate is of.
Mesh read(const Certificate& certificate, size_t which, const std::string& name) {
  Mesh mesh = read_mesh(path_of(name));
  const auto expect = [&](bool is_so, const char* otherwise) {
    if (!is_so) throw Refused(name + otherwise);
  };
  const std::string& file = certificate.file[which];
  expect(mesh.faces.size() == certificate.faces[which], ": has another number of faces");
  expect(file.empty() || sha256_of(path_of(name), [] { return true; }) == file,
         ": is another file (SHA-256)");
  expect(hash_of_corners(mesh) == certificate.corners[which], ": has other corners (SHA-256)");
  expect(mesh.delta <= certificate.delta[which], ": is read less exactly than delta says");
  return mesh;
}

/// How far it is: on a terminal four times a second, elsewhere every ten seconds.
class Progress {
 public:
  Progress(uint64_t faces, bool is_quiet) : faces_(faces), is_quiet_(is_quiet) {}
  void face_done() {
    const uint64_t done = ++done_;
    if (is_quiet_ || done % 64 != 0) return;
    const int64_t now = (Clock::now() - start_) / std::chrono::milliseconds(1);
    int64_t due = due_;
    if (now < due || !due_.compare_exchange_strong(due, now + (is_terminal_ ? 250 : 10000))) return;
    std::fprintf(stderr, is_terminal_ ? "\r%.1f %%" : "%.1f %%\n",
                 100 * static_cast<double>(done) / static_cast<double>(faces_));
  }
  ~Progress() {
    if (is_terminal_ && !is_quiet_) std::fputs("\r       \r", stderr);
  }

 private:
  const uint64_t faces_;
  const bool is_quiet_, is_terminal_ = is_error_terminal();
  const Clock::time_point start_ = Clock::now();
  std::atomic<uint64_t> done_ = 0;
  std::atomic<int64_t> due_ = is_terminal_ ? 0 : 10000;
};

std::string text_of(const Z& z) {
  std::string out(mpz_sizeinbase(z, 10) + 2, '\0');
  mpz_get_str(out.data(), 10, z);
  out.resize(std::strlen(out.data()));
  return out;
}

/// "N/D" in lowest terms.
std::string text_of(const Fraction& fraction) {
  Fraction lowest = fraction;
  Z common;
  mpz_gcd(common, fraction.numerator, fraction.denominator);
  mpz_divexact(lowest.numerator, fraction.numerator, common);
  mpz_divexact(lowest.denominator, fraction.denominator, common);
  return text_of(lowest.numerator) + "/" + text_of(lowest.denominator);
}

/// The square of a claim and the deltas, their doubles in hexadecimal.
std::string text_of(double claim, const char* sign, const std::array<double, 2>& delta) {
  std::string out = "(" + hex_float(claim);
  for (const double d : delta) out += d > 0 ? sign + hex_float(d) : "";
  return out + ")^2";
}

/// The square root as a decimal of some twenty digits, rounded up or down.
std::string root(Fraction square, bool is_up) {
  if (sign(square.numerator) == 0) return "0";
  const auto bits = [](const Z& z) { return static_cast<int64_t>(mpz_sizeinbase(z, 2)); };
  const int64_t places = 20 - (bits(square.numerator) - bits(square.denominator)) * 3 / 20;
  Z root, rest;
  mpz_ui_pow_ui(root, 100, static_cast<unsigned long>(std::abs(places)));
  Z& part = places > 0 ? square.numerator : square.denominator;
  mpz_mul(part, part, root);
  (is_up ? mpz_cdiv_q : mpz_fdiv_q)(square.numerator, square.numerator, square.denominator);
  mpz_sqrtrem(root, rest, square.numerator);
  if (is_up && sign(rest) != 0) mpz_add_ui(root, root, 1);
  std::string digits = text_of(root);
  const int64_t exponent = static_cast<int64_t>(digits.size()) - 1 - places;
  digits.erase(digits.find_last_not_of('0') + 1);
  return digits.insert(1, digits.size() > 1 ? "." : "") + "e" + std::to_string(exponent);
}

/// Throws Refused, or returns what was proven: the answer, and how.
std::array<std::string, 2> check_direction(const Question& question,
                                           const std::array<double, 2>& delta,
                                           const std::string& name) {
  const Direction& claim = question.claim;
  const Fraction most = squared_claim(claim.upper, -1, delta, question.unit);
  const Fraction least = squared_claim(claim.lower, 1, delta, question.unit);
  Fraction upper = largest_of_leaves(question, most), lower;
  if (claim.lower > 0) {
    uint64_t nearest = 0;
    lower = distance_of_witness(question, nearest);
    if (compare(lower, least) < 0)
      throw Refused("the witness is nearer than lower to triangle " + std::to_string(nearest));
  }
  const std::string unit = " 4^" + std::to_string(question.unit);
  std::string how = "  exactly: ";
  if (claim.lower > 0)
    how += text_of(claim.lower, " + ", delta) + " <= " + text_of(lower) + unit + " (witness); ";
  how += text_of(upper) + unit + " (leaves) <= " + text_of(claim.upper, " - ", delta) + "\n";
  for (Fraction* fraction : {&lower, &upper}) scale(*fraction, question.unit);
  how = "  at best, of the corners as given: " + root(lower, false) + " <= " + name +
        " <= " + root(upper, true) + "\n" + how;
  how += "  " + std::to_string(question.x.faces.size()) + " faces, " +
         std::to_string(claim.leaves) + " leaves, " + std::to_string(claim.cut) +
         " of them cut, halved up to " + std::to_string(claim.deepest) + " times\n";
  return {"proven: " + decimal(claim.lower, kJsonDigits, Rounding::kDown) + " <= " + name +
              " <= " + decimal(claim.upper, kJsonDigits, Rounding::kUp) + "\n",
          how};
}

void check_all(const Arguments& arguments) {
  const Clock::time_point start = Clock::now();
  const std::vector<unsigned char> file = read_file(arguments.certificate);
  const Certificate certificate = read_certificate(file);
  const Mesh mesh[] = {read(certificate, 0, arguments.mesh[0]),
                       read(certificate, 1, arguments.mesh[1])};
  const int unit = common_exponent(mesh[0], mesh[1]);
  std::string answer, how;
  for (size_t x = 0; x < certificate.directions.size(); ++x) {
    const std::string name = x == 0 ? "h(A,B)" : "h(B,A)";
    Progress progress(certificate.faces[x], arguments.is_quiet);
    const Question question{
        file, certificate.directions[x], mesh[x], mesh[1 - x], unit, arguments.threads, [&] {
          progress.face_done();
        }};
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
  } catch (const std::exception& error) {  // of a mesh, mostly, or no memory
    return complain(error.what(), kBroken);
  }
}

}  // namespace
}  // namespace vkh::check

int main(int argc, char** argv) {
  const vkh::Console console;
  return vkh::check::run(vkh::command_line(argc, argv));
}
