#include "host/show/draw.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "host/base/decimal.h"
#include "host/show/map_legend.h"
#include "host/show/mapped_picture.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace drawing {
namespace {

struct Places {
  Area views, side;
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
  Drawing(const MappedPicture& mapped, const PictureOptions& options)
      : mapped_(mapped),
        picture_(mapped.drawn),
        options_(options),
        image_{options.width, options.height,
               std::vector<uint8_t>(size_t{4} * options.width * options.height, 255)},
        canvas_(image_),
        unit_(unit_of(options)),
        sheet_{canvas_, picture_, unit_},
        views_(picture_, options, unit_) {}

  Image draw();

 private:
  std::vector<std::string> footer_lines() const;
  Places places_for(size_t footer_lines) const;
  Layer paint(const Camera& camera);
  void draw_header();
  double draw_name(double x, const char* letter, const std::string& name, double width);
  void draw_lines(const std::vector<std::string>& lines, double y);
  struct Label {
    glm::dvec2 tip, size;
    double clear;  ///< the least distance from the tip
  };
  /// A label that has its place: its box, and the point to which its line goes.
  struct Placed {
    Area box;
    glm::dvec2 tip;
    std::string text;
  };
  Area place_for_label(const Panel& panel, const Layer& layer, const Label& label,
                       const std::vector<Placed>& taken) const;
  std::string colours_text() const;
  void draw_panel_frame(const Panel& panel);
  void draw_axes_and_ruler(const std::vector<Panel>& panels, const Camera& camera);
  void draw_numbers(const Panel& panel, const Layer& layer, bool is_single);
  void add_label(const Panel& panel, const Layer& layer, size_t place,
                 std::vector<Placed>& taken) const;
  void draw_line(const Placed& label);
  void draw_label(const Placed& label);
  void draw_map_legend(const Area& side);

  const MappedPicture& mapped_;
  const Picture& picture_;
  const PictureOptions& options_;
  Image image_;
  Canvas canvas_;
  double unit_;
  Sheet sheet_;
  Views views_;
};

/// Says what a colour is, and how well it is known.
std::string Drawing::colours_text() const {
  if (mapped_.is_of_bounds()) return mapped_.colours_of_bounds();
  const std::string other = picture_.back ? "A" : "B";
  std::string text = "Colour: the estimated distance from " + other +
                     (mapped_.scale->is_signed() ? ", off by at most 5 % of the bar, 10 % around 0,"
                                                 : ", off by at most 5 % of the bar,") +
                     " where it is not hatched.";
  if (!mapped_.scale->is_signed()) text += " Over and under " + other + " are not told apart.";
  if (picture_.mesh.are_points) text += " A disc is a point.";
  if (!mapped_.places.empty() && options_.view.kind != View::Kind::kSix)
    text += " A grey number is hidden in this view.";
  return text;
}

std::vector<std::string> Drawing::footer_lines() const {
  std::vector<std::string> lines = {colours_text()};
  if (!picture_.unfinished.empty()) {
    lines[0] += " The map is not finished: " + picture_.unfinished + ".";
  } else if (!mapped_.is_of_bounds()) {
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
  places.footer = bottom + 14 * unit_ + 18 * unit_;
  return places;
}

Layer Drawing::paint(const Camera& camera) {
  const RasterOptions options{.width = static_cast<uint32_t>(camera.area.width),
                              .height = static_cast<uint32_t>(camera.area.height),
                              .line = std::max(1.0, 1.3 * unit_),
                              .palette = mapped_.scale->palette()};
  Layer layer =
      rasterized(options, picture_.map->cells.size(), cells_for(picture_, *mapped_.scale, camera));
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
  const double least = 25 * u * 6;  // a short name leaves room for the other
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

Image Drawing::draw() {
  const std::vector<std::string> footer = footer_lines();
  const Places places = places_for(footer.size());
  const std::vector<Panel> panels = views_.panels_in(places.views);
  draw_header();
  draw_lines(footer, places.footer);
  std::vector<Layer> layers;
  layers.reserve(panels.size());
  for (const Panel& panel : panels) layers.push_back(paint(panel.camera));
  for (size_t i = 0; i < panels.size(); ++i) {
    draw_panel_frame(panels[i]);
    draw_numbers(panels[i], layers[i], panels.size() == 1);
  }
  draw_axes_and_ruler(panels, panels[0].camera);
  draw_map_legend(places.side);
  return std::move(image_);
}

/// Draws the numbers of the places, hidden ones in grey; in a single view with their distances.
/// Lines of labels are under the numbers.
void Drawing::draw_numbers(const Panel& panel, const Layer& layer, bool is_single) {
  std::vector<Placed> labels;
  for (size_t i = 0; is_single && i < mapped_.places.size(); ++i)
    add_label(panel, layer, i, labels);
  for (const Placed& label : labels) draw_line(label);
  for (const Placed& label : labels) draw_label(label);
  for (size_t i = mapped_.places.size(); i-- > 0;) {  // the worst one is drawn last
    const bool is_hidden = !is_seen(picture_.mesh, panel.camera, mapped_.places[i].point);
    if (is_hidden && !is_single) continue;
    const glm::dvec2 at(panel.camera.pixel(mapped_.places[i].point));
    if (panel.camera.area.inner(-20 * unit_).has(at)) draw_number(sheet_, at, i + 1, is_hidden);
  }
}

glm::dvec2 nearest_in(const Area& box, const glm::dvec2& point) {
  return glm::clamp(point, glm::dvec2(box.x, box.y), glm::dvec2(box.right(), box.bottom()));
}

/// Whether a line from p to q passes through the box, by 64 of its points.
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
  const std::string text = place_text(picture_, mapped_.places[place]);
  const glm::dvec2 box_size(text_width(text, size) + 16 * u, 28 * u);
  const glm::dvec2 tip(panel.camera.pixel(mapped_.places[place].point));
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
  const MapLegend legend{*mapped_.scale, mapped_.counts, mapped_.places};
  const double u = unit_, gap = 18 * u;
  const double list =
      mapped_.places.empty() ? 0 : (34 + 28 * static_cast<double>(mapped_.places.size())) * u;
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

}  // namespace

Image draw(const MappedPicture& mapped, const PictureOptions& options) {
  return Drawing(mapped, options).draw();
}

}  // namespace drawing

void check_picture(const Picture& picture, const PictureOptions& options) {
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

Image draw(const Picture& picture, const PictureOptions& options) {
  check_picture(picture, options);
  return drawing::draw(drawing::MappedPicture(picture, options), options);
}

}  // namespace vkh
