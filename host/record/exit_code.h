// What the program's end says.
#pragma once

namespace vkh {

enum ExitCode {
  kExitClosed = 0,  ///< or within the limit, proven
  kExitBeyond = 1,  ///< beyond the limit, proven
  kExitUsage = 2,
  kExitNotClosed = 3,  ///< or undecided; the interval is true
  kExitBadInput = 4,
  kExitDevice = 5,
  kExitNotWritten = 6,  ///< the answer was given and an output could not be written
  kExitInternal = 70,   ///< a bug of ours; sysexits.h's EX_SOFTWARE
};

}  // namespace vkh
