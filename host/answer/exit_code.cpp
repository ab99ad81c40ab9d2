#include "host/answer/exit_code.h"

#include <algorithm>
#include <array>

namespace vkh {

ExitCode code_of(const Answer& answer) {
  if (answer.metrics) return answer.metrics->is_met() ? kExitClosed : kExitNotClosed;
  if (!answer.max) {
    const Status status = interval_of(answer).status;
    const bool is_pruned =
        answer.part && status == Status::kPruned;  // which is all that a part has to do
    return status == Status::kClosed || is_pruned ? kExitClosed : kExitNotClosed;
  }
  switch (verdict_of(answer)) {
    case Verdict::kWithin:
      return kExitClosed;
    case Verdict::kBeyond:
      return kExitBeyond;
    case Verdict::kUndecided:
      break;
  }
  return kExitNotClosed;
}

ExitCode worse(ExitCode x, ExitCode y) {
  constexpr std::array kWorstFirst{kExitInternal, kExitDevice, kExitBadInput,  kExitNotWritten,
                                   kExitUsage,    kExitBeyond, kExitNotClosed, kExitClosed};
  return *std::find_if(kWorstFirst.begin(), kWorstFirst.end(),
                       [&](ExitCode code) { return code == x || code == y; });
}

}  // namespace vkh
