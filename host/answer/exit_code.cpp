#include "host/answer/exit_code.h"

#include <algorithm>
#include <array>
#include <new>

#include "host/base/error.h"

namespace vkh {

ExitCode code_of(const Answer& answer) {
  if (!answer.max) {
    const Status status = interval_of(answer).status;
    const bool is_pruned = answer.part && status == Status::kPruned;  // all that it was to do
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

ExitCode code_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const UsageError&) {
    return kExitUsage;
  } catch (const InputError&) {
    return kExitBadInput;
  } catch (const DeviceError&) {
    return kExitDevice;
  } catch (const OutputError&) {
    return kExitNotWritten;
  } catch (const Interrupted&) {
    return kExitNotClosed;
  } catch (const std::bad_alloc&) {
    return kExitDevice;
  } catch (...) {
    return kExitInternal;
  }
}

ExitCode worse(ExitCode x, ExitCode y) {
  constexpr std::array kWorstFirst{kExitInternal, kExitDevice, kExitBadInput,  kExitNotWritten,
                                   kExitUsage,    kExitBeyond, kExitNotClosed, kExitClosed};
  return *std::find_if(kWorstFirst.begin(), kWorstFirst.end(),
                       [&](ExitCode code) { return code == x || code == y; });
}

}  // namespace vkh
