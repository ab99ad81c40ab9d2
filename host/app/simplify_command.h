// The command `simplify`, from its options to an exit code.
#pragma once

#include "host/answer/exit_code.h"
#include "host/answer/request.h"
#include "host/answer/stop.h"

namespace vkh {

/// Prints the answer. Returns kExitClosed if a mesh was written, kExitNotClosed if none was found.
/// Throws what reading, Device, Solver and OutputFile throw, and writes it as JSON before that, if
/// JSON was asked for.
ExitCode run_simplify_command(const Request& asked, const Stop& stop);

}  // namespace vkh
