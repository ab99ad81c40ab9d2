// Puts a page together: texts and data into the template, and meshes until they fit.
#include "host/show/page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "host/base/decimal.h"
#include "host/base/parse_json.h"
#include "host/show/deflate.h"
#include "host/show/escape.h"
#include "host/show/page_assets.h"
#include "host/show/page_figures.h"
#include "host/show/page_view.h"
#include "host/show/page_words.h"
#include "host/show/template.h"

namespace vkh {
namespace {

constexpr size_t kLeastFaces = 100;       // fewer show nothing: such a page has no view
constexpr size_t kMostFaces = 5'000'000;  // corners are numbered in three bytes
constexpr size_t kCurvePoints = 1000;     // more than the columns of a screen

/// Everything of a page but the shown meshes and the pictures.
class PageWriter {
 public:
  PageWriter(const PageContents& contents, const PageLimits& limits)
      : contents_(contents),
        answer_(*contents.answer),
        limits_(limits),
        answer_json_(to_json(answer_)) {
    sides_.push_back(&contents.a_to_b);
    if (contents.b_to_a) sides_.push_back(&*contents.b_to_a);
    for (const PageDirection* side : sides_) {
      top_ = std::max(top_, drawing::largest_known(side->shown->drawn));
      bar_ = std::max({bar_, side->shown->scale->high(), -side->shown->scale->low()});
    }
    const std::optional<Limit> asked =
        answer_.max ? std::optional<Limit>(answer_.max->limit) : std::nullopt;
    steps_ = tolerance_steps(top_, std::min(bar_, top_), asked);
  }

  // Takes fewer faces until the file is small enough; a page without a view is better than none.
  std::string text(std::vector<PageMesh> meshes) {
    keep_pictures();
    for (size_t faces = limits_.faces;; meshes = page_meshes(contents_, faces)) {
      std::string page = assembled(meshes);
      if (page.size() <= limits_.bytes) return page;
      const size_t bare = assembled({}).size();
      if (bare >= limits_.bytes || faces <= kLeastFaces) return assembled({});
      const double room =
          static_cast<double>(limits_.bytes - bare) / static_cast<double>(page.size() - bare);
      const size_t most = std::max(meshes[0].packed.faces, meshes.back().packed.faces);
      faces = static_cast<size_t>(0.9 * room * static_cast<double>(std::min(faces, most)));
      faces = std::max(faces, kLeastFaces);
    }
  }

 private:
  // Pictures may together take two fifths of the page: more is a mistake of their size.
  void keep_pictures() {
    size_t bytes = 0;
    for (const PageDirection* side : sides_) bytes += side->picture.size() * 4 / 3;
    keeps_pictures_ = bytes <= limits_.bytes / 5 * 2;
  }

  std::string assembled(const std::vector<PageMesh>& meshes) const {
    Json view = head_view(answer_, contents_.title);
    view["sides"] = Json::array();
    for (const PageDirection* side : sides_) {
      const drawing::MappedPicture& shown = *side->shown;
      view["sides"].push_back(
          side_view(answer_, {shown.drawn, *shown.scale, shown.counts, shown.places}));
      add_picture(*side, view["sides"].back());
    }
    view["record"] = record_view(answer_);
    view["has_view"] = !meshes.empty();
    view["answer"] = script_json(answer_json_);
    view["data"] = script_json(data_json(meshes).dump());
    view["meshes"] = Json::array();
    for (size_t i = 0; i < meshes.size(); ++i)
      view["meshes"].push_back({{"number", i}, {"bytes", base64(meshes[i].packed.bytes)}});
    view["style_sheet"] = std::string(kPageStyle);
    view["viewer"] = std::string(kPageViewer);
    view["style_hash"] = std::string(kPageStyleHash);
    view["viewer_hash"] = std::string(kPageViewerHash);
    return rendered(kPageTemplate, view);
  }

  void add_picture(const PageDirection& side, Json& view) const {
    const bool is_kept = !side.picture.empty() && keeps_pictures_;
    view["picture"] = is_kept ? base64(side.picture) : "";
    view["has_picture"] = is_kept;
    view["why_no_picture"] = side.picture.empty() ? "No picture was drawn for this page."
                                                  : "The picture was too large for this file.";
  }

  Json data_json(const std::vector<PageMesh>& meshes) const {
    const Enclosure whole = deviation_of(answer_);
    Json data = {{"unit", answer_.unit},
                 {"top", top_},
                 {"bar", bar_},
                 {"steps", steps_json()},
                 {"lower", whole.lower},
                 {"upper", whole.upper},
                 {"up", contents_.up == Up::kY ? "y" : "z"}};
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

  Json side_json(size_t i, const std::vector<PageMesh>& meshes) const {
    const drawing::MappedPicture& shown = *sides_[i]->shown;
    Json side = {{"from", i == 0 ? "A" : "B"},
                 {"to", i == 0 ? "B" : "A"},
                 {"curve", Json::array()},
                 {"of", of_text(shown.drawn)},
                 {"scale", scale_json(*shown.scale)}};
    if (const Statistics* statistics = shown.drawn.statistics) {
      side["curve"] = curve_json(statistics->curve);
      for (const AreaWithin& band : statistics->bands) {
        if (is_limit(answer_, band.distance))
          side["atLimit"] = {band.share.lower, band.share.upper};
      }
    }
    if (i >= meshes.size()) return side;
    const PackedMesh& mesh = meshes[i].packed;
    const Place& place = meshes[i].place;
    side["mesh"] = {{"id", "mesh" + std::to_string(i)},
                    {"deflated", can_deflate()},
                    {"faces", mesh.faces},
                    {"vertices", mesh.vertices},
                    {"unit", mesh.unit},
                    {"lo", {place.lo.x, place.lo.y, place.lo.z}},
                    {"size", place.size},
                    {"spacing", meshes[i].spacing}};
    side["decimated"] = meshes[i].is_decimated;
    side["caption"] = caption(shown, meshes[i].is_decimated, mesh.faces);
    return side;
  }

  // Names the whole that shares of a direction are parts of.
  static std::string of_text(const Picture& drawn) {
    return std::string(drawn.mesh.are_points ? "points of " : "area of ") +
           (drawn.back ? "B" : "A");
  }

  static std::string caption(const drawing::MappedPicture& shown, bool is_decimated, size_t faces) {
    const bool are_points = shown.drawn.mesh.are_points;
    const std::string one = are_points ? "point" : "face";
    std::string text =
        shown.is_of_bounds()
            ? shown.colours_of_bounds()
            : "Colours are estimated distances; hatched parts are known less closely than 5 % of "
              "the bar.";
    if (is_decimated)
      text += " Simplified for viewing to " + grouped(faces) + " " + one +
              "s: each is coloured by the farthest of what it stands for. The figures are of " +
              (are_points ? "all points." : "the whole mesh.");
    return text;
  }

  // Each point is a true statement alone, so that any of them may be left out.
  static Json curve_json(const std::vector<AreaWithin>& curve) {
    Json points = Json::array();
    if (curve.empty()) return points;
    const size_t stride = (curve.size() + kCurvePoints - 1) / kCurvePoints;
    for (size_t i = 0; i < curve.size(); i += stride) {
      points.push_back({curve[i].distance, curve[i].share.lower, curve[i].share.upper});
    }
    const AreaWithin& last = curve.back();
    if ((curve.size() - 1) % stride != 0)
      points.push_back({last.distance, last.share.lower, last.share.upper});
    return points;
  }

  const PageContents& contents_;
  const Answer& answer_;
  PageLimits limits_;
  std::string answer_json_;
  std::vector<const PageDirection*> sides_;
  double top_ = 0, bar_ = 0;
  bool keeps_pictures_ = true;
  std::vector<Step> steps_;
};

}  // namespace

std::vector<PageMesh> page_meshes(const PageContents& contents, size_t faces) {
  std::vector<PageMesh> meshes;
  const auto add = [&](const PageDirection& side) {
    const Picture& drawn = side.shown->drawn;
    const size_t most = std::clamp<size_t>(faces, 1, kMostFaces);
    const ShownMesh shown = shown_mesh(drawn.mesh, *drawn.map, *side.shown->scale, most);
    meshes.push_back({packed(shown), shown.place, shown.is_decimated, shown.spacing});
  };
  add(contents.a_to_b);
  if (contents.b_to_a) add(*contents.b_to_a);
  return meshes;
}

std::string to_page(const PageContents& contents, const PageLimits& limits,
                    std::vector<PageMesh> meshes) {
  return PageWriter(contents, limits).text(std::move(meshes));
}

std::string to_page(const PageContents& contents, const PageLimits& limits) {
  return to_page(contents, limits, page_meshes(contents, limits.faces));
}

}  // namespace vkh
