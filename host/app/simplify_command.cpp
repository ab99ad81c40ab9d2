#include "host/app/simplify_command.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <set>

#include "host/answer/progress_line.h"
#include "host/answer/session.h"
#include "host/answer/simplified.h"
#include "host/answer/steps.h"
#include "host/app/outputs.h"
#include "host/base/begin_now.h"
#include "host/base/output_file.h"
#include "host/base/system.h"
#include "host/read/readers.h"
#include "host/write/mesh_file.h"
#include "vkhausdorff/certificate.h"
#include "vkhausdorff/levels.h"

namespace vkh {
namespace {

/// The files to write, checked before any work.
struct SimplifyPlaces {
  std::vector<std::string> paths;
  std::vector<std::unique_ptr<OutputFile>> meshes;  ///< one for each path
  std::unique_ptr<OutputFile> json, certificate;
};

/// A mesh that was found, written and read back.
struct Written {
  SimplifiedFile file;
  Mesh mesh;
};

/// The name of a chain's level, from 1: B-1.ply.
std::string path_of_level(const std::string& out, size_t level) {
  const size_t stem = out.size() - 4;
  return out.substr(0, stem) + "-" + std::to_string(level) + out.substr(stem);
}

std::vector<std::string> paths_of(const std::string& out, size_t levels) {
  if (levels == 0) return {out};
  std::vector<std::string> paths;
  for (size_t level = 1; level <= levels; ++level) paths.push_back(path_of_level(out, level));
  return paths;
}

/// Refuses to write a chain beside further levels of another one, which would be taken for its own.
void check_further_levels(const std::string& out, size_t levels) {
  if (levels == 0) return;
  const std::string further = path_of_level(out, levels + 1);
  std::error_code none;
  if (std::filesystem::exists(path_of(further), none))
    throw UsageError("--levels " + std::to_string(levels) + ": '" + further +
                     "' is a further level of another chain: remove it, or choose another --out");
}

class SimplifyCommand {
 public:
  SimplifyCommand(const Request& asked, const Stop& stop)
      : question_(asked.question), asked_(asked.simplify), outputs_(asked.outputs), stop_(stop) {}

  /// Throws UsageError for files that cannot be written.
  void check_places() { places_ = places(); }
  ExitCode run();
  /// Writes the error in place of the answer, if JSON was asked for.
  void write_failure(const Failure& failure) const;

 private:
  SimplifyPlaces places() const;
  void read();
  void resolve_limit();
  SimplifyOptions options();
  std::vector<Simplified> search();
  Written write(const Mesh& mesh, const OutputFile& place, const std::string& path);
  void prove_it(const Written& written, const OutputFile& place);
  void remove_stale(size_t written);
  void write_answer();

  const Question& question_;
  const SimplifyRequest& asked_;
  const Outputs& outputs_;
  const Stop& stop_;
  ProgressLine line_;
  SimplifyPlaces places_;
  Session session_;
  ReadMesh a_;
  SimplifyAnswer answer_;
};

SimplifyPlaces SimplifyCommand::places() const {
  SimplifyPlaces places;
  const std::vector<std::string> inputs = {question_.file_a};
  std::set<std::filesystem::path> taken;
  const auto open = [&](const char* option, const std::string& path) {
    if (!taken.insert(place_of(path)).second)
      throw UsageError("two outputs would be written to '" + path + "'");
    return std::make_unique<OutputFile>(option, path, inputs);
  };
  check_further_levels(outputs_.out, asked_.levels);
  places.paths = paths_of(outputs_.out, asked_.levels);
  for (const std::string& path : places.paths) {
    places.meshes.push_back(open("--out", path));
    if (!places.meshes.back()->is_replaced())
      throw UsageError("--out '" + path +
                       "': expected a file, for the result is read back before it has its name");
  }
  if (outputs_.certificate) places.certificate = open("--certificate", *outputs_.certificate);
  if (outputs_.json_file) places.json = open("--json", *outputs_.json_file);
  return places;
}

/// Opens the device while the file is read.
void SimplifyCommand::read() {
  const bool is_share = question_.max->of == Length::Of::kDiagonal;
  const double share = is_share ? question_.max->number : 1;
  const SessionRequest request{
      .selector = question_.device,
      .threads = question_.threads,
      .engine = simplify_engine(question_.engine, share),
      .cache_folder = question_.caches ? user_cache_folder() : std::filesystem::path()};
  auto opening = begin_now([request] { return open_session(request); });
  ReadLimits limits = question_.limits;
  limits.keep_going = [this] { return !stop_.is_asked(); };
  a_ = read_mesh(path_of(question_.file_a), limits);
  answer_.input = {.path = question_.file_a,
                   .is_read = true,
                   .counts = a_.counts,
                   .place = {a_.delta, a_.unit},
                   .notes = a_.notes};
  if (question_.hashes)
    answer_.input.sha256 =
        sha256_of(path_of(question_.file_a), [this] { return !stop_.is_asked(); });
  answer_.waits.read = stop_.elapsed_s() * 1000;
  session_ = opening.get();
  answer_.waits.start = session_.setup_ms;
  answer_.device = session_.solver->description();
}

void SimplifyCommand::resolve_limit() {
  if (!question_.unit.empty() && !a_.unit.empty() && question_.unit != a_.unit)
    throw UsageError("--unit " + question_.unit + ": " + a_.name + " is in " + a_.unit);
  answer_.unit = a_.unit.empty() ? question_.unit : a_.unit;
  if (mesh_format_of(outputs_.out) == MeshFormat::kGlb && !answer_.unit.empty() &&
      answer_.unit != "m")
    throw UsageError("--out '" + outputs_.out + "': glTF is in metres, and A is in " +
                     answer_.unit + ": write .ply, .obj or .stl");
  answer_.max = *question_.max;
  answer_.limit = limit_in_files(answer_.max, "--max", answer_.unit, diagonal_of(a_));
}

SimplifyOptions SimplifyCommand::options() {
  SimplifyOptions options;
  options.max = answer_.limit;
  options.one_way = answer_.one_way = !question_.symmetric;
  options.lock_borders = answer_.lock_borders = asked_.lock_borders;
  options.rounds_to_float = !holds_doubles(*mesh_format_of(outputs_.out));
  options.time_limit_s = stop_.left_s();
  options.solve = run_options(question_);
  options.goes_on = [] { return !is_interrupted(); };
  options.progress = [this](const SimplifyProgress& progress) {
    line_.show([&] {
      return std::to_string(progress.tried) + " meshes judged, the smallest of " +
             std::to_string(progress.faces) + " faces";
    });
    return true;
  };
  return options;
}

/// Reads the file under the name that it will have.
Mesh read_back(const std::string& file, const std::string& name) {
  const InputFile input(path_of(file));
  if (!input.is_open()) throw OutputError({.file = name, .problem = "cannot be read back"});
  return parse_mesh({.name = name, .bytes = {}, .file = &input});
}

Written SimplifyCommand::write(const Mesh& mesh, const OutputFile& place, const std::string& path) {
  const MeshFormat format = *mesh_format_of(path);
  Written written{
      .file = {.path = path, .format = format_name(format), .counts = {}, .deviation = {}},
      .mesh = {}};
  const auto measure = [&](const std::string& file) {
    written.mesh = read_back(file, path);
    written.mesh.unit = a_.unit;  // coordinates are written as they are
    written.file.deviation = measure_deviation(*session_.solver, a_, written.mesh, options());
    if (is_interrupted())
      throw Interrupted(path + ": called off while it was measured, and not written");
    if (written.file.deviation.verdict != Verdict::kWithin)
      throw OutputError({.option = "--out",
                         .file = path,
                         .problem = "is farther from A as it is read back than as it was found"});
    if (question_.hashes)
      written.file.sha256 = sha256_of(path_of(file), [] { return !is_interrupted(); });
  };
  place.write(to_mesh_file(mesh, format), measure);
  if (written.mesh.faces.empty())
    measure(path);  // the file was overwritten in place: its folder is not writable
  written.file.counts = written.mesh.counts;
  return written;
}

void SimplifyCommand::prove_it(const Written& written, const OutputFile& place) {
  const Deviation& d = written.file.deviation;
  const SolveOptions run = run_options(question_);
  const auto goes_on = [](size_t) { return !is_interrupted(); };
  const Proof there = prove(*session_.solver, {a_, written.mesh, d.a_to_b, run, goes_on});
  std::optional<Proof> back;
  if (d.b_to_a) back = prove(*session_.solver, {written.mesh, a_, *d.b_to_a, run, goes_on});
  std::optional<CertifiedDirection> reverse;
  if (back) reverse.emplace(CertifiedDirection{*d.b_to_a, *back});
  place.write(certificate_of({a_, answer_.input.sha256}, {written.mesh, written.file.sha256},
                             {d.a_to_b, there}, reverse));
  answer_.certificate = outputs_.certificate.value_or("");
}

/// Removes the files of an earlier chain beyond this chain's last level: they would be taken for
/// its own.
void SimplifyCommand::remove_stale(size_t written) {
  for (size_t i = written; i < places_.paths.size(); ++i) {
    const std::string& path = places_.paths[i];
    std::error_code error;
    if (!std::filesystem::exists(path_of(path), error)) continue;
    if (!std::filesystem::remove(path_of(path), error))
      throw OutputError({.option = "--out",
                         .file = path,
                         .problem = "is of an earlier chain, and cannot be removed"});
    answer_.removed.push_back(path);
  }
}

void SimplifyCommand::write_answer() {
  line_.end();
  answer_.waits.total = stop_.elapsed_s() * 1000;
  if (outputs_.json) {
    std::cout << to_json(answer_) << '\n';
  } else {
    print_table(std::cout, answer_);
  }
  if (places_.json) places_.json->write(to_json(answer_) + '\n');
}

void SimplifyCommand::write_failure(const Failure& failure) const {
  const std::string json = to_simplify_json(failure) + '\n';
  if (outputs_.json) std::cout << json << std::flush;
  try {
    if (places_.json) places_.json->write(json);
  } catch (const OutputError&) {  // the line on stderr has the error
  }
}

/// The meshes that were found, in the order of their names.
std::vector<Simplified> SimplifyCommand::search() {
  std::vector<Simplified> found;
  if (asked_.levels > 0) {
    found = simplify_levels(*session_.solver, a_,
                            {.simplify = options(), .levels = asked_.levels, .ratio = asked_.ratio},
                            &answer_.chain_end);
    answer_.complete = !found.empty() ? found.back().complete : !stop_.is_asked();
    answer_.tried = found.size();
    return found;
  }
  Simplified one = simplify(*session_.solver, a_, options());
  answer_.complete = one.complete;
  answer_.tried = one.tried;
  if (one.found) found.push_back(std::move(one));
  return found;
}

ExitCode SimplifyCommand::run() {
  answer_.words = question_.words;
  read();
  resolve_limit();
  answer_.is_chain = asked_.levels > 0;
  answer_.levels = asked_.levels;
  const std::vector<Simplified> found = search();
  for (size_t i = 0; i < found.size(); ++i) {
    const Written written = write(found[i].mesh, *places_.meshes[i], places_.paths[i]);
    answer_.files.push_back(written.file);
    if (places_.certificate) prove_it(written, *places_.certificate);
  }
  if (!found.empty()) remove_stale(found.size());
  write_answer();
  return found.empty() ? kExitNotClosed : kExitClosed;
}

}  // namespace

ExitCode run_simplify_command(const Request& asked, const Stop& stop) {
  SimplifyCommand command(asked, stop);
  try {
    command.check_places();
  } catch (const UsageError& error) {
    report_misuse(asked.question.words, error);
    throw;
  }
  try {
    return command.run();
  } catch (const Error& error) {
    command.write_failure(failure_of(error));
    throw;
  }
}

}  // namespace vkh
