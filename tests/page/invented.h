// An answer about two meshes, and fields of them, as if a run had made them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "host/show/page.h"
#include "host/show/page_words.h"
#include "host/solve/cell_corners.h"

namespace vkh::test {

/// Bounds that follow a wave over the mesh, each a few percent apart.
inline Field invented_field(const Mesh& mesh, double largest) {
  glm::dvec3 lo = mesh.vertices[0], hi = lo;
  for (const glm::dvec3& v : mesh.vertices) lo = min(lo, v), hi = max(hi, v);
  Field field;
  for (const glm::uvec3& f : mesh.faces) {
    const glm::dvec3 t =
        (mesh.vertices[f.x] - lo) / std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z, 1e-300});
    const double wave =
        std::pow(0.5 + 0.25 * std::sin(9 * t.x + 4 * t.z) + 0.25 * std::sin(7 * t.y), 3);
    field.upper.push_back(largest * wave);
    field.lower.push_back(largest * wave * (0.9 + 0.06 * std::sin(40 * t.z)));
  }
  return field;
}

/// A map of whole faces that follows a wave over the vertices, known to a tenth of its height.
inline CellMap invented_map(const Mesh& mesh, double largest) {
  glm::dvec3 lo = mesh.vertices[0], hi = lo;
  for (const glm::dvec3& v : mesh.vertices) lo = min(lo, v), hi = max(hi, v);
  const glm::dvec3 size = max(hi - lo, glm::dvec3(1e-300));
  CellMap map;
  map.bar = 0.8 * largest;
  gpu::Cell whole{};
  set_corners(whole, lib::whole_root());
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    MapCell cell{.face = f, .share = 1.0f / static_cast<float>(mesh.faces.size())};
    cell.corners = {whole.corners.x, whole.corners.y, whole.corners.z, whole.corners.w};
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 t = (glm::dvec3(mesh.vertices[mesh.faces[f][i]]) - lo) / size;
      const double wave =
          std::pow(0.5 + 0.25 * std::sin(9 * t.x + 4 * t.z) + 0.25 * std::sin(7 * t.y), 3);
      cell.estimate[static_cast<size_t>(i)] = static_cast<float>(largest * wave);
    }
    cell.width = static_cast<float>(largest * (f % 5 == 0 ? 0.1 : 0.02));
    map.cells.push_back(cell);
  }
  return map;
}

inline double box_diagonal(const Mesh& mesh) {
  glm::dvec3 lo = mesh.vertices[0], hi = lo;
  for (const glm::dvec3& v : mesh.vertices) lo = min(lo, v), hi = max(hi, v);
  return length(hi - lo);
}

inline size_t worst_face(const Field& field) {
  return static_cast<size_t>(std::max_element(field.upper.begin(), field.upper.end()) -
                             field.upper.begin());
}

/// Distributions of the field's own bounds, by area: true of every field.
inline Statistics invented_statistics(const Mesh& mesh, const Field& field) {
  Statistics out;
  out.mean = out.rms = {0, 0};
  std::vector<double> areas;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const glm::dvec3 a = mesh.vertices[mesh.faces[f].x];
    areas.push_back(
        length(cross(mesh.vertices[mesh.faces[f].y] - a, mesh.vertices[mesh.faces[f].z] - a)) / 2);
    out.area += areas.back();
    out.mean.upper += areas.back() * field.upper[f];
    out.rms.upper += areas.back() * field.upper[f] * field.upper[f];
  }
  out.mean = {0.9 * out.mean.upper / out.area, out.mean.upper / out.area};
  out.rms = {0.9 * std::sqrt(out.rms.upper / out.area), std::sqrt(out.rms.upper / out.area)};
  const double top = field.upper[worst_face(field)];
  const auto within = [&](double distance) {
    double share = 0;
    for (size_t f = 0; f < areas.size(); ++f)
      share += field.upper[f] <= distance ? areas[f] / out.area : 0;
    return Enclosure{std::min(share, 1.0), std::min(1.0, share + 0.05)};
  };
  for (int i = 0; i <= 64; ++i) out.curve.push_back({top * i / 64, within(top * i / 64)});
  for (const double share : {0.25, 0.5}) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", top * share);
    const double distance = std::strtod(text.data(), nullptr);
    out.bands.push_back({distance, within(distance)});
  }
  std::vector<size_t> order(areas.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(),
            [&](size_t f, size_t g) { return field.upper[f] < field.upper[g]; });
  for (const double share : {0.5, 0.9, 0.95, 0.99}) {
    double area = 0;
    size_t i = 0;
    while (i + 1 < order.size() && (area += areas[order[i]]) < share * out.area) ++i;
    out.percentiles.push_back({share, {0.9 * field.upper[order[i]], field.upper[order[i]]}});
  }
  return out;
}

struct Invented {
  Invented(const Mesh& mesh_a, const Mesh& mesh_b) : a(mesh_a), b(mesh_b) {
    const double size = box_diagonal(a);
    field_a = invented_field(a, 0.004 * size);
    field_b = invented_field(b, 0.003 * size);
    map_a = invented_map(a, 0.0039 * size);
    map_b = invented_map(b, 0.0029 * size);
    answer.survey_a.emplace().statistics = invented_statistics(a, field_a);
    answer.survey_a->ended = SurveyEnd::kMet;
    answer.command = "distance";
    answer.words = {"distance",
                    "parts/bracket as scanned.ply",
                    "parts/bracket.stl",
                    "--symmetric",
                    "--unit",
                    "mm",
                    "--report",
                    "bracket.html"};
    answer.started = "2026-11-23T09:46:25Z";
    answer.host = "measure-3";
    answer.unit = "mm";
    answer.tolerance = {"1e-6diag", 1e-6};
    answer.inputs = {input("parts/bracket as scanned.ply", a, '3'),
                     input("parts/bracket.stl", b, 'b')};
    answer.inputs[1].notes = {note_of(NoteCode::kPolygons, "3 faces were triangulated")};
    answer.a_to_b = report(a, field_a);
    answer.b_to_a = report(b, field_b);
    answer.b_to_a->tolerance = answer.a_to_b.tolerance;
    answer.waits = {120, 312, 1834};
  }

  static Input input(const std::string& path, const Mesh& mesh, char digit) {
    Input out{.path = path, .is_read = true, .counts = mesh.counts};
    out.sha256 = std::string(60, digit) + "0a1f";
    return out;
  }

  static Report report(const Mesh& mesh, const Field& field) {
    Report r;
    const size_t worst = worst_face(field);
    r.upper = field.upper[worst];
    r.lower = r.upper * (1 - 1e-5);
    r.diagonal_a = box_diagonal(mesh);
    r.tolerance = r.upper * 1.1e-5;
    r.has_witness = true;
    r.witness_a = {worst, {1, 0, 0}, mesh.vertices[mesh.faces[worst].x]};
    r.witness_b = r.witness_a;
    r.device = {
        0, "llvmpipe (LLVM 15.0.6, 256 bits)", "Mesa 22.3.6", "cpu", "1.3.230", 1u << 30, true, ""};
    r.times.wall_ms = 1350;
    return r;
  }

  /// The limit, as a share of upper; 0: none.
  void ask(double share) {
    answer.max.reset();
    if (share == 0) return;
    const double typed = interval_of(answer).upper * share;
    std::array<char, 32> text{};
    // Every digit of a limit within the interval matters.
    std::snprintf(text.data(), text.size(), share == middle() ? "%.8g" : "%.3g", typed);
    const double limit = std::strtod(text.data(), nullptr);
    answer.max = Asked{{std::string(text.data()) + "mm", limit, Length::Of::kUnit, "mm"},
                       {std::nextafter(limit, 0.0), std::nextafter(limit, limit * 2)}};
    answer.command = "gate";
  }
  /// A share that lies between lower and upper.
  static double middle() { return 1 - 0.5e-5; }

  /// Every character that might end a page's text.
  void name_oddly() {
    const std::string odd =
        "</script><script>document.title='taken'</script>\" onload='x' \u2028\u202eexe.lp &amp; "
        "<b>\x01\x7f\xff.ply";
    answer.inputs[0].path = odd;
    answer.inputs[0].notes.push_back(note_of(NoteCode::kUnread, odd));
    answer.words[1] = odd;
    answer.notes = {note_of(NoteCode::kDevices, odd), note_of(NoteCode::kSurvey, "<!-- <script>")};
    // The text is also longer than a sheet of paper holds.
    answer.inputs[1].path = std::string(400, 'x') + ".stl";
    for (int i = 0; i < 20; ++i)
      answer.notes.push_back(note_of(NoteCode::kMemory, std::string(600, 'n')));
    for (int i = 0; i < 40; ++i)
      answer.survey_a->statistics->bands.push_back({0.01 * i, {0.1, 0.9}});
    answer.host = odd;
    answer.a_to_b.device.name = odd;
  }

  /// Every upper of A as given, of one direction.
  void set_upper(double upper) {
    answer.b_to_a.reset();
    answer.max.reset();
    field_a.upper.assign(field_a.upper.size(), upper);
    field_a.lower.assign(field_a.lower.size(), 0);
    answer.a_to_b.upper = upper;
    answer.a_to_b.lower = 0;
    answer.a_to_b.has_witness = false;
    answer.survey_a.reset();
    has_maps = false;
  }

  /// Sides for A: over B, under it, and none, in turn.
  void set_sides() {
    map_a.has_sides = true;
    for (MapCell& cell : map_a.cells)
      cell.side = std::array{SurfaceSide::kOver, SurfaceSide::kUnder, SurfaceSide::kUnsigned,
                             SurfaceSide::kOver}[cell.face % 4];
  }

  PageContents contents(const PictureOptions& look = {}) const {
    PageContents out{&answer, direction(false, look)};
    if (answer.b_to_a) out.b_to_a = direction(true, look);
    return out;
  }
  PageDirection direction(bool back, const PictureOptions& look) const {
    return {std::make_shared<const drawing::MappedPicture>(drawn(back), look), picture};
  }

  Picture drawn(bool back) const {
    const Report& r = back ? *answer.b_to_a : answer.a_to_b;
    Picture out{
        .mesh = back ? b : a, .field = back ? field_b : field_a, .interval = {r.lower, r.upper}};
    out.unit = answer.unit;
    out.back = back;
    if (!back && answer.survey_a && answer.survey_a->statistics)
      out.statistics = &*answer.survey_a->statistics;
    if (answer.max) out.limit = answer.max->limit;
    if (has_maps) out.map = back ? &map_b : &map_a;
    if (r.has_witness) out.witness = Witness{r.witness_a, r.witness_b, deviation_of(answer, r)};
    return out;
  }

  const Statistics& statistics_a() const { return *answer.survey_a->statistics; }

  Mesh a, b;
  Field field_a, field_b;
  Answer answer;
  CellMap map_a, map_b;
  std::string picture;
  bool has_maps = true;
};

}  // namespace vkh::test
