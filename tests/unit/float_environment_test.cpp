// For any floating-point environment of the calling thread, the answers are the same to the last
// bit, and the caller finds that environment again, also within the callback.
#include "host/base/float_environment.h"

#include <cfenv>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/support/files.h"
#include "tests/support/solver_bench.h"
#include "tests/support/tally.h"
#include "vkhausdorff/mesh_io.h"

using namespace vkh;
using namespace vkh::test;

namespace {

struct Odd {
  const char* name;
  int rounding;
  bool flush;
};
#ifdef VKH_SSE
constexpr bool kCanFlush = true;
unsigned control() { return _mm_getcsr() & 0xffc0u; }        // without the exception flags
void set_control(unsigned control) { _mm_setcsr(control); }  // mingw-w64's fesetenv leaves it alone
void flush() { _mm_setcsr(_mm_getcsr() | 0x8040u); }
#else
constexpr bool kCanFlush = false;
unsigned control() { return 0; }
void set_control(unsigned) {}
void flush() {}
#endif

const std::vector<Odd>& odd_environments() {
  static const std::vector<Odd> all = {{"upward", FE_UPWARD, false},
                                       {"downward", FE_DOWNWARD, false},
                                       {"to zero", FE_TOWARDZERO, false},
                                       {"flushing", FE_TONEAREST, kCanFlush},
                                       {"flushing and upward", FE_UPWARD, kCanFlush}};
  return all;
}

struct State {
  int rounding, raised;
  unsigned control;
  bool operator==(const State&) const = default;
};
State state() { return {std::fegetround(), std::fetestexcept(FE_ALL_EXCEPT), control()}; }

/// Calls `work` in that environment, and returns whether it was left unchanged.
bool leaves_alone(const Odd& odd, const std::function<void()>& work) {
  std::fenv_t before;
  std::fegetenv(&before);
  const unsigned control_before = control();
  std::fesetround(odd.rounding);
  if (odd.flush) flush();
  std::feclearexcept(FE_ALL_EXCEPT);
  std::feraiseexcept(FE_DIVBYZERO);
  const State found = state();
  work();
  const bool same = state() == found;
  std::fesetenv(&before);
  set_control(control_before);
  return same;
}

Mesh tiny(double height) {
  return single_triangle({0, 0, height}, {1e-310, 0, height}, {0, 1e-310, height});
}

}  // namespace

TEST_CASE("runs in odd environments: the same bits, and the environment unchanged") {
  const std::vector<std::pair<Mesh, Mesh>> pairs = {
      {tiny(0), tiny(2.5e-311)},
      {translated(soup(1, 40), {0.1, 0.2, 0.3}), soup(2, 30)},
      {scaled(soup(3, 20), -1030), scaled(soup(4, 20), -1030)}};
  for (const auto& meshes : pairs) {
    const Mesh &a = meshes.first, &b = meshes.second;
    const Report normal = solver().distance(a, b);
    const SymmetricReport both = solver().symmetric(a, b);
    const PreparedMesh prepared = solver().prepare(b);
    const Report kept = solver().distance(a, prepared);
    CHECK(normal.upper > 0);
    for (const Odd& odd : odd_environments()) {
      CAPTURE(odd.name);
      Report r, again, with_prepared;
      SymmetricReport s;
      bool serves = false, gaps = false;
      CHECK(leaves_alone(odd, [&] { r = solver().distance(a, b); }));
      CHECK(leaves_alone(odd, [&] { s = solver().symmetric(a, b); }));
      CHECK(leaves_alone(odd, [&] {
        const PairView pair{a, b};
        again = solver().distances({&pair, 1})[0];
      }));
      CHECK(leaves_alone(odd, [&] { serves = solver().prepare(b).serves(a); }));
      CHECK(leaves_alone(odd, [&] { with_prepared = solver().distance(a, prepared); }));
      CHECK(leaves_alone(
          odd, [&] { gaps = r.gap() == normal.gap() && s.interval().gap == both.interval().gap; }));
      check_same(r, normal);
      check_same(again, normal);
      check_same(with_prepared, kept);
      check_same(s.a_to_b, both.a_to_b);
      check_same(s.b_to_a, both.b_to_a);
      CHECK(r.tolerance == normal.tolerance);
      CHECK(r.diagonal_a == normal.diagonal_a);
      CHECK(serves == prepared.serves(a));
      CHECK(gaps);
    }
  }
}

TEST_CASE("a device and its threads, made in an odd environment") {
  const Mesh a = soup(5, 40), b = soup(6, 30);
  const Report normal = solver().distance(a, b);
  for (const Odd& odd : odd_environments()) {
    CAPTURE(odd.name);
    Report r;
    CHECK(leaves_alone(odd, [&] {
      Device device(DeviceRequest{.selector = "cpu"});
      Solver other(device);
      other.make_ready();
      r = other.distance(a, b);
    }));
    if (test_device().description().type == "cpu") check_same(r, normal);
  }
}

TEST_CASE("the callback runs in the caller's environment; it may change that, and throw") {
  const Mesh a = soup(7, 40), b = soup(8, 30);
  for (const Odd& odd : odd_environments()) {
    CAPTURE(odd.name);
    State inside{}, found{};
    SolveOptions options;
    options.progress = [&](const Progress&) {
      inside = state();
      return true;
    };
    CHECK(leaves_alone(odd, [&] {
      found = state();
      solver().symmetric(a, b, options);
    }));
    CHECK(inside == found);
    options.progress = [&](const Progress&) -> bool { throw std::string("enough"); };
    CHECK(leaves_alone(odd, [&] {
      try {
        solver().distance(a, b, options);
      } catch (const std::string&) {
      }
    }));
    options.progress = [&](const Progress&) {
      std::fesetround(FE_UPWARD);
      return true;
    };
    int after = 0;
    leaves_alone(odd, [&] {
      solver().distance(a, b, options);
      after = std::fegetround();
    });
    CHECK(after == FE_UPWARD);
  }
}

TEST_CASE("files are read to the same bits") {
  const std::string path = folder() / "tiny.off";
  write_file(path,
             "OFF\n4 2 0\n1e-310 0.1 3e-320\n0.3 0.7 1e23\n-0.1 9007199254740993 4e-324\n"
             "1 1 2.2250738585072011e-308\n3 0 1 2\n3 0 1 3\n");
  const Mesh normal = read_mesh(path);
  CHECK(normal.vertices[0].x > 0);
  for (const Odd& odd : odd_environments()) {
    CAPTURE(odd.name);
    Mesh mesh;
    CHECK(leaves_alone(odd, [&] { mesh = read_mesh(path); }));
    CHECK(mesh.vertices == normal.vertices);
    CHECK(mesh.counts.degenerate == normal.counts.degenerate);
  }
}
