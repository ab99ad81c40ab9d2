// The subcommands of vkh_bench: each adds its options to its command, and returns what then
// measures.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace vkh::bench {

/// Returns the exit code; throws what went wrong.
using Measure = std::function<int()>;

/// The solver's times over a manifest of pairs, by presets and changes of them.
Measure add_pairs(CLI::App& command);
/// The accuracy and cost of surveys over a manifest.
Measure add_survey(CLI::App& command);
/// The time of reading files.
Measure add_read(CLI::App& command);
/// The faces that simplify keeps.
Measure add_simplify(CLI::App& command);
/// The time of a run in smaller workspaces.
Measure add_workspace(CLI::App& command);

}  // namespace vkh::bench
