// Pictures by cells: colours of distances, what they do not tell, worst places, fixed views.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "host/base/parallel.h"
#include "host/show/camera.h"
#include "host/show/draw.h"
#include "host/show/map_legend.h"
#include "host/show/map_places.h"
#include "host/show/map_scale.h"
#include "host/solve/cell_corners.h"

namespace {

using namespace vkh;
using namespace vkh::drawing;

/// A square of n x n squares, of side 1 each.
Mesh sheet(uint32_t n) {
  std::vector<DVec3> vertices;
  std::vector<UVec3> faces;
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; j <= n; ++j) vertices.emplace_back(i, j, 0);
  }
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      const uint32_t v = i * (n + 1) + j, w = v + n + 1;
      faces.insert(faces.end(), {{v, w, w + 1}, {v, w + 1, v + 1}});
    }
  }
  return make_mesh("sheet", vertices, faces);
}

/// A map of whole faces, with distances by the place.
template <class Distance>
CellMap map_of_faces(const Mesh& mesh, const Distance& distance) {
  CellMap map;
  gpu::Cell whole{};
  set_corners(whole, lib::whole_root());
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const glm::uvec3 face = mesh.faces[f];
    const auto at = [&](uint32_t v) {
      return static_cast<float>(distance(glm::dvec3(mesh.vertices[v])));
    };
    map.cells.push_back(
        {.corners = {whole.corners.x, whole.corners.y, whole.corners.z, whole.corners.w},
         .face = static_cast<uint32_t>(f),
         .estimate = {at(face.x), at(face.y), at(face.z)},
         .width = 0,
         .share = 1.0f / static_cast<float>(mesh.faces.size())});
  }
  map.bar = 1;
  return map;
}

struct Drawn {
  Mesh mesh = sheet(8);
  Field field;
  CellMap map;
  Picture picture{.mesh = mesh, .field = field, .interval = {0, 1}};
  PictureOptions options;

  template <class Distance>
  explicit Drawn(const Distance& distance) : map(map_of_faces(mesh, distance)) {
    field.lower.assign(mesh.faces.size(), 0);
    field.upper.assign(mesh.faces.size(), 1);
    picture.map = &map;
    options.width = 800;
    options.height = 500;
    options.view = parse_view("--view", "0,0,1");
  }
  Drawn(const Drawn&) = delete;
  Drawn& operator=(const Drawn&) = delete;

  Image image() const { return draw(picture, options); }
  /// The number of pixels among the views that have about this colour, lit from the front.
  size_t count(Rgb colour) const {
    const Image all = image();
    size_t found = 0;
    const auto is_near = [](uint8_t x, uint8_t y) { return std::abs(x - y) <= 2; };
    for (uint32_t y = all.height / 8; y < all.height * 3 / 4; ++y) {
      for (uint32_t x = 0; x < all.width * 2 / 3; ++x) {
        const uint8_t* p = &all.rgba[4 * (size_t{y} * all.width + x)];
        found +=
            is_near(p[0], colour.red) && is_near(p[1], colour.green) && is_near(p[2], colour.blue);
      }
    }
    return found;
  }
};

constexpr Rgb kStripes{74, 64, 51};

TEST_CASE("a cell has the colour of its distance") {
  for (const double distance : {0.0, 0.25, 0.8}) {
    const Drawn drawn([&](const glm::dvec3&) { return distance; });
    const MapScale scale(drawn.picture, drawn.options);
    CHECK(scale.high() == 1);
    CHECK(drawn.count(scale.colour(distance)) > 20000);
    CHECK(drawn.count(kOver) == 0);
  }
}

TEST_CASE("a slope has a colour a place") {
  const Drawn drawn([](const glm::dvec3& p) { return p.x / 8; });
  const MapScale scale(drawn.picture, drawn.options);
  for (const double distance : {0.1, 0.5, 0.9}) CHECK(drawn.count(scale.colour(distance)) > 400);
}

TEST_CASE("what is over the bar has a colour of its own, and a share") {
  Drawn drawn([](const glm::dvec3& p) { return p.x > 4 ? 3.0 : 0.2; });
  drawn.picture.interval = {3, 3};
  const MapScale scale(drawn.picture, drawn.options);
  CHECK(drawn.count(kOver) > 5000);
  const MapCounts counts = counts_of(drawn.map, scale);
  CHECK(counts.above > 0.4);
  CHECK(counts.above < 0.6);
  CHECK(counts.unresolved == 0);
}

TEST_CASE("a cell that is not resolved is hatched, and counted") {
  Drawn drawn([](const glm::dvec3&) { return 0.2; });
  CHECK(drawn.count(kStripes) == 0);
  for (size_t i = 0; i < drawn.map.cells.size() / 4; ++i) drawn.map.cells[i].width = 0.06f;
  for (size_t i = drawn.map.cells.size() / 2; i < drawn.map.cells.size(); ++i)
    drawn.map.cells[i].width = 0.04f;
  CHECK(drawn.count(kStripes) > 1000);
  const MapScale scale(drawn.picture, drawn.options);
  CHECK(counts_of(drawn.map, scale).unresolved == doctest::Approx(0.25));
}

TEST_CASE("in a gate the bar ends at one and a half limits, and what is beyond stands out") {
  Drawn drawn([](const glm::dvec3& p) { return p.x / 8; });
  drawn.picture.limit = Limit{0.4, 0.4};
  const MapScale scale(drawn.picture, drawn.options);
  CHECK(scale.high() == doctest::Approx(0.6));
  CHECK(drawn.count(kOver) > 5000);
  CHECK(scale.colour(0.4).green > 200);  // the map's yellow
  CHECK(scale.colour(0.401).green < 120);
  CHECK(counts_of(drawn.map, scale).within == doctest::Approx(0.4).epsilon(0.1));
}

TEST_CASE("a signed map tells over from under, and greys what has no side") {
  Drawn drawn([](const glm::dvec3&) { return 0.8; });
  drawn.map.has_sides = true;
  for (size_t i = 0; i < drawn.map.cells.size(); ++i) {
    drawn.map.cells[i].side = i % 4 == 0   ? SurfaceSide::kUnsigned
                              : i % 2 == 0 ? SurfaceSide::kOver
                                           : SurfaceSide::kUnder;
  }
  const MapScale scale(drawn.picture, drawn.options);
  CHECK(scale.low() == -1);
  CHECK(scale.colour(0.8).red > scale.colour(0.8).blue);
  CHECK(scale.colour(-0.8).blue > scale.colour(-0.8).red);
  for (const Rgb colour : {scale.colour(0.8), scale.colour(-0.8), kNoSide})
    CHECK(drawn.count(colour) > 2000);
  CHECK(counts_of(drawn.map, scale).no_side == doctest::Approx(0.25));
}

TEST_CASE(
    "what has no side is within limits by its distance, and looks like nought where it is near") {
  Drawn drawn([](const glm::dvec3& p) { return p.x < 4.5 ? 0.05 : 0.3; });
  drawn.map.has_sides = true;
  drawn.picture.limit = Limit{0.5, 0.5};
  const MapScale scale(drawn.picture, drawn.options);
  const MapCounts counts = counts_of(drawn.map, scale);
  CHECK(counts.no_side > 0.4);
  CHECK(counts.no_side < 0.6);  // 0.05 is within a tenth of the bar, which ends at 0.75
  CHECK(counts.within == doctest::Approx(1));
  for (MapCell& cell : drawn.map.cells) cell.width = 0.03f;  // 0.05 + 0.03 is not
  CHECK(counts_of(drawn.map, scale).no_side == doctest::Approx(1));
  drawn.picture.sided = SidedLimits{{0.5, 0.5}, {0.2, 0.2}};
  const MapScale sided(drawn.picture, drawn.options);
  CHECK(counts_of(drawn.map, sided).within < 0.6);  // 0.3 may be under B, and beyond its limit
  for (MapCell& cell : drawn.map.cells) cell.width = 0.01f;
  drawn.picture.sided = SidedLimits{{0.2, 0.2}, {0.5, 0.5}};
  const MapScale longer(drawn.picture, drawn.options);
  CHECK(counts_of(drawn.map, longer).no_side < 0.6);  // 0.06 is within a tenth of its longer end
}

TEST_CASE("limits that differ by side end the bar on either side") {
  Drawn drawn([](const glm::dvec3&) { return 0.3; });
  drawn.map.has_sides = true;
  for (MapCell& cell : drawn.map.cells) cell.side = SurfaceSide::kUnder;
  drawn.picture.limit = Limit{0.4, 0.4};
  drawn.picture.sided = SidedLimits{{0.4, 0.4}, {0.2, 0.2}};
  const MapScale scale(drawn.picture, drawn.options);
  CHECK(scale.high() == doctest::Approx(0.6));
  CHECK(scale.low() == doctest::Approx(-0.3));
  CHECK(counts_of(drawn.map, scale).within == 0);
  CHECK(scale.colour(-0.19) != scale.colour(-0.21));
}

double bump(const glm::dvec3& p, double x, double y, double height) {
  return height * std::exp(-4 * ((p.x - x) * (p.x - x) + (p.y - y) * (p.y - y)));
}

TEST_CASE("a place is a cluster, not a cell") {
  const Mesh mesh = sheet(40);
  const CellMap map = map_of_faces(mesh, [](const glm::dvec3& p) {
    return bump(p, 10, 10, 1) + bump(p, 30, 12, 0.6) + bump(p, 20, 33, 0.3) + bump(p, 35, 35, 0.05);
  });
  const std::vector<MapPlace> places = map_places(mesh, map, 5);
  REQUIRE(places.size() == 3);
  CHECK(places[0].distance == doctest::Approx(1));
  CHECK(places[0].point.x == 10);
  CHECK(places[1].distance == doctest::Approx(0.6));
  CHECK(places[2].point.y == 33);
  CHECK(map_places(mesh, map, 2).size() == 2);
  const CellMap flat = map_of_faces(mesh, [](const glm::dvec3&) { return 0.0; });
  CHECK(map_places(mesh, flat, 5).empty());
}

TEST_CASE("a stray triangle leaves the other places") {
  const Mesh mesh = sheet(40);
  const CellMap map = map_of_faces(mesh, [](const glm::dvec3& p) {
    return bump(p, 10, 10, 50) + bump(p, 30, 12, 0.6) + bump(p, 20, 33, 0.3);
  });
  const std::vector<MapPlace> places = map_places(mesh, map, 5);
  REQUIRE(places.size() == 3);
  CHECK(places[0].distance == doctest::Approx(50));
  CHECK(places[1].distance == doctest::Approx(0.6));
  CHECK(places[2].distance == doctest::Approx(0.3));
}

TEST_CASE("a ridge is one place") {
  const Mesh mesh = sheet(40);
  const CellMap map = map_of_faces(mesh, [](const glm::dvec3& p) {
    return std::abs(p.x - 20) < 1.5 ? 0.8 + 0.2 * std::sin(p.y) * std::sin(p.y) : 0.01;
  });
  CHECK(map_places(mesh, map, 5).size() == 1);
}

TEST_CASE("places do not depend on the number of threads") {
  constexpr uint32_t kRow = 400;
  Mesh mesh = sheet(kRow);
  const auto vertex = [](uint32_t x, uint32_t y) { return x * (kRow + 1) + y; };
  // It joins the first place to the second one.
  mesh.faces.emplace_back(vertex(50, 50), vertex(350, 350), vertex(350, 351));
  const CellMap map = map_of_faces(mesh, [](const glm::dvec3& p) {
    const glm::dvec3 at = p / 8.0;  // steps make many as far
    const double far =
        bump(at, 6.25, 6.25, 1) + bump(at, 43.75, 43.75, 0.95) + bump(at, 44, 8, 0.8);
    return std::floor(far * 16) / 16;
  });
  REQUIRE(map.cells.size() > 2 * (size_t{1} << 17));
  limit_threads(1);
  const std::vector<MapPlace> one = map_places(mesh, map, 5);
  limit_threads(5);
  const std::vector<MapPlace> five = map_places(mesh, map, 5);
  limit_threads(0);
  REQUIRE(one.size() == 2);
  REQUIRE(five.size() == 2);
  for (size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].face == five[i].face);
    CHECK(one[i].point == five[i].point);
    CHECK(one[i].distance == five[i].distance);
  }
}

TEST_CASE("the farthest point that was found is the place of its cluster") {
  const Mesh mesh = sheet(40);
  CellMap map = map_of_faces(
      mesh, [](const glm::dvec3& p) { return bump(p, 10, 10, 1) + bump(p, 30, 12, 0.6); });
  map.cells[0].width = 0.01f;
  Witness witness;
  witness.on_a = {.face = 820, .barycentric = {0.5, 0.25, 0.25}, .point = {10.25, 10.5, 0}};
  witness.distance = {1.02, 1.0201};
  const std::vector<MapPlace> places = map_places(mesh, map, 5, witness);
  REQUIRE(places.size() == 2);
  CHECK(places[0].is_farthest);
  CHECK(places[0].point == glm::dvec3(10.25, 10.5, 0));
  CHECK(places[0].distance == 1.02);
  CHECK(places[0].known.lower == 1.02);
  CHECK(places[0].known.upper == 1.0201);
  CHECK(!places[1].is_farthest);
  CHECK(places[1].known.lower <= places[1].distance);
  CHECK(places[1].known.upper >= places[1].distance);
  witness.distance.lower = 0.3;  // a search that ended early: the map knows of a farther place
  CHECK(!map_places(mesh, map, 5, witness)[0].is_farthest);
}

TEST_CASE("without a map, places are of faces, and what is not proven is none") {
  Drawn drawn([](const glm::dvec3&) { return 0.0; });
  drawn.picture.map = nullptr;
  drawn.field.upper.assign(drawn.mesh.faces.size(), 1e9);
  CHECK(worst_places(drawn.picture).empty());
  drawn.field.lower[37] = 0.4;
  const std::vector<MapPlace> places = worst_places(drawn.picture);
  REQUIRE(places.size() == 1);
  CHECK(places[0].face == 37);
  CHECK(places[0].known.lower == 0.4);
  CHECK(places[0].known.upper == 1e9);
  const glm::uvec3 f = drawn.mesh.faces[37];
  const glm::dvec3 sum = glm::dvec3(drawn.mesh.vertices[f.x]) +
                         glm::dvec3(drawn.mesh.vertices[f.y]) +
                         glm::dvec3(drawn.mesh.vertices[f.z]);
  CHECK(glm::distance(places[0].point, sum / 3.0) < 1e-12);
}

TEST_CASE("a place is told with its sign, and on its side of the limit") {
  Drawn drawn([](const glm::dvec3&) { return 0.3; });
  drawn.picture.unit = "mm";
  MapPlace place{.distance = 0.1000021, .side = SurfaceSide::kUnder, .known = {0.09, 0.11}};
  CHECK(place_text(drawn.picture, place) == "0.1 mm");
  drawn.picture.limit = Limit{0.1, 0.1};
  CHECK(place_text(drawn.picture, place) == "0.100002 mm");
  drawn.map.has_sides = true;
  CHECK(place_text(drawn.picture, place) == "\u22120.1 mm");
  place.side = SurfaceSide::kOver;
  CHECK(place_text(drawn.picture, place) == "+0.1 mm");
  place.side = SurfaceSide::kUnsigned;
  CHECK(place_text(drawn.picture, place) == "0.1 mm");
}

TEST_CASE("the view from a corner does not depend on the answer") {
  const Drawn drawn([](const glm::dvec3& p) { return p.x / 8; });
  PictureOptions options;
  Picture picture = drawn.picture;
  const Area area{0, 0, 1000, 800};
  const Panel one = Views(picture, options, 1).panels_in(area)[0];
  picture.witness = Witness{{3, {1, 0, 0}, {0, 8, 0}}, {0, {}, {0, 8, -1}}};
  const Panel other = Views(picture, options, 1).panels_in(area)[0];
  CHECK(one.camera.axes.back == other.camera.axes.back);
  CHECK(one.camera.scale == other.camera.scale);
}

TEST_CASE("six views leave out those that see a line") {
  const Drawn drawn([](const glm::dvec3&) { return 0.5; });
  PictureOptions options;
  options.view.kind = View::Kind::kSix;
  const std::vector<Panel> flat = Views(drawn.picture, options, 1).panels_in({0, 0, 1000, 800});
  REQUIRE(flat.size() == 2);
  CHECK(flat[0].label == "from +z");
  Mesh solid = drawn.mesh;
  solid.vertices[0].z = 3;
  const Picture picture{.mesh = solid, .field = drawn.field, .interval = {0, 1}};
  CHECK(Views(picture, options, 1).panels_in({0, 0, 1000, 800}).size() == 6);
}

/// Points in a plane, `along` a side and so far apart.
Mesh grid_of_points(uint32_t along, double apart) {
  std::vector<DVec3> points;
  for (uint32_t i = 0; i < along; ++i) {
    for (uint32_t j = 0; j < along; ++j) points.emplace_back(apart * i, apart * j, 0);
  }
  return make_points("points", points);
}

TEST_CASE("the spacing of points is that of their surface, however many there are") {
  for (const uint32_t along : {20u, 60u, 300u, 1300u}) {
    for (const double apart : {1e-3, 7.0}) {
      const double found = spacing_of(grid_of_points(along, apart));
      CHECK(found > 0.7 * apart);
      CHECK(found < 1.5 * apart);
    }
  }
  CHECK(spacing_of(sheet(4)) == 0);
  CHECK(spacing_of(make_points("one", {{1, 2, 3}})) >= 0);
}

TEST_CASE("a point is a disc in the colour of its distance, and discs hide what is behind them") {
  Drawn drawn([](const glm::dvec3&) { return 0; });
  drawn.mesh = grid_of_points(9, 1);
  drawn.mesh.vertices.emplace_back(4, 4, -1);  // behind the one in the middle
  drawn.mesh = make_points("points", drawn.mesh.vertices);
  drawn.map = map_of_faces(drawn.mesh, [](const glm::dvec3& p) { return p.z < 0 ? 0.05 : 0.25; });
  drawn.field.lower.assign(drawn.mesh.faces.size(), 0);
  drawn.field.upper.assign(drawn.mesh.faces.size(), 1);
  const MapScale scale(drawn.picture, drawn.options);
  const auto shade = [](Rgb c) { return static_cast<int>(c.red) + c.green + c.blue; };
  const auto count = [&](double distance) {
    const Image all = drawn.image();
    size_t found = 0;
    const Rgb colour = scale.colour(distance);
    for (size_t at = 0; at < all.rgba.size();
         at += 4) {  // as dark as its rim and its depth make it
      const double light =
          (all.rgba[at] + all.rgba[at + 1] + all.rgba[at + 2]) / static_cast<double>(shade(colour));
      const auto is_near = [&](uint8_t x, uint8_t y) { return std::abs(x - light * y) <= 4; };
      const uint32_t x = static_cast<uint32_t>(at / 4) % all.width;
      found += x < all.width / 2 && light < 1.01 && light > 0.5 &&
               is_near(all.rgba[at], colour.red) && is_near(all.rgba[at + 1], colour.green) &&
               is_near(all.rgba[at + 2], colour.blue);
    }
    return found;
  };
  const size_t of_one = count(0.25) / 81;
  CHECK(of_one > 40);
  CHECK(count(0.05) < of_one / 4);  // hidden
  drawn.options.view = parse_view("--view", "0,0,-1");
  CHECK(count(0.05) > of_one / 2);
  const Area area{0, 0, 1000, 800};
  const auto is_seen_from = [&](const char* view, glm::dvec3 point) {
    PictureOptions options;
    options.view = parse_view("--view", view);
    return is_seen(drawn.mesh, Views(drawn.picture, options, 1).panels_in(area)[0].camera, point);
  };
  drawn.mesh.vertices.back().z = -8;
  CHECK(!is_seen_from("0,0,1", {4, 4, -8}));
  CHECK(is_seen_from("0,0,1", {4, 4, 0}));
  CHECK(is_seen_from("0,0,-1", {4, 4, -8}));
}

TEST_CASE("what is left out is grey, is counted, and has no place") {
  Drawn drawn([](const glm::dvec3&) { return 0.2; });
  for (MapCell& cell : drawn.map.cells) {
    const glm::uvec3 f = drawn.mesh.faces[cell.face];
    const auto& v = drawn.mesh.vertices;
    if (std::min({v[f.x].x, v[f.y].x, v[f.z].x}) >= 4) cell.estimate = {3, 3, 3};
  }
  drawn.picture.interval = {3.5, 3.5};
  drawn.picture.witness = Witness{{0, {1, 0, 0}, {8, 8, 0}}, {0, {}, {8, 8, -3}}, {3.5, 3.5}};
  drawn.map.max_distance = 2;
  const MapScale scale(drawn.picture, drawn.options);
  CHECK(drawn.count(kLeftOut) > 5000);
  CHECK(drawn.count(kOver) == 0);
  const MapCounts counts = counts_of(drawn.map, scale);
  CHECK(counts.left_out == doctest::Approx(0.5));
  CHECK(counts.above == 0);
  CHECK(counts.within == doctest::Approx(1));
  CHECK(counts.mean == doctest::Approx(0.2));
  const auto rows = legend_rows(drawn.picture, scale, counts);
  REQUIRE(!rows.empty());
  const bool says = std::any_of(rows.begin(), rows.end(), [](const LegendRow& row) {
    return row.text.starts_with("left out, over 2: ") && row.text.ends_with(" of the area");
  });
  CHECK(says);
  REQUIRE(!worst_places(drawn.picture).empty());
  for (const MapPlace& place : worst_places(drawn.picture)) CHECK(place.distance < 0.3);
  drawn.map.max_distance.reset();
  CHECK(worst_places(drawn.picture).front().point.x == 8);
}

TEST_CASE("shares that the survey has added up are not added up again") {
  Drawn drawn([](const glm::dvec3& p) { return p.x > 4 ? 3.0 : 0.2; });
  MapShares known = shares_of(drawn.map, {.low = 0, .high = 2});
  CHECK(known.above > 0.4);
  known.above = 0.125;
  drawn.picture.shares = &known;
  const MapScale scale(drawn.picture, drawn.options);
  CHECK(scale.high() == 2);
  const MapCounts counts = counts_of(drawn.map, scale, drawn.picture.shares);
  CHECK(counts.above == 0.125);
  CHECK(counts.bins[3] > 0.4);  // 0.2 of 2 is in the fourth of 36
  CHECK(counts_of(drawn.map, scale).above > 0.4);
}

TEST_CASE("a caption names both limits where they differ by side") {
  Drawn drawn([](const glm::dvec3&) { return 0.3; });
  drawn.picture.limit = Limit{0.4, 0.4};
  CHECK(limit_clause(drawn.picture) == "the limit is 0.4");
  drawn.picture.sided = SidedLimits{{0.25, 0.25}, {0.4, 0.4}};
  drawn.picture.unit = "mm";
  CHECK(limit_clause(drawn.picture) == "the limits are +0.25 mm over and \u22120.4 mm under B");
  drawn.picture.back = true;
  CHECK(limit_clause(drawn.picture) == "the limits are +0.25 mm over and \u22120.4 mm under A");
}

TEST_CASE("shares are printed for people") {
  CHECK(percent_text(0) == "0 %");
  CHECK(percent_text(1e-6) == "under 0.01 %");
  CHECK(percent_text(0.12345) == "12.3 %");
  CHECK(percent_text(0.99995) == "over 99.9 %");
  CHECK(percent_text(1) == "100 %");
}

TEST_CASE("a map has the same bytes each time, in any size") {
  Drawn drawn([](const glm::dvec3& p) { return p.x / 6; });
  drawn.map.cells[0].width = 1;
  drawn.picture.unfinished = "its effort was used";
  for (const char* size : {"640x400", "640x2000", "2000x400"}) {
    parse_picture_size("--size", size, drawn.options);
    CHECK(drawn.image().rgba == drawn.image().rgba);
  }
}

}  // namespace
