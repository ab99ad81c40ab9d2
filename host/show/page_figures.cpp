// Tolerances of few digits, sums over faces, and places that are apart.
#include "host/show/page_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "host/base/decimal.h"
#include "host/base/length.h"

namespace vkh {
namespace {

// Two digits with even ratios: E24 of IEC 60063, which engineers know from resistors.
constexpr std::array kSeries = {10, 11, 12, 13, 15, 16, 18, 20, 22, 24, 27, 30,
                                33, 36, 39, 43, 47, 51, 56, 62, 68, 75, 82, 91};
constexpr int kDecades = 6;           // below the largest distance; less is as good as 0 to the eye
constexpr double kLinearSteps = 250;  // at least so many: finer than a hand drags
constexpr double kNiceFactors[] = {5, 2, 1};

// Makes the double nearest to a decimal of few digits. The decimal itself lies between its
// neighbours.
Step step_of(double digits, int exponent) {
  const std::string text =
      number_text(digits, std::chars_format::fixed, 0) + "e" + std::to_string(exponent);
  Step step;
  std::from_chars(text.data(), text.data() + text.size(), step.value);
  if (step.value > 0) {
    step.limit = {std::nextafter(step.value, 0.0),
                  std::nextafter(step.value, std::numeric_limits<double>::infinity())};
  }
  step.label = number_text(step.value, std::chars_format::general, 6);
  return step;
}

void add_linear(std::vector<Step>& steps, double top) {
  const double widest = top / kLinearSteps;
  const int exponent = static_cast<int>(std::floor(std::log10(widest)));
  const double unit = std::pow(10.0, exponent);
  double factor = 1;
  for (const double nice : kNiceFactors) {
    if (nice * unit <= widest) {
      factor = nice;
      break;
    }
  }
  // Ten times kLinearSteps is more than any: no input makes this loop longer.
  for (double i = 0; i <= 10 * kLinearSteps; ++i) {
    steps.push_back(step_of(i * factor, exponent));
    steps.back().is_linear = true;
    if (steps.back().limit.within >= top) return;
  }
}

void add_log(std::vector<Step>& steps, double top) {
  const int last = static_cast<int>(std::ceil(std::log10(top)));
  for (int decade = last - kDecades - 1; decade <= last; ++decade) {
    for (const int digits : kSeries) {
      steps.push_back(step_of(digits, decade - 1));
      steps.back().is_log = true;
      if (steps.back().limit.within >= top) return;
    }
  }
}

// Puts the limit in: steps that it overlaps give way, so that both ends of all limits ascend.
void add_asked(std::vector<Step>& steps, const Limit& asked) {
  std::erase_if(steps, [&](const Step& step) {
    return step.limit.beyond >= asked.within && step.limit.within <= asked.beyond;
  });
  const double value = asked.within / 2 + asked.beyond / 2;
  steps.push_back({value, asked, length_in_words(asked)});
}

void merge_equals(std::vector<Step>& steps) {
  std::sort(steps.begin(), steps.end(),
            [](const Step& a, const Step& b) { return a.value < b.value; });
  std::vector<Step> out;
  for (const Step& step : steps) {
    if (out.empty() || out.back().value != step.value) {
      out.push_back(step);
      continue;
    }
    out.back().is_linear |= step.is_linear;
    out.back().is_log |= step.is_log;
  }
  steps = std::move(out);
}

double area_of(const Mesh& mesh, const glm::uvec3& face) {
  const glm::dvec3 a = mesh.vertices[face.x];
  return length(cross(mesh.vertices[face.y] - a, mesh.vertices[face.z] - a)) / 2;
}

// Sums up to a step: faces that are within from step k on were counted at k, those within none at
// the end.
template <class T>
std::vector<T> sums_up_to(std::vector<T> at) {
  std::partial_sum(at.begin(), at.end(), at.begin());
  at.pop_back();
  return at;
}

// Sums after a step: faces that are beyond steps 0 to k - 1 were counted at k.
template <class T>
std::vector<T> sums_after(std::vector<T> at) {
  at.erase(at.begin());
  std::partial_sum(at.rbegin(), at.rend(), at.rbegin());
  return at;
}

std::vector<double> shares(std::vector<double> areas, double whole) {
  for (double& area : areas)
    area = whole > 0 && std::isfinite(whole) ? std::min(area / whole, 1.0) : 0;
  return areas;
}

WorstPlace place_of_face(const Mesh& mesh, const Field& field, uint32_t face) {
  const glm::uvec3 f = mesh.faces[face];
  const glm::dvec3 a = mesh.vertices[f.x], b = mesh.vertices[f.y], c = mesh.vertices[f.z];
  const glm::dvec3 across = cross(b - a, c - a);
  const double area = length(across);
  return {face, mesh.file_faces.of(face), field.of(face), a / 3.0 + b / 3.0 + c / 3.0,
          area > 0 ? across / area : glm::dvec3(0)};
}

}  // namespace

std::vector<Step> tolerance_steps(double top, const std::optional<Limit>& asked) {
  std::vector<Step> steps = {step_of(0, 0)};
  if (top > 0 && std::isfinite(top)) {
    add_linear(steps, top);
    add_log(steps, top);
  }
  if (asked && asked->within > 0) add_asked(steps, *asked);
  merge_equals(steps);
  if (std::isfinite(top) &&
      steps.back().limit.within < top) {  // the limit took the last one's place
    const double last = std::max(top, steps.back().limit.beyond);
    steps.push_back({last, {last, std::nextafter(last, last * 2)}, shortest_decimal(last)});
  }
  return steps;
}

FaceSteps steps_of(const Enclosure& face, const std::vector<Step>& steps) {
  const auto within = std::partition_point(
      steps.begin(), steps.end(), [&](const Step& step) { return step.limit.within < face.upper; });
  const auto beyond = std::partition_point(
      steps.begin(), steps.end(), [&](const Step& step) { return step.limit.beyond < face.lower; });
  return {static_cast<uint32_t>(within - steps.begin()),
          static_cast<uint32_t>(beyond - steps.begin())};
}

Tally tally(const Mesh& mesh, const Field& field, const std::vector<Step>& steps) {
  std::vector<uint64_t> within(steps.size() + 1), beyond(steps.size() + 1);
  std::vector<double> within_area(steps.size() + 1), beyond_area(steps.size() + 1);
  Tally sums;
  sums.faces = mesh.faces.size();
  for (size_t i = 0; i < mesh.faces.size(); ++i) {
    const FaceSteps at = steps_of(field.of(i), steps);
    const double area = area_of(mesh, mesh.faces[i]);
    sums.area += area;
    ++within[at.within];
    ++beyond[at.beyond];
    within_area[at.within] += area;
    beyond_area[at.beyond] += area;
  }
  sums.within = sums_up_to(std::move(within));
  sums.beyond = sums_after(std::move(beyond));
  sums.within_area = shares(sums_up_to(std::move(within_area)), sums.area);
  sums.beyond_area = shares(sums_after(std::move(beyond_area)), sums.area);
  return sums;
}

std::vector<WorstPlace> worst_places(const Mesh& mesh, const Field& field, size_t most,
                                     double apart) {
  const auto is_worse = [&](uint32_t f, uint32_t g) {
    if (field.upper[f] != field.upper[g]) return field.upper[f] > field.upper[g];
    if (field.lower[f] != field.lower[g]) return field.lower[f] > field.lower[g];
    return f < g;
  };
  std::vector<uint32_t> order(mesh.faces.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<WorstPlace> places;
  size_t sorted = 0;
  for (size_t i = 0; i < order.size() && places.size() < most; ++i) {
    if (i == sorted) {  // ten times as many as last time: most of a mesh is never sorted
      sorted = std::min(order.size(), 10 * std::max<size_t>(i, 100));
      std::partial_sort(order.begin() + static_cast<ptrdiff_t>(i),
                        order.begin() + static_cast<ptrdiff_t>(sorted), order.end(), is_worse);
    }
    if (!(field.upper[order[i]] > 0)) break;
    const WorstPlace next = place_of_face(mesh, field, order[i]);
    const auto is_near = [&](const WorstPlace& p) {
      return distance(p.centre, next.centre) < apart;
    };
    if (std::none_of(places.begin(), places.end(), is_near)) places.push_back(next);
  }
  return places;
}

}  // namespace vkh
