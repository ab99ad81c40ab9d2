#include "host/cli/pictures.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "host/base/error.h"
#include "host/export/field_file.h"
#include "host/page/page.h"
#include "host/prove/certificate.h"
#include "host/system/system.h"

namespace vkh {
namespace {

// part.ply: part-b.ply
std::string back_of(const std::string& path) {
  const size_t dot = path.rfind('.');
  const bool has_ending =
      dot != std::string::npos && path.find_first_of("/\\", dot) == std::string::npos;
  return has_ending ? path.substr(0, dot) + "-b" + path.substr(dot) : path + "-b";
}

void check_ending(const char* option, const std::optional<std::string>& path,
                  const std::vector<std::string>& endings) {
  if (!path) return;
  std::string list;
  for (const std::string& ending : endings) {
    if (path->ends_with(ending)) return;
    list += (list.empty() ? "" : " or ") + ending;
  }
  throw UsageError(std::string(option) + " '" + *path + "': expected a name that ends in " + list);
}

std::string name_of(const std::string& path) {
  return path_of(path).filename().empty() ? path : path.substr(path.find_last_of("/\\") + 1);
}

// One direction of an answer, and what was surveyed of it.
struct Side {
  const Mesh& mesh;
  const Report& report;
  const SurveyResult& survey;
  bool back;
};

std::vector<Side> sides_of(const Done& done) {
  std::vector<Side> sides;
  const Answer& answer = done.answer;
  if (!answer.survey_a || !done.session.device)
    throw OutputError("the run ended before there were bounds of faces");
  sides.push_back({done.pair.a, answer.a_to_b, *answer.survey_a, false});
  if (answer.b_to_a && answer.survey_b)
    sides.push_back({done.pair.b, *answer.b_to_a, *answer.survey_b, true});
  return sides;
}

std::string label_of(const Answer& answer, bool back) {
  return name_of(answer.inputs[back ? 1 : 0].path);
}

Enclosure interval_of(const Side& side) { return {side.report.lower, side.report.upper}; }

std::string field_text(const Side& side, const Answer& answer, const PicturesAsked& asked) {
  const FieldFile file{.mesh = side.mesh,
                       .field = side.survey.field,
                       .interval = interval_of(side),
                       .unit = answer.unit,
                       .against = label_of(answer, !side.back),
                       .map = asked.options.map};
  return asked.field->ends_with(".glb") ? to_glb(file) : to_ply(file);
}

PictureOptions picture_options(const PicturesAsked& asked, const Answer& answer) {
  PictureOptions options = asked.options;
  if (!asked.range) return options;
  const auto resolved = [&](const Length& length) {
    return length.number == 0
               ? 0
               : in_files(length, "--range", answer.unit, answer.a_to_b.diagonal_a).within;
  };
  options.range = Enclosure{resolved((*asked.range)[0]), resolved((*asked.range)[1])};
  return options;
}

// A share of a diagonal has too many digits as a number.
std::string limit_as(const Asked& max) {
  if (max.length.of != Length::Of::kDiagonal) return "";
  const std::string& typed = max.length.requested;
  return typed + (typed.ends_with("diag") ? "(A)" : " of A's diagonal");
}

std::string picture_of(const Side& side, const Done& done, const PicturesAsked& asked) {
  const Answer& answer = done.answer;
  Picture picture{.mesh = side.mesh,
                  .field = side.survey.field,
                  .interval = interval_of(side),
                  .unit = answer.unit,
                  .name = label_of(answer, side.back),
                  .against = label_of(answer, !side.back),
                  .back = side.back,
                  .caption = {in_words(answer)}};
  if (answer.max) picture.limit = answer.max->limit;
  if (answer.max) picture.limit_as = limit_as(*answer.max);
  if (answer.max) picture.verdict = verdict_of(answer, side.back);
  if (side.report.has_witness)
    picture.witness = Witness{side.report.witness_a, side.report.witness_b};
  return encode_png(draw(*done.session.device, picture, picture_options(asked, answer)));
}

// "0" has no unit.
std::array<Length, 2> range_of(const std::vector<std::string>& typed) {
  if (typed.size() != 2) throw UsageError("--range: expected two lengths, as in 0,0.5mm");
  std::array<Length, 2> range;
  for (size_t i = 0; i < 2; ++i) {
    range[i] = typed[i] == "0" ? Length{.requested = typed[i], .of = Length::Of::kFiles}
                               : parse_length("--range", typed[i], PlainNumber::kRefused);
  }
  return range;
}

// A report without pictures is one all the same: they only stand in where there is no WebGL.
std::string picture_or_none(const Side& side, const Done& done, const PicturesAsked& asked) {
  try {
    return picture_of(side, done, asked);
  } catch (const DeviceError&) {  // a queue that does not draw
    return "";
  }
}

std::string report_of(const std::vector<Side>& sides, const Done& done,
                      const PicturesAsked& asked) {
  std::vector<std::string> pictures;
  std::vector<PageDirection> directions;
  pictures.reserve(sides.size());
  for (const Side& side : sides) pictures.push_back(picture_or_none(side, done, asked));
  for (size_t i = 0; i < sides.size(); ++i) {
    const std::optional<Statistics>& statistics = sides[i].survey.statistics;
    directions.push_back({.mesh = &sides[i].mesh,
                          .field = &sides[i].survey.field,
                          .statistics = statistics ? &*statistics : nullptr,
                          .picture = pictures[i]});
  }
  PageContents contents{.answer = &done.answer, .a_to_b = directions[0]};
  if (directions.size() > 1) contents.b_to_a = directions[1];
  return to_page(contents);
}

std::string certificate_text(const Done& done) {
  const Answer& answer = done.answer;
  if (!answer.proof_a || answer.b_to_a.has_value() != answer.proof_b.has_value())
    throw OutputError("the run ended before there was a certificate");
  std::optional<CertifiedDirection> back;
  if (answer.b_to_a) back.emplace(CertifiedDirection{*answer.b_to_a, *answer.proof_b});
  return certificate_of({done.pair.a, answer.inputs[0].sha256},
                        {done.pair.b, answer.inputs[1].sha256}, {answer.a_to_b, *answer.proof_a},
                        back);
}

}  // namespace

void add_picture_options(CLI::App& command, TypedPictures& typed) {
  command
      .add_option("--field", typed.field,
                  "Write A with bounds and colours of its faces: .ply or .glb (B: beside it, -b)")
      ->type_name("FILE");
  command.add_option("--image", typed.image, "Draw A in the colours of those bounds: .png")
      ->type_name("FILE");
  command
      .add_option("--report", typed.report,
                  "Write all of it as a page to look at and to pass on: .html, which needs no "
                  "network")
      ->type_name("FILE");
  command.add_option("--view", typed.view, "From where it is drawn: iso, six, or x,y,z [iso]");
  command.add_option("--up", typed.up, "The axis that points up, y or z [z]");
  command.add_option("--size", typed.size, "Of the picture [1600x1000]")->type_name("WxH");
  command.add_option("--map", typed.map, "Its colours: viridis, batlow or cividis [viridis]");
  command.add_option("--range", typed.range, "Lengths at the ends of its colours: 0,0.5mm")
      ->delimiter(',')
      ->type_name("LENGTH,LENGTH")
      ->allow_extra_args(false);
  command.add_option("--steps", typed.steps, "So many steps of colour [smooth]")->type_name("N");
}

void add_certificate_option(CLI::App& command, TypedPictures& typed) {
  command
      .add_option("--certificate", typed.certificate,
                  "Write what proves the interval, for vkh_check to check: .vhc")
      ->type_name("FILE");
}

// What would be ignored otherwise.
void check_needed(const TypedPictures& typed) {
  const bool draws = !typed.image.empty() || !typed.report.empty();
  const std::pair<const char*, bool> given[] = {{"--view", typed.view.has_value()},
                                                {"--up", typed.up.has_value()},
                                                {"--size", typed.size.has_value()},
                                                {"--range", !typed.range.empty()},
                                                {"--steps", typed.steps.has_value()}};
  for (const auto& [option, is_given] : given) {
    if (is_given && !draws)
      throw UsageError(std::string(option) + ": is of a picture: ask for --image or --report");
  }
  if (typed.map && !draws && typed.field.empty())
    throw UsageError("--map: is of colours: ask for --image, --report or --field");
}

PicturesAsked asked_of(const TypedPictures& typed) {
  constexpr uint32_t kMostSteps = 256;
  check_needed(typed);
  PicturesAsked asked;
  if (!typed.field.empty()) asked.field = typed.field;
  if (!typed.image.empty()) asked.image = typed.image;
  if (!typed.report.empty()) asked.report = typed.report;
  if (!typed.certificate.empty()) asked.certificate = typed.certificate;
  asked.options.view = parse_view("--view", typed.view.value_or("iso"));
  asked.options.map = parse_colour_map("--map", typed.map.value_or("viridis"));
  if (typed.size) parse_picture_size("--size", *typed.size, asked.options);
  const std::string up = typed.up.value_or("z");
  if (up != "y" && up != "z") throw UsageError("--up '" + up + "': expected y or z");
  asked.options.up = up == "y" ? Up::kY : Up::kZ;
  asked.options.bands = typed.steps.value_or(0);
  if (asked.options.bands > kMostSteps) throw UsageError("--steps: 256 at most");
  if (!typed.range.empty()) asked.range = range_of(typed.range);
  return asked;
}

void Pictures::open(Files& files, const char* option, const std::optional<std::string>& path,
                    bool symmetric, const std::vector<std::string>& inputs) {
  if (!path) return;
  files.there.emplace(option, *path, inputs);
  if (symmetric) files.back.emplace(option, back_of(*path), inputs);
}

Pictures::Pictures(const PicturesAsked& asked, bool symmetric,
                   const std::vector<std::string>& inputs)
    : asked_(asked) {
  std::vector<std::string> taken;
  for (const std::string& input : inputs) {
    if (!input.empty()) taken.push_back(input);
  }
  check_ending("--field", asked.field, {".ply", ".glb"});
  check_ending("--image", asked.image, {".png"});
  check_ending("--report", asked.report, {".html"});
  open(field_, "--field", asked.field, symmetric, taken);
  open(image_, "--image", asked.image, symmetric, taken);
  if (asked.report) report_.emplace("--report", *asked.report, taken);
  check_ending("--certificate", asked.certificate, {".vhc"});
  if (asked.certificate) certificate_.emplace("--certificate", *asked.certificate, taken);
}

std::string Pictures::write(const Done& done) const {
  if (!asked_.any()) return "";
  try {
    if (certificate_) certificate_->write(certificate_text(done));
    if (!asked_.of_cells()) return "";
    const std::vector<Side> sides = sides_of(done);
    for (const Side& side : sides) {
      const std::optional<OutputFile>& field = side.back ? field_.back : field_.there;
      const std::optional<OutputFile>& image = side.back ? image_.back : image_.there;
      if (field) field->write(field_text(side, done.answer, asked_));
      if (image) image->write(picture_of(side, done, asked_));
    }
    if (report_) report_->write(report_of(sides, done, asked_));
  } catch (const OutputError& error) {
    return error.what();
  } catch (const DeviceError& error) {
    return error.what();
  } catch (const UsageError& error) {  // of lengths that the files' units do not resolve
    return error.what();
  }
  return "";
}

}  // namespace vkh
