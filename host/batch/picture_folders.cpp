#include "host/batch/picture_folders.h"

#include <algorithm>
#include <exception>
#include <tuple>

#include "host/answer/merge.h"
#include "host/answer/rules.h"
#include "host/answer/steps.h"
#include "host/base/decimal.h"
#include "host/base/system.h"
#include "host/batch/index.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// Lists everything that a picture depends on, except its answer.
std::string text_of(const PictureStyle& look) {
  const PictureOptions& o = look.options;
  const glm::dvec3& from = o.view.direction;
  std::string text = std::to_string(o.width) + "x" + std::to_string(o.height);
  for (const int choice : {static_cast<int>(o.view.kind), static_cast<int>(o.up),
                           static_cast<int>(o.map), static_cast<int>(o.bands)})
    text += " " + std::to_string(choice);
  for (const double part : {from.x, from.y, from.z}) text += " " + hex_float(part);
  if (!look.is_plain) text += " sides";
  if (look.range) text += " " + (*look.range)[0].requested + "," + (*look.range)[1].requested;
  return text;
}

std::vector<std::string> ids_of(const std::vector<Entry>& entries) {
  std::vector<std::string> ids;
  ids.reserve(entries.size());
  for (const Entry& entry : entries) ids.push_back(entry.id);
  return ids;
}

std::string reason_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    return "no memory for what is drawn of it";
  } catch (const std::exception& e) {
    return e.what();
  }
}

}  // namespace

BatchFolders::BatchFolders(const Request& asked, const std::vector<Entry>& entries,
                           const std::vector<std::string>& taken)
    : style_(style_of(asked.outputs.look)),
      effort_(asked.question.budget.effort),
      max_distance_(asked.question.max_distance) {
  const auto& [images, reports] = std::tie(asked.many.image_folder, asked.many.report_folder);
  if (images) images_.emplace("--image-dir", *images, ".png");
  if (reports) reports_.emplace("--report-dir", *reports, ".html");
  for (const auto* folder : {&images_, &reports_}) {
    if (*folder) (*folder)->open(ids_of(entries), taken);
  }
  are_one_ = images && reports && place_of(*images) == place_of(*reports);
}

std::string BatchFolders::key_of(const ResultName& name) const {
  const std::string effort = effort_ ? "\neffort " + std::to_string(*effort_) : "";
  const std::string most = max_distance_ ? "\nmax-distance " + max_distance_->requested : "";
  return name.key + "\n" + text_of(style_) + effort + most;
}

bool BatchFolders::has(const ResultName& name, bool symmetric) const {
  const std::string key = key_of(name);
  if (reports_ && !reports_->has(name.id, false, key)) return false;
  if (!images_) return true;
  return images_->has(name.id, false, key) && (!symmetric || images_->has(name.id, true, key));
}

void BatchFolders::draw(const EndedPair& ended) noexcept {
  std::exception_ptr error;
  bool is_left = false;
  try {
    if (ended.goes_on()) write(ended);
    is_left = !ended.goes_on() && !has(ended.name, ended.pair.question().symmetric);
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  if (is_left) ++left_;
  if (error) failures_.push_back(ended.name.id + ": " + reason_of(error));
}

void BatchFolders::ask(Question& question) const {
  ask_for(style_, question);
  question.statistics = question.statistics || reports_.has_value();
  if (effort_) question.budget.effort = effort_;
  if (!max_distance_) return;
  question.max_distance = max_distance_;
  check_question(question);
}

// Writes no picture of a survey that was cut short: later it would be taken for a complete one.
void BatchFolders::write(const EndedPair& ended) const {
  const AskedPair& pair = ended.pair;
  Answer answer = pair.answer();
  if (!answer.survey_a) {
    Question question = pair.question();
    ask(question);
    const Observer observer{.goes_on = ended.goes_on,
                            .left_s = [&] { return question.budget.time_limit_s; }};
    finish(question, ended.solver, {*pair.a(), *pair.b()}, observer, answer);
  }
  if (!ended.goes_on()) return;
  const Measured measured{answer, *pair.a(), *pair.b()};
  const std::string& id = ended.name.id;
  const std::string key = key_of(ended.name);
  const ShownAnswer shown(measured, style_);
  ShownAnswer::Page drawn = reports_ ? shown.page() : ShownAnswer::Page{shown.pictures(), ""};
  if (reports_) reports_->write(id, false, std::move(drawn.text), key);
  if (!images_) return;
  for (const Side& side : sides_of(measured))
    images_->write(id, side.back, std::move(drawn.pictures[side.back ? 1 : 0]), key);
}

void BatchFolders::write_indexes(const std::string& file, const std::vector<Entry>& entries,
                                 bool has_limit) const {
  Results results;
  results.add(file);
  const bool is_one = are_one_;
  IndexContents index{.rows = {}, .results = file, .look = style_, .has_limit = has_limit};
  for (const Entry& entry : entries) index.left += results.has(entry.id) ? 0 : 1;
  const auto write = [&](const PairFolder& folder, bool has_images, bool has_reports) {
    index.rows.clear();
    results.for_each([&](const Result& result, const std::string&) {
      const std::string key = key_of(result.name);
      IndexRow row{.result = result};
      for (const bool back : {false, true}) {
        if (has_images && images_->has(result.name.id, back, key))
          row.pictures.push_back(images_->name_of(result.name.id, back));
      }
      if (has_reports && reports_->has(result.name.id, false, key))
        row.report = reports_->name_of(result.name.id, false);
      index.rows.push_back(std::move(row));
    });
    index.has_pictures = has_images;
    index.has_reports = has_reports;
    folder.write_index(to_index(index));
  };
  if (images_) write(*images_, true, is_one);
  if (reports_ && !is_one) write(*reports_, false, true);
}

std::vector<std::string> BatchFolders::indexes() const {
  std::vector<std::string> files;
  if (images_) files.push_back(images_->path_in(PairFolder::kIndex));
  if (reports_ && !are_one_) files.push_back(reports_->path_in(PairFolder::kIndex));
  return files;
}

std::vector<std::string> BatchFolders::failures() const {
  const std::lock_guard lock(mutex_);
  return failures_;
}

size_t BatchFolders::left() const {
  const std::lock_guard lock(mutex_);
  return left_;
}

}  // namespace vkh
