#include "host/app/pictures.h"

#include "host/answer/steps.h"
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

std::string field_text(const Side& side, const Answer& answer, const std::string& path,
                       ColourMap map) {
  const std::optional<SignedFigures>& sides = side.survey.sides;
  const bool has_sides = sides && sides->over_of_faces.face_count() == side.mesh.faces.size();
  const FieldFile file{.mesh = side.mesh,
                       .field = side.survey.field,
                       .interval = interval_of(side),
                       .unit = answer.unit,
                       .against = label_of(answer, !side.back),
                       .map = map,
                       .sides = has_sides ? &*sides : nullptr};
  return path.ends_with(".glb") ? to_glb(file) : to_ply(file);
}

// A reader takes a GLB's coordinates as metres.
void note_on_metres(const Answer& answer, const std::string& path) {
  if (!path.ends_with(".glb") || !answer.unit.empty()) return;
  std::fprintf(stderr,
               "vkhausdorff: note: %s: glTF is in metres; what the files are in is not known, so "
               "that coordinates are as they are there: say it by --unit\n",
               printable(path).c_str());
}

}  // namespace

void Pictures::open(Files& files, const char* option, const std::optional<std::string>& path,
                    bool symmetric, const std::vector<std::string>& inputs) {
  if (!path) return;
  files.there.emplace(option, *path, inputs);
  if (symmetric) files.back.emplace(option, back_of(*path), inputs);
}

Pictures::Pictures(const Outputs& asked, bool symmetric, const std::vector<std::string>& inputs)
    : asked_(asked), style_(style_of(asked.look)) {
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

void Pictures::draw(const Measured& measured) const {
  const ShownAnswer shown(measured, style_);
  const ShownAnswer::Page drawn =
      report_ ? shown.page(asked_.title) : ShownAnswer::Page{shown.pictures(), ""};
  if (image_.there) image_.there->write(drawn.pictures[0]);
  if (image_.back && drawn.pictures.size() > 1) image_.back->write(drawn.pictures[1]);
  if (report_) report_->write(drawn.text);
}

std::string Pictures::write(const Answer& answer, const MeshPointer& a,
                            const MeshPointer& b) const {
  if (!asked_.has_pictures()) return "";
  try {
    if (a == nullptr)
      throw OutputError(certificate_ ? "the run ended before there was a certificate"
                                     : "the run ended before there were bounds of faces");
    if (certificate_) certificate_->write(certificate_text(answer, {*a, *b}));
    if (!asked_.shows_cells()) return "";
    const Measured measured{answer, *a, *b};
    write_tables(measured);
    for (const Side& side : sides_of(measured)) {
      const std::optional<OutputFile>& field = side.back ? field_.back : field_.there;
      if (field) field->write(field_text(side, answer, *asked_.field, style_.options.map));
      if (field && !side.back) note_on_metres(answer, *asked_.field);
    }
    if (image_.there || report_) draw(measured);
  } catch (const Error& error) {  // a length that the files' units do not resolve, for example
    return error.what();
  }
  return "";
}

}  // namespace vkh
