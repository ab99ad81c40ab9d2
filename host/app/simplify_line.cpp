#include "host/app/simplify_line.h"

#include <CLI/CLI.hpp>
#include <limits>

#include "host/answer/options.h"
#include "host/write/mesh_file.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

void add_unit(CLI::App& command, Typed& typed) {
  command
      .add_option("--unit", typed.unit,
                  "What A's file is in, if it does not say: um, mm, cm, m, in or ft")
      ->type_name("UNIT");
}

void add_json(CLI::App& command, Typed& typed) {
  command
      .add_flag("--json", typed.json,
                "Print one JSON object instead of the table; --json=FILE, without a space, writes "
                "it beside the table")
      ->type_name("[=FILE]");
}

}  // namespace

void add_simplify(CLI::App& command, TypedSimplify& typed) {
  command.footer(
      "The result is read back as it was written, and measured, before it has its name. UVs, "
      "normals and colours are dropped. The distance alone is proven: neither that the result is "
      "watertight nor how its faces are turned.");
  command.add_option("A", typed.of_mesh.file_a, "Mesh to simplify (OBJ, STL, PLY, OFF, glTF, 3MF)")
      ->required();
  command
      .add_option("--max", typed.of_mesh.max,
                  std::string("The limit, for each point of either mesh: ") + kLengths)
      ->type_name("LENGTH")
      ->required();
  command.add_option("--out", typed.out, "The result: .ply, .obj, .stl or .glb")
      ->type_name("FILE")
      ->required();
  command.add_flag("--one-way", typed.one_way,
                   "Limit the points of A alone: the result may reach farther from A");
  command.add_flag("--lock-borders", typed.lock_borders,
                   "Keep each vertex of an edge that only one face has");
  command
      .add_option("--certificate", typed.certificate,
                  "Write what proves the distances, for vkh_check to check: .vhc")
      ->type_name("FILE");
  command
      .add_option("--levels", typed.levels,
                  "Write a chain instead, each level measured against A itself: B-1.ply, the "
                  "finest, to B-N.ply, as far as the limit allows")
      ->type_name("N")
      ->check(CLI::Range(1, 32));
  command
      .add_option("--ratio", typed.ratio,
                  "With --levels: the share of faces from one to the next [0.5]")
      ->type_name("SHARE")
      ->check(CLI::Range(0.01, 0.99));
  add_unit(command, typed.of_mesh);
  add_input_options(command, typed.of_mesh);
  add_json(command, typed.of_mesh);
  add_search_options(command, typed.of_mesh);
}

CommandLine simplify_line(const TypedSimplify& typed, const Words& words) {
  Typed of_mesh = typed.of_mesh;
  of_mesh.tolerance = "1e-7";
  of_mesh.symmetric = !typed.one_way;
  CommandLine line;
  line.command = Command::kSimplify;
  line.question = question_of(of_mesh, words, "simplify");
  line.outputs = outputs_of(of_mesh);
  line.time_limit_s =
      of_mesh.time ? parse_time(*of_mesh.time) : std::numeric_limits<double>::infinity();
  if (line.question.max_sides)
    throw UsageError("--max '" + of_mesh.max + "': expected one length, such as 0.1mm");
  if (!mesh_format_of(typed.out))
    throw UsageError("--out '" + typed.out +
                     "': expected a name that ends in .ply, .obj, .stl or .glb");
  if (!typed.certificate.empty() && !typed.certificate.ends_with(".vhc"))
    throw UsageError("--certificate '" + typed.certificate +
                     "': expected a name that ends in .vhc");
  if (typed.ratio && !typed.levels) throw UsageError("--ratio: is of --levels");
  if (typed.levels && !typed.certificate.empty())
    throw UsageError("--certificate: is of one mesh: leave --levels out");
  line.simplify = {.out = typed.out,
                   .certificate = typed.certificate,
                   .lock_borders = typed.lock_borders,
                   .levels = typed.levels.value_or(0),
                   .ratio = typed.ratio.value_or(0.5)};
  return line;
}

}  // namespace vkh
