// The program's exit codes.
#pragma once

#include <exception>

#include "host/answer/answer.h"

namespace vkh {

enum ExitCode {
  kExitClosed = 0,  ///< closed, or proven to be within the limit
  kExitBeyond = 1,  ///< beyond the limit, proven
  kExitUsage = 2,
  kExitNotClosed = 3,  ///< not closed, or undecided; the interval is true
  kExitBadInput = 4,
  kExitDevice = 5,
  kExitNotWritten = 6,  ///< the answer was given and an output could not be written
  kExitInternal = 70,   ///< a bug of ours; sysexits.h's EX_SOFTWARE
};

/// The code of a pair's answer: kExitClosed, kExitBeyond or kExitNotClosed.
ExitCode code_of(const Answer& answer);

/// The code of the exception that `error` holds, which must be one of host/base/error.h's or
/// std::bad_alloc; else kExitInternal.
ExitCode code_of(const std::exception_ptr& error);

/// The code of a batch with two pairs: the worse, in the order 70, 5, 4, 6, 2, 1, 3, 0.
ExitCode worse(ExitCode x, ExitCode y);

}  // namespace vkh
