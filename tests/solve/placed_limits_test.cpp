// Limits as shares of the diagonal of an A that was moved: each verdict against exact rationals, at
// limits as near to the distance as the deltas are. VKH_PLACED_LIMITS for more.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>

#include "host/answer/asked_pair.h"
#include "tests/files/gltf_document.h"
#include "tests/files/las_file.h"
#include "tests/files/stored_zip.h"
#include "tests/shapes/adversarial.h"
#include "tests/shapes/shapes.h"
#include "tests/support/decimal_value.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/exact.h"
#include "vkhausdorff/place.h"

namespace {

using namespace vkh;
using namespace vkh::test;

using Exact = std::array<Rational, 3>;

/// An A as the program holds it, and where its corners are in exact arithmetic.
struct Placed {
  std::string how;
  Mesh mesh;
  std::vector<Exact> exact;
};

std::string digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

Exact exact_of(const DVec3& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }

Exact moved(const MatrixRows& rows, const Exact& p) {
  Exact out;
  for (size_t r = 0; r < 3; ++r) {
    out[r] = Rational(rows[r][3]);
    for (size_t c = 0; c < 3; ++c) out[r] += Rational(rows[r][c]) * p[c];
  }
  return out;
}

Rational square_between(const Exact& p, const Exact& q) {
  Rational sum = 0;
  for (size_t i = 0; i < 3; ++i) sum += (p[i] - q[i]) * (p[i] - q[i]);
  return sum;
}

Rational squared_diagonal(const std::vector<Exact>& corners) {
  Rational sum = 0;
  for (size_t i = 0; i < 3; ++i) {
    Rational least = corners[0][i], most = corners[0][i];
    for (const Exact& corner : corners) {
      least = std::min(least, corner[i]);
      most = std::max(most, corner[i]);
    }
    sum += (most - least) * (most - least);
  }
  return sum;
}

double log_size(Random& random, double low, double high) {
  return std::pow(10, random.range(std::log10(low), std::log10(high)));
}

std::vector<DVec3> random_points(Random& random, double size, double far) {
  const DVec3 centre = {random.range(-far, far), random.range(-far, far), random.range(-far, far)};
  std::vector<DVec3> points(3 + random.below(6));
  for (DVec3& p : points)
    p = centre + size * DVec3(random.range(-1, 1), random.range(-1, 1), random.range(-1, 1));
  return points;
}

/// A rotation by a random quaternion, its entries rounded, and a shift.
MatrixRows random_matrix(Random& random, double shift) {
  double q[4], square = 0;
  for (double& part : q) {
    part = random.range(-1, 1);
    square += part * part;
  }
  const auto [x, y, z, w] = std::array{q[0], q[1], q[2], q[3]};
  const double s = 2 / square;
  MatrixRows rows = {{{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), 0},
                      {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w), 0},
                      {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y), 0}}};
  for (auto& row : rows) row[3] = random.range(-shift, shift);
  return rows;
}

/// Where the exact corners of a mesh of points are after place(): by the unit, then the matrix.
std::vector<Exact> placed_exactly(const Mesh& mesh, const MeshTransform& by) {
  std::vector<Exact> out;
  for (const DVec3& v : mesh.vertices) {
    Exact p = exact_of(v);
    for (Rational& x : p) x *= Rational(by.numerator) / Rational(by.denominator);
    out.push_back(by.matrix ? moved(*by.matrix, p) : p);
  }
  return out;
}

Placed placed_by(Random& random, const std::string& how, const Question& question) {
  const double size = log_size(random, 1e-2, 1e3), far = log_size(random, 1, 1e9);
  Placed a{how, make_points("A", random_points(random, size, far)), {}};
  const Mesh before = a.mesh;
  place_a(question, a.mesh, before);
  a.exact = placed_exactly(before, a.mesh.placed->by);
  return a;
}

Placed by_inches(Random& random) {
  Question question;
  question.unit_a = "in";
  question.unit_b = "mm";
  return placed_by(random, "inches", question);
}

Placed by_matrix(Random& random) {
  Question question;
  question.transform = random_matrix(random, log_size(random, 1, 1e9));
  return placed_by(random, "a matrix", question);
}

Placed by_las(Random& random) {
  const double scale = log_size(random, 1e-4, 1), offset = log_size(random, 1e3, 1e9);
  const std::array<double, 3> scales = {scale, scale, scale};
  const std::array<double, 3> offsets = {random.range(-offset, offset),
                                         random.range(-offset, offset), 0.1};
  std::vector<std::array<int32_t, 3>> numbers(3 + random.below(6));
  for (auto& number : numbers)
    for (int32_t& n : number) n = static_cast<int32_t>(random.below(2001)) - 1000;
  Las las;
  las.put(131, scales);
  las.put(155, offsets);
  las.put_points(numbers);
  Placed a{"LAS", parse_las({.name = "a.las", .bytes = las.bytes()}), {}};
  for (const auto& number : numbers) {
    Exact p;
    for (size_t i = 0; i < 3; ++i)
      p[i] = Rational(number[i]) * Rational(scales[i]) + Rational(offsets[i]);
    a.exact.push_back(p);
  }
  return a;
}

/// Two nodes, one in the other.
Placed by_gltf(Random& random) {
  const MatrixRows outer = random_matrix(random, log_size(random, 1, 1e9));
  const MatrixRows inner = random_matrix(random, log_size(random, 1, 1e6));
  const auto by_columns = [](const MatrixRows& rows) {
    Json columns = Json::array();
    for (size_t c = 0; c < 4; ++c) {
      for (size_t r = 0; r < 3; ++r) columns.push_back(rows[r][c]);
      columns.push_back(c == 3 ? 1 : 0);
    }
    return columns;
  };
  std::vector<float> xyz(9);
  const double size = log_size(random, 1e-2, 1e3);
  for (float& x : xyz) x = static_cast<float>(random.range(-size, size));
  Document document;
  document.add_mesh(document.add_positions(xyz));
  document.json["nodes"] = {{{"children", {1}}, {"matrix", by_columns(outer)}},
                            {{"mesh", 0}, {"matrix", by_columns(inner)}}};
  Placed a{"glTF", parse(document.text()), {}};
  for (size_t v = 0; v < 3; ++v) {
    const DVec3 p = {double{xyz[3 * v]}, double{xyz[3 * v + 1]}, double{xyz[3 * v + 2]}};
    a.exact.push_back(moved(outer, moved(inner, exact_of(p))));
  }
  return a;
}

std::string threemf_text(const MatrixRows& rows) {
  std::string text;
  for (size_t c = 0; c < 4; ++c)
    for (size_t r = 0; r < 3; ++r) text += (text.empty() ? "" : " ") + digits(rows[r][c]);
  return text;
}

/// A component in an item, each with a transform.
Placed by_3mf(Random& random) {
  const MatrixRows item = random_matrix(random, log_size(random, 1, 1e9));
  const MatrixRows component = random_matrix(random, log_size(random, 1, 1e6));
  const double size = log_size(random, 1e-2, 1e3);
  std::string vertices;
  Placed a{"3MF", {}, {}};
  for (int v = 0; v < 3; ++v) {
    const DVec3 p = {random.range(-size, size), random.range(-size, size),
                     random.range(-size, size)};
    vertices +=
        "<vertex x=\"" + digits(p.x) + "\" y=\"" + digits(p.y) + "\" z=\"" + digits(p.z) + "\"/>";
    a.exact.push_back(moved(item, moved(component, exact_of(p))));
  }
  const std::string objects =
      object_of("1", mesh_of(vertices, "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>")) +
      object_of("2", "<components><component objectid=\"1\" transform=\"" +
                         threemf_text(component) + "\"/></components>");
  const std::string build = "<item objectid=\"2\" transform=\"" + threemf_text(item) + "\"/>";
  const std::string bytes = package_of(model_of(objects, build));
  a.mesh = parse_3mf({.name = "a.3mf", .bytes = bytes});
  return a;
}

/// A part far out that was laid on itself, turned: the matrix that align() found is exact.
Placed by_fit(Random& random) {
  const double far = log_size(random, 1e3, 1e9);
  const DVec3 centre = {random.range(-far, far), random.range(-far, far), 0};
  Placed a{"a fit", translated(noisy(icosphere(1, 1), 0.2, random.below(1000)), centre), {}};
  const Mesh before = a.mesh;
  Mesh b = before;
  place(b, {.matrix = random_matrix(random, far)}, "", false);
  b.placed.reset();
  Question question;
  question.align = true;
  fit_a(question, solver(), {}, {a.mesh, b});
  a.exact = placed_exactly(before, a.mesh.placed->by);
  return a;
}

using Maker = Placed (*)(Random&);

/// Kinds of A, each so many times of a hundred: a fit takes longer than all others.
Placed random_a(Random& random) {
  const uint32_t at = random.below(100);
  const Maker makers[] = {by_inches, by_matrix, by_las, by_gltf, by_3mf};
  return at < 2 ? by_fit(random) : makers[at % 5](random);
}

/// B is one point: h(A,B) is the largest distance of A's corners, whatever A's faces are.
Mesh point_at(const DVec3& p, bool are_points) {
  return are_points ? make_points("B", {p}) : make_mesh("B", {p}, {{0, 0, 0}});
}

/// A question whose limit is nearly the distance.
struct Case {
  Mesh b;
  Rational squared_distance;
  Question question;
  Rational squared_limit;
};

/// The limit is off by up to twice what delta makes of the distance and of the limit.
Case random_case(Random& random, const Placed& a) {
  const double size = std::sqrt(squared_diagonal(a.exact).get_d());
  const double away = log_size(random, 0.02, 180) * size;
  DVec3 to = a.mesh.vertices[random.below(static_cast<uint32_t>(a.mesh.vertices.size()))];
  to[static_cast<int>(random.below(3))] += random.below(2) == 0 ? away : -away;
  Case one{point_at(to, a.mesh.are_points), 0, {}, 0};
  for (const Exact& corner : a.exact)
    one.squared_distance = std::max(one.squared_distance, square_between(corner, exact_of(to)));
  const Rational squared_size = squared_diagonal(a.exact);
  const Rational ratio = one.squared_distance / squared_size;
  const mpf_class share = sqrt(mpf_class(ratio, 256));
  const double width =
      (2 + 7 * share.get_d()) * a.mesh.delta / std::sqrt(one.squared_distance.get_d());
  const double part = random.below(2) == 0 ? 2 : log_size(random, 0.01, 1);
  const double off = random.range(-part, part) * std::max(width, 1e-15);
  const std::string number = digits(mpf_class(100 * share * (1 + off)).get_d());
  one.question.tolerance.number = 1e-10;
  one.question.max = parse_length("--max", number + "%", PlainNumber::kRefused);
  one.squared_limit = decimal_value(number) * decimal_value(number) / 10000 * squared_size;
  return one;
}

struct Counts {
  int asked = 0, within = 0, beyond = 0, undecided = 0, refused = 0, wrong = 0;
};

Verdict verdict_on(const Placed& a, Case& one) {
  AskedPair pair(one.question);
  pair.take(std::make_shared<const ReadMesh>(a.mesh),
            shaped(std::make_shared<const ReadMesh>(one.b)));
  Solver* const solvers[] = {&solver()};
  pair.solve(solvers, {});
  const Answer& answer = pair.answer();
  // Every other use of the length has these two ends.
  CHECK(Rational(answer.max->limit.within) * Rational(answer.max->limit.within) <=
        one.squared_limit);
  CHECK(Rational(answer.max->limit.beyond) * Rational(answer.max->limit.beyond) >=
        one.squared_limit);
  return verdict_of(answer);
}

void ask(const Placed& a, Case one, Counts& counts) {
  CAPTURE(a.how);
  CAPTURE(a.mesh.delta);
  CAPTURE(one.question.max->requested);
  ++counts.asked;
  const bool is_within = one.squared_distance <= one.squared_limit;
  try {
    const Verdict verdict = verdict_on(a, one);
    counts.within += verdict == Verdict::kWithin ? 1 : 0;
    counts.beyond += verdict == Verdict::kBeyond ? 1 : 0;
    counts.undecided += verdict == Verdict::kUndecided ? 1 : 0;
    const bool is_wrong = verdict == (is_within ? Verdict::kBeyond : Verdict::kWithin);
    counts.wrong += is_wrong ? 1 : 0;
    CHECK(!is_wrong);
  } catch (const UsageError&) {  // too little is known of A's diagonal
    ++counts.refused;
  }
}

int asked_cases() {
  const char* more = std::getenv("VKH_PLACED_LIMITS");
  return more != nullptr ? std::atoi(more) : kIsSanitized ? 20 : 100;
}

}  // namespace

TEST_CASE("verdicts on shares of a moved A's diagonal are true") {
  Random random(5);
  std::map<std::string, Counts> kinds;
  for (int i = 0; i < asked_cases(); ++i) {
    const Placed a = random_a(random);
    REQUIRE(a.mesh.delta > 0);
    REQUIRE(a.mesh.vertices.size() == a.exact.size());
    ask(a, random_case(random, a), kinds[a.how]);
  }
  for (const auto& [how, n] : kinds)
    MESSAGE(how << ": " << n.asked << " asked, " << n.within << " within, " << n.beyond
                << " beyond, " << n.undecided << " undecided, " << n.refused << " refused, "
                << n.wrong << " wrong");
}
