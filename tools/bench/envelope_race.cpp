// Times an envelope test on a gate's question, on one core: is every face of A within EPS of B? Two
// peers, one a program: CGAL's Polyhedral_envelope, and Wang et al.'s fast-envelope (with
// VKH_FAST_ENVELOPE). Both take prisms of half-width EPS / sqrt(3), so a face inside is within EPS,
// and a face outside may be within it, too.
//
//   vkh_envelope_cgal A B EPS... [--time SECONDS]
//
// One CSV row for each EPS: eps,build_ms,verdict_ms,all_ms,asked,outside. verdict_ms: from both
// meshes in memory to the first face that is outside, or the last that is not; all_ms: to the last.
// Faces are asked until the time is over.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "vkhausdorff/mesh_io.h"
#ifdef VKH_FAST_ENVELOPE
#include <fastenvelope/FastEnvelope.h>
#else
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedral_envelope.h>

#include <array>
#endif

namespace {

#ifdef VKH_FAST_ENVELOPE

using Point = fastEnvelope::Vector3;
Point point(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

class Envelope {
 public:
  Envelope(const vkh::Mesh& b, double eps) {
    std::vector<Point> points;
    std::vector<fastEnvelope::Vector3i> faces;
    for (const glm::dvec3& v : b.vertices) points.push_back(point(v));
    for (const glm::uvec3& f : b.faces)
      faces.emplace_back(static_cast<int>(f.x), static_cast<int>(f.y), static_cast<int>(f.z));
    envelope_.init(points, faces, eps);
  }
  bool contains(const Point& p, const Point& q, const Point& r) const {
    return !envelope_.is_outside(std::array<Point, 3>{p, q, r});
  }

 private:
  fastEnvelope::FastEnvelope envelope_;
};

#else

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
Point point(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

class Envelope {
 public:
  Envelope(const vkh::Mesh& b, double eps) {
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 3> > faces;
    for (const glm::dvec3& v : b.vertices) points.push_back(point(v));
    for (const glm::uvec3& f : b.faces) faces.push_back({f.x, f.y, f.z});
    envelope_ = CGAL::Polyhedral_envelope<Kernel>(points, faces, eps);
  }
  bool contains(const Point& p, const Point& q, const Point& r) const { return envelope_(p, q, r); }

 private:
  CGAL::Polyhedral_envelope<Kernel> envelope_;
};

#endif

void race(const vkh::Mesh& a, const vkh::Mesh& b, double eps, double time_s) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto ms = [&] {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  };
  const Envelope envelope(b, eps);
  const double built = ms();
  double verdict = 0;
  size_t outside = 0, asked = 0;
  for (const glm::uvec3& f : a.faces) {
    ++asked;
    if (!envelope.contains(point(a.vertices[f.x]), point(a.vertices[f.y]),
                           point(a.vertices[f.z]))) {
      if (outside++ == 0) verdict = ms();
    }
    if (ms() > 1000 * time_s) break;
  }
  const double all = ms();
  if (outside == 0 && asked == a.faces.size()) verdict = all;
  std::printf("%.17g,%.3f,%.3f,%.3f,%zu,%zu\n", eps, built, verdict, all, asked, outside);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("An envelope test's time for a gate's question");
  std::string a, b;
  std::vector<double> eps;
  double time_s = 60;
  app.add_option("A", a)->required();
  app.add_option("B", b)->required();
  app.add_option("EPS", eps, "in the files' unit")->required();
  app.add_option("--time", time_s, "of each, beyond the envelope's making");
  CLI11_PARSE(app, argc, argv);
  try {
    const vkh::Mesh mesh_a = vkh::read_mesh(a), mesh_b = vkh::read_mesh(b);
    for (const double e : eps) race(mesh_a, mesh_b, e, time_s);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
