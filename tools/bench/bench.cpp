// vkh_bench pairs|survey|read|simplify|workspace ...: what takes how long.
#include "tools/bench/bench.h"

#include <cstdio>
#include <map>

namespace {

int run(int argc, char** argv) {
  using namespace vkh::bench;
  CLI::App app("What takes how long", "vkh_bench");
  app.require_subcommand(1);
  std::map<std::string, Measure> measures;
  const auto add = [&](const char* name, const char* text, Measure (*add_to)(CLI::App&)) {
    measures[name] = add_to(*app.add_subcommand(name, text));
  };
  add("pairs", "The solver's times over a manifest of pairs", add_pairs);
  add("survey", "Bounds of the distance over all of A, over a manifest", add_survey);
  add("read", "The reading of mesh files", add_read);
#ifdef VKH_HAS_MESHOPTIMIZER
  add("simplify", "Faces that simplify keeps, beside meshoptimizer by itself", add_simplify);
#endif
  add("workspace", "What a smaller workspace costs", add_workspace);
  CLI11_PARSE(app, argc, argv);
  return measures.at(app.get_subcommands()[0]->get_name())();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vkh_bench: %s\n", error.what());
    return 2;
  }
}
