#include "host/app/picture_options.h"

#include <CLI/CLI.hpp>

#include "host/answer/steps.h"
#include "host/batch/list.h"
#include "host/show/report_csv.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/field_file.h"

namespace vkh {
namespace {

// Turns part.ply into part-b.ply.
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

std::string field_text(const Side& side, const Answer& answer, const PicturesAsked& asked) {
  const std::optional<SignedFigures>& sides = side.survey.sides;
  const bool has_sides = sides && sides->over_of_faces.face_count() == side.mesh.faces.size();
  const FieldFile file{.mesh = side.mesh,
                       .field = side.survey.field,
                       .interval = interval_of(side),
                       .unit = answer.unit,
                       .against = label_of(answer, !side.back),
                       .map = asked.look.options.map,
                       .sides = has_sides ? &*sides : nullptr};
  return asked.field->ends_with(".glb") ? to_glb(file) : to_ply(file);
}

// Whether the first length is the longer one, as far as that is known without the files.
bool is_reversed(const std::array<Length, 2>& range) {
  const auto& [first, second] = range;
  if (second.number == 0) return first.number > 0;
  return first.of == second.of &&
         in_millimetres(first.number, first.unit) > in_millimetres(second.number, second.unit);
}

// A reader takes a GLB's coordinates as metres.
void note_on_metres(const Answer& answer, const std::string& path) {
  if (!path.ends_with(".glb") || !answer.unit.empty()) return;
  std::fprintf(stderr,
               "vkhausdorff: note: %s: glTF is in metres; what the files are in is not known, so "
               "that coordinates are as they are there: say it by --unit\n",
               printable(path).c_str());
}

// Reads two lengths; "0" has no unit.
std::array<Length, 2> range_of(const std::vector<std::string>& typed) {
  if (typed.size() != 2) throw UsageError("--range: expected two lengths, as in 0,0.5mm");
  std::array<Length, 2> range;
  for (size_t i = 0; i < 2; ++i) {
    range[i] = typed[i] == "0" ? Length{.requested = typed[i], .of = Length::Of::kFiles}
                               : parse_length("--range", typed[i], PlainNumber::kRefused);
  }
  if (is_reversed(range))
    throw UsageError("--range '" + typed[0] + "," + typed[1] +
                     "': expected the shorter length first");
  return range;
}

void add_look_options(CLI::App& command, TypedPictures& typed) {
  command.add_option("--view", typed.view, "From where it is drawn: iso, six, or x,y,z [iso]");
  command.add_option("--up", typed.up, "The axis that points up, y or z [z]");
  command.add_option("--size", typed.size, "Of the picture [1600x1000]")->type_name("WxH");
  command.add_option(
      "--map", typed.map,
      "Its colours, of distances without a side: viridis, batlow or cividis [by side where it "
      "costs little, otherwise viridis]");
  command.add_option("--range", typed.range, "Lengths at the ends of its colours: 0,0.5mm")
      ->delimiter(',')
      ->type_name("LENGTH,LENGTH")
      ->allow_extra_args(false);
  command.add_option("--steps", typed.steps, "So many steps of colour [smooth]")->type_name("N");
}

}  // namespace

void add_picture_options(CLI::App& command, TypedPictures& typed) {
  command
      .add_option("--field", typed.field,
                  "Write A with bounds and colours of its faces: .ply or .glb (B: beside it, -b)")
      ->type_name("FILE");
  command.add_option("--image", typed.image, "Draw A in the colours of its distances from B: .png")
      ->type_name("FILE");
  command
      .add_option("--report", typed.report,
                  "Write all of it as a page to look at and to pass on: .html, which needs no "
                  "network")
      ->type_name("FILE");
  command.add_option("--title", typed.title, "The heading of the report [the names of the files]")
      ->type_name("TEXT");
  command
      .add_option("--figures-csv", typed.figures,
                  "Write the figures of the report as a table: .csv")
      ->type_name("FILE");
  command
      .add_option("--points-out", typed.points,
                  "Write the worst places of the report as a table of x, y, z and deviation: .csv")
      ->type_name("FILE");
  add_look_options(command, typed);
}

void add_folder_options(CLI::App& command, TypedPictures& typed) {
  command
      .add_option("--image-dir", typed.image_folder,
                  "Draw each A in the colours of its distances, as .png in this folder, with "
                  "an index page")
      ->type_name("DIR");
  command
      .add_option("--report-dir", typed.report_folder,
                  "Write each pair's report, as .html in this folder, with an index page")
      ->type_name("DIR");
  add_look_options(command, typed);
}

void add_certificate_option(CLI::App& command, TypedPictures& typed) {
  command
      .add_option("--certificate", typed.certificate,
                  "Write what proves the interval, for vkh_check to check: .vhc")
      ->type_name("FILE");
}

namespace {

// Refuses options that would be ignored otherwise.
void check_needed(const TypedPictures& typed, bool draws, const std::string& drawing) {
  const std::pair<const char*, bool> given[] = {{"--view", typed.view.has_value()},
                                                {"--up", typed.up.has_value()},
                                                {"--size", typed.size.has_value()},
                                                {"--range", !typed.range.empty()},
                                                {"--steps", typed.steps.has_value()}};
  for (const auto& [option, is_given] : given) {
    if (is_given && !draws)
      throw UsageError(std::string(option) + ": is of a picture: ask for " + drawing);
  }
}

PictureStyle look_of(const TypedPictures& typed) {
  constexpr uint32_t kMostSteps = 256;
  PictureStyle look;
  look.options.view = parse_view("--view", typed.view.value_or("iso"));
  look.options.map = parse_colour_map("--map", typed.map.value_or("viridis"));
  if (typed.size) parse_picture_size("--size", *typed.size, look.options);
  const std::string up = typed.up.value_or("z");
  if (up != "y" && up != "z") throw UsageError("--up '" + up + "': expected y or z");
  look.options.up = up == "y" ? Up::kY : Up::kZ;
  look.options.bands = typed.steps.value_or(0);
  if (look.options.bands > kMostSteps) throw UsageError("--steps: 256 at most");
  if (!typed.range.empty()) look.range = range_of(typed.range);
  look.is_plain = typed.map.has_value();  // the palettes of signed maps have no names
  return look;
}

}  // namespace

PicturesAsked asked_of(const TypedPictures& typed) {
  const bool draws = !typed.image.empty() || !typed.report.empty();
  check_needed(typed, draws, "--image or --report");
  if (typed.map && !draws && typed.field.empty())
    throw UsageError("--map: is of colours: ask for --image, --report or --field");
  if (!typed.title.empty() && typed.report.empty())
    throw UsageError("--title: is of a page: ask for --report");
  if (!is_utf8(typed.title)) throw UsageError("--title: expected a text in UTF-8");
  PicturesAsked asked;
  asked.look = look_of(typed);
  if (!typed.field.empty()) asked.field = typed.field;
  if (!typed.image.empty()) asked.image = typed.image;
  if (!typed.report.empty()) asked.report = typed.report;
  if (!typed.certificate.empty()) asked.certificate = typed.certificate;
  if (!typed.figures.empty()) asked.figures = typed.figures;
  if (!typed.points.empty()) asked.points = typed.points;
  asked.title = typed.title;
  return asked;
}

FoldersAsked folders_of(const TypedPictures& typed) {
  FoldersAsked asked{.look = look_of(typed)};
  asked.images = typed.image_folder;
  asked.reports = typed.report_folder;
  constexpr const char* kDrawing = "--image-dir or --report-dir";
  check_needed(typed, asked.any(), kDrawing);
  if (typed.map && !asked.any())
    throw UsageError(std::string("--map: is of colours: ask for ") + kDrawing);
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
  check_ending("--figures-csv", asked.figures, {".csv"});
  if (asked.figures) figures_.emplace("--figures-csv", *asked.figures, taken);
  check_ending("--points-out", asked.points, {".csv"});
  if (asked.points) points_.emplace("--points-out", *asked.points, taken);
}

void Pictures::write_tables(const Measured& measured) const {
  if (figures_) figures_->write(figures_csv(measured));
  if (points_) points_->write(points_csv(measured));
}

std::string Pictures::write(const Answered& done) const {
  if (!asked_.any()) return "";
  try {
    if (certificate_)
      certificate_->write(certificate_text(done.answer, {done.pair.a, done.pair.b}));
    if (!asked_.of_cells()) return "";
    if (!done.session.device) throw OutputError("the run ended before there were bounds of faces");
    const Measured measured{done.answer, done.pair.a, done.pair.b};
    write_tables(measured);
    for (const Side& side : sides_of(measured)) {
      const std::optional<OutputFile>& field = side.back ? field_.back : field_.there;
      const std::optional<OutputFile>& image = side.back ? image_.back : image_.there;
      if (field) field->write(field_text(side, done.answer, asked_));
      if (field && !side.back) note_on_metres(done.answer, *asked_.field);
      if (image) image->write(picture_of(side, done.answer, asked_.look));
    }
    if (report_)
      report_->write(
          report_of(measured, pictures_of(measured, asked_.look), asked_.look, asked_.title));
  } catch (const Error& error) {  // a length that the files' units do not resolve, for example
    return error.what();
  }
  return "";
}

}  // namespace vkh
