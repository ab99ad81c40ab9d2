// Puts a page together: pieces into the template, and meshes until they fit.
#include "host/show/page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "host/show/escape.h"
#include "host/show/page_assets.h"
#include "host/show/page_figures.h"
#include "host/show/page_markup.h"
#include "host/show/page_mesh.h"

namespace vkh {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kPlaces = 10;
constexpr double kApart = 1.0 / 20;       // fraction of the diagonal, between two of them
constexpr size_t kLeastFaces = 100;       // fewer show nothing: such a page has no view
constexpr size_t kMostFaces = 5'000'000;  // corners are numbered in three bytes
constexpr size_t kCurvePoints = 1000;     // more than the columns of a screen

/// The texts by the names that the template has for them.
using Pieces = std::vector<std::pair<std::string_view, std::string>>;

std::string filled(std::string_view frame, const Pieces& pieces) {
  std::string out;
  for (size_t at = 0; at < frame.size();) {
    const size_t open = std::min(frame.find("{{", at), frame.size());
    out += frame.substr(at, open - at);
    if (open == frame.size()) break;
    const size_t close = frame.find("}}", open);
    const std::string_view name = frame.substr(open + 2, close - open - 2);
    for (const auto& piece : pieces) {
      if (piece.first == name) out += piece.second;
    }
    at = close + 2;
  }
  return out;
}

/// Everything of a page but the shown meshes and the pictures.
class PageWriter {
 public:
  PageWriter(const PageContents& contents, const PageLimits& limits)
      : answer_(*contents.answer),
        limits_(limits),
        answer_json_(to_json(answer_)),
        text_{answer_, Json::parse(answer_json_)} {
    sides_.push_back(&contents.a_to_b);
    if (contents.b_to_a) sides_.push_back(&*contents.b_to_a);
    find_top();
    const std::optional<Limit> asked =
        answer_.max ? std::optional<Limit>(answer_.max->limit) : std::nullopt;
    steps_ = tolerance_steps(top_, asked);
    for (const PageDirection* side : sides_)
      tallies_.push_back(tally(*side->mesh, *side->field, steps_));
    find_places();
  }

  // Takes fewer faces until the file is small enough; a page without a view is better than none.
  std::string text() {
    keep_pictures();
    const size_t bare = assembled({}).size();
    for (size_t faces = std::clamp<size_t>(limits_.faces, 1, kMostFaces);;) {
      const Meshes meshes = meshes_of(faces);
      std::string page = assembled(meshes);
      if (page.size() <= limits_.bytes) return page;
      if (bare >= limits_.bytes || faces <= kLeastFaces) return assembled({});
      const double room =
          static_cast<double>(limits_.bytes - bare) / static_cast<double>(page.size() - bare);
      const size_t most = std::max(meshes.packed[0].faces, meshes.packed.back().faces);
      faces = static_cast<size_t>(0.9 * room * static_cast<double>(std::min(faces, most)));
      faces = std::max(faces, kLeastFaces);
    }
  }

 private:
  struct Meshes {
    std::vector<PackedMesh> packed;
    std::vector<Place> places;
    std::vector<bool> is_decimated;
  };

  // Finds the largest known distance: infinite uppers are shown apart.
  void find_top() {
    for (const PageDirection* side : sides_) {
      for (size_t f = 0; f < side->field->face_count(); ++f) {
        const double upper = side->field->upper[f];
        top_ = std::max(top_, std::isfinite(upper) ? upper : side->field->lower[f]);
      }
    }
  }

  void find_places() {
    for (size_t i = 0; i < sides_.size(); ++i) {
      const Report& r = i == 0 ? answer_.a_to_b : *answer_.b_to_a;
      places_.push_back(
          worst_places(*sides_[i]->mesh, *sides_[i]->field, kPlaces, kApart * r.diagonal_a));
    }
  }

  // Pictures may together take two fifths of the page: more is a mistake of their size.
  void keep_pictures() {
    size_t bytes = 0;
    for (const PageDirection* side : sides_) bytes += side->picture.size() * 4 / 3;
    keeps_pictures_ = bytes <= limits_.bytes / 5 * 2;
  }

  Meshes meshes_of(size_t faces) const {
    Meshes out;
    for (const PageDirection* side : sides_) {
      const Shown shown = shown_of(*side->mesh, faces);
      out.packed.push_back(packed(shown, field_of(shown, *side->field), steps_));
      out.places.push_back(shown.place);
      out.is_decimated.push_back(shown.is_decimated);
    }
    return out;
  }

  std::string assembled(const Meshes& meshes) const {
    std::string places, statistics, scripts;
    for (size_t i = 0; i < sides_.size(); ++i) {
      places += places_html(text_, i > 0, places_[i]);
      if (sides_[i]->statistics)
        statistics += statistics_html(text_, i > 0, *sides_[i]->statistics);
      if (i < meshes.packed.size()) {
        scripts += "<script type=\"application/octet-stream\" id=\"mesh" + std::to_string(i) +
                   "\">" + base64(meshes.packed[i].bytes) + "</script>\n";
      }
    }
    const std::string program = text_.json["version"].get<std::string>();
    return filled(kPageTemplate, {{"style_hash", std::string(kPageStyleHash)},
                                  {"viewer_hash", std::string(kPageViewerHash)},
                                  {"style", std::string(kPageStyle)},
                                  {"viewer", std::string(kPageViewer)},
                                  {"title", title_text(text_)},
                                  {"verdict", verdict_html(text_)},
                                  {"facts", facts_html(text_)},
                                  {"directions", directions_html(text_)},
                                  {"pictures", pictures_html(!meshes.packed.empty())},
                                  {"places", places},
                                  {"statistics", statistics},
                                  {"inputs", inputs_html(text_)},
                                  {"run", run_html(text_)},
                                  {"notes", notes_html(text_)},
                                  {"version", html_text("vkhausdorff " + program)},
                                  {"answer", script_json(answer_json_)},
                                  {"data", script_json(data_json(meshes).dump())},
                                  {"meshes", scripts}});
  }

  std::string pictures_html(bool has_view) const {
    std::string out;
    for (size_t i = 0; i < sides_.size(); ++i) {
      const char* mesh = i == 0 ? "A" : "B";
      out += i == 0 ? "<figure>" : "<figure class=\"other\">";
      if (!has_view) {
        out += "<p>The mesh did not fit into this file; there is no view to turn.</p>";
      } else {
        out +=
            "<p class=\"no-view\" hidden>This browser cannot draw the mesh; there is no view to "
            "turn.</p>";
      }
      if (sides_[i]->picture.empty()) {
        out += "<p>No picture was drawn for this page.</p>";
      } else if (!keeps_pictures_) {
        out += "<p>The picture was too large for this file.</p>";
      } else {
        out += std::string("<img alt=\"") + mesh +
               ", coloured by its distances\" src=\"data:image/png;base64," +
               base64(sides_[i]->picture) + "\">";
      }
      out += "</figure>";
    }
    return out;
  }

  Json data_json(const Meshes& meshes) const {
    const CertifiedInterval whole = interval_of(answer_);
    Json data = {{"unit", answer_.unit}, {"top", top_}, {"steps", steps_json()}};
    data["interval"] = {{"lower", whole.lower},
                        {"upper", whole.upper},
                        {"name", answer_.b_to_a ? "max(h(A,B), h(B,A))" : "h(A,B)"}};
    const int asked = asked_step();
    data["asked"] = asked;
    data["start"] = asked >= 0 ? asked : static_cast<int>(steps_.size()) - 1;
    data["sides"] = Json::array();
    for (size_t i = 0; i < sides_.size(); ++i) data["sides"].push_back(side_json(i, meshes));
    return data;
  }

  Json steps_json() const {
    Json values = Json::array(), labels = Json::array(), linear = Json::array(),
         log = Json::array();
    for (const Step& step : steps_) {
      values.push_back(step.value);
      labels.push_back(step.label);
      linear.push_back(step.is_linear ? 1 : 0);
      log.push_back(step.is_log ? 1 : 0);
    }
    return {{"value", values}, {"label", labels}, {"linear", linear}, {"log", log}};
  }

  int asked_step() const {
    if (!answer_.max) return -1;
    for (size_t k = 0; k < steps_.size(); ++k) {
      if (steps_[k].limit.within == answer_.max->limit.within) return static_cast<int>(k);
    }
    return -1;
  }

  Json side_json(size_t i, const Meshes& meshes) const {
    const Tally& sums = tallies_[i];
    Json side = {{"from", i == 0 ? "A" : "B"},
                 {"faces", sums.faces},
                 {"hasArea", sums.area > 0 && std::isfinite(sums.area)},
                 {"within", sums.within},
                 {"beyond", sums.beyond},
                 {"withinArea", sums.within_area},
                 {"beyondArea", sums.beyond_area}};
    if (const Statistics* statistics = sides_[i]->statistics;
        statistics && statistics->curve.size() > 1) {
      side["curve"] = curve_json(statistics->curve);
    }
    if (i >= meshes.packed.size()) return side;
    const PackedMesh& mesh = meshes.packed[i];
    const Place& place = meshes.places[i];
    side["mesh"] = {{"id", "mesh" + std::to_string(i)},
                    {"deflated", can_deflate()},
                    {"faces", mesh.faces},
                    {"vertices", mesh.vertices},
                    {"lo", {place.lo.x, place.lo.y, place.lo.z}},
                    {"size", place.size}};
    side["caption"] = caption(meshes.is_decimated[i], mesh.faces);
    return side;
  }

  static std::string caption(bool is_decimated, size_t faces) {
    if (!is_decimated) return "Every face is shown.";
    return "A decimated view of " + grouped(faces) +
           " faces; every shown face carries the largest upper and the least lower of what it "
           "stands for. "
           "Counts, shares and the histogram are of every face.";
  }

  // Each point is a true statement alone, so that any of them may be left out.
  static Json curve_json(const std::vector<AreaWithin>& curve) {
    Json points = Json::array();
    const size_t stride = (curve.size() + kCurvePoints - 1) / kCurvePoints;
    for (size_t i = 0; i < curve.size(); i += stride) {
      points.push_back({curve[i].distance, curve[i].share.lower, curve[i].share.upper});
    }
    const AreaWithin& last = curve.back();
    if ((curve.size() - 1) % stride != 0)
      points.push_back({last.distance, last.share.lower, last.share.upper});
    return points;
  }

  const Answer& answer_;
  PageLimits limits_;
  std::string answer_json_;
  PageText text_;
  std::vector<const PageDirection*> sides_;
  double top_ = 0;
  bool keeps_pictures_ = true;
  std::vector<Step> steps_;
  std::vector<Tally> tallies_;
  std::vector<std::vector<WorstPlace>> places_;
};

}  // namespace

std::string to_page(const PageContents& contents, const PageLimits& limits) {
  return PageWriter(contents, limits).text();
}

}  // namespace vkh
