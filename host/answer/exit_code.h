// The exit codes of answers. host/include/vkhausdorff/error.h has those of errors.
#pragma once

#include "vkhausdorff/answer.h"
#include "vkhausdorff/error.h"

namespace vkh {

/// The code of a pair's answer: kExitClosed, kExitBeyond or kExitNotClosed.
ExitCode code_of(const Answer& answer);

/// The code of a batch with two pairs: the worse, in the order 70, 5, 4, 6, 2, 1, 3, 0.
ExitCode worse(ExitCode x, ExitCode y);

}  // namespace vkh
