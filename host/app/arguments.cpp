#include "host/app/arguments.h"

#include <algorithm>
#include <sstream>

#include "host/answer/rules.h"
#include "host/app/help_text.h"
#include "host/app/misuse.h"
#include "host/app/program.h"
#include "host/show/draw_answer.h"
#include "host/write/mesh_file.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

void check_name_ends(const char* option, const std::optional<std::string>& path,
                     const char* ending) {
  if (path && !path->ends_with(ending))
    throw UsageError(std::string(option) + " '" + *path + "': expected a name that ends in " +
                     ending);
}

void check_simplify(const Request& asked) {
  if (!mesh_format_of(asked.outputs.out))
    throw UsageError("--out '" + asked.outputs.out +
                     "': expected a name that ends in .ply, .obj, .stl or .glb");
  check_name_ends("--certificate", asked.outputs.certificate, ".vhc");
}

/// Decides whether the files are a list, two folders, or meshes against one B.
void check_source(const Request& asked) {
  const ManyRequest& many = asked.many;
  if (many.against.empty() && many.files.size() > 2)
    throw UsageError("batch: expected one LIST, two folders, or --against B with meshes");
  if (many.allows_unpaired && (!many.against.empty() || many.files.size() != 2))
    throw UsageError("--allow-unpaired: is of two folders: batch FOLDER_A FOLDER_B");
}

/// Adds to the question what pictures show.
void ask_for_pictures(Request& asked) {
  const Outputs& outputs = asked.outputs;
  const PictureStyle style = style_of(outputs.look);  // throws for an invalid look
  if (outputs.image || outputs.points || outputs.report || outputs.figures)
    ask_for(style, asked.question);
}

void make_sense(Request& asked) {
  if (asked.command == kMetrics) asked.metrics = true;
  check_together(asked, with_dashes);
  if (asked.command == kSimplify) check_simplify(asked);
  if (asked.command == kBatch) check_source(asked);
  complete(asked, with_dashes);
  ask_for_pictures(asked);
}

std::string expected_behind(const std::string& word, const Option& option) {
  const std::string shape = shape_of(option);
  if (option.kind == Kind::kFile || shape.starts_with('['))
    return "the name of a file, as in " + word + "answer.txt";
  return shape.empty() ? "true or false" : shape + ", as in " + word + shape;
}

/// Refuses an option whose value is empty: the parser would take the next word for it.
void check_values(const Words& words) {
  for (const std::string& word : words) {
    if (!word.starts_with("--") || !word.ends_with('=')) continue;
    const Option* option = option_of(std::string_view(word).substr(2, word.size() - 3));
    if (option == nullptr) continue;
    throw UsageError(word + "'': expected " + expected_behind(word, *option));
  }
}

std::string help_text(Program& program, bool shows_all) {
  return wrapped(program.help(shows_all), terminal_columns());
}

}  // namespace

CommandLine understand(const Words& given) {
  Words words = given;
  if (!words.empty() && words[0] == "help") {
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  check_values(words);
  Program program;
  try {
    program.app().parse(Words(words.rbegin(), words.rend()));  // CLI11 wants them reversed
  } catch (const CLI::CallForHelp&) {
    return {.help = help_text(program, false), .asked = {}};
  } catch (const CLI::CallForAllHelp&) {
    return {.help = help_text(program, true), .asked = {}};
  } catch (const CLI::Success& version) {
    std::ostringstream text, none;
    program.app().exit(version, text, none);
    return {.help = text.str(), .asked = {}};
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_message(program.app(), error, words));
  }
  CommandLine line{.help = {}, .asked = program.asked()};
  line.asked.question.words = words;
  make_sense(line.asked);
  return line;
}

}  // namespace vkh
