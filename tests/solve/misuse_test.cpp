// A caller may write anything into a vkh::Mesh, which is an open struct: the solver gives an
// answer, or an InputError that names the element.
#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "vkhausdorff/error.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

struct Misuse {
  const char* names;
  std::function<void(Mesh&)> spoil;
};

const std::vector<Misuse>& misuses() {
  static const std::vector<Misuse> all{
      {"vertex 7: (nan", [](Mesh& m) { m.vertices[7].x = kNan; }},
      {"vertex 3: ", [](Mesh& m) { m.vertices[3].z = -kInf; }},
      {"vertex 0: ", [](Mesh& m) { m.vertices[0].y = m.vertices[9].y = kInf; }},
      {"face 5: index 4294967295 of", [](Mesh& m) { m.faces[5].z = 0xffffffffu; }},
      {"face 0: index 50000000 of", [](Mesh& m) { m.faces[0].x = 50'000'000; }},
      {"face 2: index 42 of 42", [](Mesh& m) { m.faces[2].y = 42; }},
      {"face 0: there is no face", [](Mesh& m) { m.faces.clear(); }},
      {"of 0 vertices", [](Mesh& m) { m.vertices.clear(); }},
      {"face 0: there is no face", [](Mesh& m) { m = Mesh(), m.name = "ball"; }},
      {"delta: nan", [](Mesh& m) { m.delta = kNan; }},
      {"delta: -1", [](Mesh& m) { m.delta = -1; }},
      {"file_faces", [](Mesh& m) {
         m.file_faces = FileFaces({{1, 0}, {9, 0}});
       }}};
  return all;
}

std::string said(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

}  // namespace

TEST_CASE("a mesh that is none is named, whichever call it is given to") {
  const Mesh good = icosphere(1, 1);
  for (const Misuse& misuse : misuses()) {
    CAPTURE(misuse.names);
    Mesh bad = good;
    bad.name = "ball";
    misuse.spoil(bad);
    const auto check = [&](const std::function<void()>& call) {
      const std::string text = said(call);
      CAPTURE(text);
      CHECK(text.rfind("ball: ", 0) == 0);
      CHECK(text.find(misuse.names) != std::string::npos);
    };
    check([&] { solver().distance(bad, good); });
    check([&] { solver().distance(good, bad); });
    check([&] { solver().symmetric(bad, good); });
    check([&] { solver().prepare(bad); });
    const PreparedMesh prepared = solver().prepare(good);
    check([&] { solver().distance(bad, prepared); });
    const std::vector<PairView> pairs{{.a = good, .b = good}, {.a = good, .b = bad}};
    check([&] { solver().distances(pairs); });
  }
}

TEST_CASE("what looks odd and is a mesh gets an answer") {
  const Mesh good = icosphere(1, 1);
  Mesh odd = good;
  odd.vertices.push_back({50, 0, 0});  // no face uses it
  odd.counts = {};
  odd.name = "";
  const Report r = solver().distance(odd, good);
  CHECK(r.lower == 0);
  CHECK(r.upper < 1e-4);
  Mesh point = good;
  for (glm::dvec3& p : point.vertices) p = {3, 0, 0};
  const Report far = solver().distance(point, good);
  CHECK(far.lower <= 2.2);
  CHECK(far.upper >= 2);
}

TEST_CASE("the check costs little of what is done with a mesh") {
  if (std::getenv("VKH_TIMES") == nullptr) return;
  const Mesh large = icosphere(1, 9);
  using Clock = std::chrono::steady_clock;
  for (int i = 0; i < 3; ++i) {
    const auto start = Clock::now();
    check_mesh(large);
    const auto checked = Clock::now();
    const Report r = solver().distance(large, large);
    const auto ms = [](auto d) { return std::chrono::duration<double, std::milli>(d).count(); };
    MESSAGE(large.faces.size(), " faces: check ", ms(checked - start), " ms, upload ",
            r.times.upload_ms, " ms, wall ", r.times.wall_ms, " ms");
  }
}
