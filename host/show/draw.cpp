#include "host/show/draw.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "host/base/decimal.h"
#include "host/show/map_legend.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace drawing {
namespace {

struct Places {
  Area views, side, inset;
  double footer;  ///< base line of the first line below
};

/// Pixels per unit of a picture of 1600 x 1000; letters of 15 units stay legible.
double unit_of(const PictureOptions& options) {
  constexpr double kLeast = 0.6;
  const double width = options.width, height = options.height;
  const double of_area = std::sqrt(width * height / (1600.0 * 1000.0));
  return std::max(std::min({of_area, width / 1000, height / 620}), kLeast);
}

class Drawing {
 public:
  Drawing(const Device& device, const Picture& picture, const PictureOptions& options)
      : device_(device),
        picture_(picture),
        options_(options),
        image_{options.width, options.height,
               std::vector<uint8_t>(size_t{4} * options.width * options.height, 255)},
        canvas_(image_),
        scale_(picture, options),
        unit_(unit_of(options)),
        sheet_{canvas_, picture, scale_, unit_},
        views_(picture, options, unit_) {
    if (picture.map == nullptr) return;
    map_scale_.emplace(picture, options);
    counts_ = counts_of(*picture.map, *map_scale_, picture.shares);
    places_ = worst_places(picture);
  }

  Image draw() { return picture_.map != nullptr ? draw_map() : draw_faces(); }

 private:
  Image draw_faces() {
    const std::vector<std::string> footer = footer_lines();
    const Places places = places_for(footer.size());
    const std::vector<Panel> panels = views_.panels_in(places.views);
    const Panel& best = panels[views_.best_of(panels)];
    const std::optional<Panel> inset = views_.inset_in(places.inset, best);
    Raster raster(device_, most_pixels(panels, inset, false), most_pixels(panels, inset, true));
    draw_header();
    draw_lines(footer, places.footer);
    draw_views(raster, panels, inset);
    if (inset) draw_inset(raster, *inset, best);
    draw_legend(places.side);
    return std::move(image_);
  }
  Image draw_map();

  std::vector<std::string> footer_lines() const;
  Places places_for(size_t footer_lines) const;
  static uint32_t most_pixels(const std::vector<Panel>& panels, const std::optional<Panel>& inset,
                              bool height);
  Layer paint(Raster& raster, const Camera& camera);
  void draw_header();
  double draw_name(double x, const char* letter, const std::string& name, double width);
  void draw_lines(const std::vector<std::string>& lines, double y);
  void draw_views(Raster& raster, const std::vector<Panel>& panels,
                  const std::optional<Panel>& inset);
  void draw_pin(const Panel& panel, const Layer& layer, double clear);
  struct Label {
    glm::dvec2 tip, size;
    double clear;  ///< no nearer to the tip than that
  };
  /// A label that has its place: its box, and the point to which its line goes.
  struct Placed {
    Area box;
    glm::dvec2 tip;
    std::string text;
  };
  Area place_for_label(const Panel& panel, const Layer& layer, const Label& label,
                       const std::vector<Placed>& taken) const;
  /// The colour of pointers to the witness: none of the faces' colours.
  Rgb pin_colour() const { return picture_.limit ? kInk : kSignal; }
  void draw_ring(glm::dvec2 at, double radius);
  void draw_frame(const Area& area);
  void draw_inset(Raster& raster, const Panel& inset, const Panel& best);
  bool draw_closest(const Camera& camera);
  void draw_legend(const Area& side);
  std::string map_colours_text() const;
  std::string bounds_colours_text() const;
  void draw_panel_frame(const Panel& panel);
  void draw_axes_and_ruler(const std::vector<Panel>& panels, const Camera& camera);
  void draw_numbers(const Panel& panel, const Layer& layer, bool is_single);
  void add_label(const Panel& panel, const Layer& layer, size_t place,
                 std::vector<Placed>& taken) const;
  void draw_line(const Placed& label);
  void draw_label(const Placed& label);
  void draw_map_legend(const Area& side);

  const Device& device_;
  const Picture& picture_;
  const PictureOptions& options_;
  Image image_;
  Canvas canvas_;
  Scale scale_;
  double unit_;
  Sheet sheet_;
  Views views_;
  std::optional<MapScale> map_scale_;
  MapCounts counts_;
  std::vector<MapPlace> places_;
};

/// Says what a colour is, and how well it is known.
std::string Drawing::map_colours_text() const {
  const std::string other = picture_.back ? "A" : "B";
  std::string text =
      "Colour: the estimated distance from " + other +
      (map_scale_->is_signed() ? ", off by at most 5 % of the bar, 10 % about nought,"
                               : ", off by at most 5 % of the bar,") +
      " where it is not hatched.";
  if (!map_scale_->is_signed()) text += " Over and under " + other + " are not told apart.";
  if (picture_.mesh.are_points) text += " A disc is a point.";
  if (!places_.empty() && options_.view.kind != View::Kind::kSix)
    text += " A grey number is hidden in this view.";
  return text;
}

std::string Drawing::bounds_colours_text() const {
  const std::string other = picture_.back ? "A" : "B";
  const bool are_points = picture_.mesh.are_points;
  return std::string(are_points ? "Colour of a point: " : "Colour of a face: ") +
         (picture_.limit ? "the verdict on its " : "a proven upper bound of its ") +
         (are_points ? "distance from " : "largest distance from ") + other + ".";
}

std::vector<std::string> Drawing::footer_lines() const {
  std::vector<std::string> lines = {picture_.map != nullptr ? map_colours_text()
                                                            : bounds_colours_text()};
  if (!picture_.unfinished.empty()) {
    lines[0] += " The map is not finished: " + picture_.unfinished + ".";
  } else if (picture_.map != nullptr) {
    lines[0] += " The map is finished.";
  }
  std::vector<std::string> texts = std::move(lines);
  texts.insert(texts.end(), picture_.caption.begin(), picture_.caption.end());
  lines.clear();
  for (const std::string& text : texts) {
    for (std::string& line : wrapped(text, 15 * unit_, options_.width - 72 * unit_, 2))
      lines.push_back(std::move(line));
  }
  const double most = 0.2 * options_.height / (24 * unit_);  // the rest is for the mesh
  lines.resize(std::min(lines.size(), static_cast<size_t>(most)));
  return lines;
}

Places Drawing::places_for(size_t footer_lines) const {
  const double margin = std::round(36 * unit_), top = std::round(118 * unit_);
  const double footer = 24 * unit_ * static_cast<double>(footer_lines);
  const double side = std::round(370 * unit_), gap = std::round(24 * unit_);
  const double bottom = std::floor(options_.height - margin - footer - 14 * unit_);
  const double width = options_.width - 2 * margin - side - gap;
  Places places;
  places.views = {margin, top, std::floor(width), bottom - top};
  places.side = {options_.width - margin - side, top, side, bottom - top};
  const double square = std::floor(std::min(side, 0.43 * places.side.height));
  places.inset = {places.side.right() - square, bottom - square, square, square};
  places.side.height -= square + 56 * unit_;
  if (places.side.height < 170 * unit_) {  // no room for both
    places.side.height = bottom - top;
    places.inset.width = 0;
  }
  places.footer = bottom + 14 * unit_ + 18 * unit_;
  return places;
}

uint32_t Drawing::most_pixels(const std::vector<Panel>& panels, const std::optional<Panel>& inset,
                              bool height) {
  const auto side = [&](const Area& area) { return height ? area.height : area.width; };
  double most = inset ? side(inset->camera.area) : 1;
  for (const Panel& panel : panels) most = std::max(most, side(panel.camera.area));
  return static_cast<uint32_t>(most);
}

Layer Drawing::paint(Raster& raster, const Camera& camera) {
  const VkExtent2D pixels{static_cast<uint32_t>(camera.area.width),
                          static_cast<uint32_t>(camera.area.height)};
  const double line = std::max(1.0, 1.3 * unit_);
  Layer layer = picture_.map != nullptr ? raster.draw(pixels, line, picture_.map->cells.size(),
                                                      cells_for(picture_, *map_scale_, camera))
                                        : raster.draw(pixels, line, picture_.mesh.faces.size(),
                                                      faces_for(picture_, scale_, camera));
  canvas_.paste(layer, static_cast<uint32_t>(camera.area.x), static_cast<uint32_t>(camera.area.y));
  return layer;
}

double Drawing::draw_name(double x, const char* letter, const std::string& name, double width) {
  const double u = unit_, size = 25 * u, y = 58 * u;
  const Area chip{x, y - 24 * u, 31 * u, 31 * u};
  canvas_.fill(chip, kInk, 1, 5 * u);
  write(canvas_, {chip.centre().x, y - 1.5 * u}, letter, {20 * u, kPaper, Align::kCentre});
  const double from = chip.right() + 12 * u;
  const std::string shown = shortened(name, size, x + width - from);
  write(canvas_, {from, y}, shown, {.size = size});
  return from + text_width(shown, size);
}

void Drawing::draw_header() {
  const double u = unit_, x = 36 * u, width = options_.width - 2 * x, gap = 44 * u;
  const char* first = picture_.back ? "B" : "A";
  const char* second = picture_.back ? "A" : "B";
  const double least = 25 * u * 6;  // a short name leaves its room to the other
  const double wanted = text_width(picture_.against, 25 * u) + 43 * u;
  const double half = (width - gap) / 2;
  const double for_second = std::clamp(wanted, std::min(least, half), half);
  const double end = draw_name(x, first, picture_.name, width - gap - for_second);
  if (!picture_.against.empty())
    draw_name(end + gap, second, picture_.against, x + width - end - gap);
  const PrintedInterval h = printed(picture_);
  double at = x;
  if (picture_.limit) {
    const Verdict verdict = picture_.verdict.value_or(
        verdict_of(picture_.interval.lower, picture_.interval.upper, *picture_.limit));
    std::string word = verdict_name(verdict);
    for (char& c : word) c = static_cast<char>(c - 'a' + 'A');
    const Area pill{at, 76 * u, text_width(word, 18 * u) + 26 * u, 30 * u};
    canvas_.fill(pill, verdict_colour(verdict), 1, 6 * u);
    const Rgb letters = verdict == Verdict::kBeyond ? kPaper : kInk;
    write(canvas_, {pill.centre().x, 97.5 * u}, word, {18 * u, letters, Align::kCentre});
    at = pill.right() + 14 * u;
  }
  std::string text = std::string("the largest deviation of ") +
                     (picture_.back ? "B from A" : "A from B") + " is in " +
                     with_unit(picture_, "[" + h.lower + ", " + h.upper + "]");
  if (picture_.limit) text += "; " + limit_clause(picture_);
  write(canvas_, {at, 98 * u}, shortened(text, 20 * u, x + width - at),
        {20 * u, kInk, Align::kLeft});
}

void Drawing::draw_lines(const std::vector<std::string>& lines, double y) {
  for (const std::string& line : lines) {
    write(canvas_, {36 * unit_, y}, line, {15 * unit_, kGrey, Align::kLeft});
    y += 24 * unit_;
  }
}

void Drawing::draw_ring(glm::dvec2 at, double radius) {
  canvas_.ring(at, radius, 5.5 * unit_, kPaper);
  canvas_.ring(at, radius, 2.5 * unit_, pin_colour());
}

/// Draws a frame around the magnified part.
void Drawing::draw_frame(const Area& area) {
  canvas_.frame(area, 3.5 * unit_, kPaper);
  canvas_.frame(area, 1.5 * unit_, kInk);
}

void Drawing::draw_views(Raster& raster, const std::vector<Panel>& panels,
                         const std::optional<Panel>& inset) {
  std::vector<Layer> layers;
  layers.reserve(panels.size());
  for (const Panel& panel : panels) layers.push_back(paint(raster, panel.camera));
  const Panel& best = panels[views_.best_of(panels)];
  for (size_t i = 0; i < panels.size(); ++i) {
    const Panel& panel = panels[i];
    draw_panel_frame(panel);
    const glm::dvec2 spot(panel.camera.pixel(views_.spot().point));
    if (&panel == &best) {
      const double magnified = inset && panel.shows_spot ? inset->camera.scale : 0;
      const double half =
          magnified > 0 ? inset->camera.area.width * panel.camera.scale / magnified / 2 : 0;
      if (half > 0) draw_frame({spot.x - half, spot.y - half, 2 * half, 2 * half});
      draw_pin(panel, layers[i], half + 24 * unit_);
    } else if (picture_.witness && panel.shows_spot) {
      draw_ring(spot, 7 * unit_);
    }
  }
  draw_axes_and_ruler(panels, best.camera);
}

void Drawing::draw_panel_frame(const Panel& panel) {
  if (panel.label.empty()) return;
  const Area& area = panel.camera.area;
  canvas_.frame(area.inner(-std::round(20 * unit_)), 1, kPale);
  write(canvas_, {area.x - 8 * unit_, area.y + 4 * unit_}, panel.label,
        {15 * unit_, kGrey, Align::kLeft});
}

void Drawing::draw_axes_and_ruler(const std::vector<Panel>& panels, const Camera& camera) {
  const double bottom = panels.back().camera.area.bottom() + 64 * unit_, left = 36 * unit_;
  const bool is_one = panels.size() == 1;
  if (is_one) draw_axes(sheet_, camera.axes, {left + 46 * unit_, bottom - 22 * unit_});
  draw_ruler(sheet_, camera, {left + (is_one ? 120 : 4) * unit_, bottom});
}

Image Drawing::draw_map() {
  const std::vector<std::string> footer = footer_lines();
  Places places = places_for(footer.size());
  places.side.height = places.views.height;
  const std::vector<Panel> panels = views_.panels_in(places.views);
  Raster raster(device_, most_pixels(panels, {}, false), most_pixels(panels, {}, true));
  raster.set_palette(map_scale_->palette());
  draw_header();
  draw_lines(footer, places.footer);
  std::vector<Layer> layers;
  layers.reserve(panels.size());
  for (const Panel& panel : panels) layers.push_back(paint(raster, panel.camera));
  for (size_t i = 0; i < panels.size(); ++i) {
    draw_panel_frame(panels[i]);
    draw_numbers(panels[i], layers[i], panels.size() == 1);
  }
  draw_axes_and_ruler(panels, panels[0].camera);
  draw_map_legend(places.side);
  return std::move(image_);
}

/// Draws the numbers of the places; in a single view with their distances, and those that are
/// hidden in grey. Lines of labels are under the numbers.
void Drawing::draw_numbers(const Panel& panel, const Layer& layer, bool is_single) {
  std::vector<Placed> labels;
  for (size_t i = 0; is_single && i < places_.size(); ++i) add_label(panel, layer, i, labels);
  for (const Placed& label : labels) draw_line(label);
  for (const Placed& label : labels) draw_label(label);
  for (size_t i = places_.size(); i-- > 0;) {  // the worst one is drawn last
    const bool is_hidden = !is_seen(picture_.mesh, panel.camera, places_[i].point);
    if (is_hidden && !is_single) continue;
    const glm::dvec2 at(panel.camera.pixel(places_[i].point));
    if (panel.camera.area.inner(-20 * unit_).has(at)) draw_number(sheet_, at, i + 1, is_hidden);
  }
}

glm::dvec2 nearest_in(const Area& box, const glm::dvec2& point) {
  return glm::clamp(point, glm::dvec2(box.x, box.y), glm::dvec2(box.right(), box.bottom()));
}

/// Whether a line from p to q passes through the box, as 64 of its points see it.
bool meets(const Area& box, const glm::dvec2& p, const glm::dvec2& q) {
  constexpr int kPoints = 64;
  for (int i = 0; i <= kPoints; ++i) {
    if (box.has(p + (q - p) * (static_cast<double>(i) / kPoints))) return true;
  }
  return false;
}

/// Finds a place for a place's distance near its number.
void Drawing::add_label(const Panel& panel, const Layer& layer, size_t place,
                        std::vector<Placed>& taken) const {
  const double u = unit_, size = 17 * u;
  const std::string text = place_text(picture_, places_[place]);
  const glm::dvec2 box_size(text_width(text, size) + 16 * u, 28 * u);
  const glm::dvec2 tip(panel.camera.pixel(places_[place].point));
  if (!panel.camera.area.inner(-20 * u).has(tip)) return;
  const Area box = place_for_label(panel, layer, {tip, box_size, 16 * u}, taken);
  taken.push_back({box, tip, text});
}

void Drawing::draw_line(const Placed& label) {
  const double u = unit_;
  const glm::dvec2 from = nearest_in(label.box, label.tip), to = label.tip;
  const glm::dvec2 end =
      to + (from - to) * std::min(1.0, 13 * u / std::max(glm::distance(from, to), 1e-9));
  canvas_.line(from, end, 4 * u, kPaper);
  canvas_.line(from, end, 1.6 * u, kInk);
}

void Drawing::draw_label(const Placed& label) {
  const double u = unit_;
  canvas_.fill(label.box.inner(-1.5 * u), kInk, 1, 6 * u);
  canvas_.fill(label.box, kPaper, 1, 5 * u);
  write(canvas_, {label.box.centre().x, label.box.y + 20 * u}, label.text,
        {17 * u, kInk, Align::kCentre});
}

void Drawing::draw_map_legend(const Area& side) {
  const MapLegend legend{*map_scale_, counts_, places_};
  const double u = unit_, gap = 18 * u;
  const double list = places_.empty() ? 0 : (34 + 28 * static_cast<double>(places_.size())) * u;
  const double histogram = std::min(side.height / 3, 250 * u);
  const bool has_all = side.height > list + histogram + 260 * u;
  const double bar = side.height - (has_all ? list + histogram + 2 * gap : 0);
  draw_map_bar(sheet_, legend, {side.x, side.y, side.width, bar});
  if (!has_all) return;
  draw_places(sheet_, legend, {side.x, side.y + bar + gap, side.width, list});
  draw_histogram(sheet_, legend, {side.x, side.bottom() - histogram, side.width, histogram});
}

/// The share of the box that lies over the mesh, from 0 to 1; and as much again if any of it does.
double covered(const Layer& layer, const Area& views, const Area& box) {
  double sum = 0;
  size_t count = 0;
  for (double y = box.y; y < box.bottom(); y += 4) {
    for (double x = box.x; x < box.right(); x += 4, ++count) {
      if (!views.has({x, y})) continue;
      const auto column = static_cast<size_t>(x - views.x), row = static_cast<size_t>(y - views.y);
      if (column < layer.width && row < layer.height)
        sum += layer.rgba[4 * (row * layer.width + column) + 3] / 255.0;
    }
  }
  return sum / static_cast<double>(std::max<size_t>(count, 1)) + (sum > 0 ? 1 : 0);
}

/// Whether two labels hide each other, or the line of one passes within `clear` of the other.
bool is_in_the_way(const Area& one, const glm::dvec2& tip, const Area& two,
                   const glm::dvec2& other_tip, double clear) {
  const bool is_over =
      one.x < two.right() && two.x < one.right() && one.y < two.bottom() && two.y < one.bottom();
  return is_over || meets(one.inner(-clear), other_tip, nearest_in(two, other_tip)) ||
         meets(two.inner(-clear), tip, nearest_in(one, tip));
}

/// Places a label near its tip, beside the mesh if there is room, and clear of others and their
/// lines.
Area Drawing::place_for_label(const Panel& panel, const Layer& layer, const Label& label,
                              const std::vector<Placed>& taken) const {
  const auto& [tip, size, clear] = label;
  constexpr int kDirections = 24;
  constexpr double kTurn = 2 * 3.14159265358979 / kDirections;
  const Area& views = panel.camera.area;
  Area best{};
  double least = std::numeric_limits<double>::infinity();
  for (const double far : {50.0, 90.0, 140.0, 200.0, 280.0, 380.0, 520.0, 680.0}) {
    for (int i = 0; i < kDirections; ++i) {
      const glm::dvec2 way(1.25 * std::cos(i * kTurn), -std::sin(i * kTurn));
      const glm::dvec2 middle = tip + way * (far * unit_);
      Area box{middle.x - size.x / 2, middle.y - size.y / 2, size.x, size.y};
      box.x = std::clamp(box.x, views.x, std::max(views.x, views.right() - size.x));
      box.y = std::clamp(box.y, views.y, std::max(views.y, views.bottom() - size.y));
      double cost = covered(layer, views, box) + far / 500;
      if (box.inner(-clear).has(tip)) cost += 9;
      if (std::any_of(taken.begin(), taken.end(), [&](const Placed& other) {
            return is_in_the_way(other.box, other.tip, box, label.tip, 6 * unit_);
          }))
        cost += 9;
      if (cost >= least) continue;
      least = cost;
      best = box;
    }
  }
  return best;
}

/// Draws an arrow to the worst place, with the number that it proves; a ring if it is hidden.
void Drawing::draw_pin(const Panel& panel, const Layer& layer, double clear) {
  if (!picture_.witness) return;
  const double u = unit_;
  const glm::dvec2 tip(panel.camera.pixel(views_.spot().point));
  const std::string number = with_unit(picture_, "\u2265 " + printed(picture_).lower);
  const std::string what = panel.shows_spot ? "at the witness" : "at the witness, hidden here";
  const double width = std::max(text_width(number, 19 * u), text_width(what, 14 * u));
  const glm::dvec2 size(std::min(width + 26 * u, panel.camera.area.width), 54 * u);
  const Area box = place_for_label(panel, layer, {tip, size, clear}, {});
  const glm::dvec2 from =
      glm::clamp(tip, glm::dvec2(box.x, box.y), glm::dvec2(box.right(), box.bottom()));
  const double off = (panel.shows_spot ? 2 : 13) * u;
  const glm::dvec2 end = tip + (from - tip) * std::min(1.0, off / glm::distance(from, tip));
  canvas_.arrow(from, end, 3.2 * u, kPaper, 2 * u);
  canvas_.arrow(from, end, 3.2 * u, pin_colour());
  if (!panel.shows_spot) draw_ring(tip, 7 * u);
  canvas_.fill(box.inner(-1.5 * u), pin_colour(), 1, 7 * u);
  canvas_.fill(box, kPaper, 1, 6 * u);
  write(canvas_, {box.centre().x, box.y + 23 * u}, shortened(number, 19 * u, size.x - 12 * u),
        {19 * u, kInk, Align::kCentre});
  write(canvas_, {box.centre().x, box.y + 44 * u}, shortened(what, 14 * u, size.x - 12 * u),
        {14 * u, kGrey, Align::kCentre});
}

/// Draws a line from the witness to its closest point on B, as far as the inset shows it; returns
/// whether it ends there.
bool Drawing::draw_closest(const Camera& camera) {
  if (!views_.spot().closest) return false;
  const double u = unit_;
  const Area inner = camera.area.inner(4 * u);
  const glm::dvec2 from(camera.pixel(views_.spot().point));
  const glm::dvec2 to(camera.pixel(*views_.spot().closest));
  const double length = glm::distance(from, to);
  if (length < 12 * u) return false;
  double shown = 1;
  while (shown > 0 && !inner.has(from + (to - from) * shown)) shown -= 1.0 / 64;
  const glm::dvec2 end = from + (to - from) * shown;
  canvas_.line(from, end, 5.5 * u, kPaper);
  canvas_.line(from, end, 2.5 * u, pin_colour());
  if (shown < 1) return false;
  canvas_.disc(to, 6.5 * u, kPaper);
  canvas_.disc(to, 4.5 * u, kInk);
  return true;
}

void Drawing::draw_inset(Raster& raster, const Panel& inset, const Panel& best) {
  const double u = unit_, size = 15 * u;
  const Area& area = inset.camera.area;
  paint(raster, inset.camera);
  canvas_.frame(area, std::max(1.0, 1.5 * u), kInk);
  const bool has_dot = draw_closest(inset.camera);
  draw_ring(area.centre(), 8 * u);
  const auto times = static_cast<size_t>(std::lround(inset.camera.scale / best.camera.scale));
  std::string text = picture_.witness ? "witness" : "largest upper bound";
  text += ", \u00d7" + grouped(times);
  if (!best.shows_spot) text += ", from its side";
  if (has_dot) text += std::string("; dot: closest on ") + (picture_.back ? "A" : "B");
  write(canvas_, {area.x, area.y - 9 * u}, shortened(text, size, area.width),
        {size, kGrey, Align::kLeft});
}

void Drawing::draw_legend(const Area& side) {
  if (picture_.limit) {
    draw_verdicts(sheet_, side);
  } else {
    draw_bar(sheet_, side);
  }
}

void check(const Picture& picture, const PictureOptions& options) {
  const auto refuse = [](const std::string& why) { throw UsageError("a picture " + why); };
  if (picture.field.lower.size() != picture.mesh.faces.size() ||
      picture.field.upper.size() != picture.mesh.faces.size())
    throw std::invalid_argument("a picture needs bounds for each face of its mesh");
  const double diagonal =
      drawing::drawn_diagonal_of(picture.mesh);  // squares of lengths are finite
  if (!(diagonal > 1e-100 && diagonal < 1e100)) refuse("shows meshes of 1e-100 to 1e100 units");
  if (options.width < kLeastPictureWidth || options.height < kLeastPictureHeight)
    refuse("has at least 640x400 pixels");
  if (std::max(options.width, options.height) > kMostPictureSide)
    refuse("has at most 8192x8192 pixels");
  if (options.range && !(options.range->lower <= options.range->upper &&
                         std::isfinite(options.range->upper - options.range->lower)))
    refuse("needs a range from a length to another that is no smaller");
}

}  // namespace
}  // namespace drawing

Image draw(const Device& device, const Picture& picture, const PictureOptions& options) {
  drawing::check(picture, options);
  return drawing::Drawing(device, picture, options).draw();
}

}  // namespace vkh
