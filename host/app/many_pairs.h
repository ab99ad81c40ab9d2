// The commands about many pairs, from the typed options to an exit code.
#pragma once

#include "host/answer/exit_code.h"
#include "host/answer/request.h"

namespace vkh {

/// Throw what run_batch() and Results throw. Notes go to stderr.
ExitCode run_batch_command(const Request& asked);
ExitCode run_merge_command(const Request& request);

}  // namespace vkh
