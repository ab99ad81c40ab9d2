#include "host/show/draw_answer.h"

#include <algorithm>
#include <utility>

#include "host/answer/steps.h"
#include "host/base/parallel.h"
#include "host/base/system.h"
#include "host/show/page.h"
#include "host/show/page_words.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

constexpr double kPixelsOfDiagonal = 0.7;  // of a picture's larger side, in the view from a corner

PictureOptions options_of(const PictureStyle& look, const Answer& answer) {
  PictureOptions options = look.options;
  if (look.range) options.range = range_in_files(*look.range, answer);
  return options;
}

// A share of a diagonal has too many digits as a number.
std::string limit_as(const Asked& max) {
  if (max.length.of != Length::Of::kDiagonal) return "";
  const std::string& typed = max.length.requested;
  return typed + (typed.ends_with("diag") ? "(A)" : " of A's diagonal");
}

const char* unfinished_text(SurveyEnd end) {
  switch (end) {
    case SurveyEnd::kEffort:
      return "its effort was used, and more --effort resolves more";
    case SurveyEnd::kTime:
      return "its time ended, and more --time resolves more";
    case SurveyEnd::kCancelled:
      return "it was interrupted";
    case SurveyEnd::kMemory:
      return "there was no memory for it";
    default:
      return "";
  }
}

void add_map(const Side& side, const Answer& answer, Picture& picture) {
  if (!side.survey.map || side.survey.map->cells.empty()) return;
  picture.map = &*side.survey.map;
  if (side.survey.shares) picture.shares = &*side.survey.shares;
  picture.unfinished = unfinished_text(side.survey.ended);
  if (answer.max && answer.max->sides) picture.sided = answer.max->sides->limits;
}

}  // namespace

std::vector<Side> sides_of(const Measured& measured) {
  std::vector<Side> sides;
  const Answer& answer = measured.answer;
  if (!answer.survey_a) throw OutputError("the run ended before there were bounds of faces");
  sides.push_back({measured.a, answer.a_to_b, *answer.survey_a, false});
  if (answer.b_to_a && answer.survey_b)
    sides.push_back({measured.b, *answer.b_to_a, *answer.survey_b, true});
  return sides;
}

std::string label_of(const Answer& answer, bool back) {
  return file_name_of(answer.inputs[back ? 1 : 0].path);
}

Enclosure interval_of(const Side& side) { return {side.report.lower, side.report.upper}; }

PictureStyle style_of(const Look& look) {
  PictureStyle style;
  style.options.view = parse_view("--view", look.view);
  style.options.map = parse_colour_map("--map", look.map.value_or("viridis"));
  if (look.size) parse_picture_size("--size", *look.size, style.options);
  style.options.up = look.up == "y" ? Up::kY : Up::kZ;
  style.options.bands = static_cast<uint32_t>(look.steps);
  style.range = look.range;
  style.is_plain = look.map.has_value();  // the palettes of signed maps have no names
  return style;
}

void ask_for(const PictureStyle& look, Question& question) {
  const PictureOptions& options = look.options;
  question.map_range = look.range;
  question.map_pixels = kPixelsOfDiagonal * std::max(options.width, options.height);
  question.map_sides = !look.is_plain && !(look.range && (*look.range)[0].number != 0);
}

Picture drawn_of(const Side& side, const Answer& answer) {
  Picture picture{.mesh = side.mesh,
                  .field = side.survey.field,
                  .interval = interval_of(side),
                  .unit = answer.unit,
                  .name = label_of(answer, side.back),
                  .against = label_of(answer, !side.back),
                  .back = side.back,
                  .caption = {in_words(answer)}};
  add_map(side, answer, picture);
  if (side.survey.statistics) picture.statistics = &*side.survey.statistics;
  if (answer.max) picture.limit = answer.max->limit;
  if (answer.max) picture.limit_as = limit_as(*answer.max);
  if (answer.max) picture.verdict = verdict_of(answer, side.back);
  if (side.report.has_witness)
    picture.witness =
        Witness{side.report.witness_a, side.report.witness_b, deviation_of(answer, side.report)};
  return picture;
}

ShownAnswer::ShownAnswer(const Measured& measured, const PictureStyle& look)
    : answer_(measured.answer), options_(options_of(look, measured.answer)) {
  for (const Side& side : sides_of(measured)) {
    const Picture picture = drawn_of(side, answer_);
    check_picture(picture, options_);
    sides_.push_back(std::make_shared<const drawing::MappedPicture>(picture, options_));
  }
}

std::vector<std::string> ShownAnswer::pictures() const {
  std::vector<std::string> pictures;
  for (const auto& side : sides_) pictures.push_back(encode_png(drawing::draw(*side, options_)));
  return pictures;
}

// Draws the pictures while the page's meshes are made: both take about as long, and parts of both
// use a single core.
ShownAnswer::Page ShownAnswer::page(const std::string& title) const {
  PageContents contents{
      .answer = &answer_, .a_to_b = {sides_[0]}, .title = title, .up = options_.up};
  if (sides_.size() > 1) contents.b_to_a.emplace(PageDirection{sides_[1]});
  Page page;
  std::vector<PageMesh> meshes;
  for_each_index(2, [&](size_t i) {
    if (i == 0)
      meshes = page_meshes(contents);
    else
      page.pictures = pictures();
  });
  contents.a_to_b.picture = page.pictures[0];
  if (contents.b_to_a) contents.b_to_a->picture = page.pictures[1];
  page.text = to_page(contents, {}, std::move(meshes));
  return page;
}

}  // namespace vkh
