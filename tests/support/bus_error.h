// Reports the cause of a bus error, before it ends a test program. doctest reports the other
// signals.
#pragma once

namespace vkh::test {

/// From now on writes to stderr the address, the mapping there and the callers. There are two
/// kinds: a file that is mapped and has no room on its disk, or was cut (BUS_ADRERR: it names the
/// file), and an address that no memory can have, through the stack's registers (SI_KERNEL: a
/// kernel or a library has gone astray). Kernels run on threads of Mesa's, which block all signals:
/// a fault there ends the process before any handler hears of it, doctest's too. So these programs
/// have a pthread_sigmask of their own, which lets faults through.
void explain_bus_errors();

}  // namespace vkh::test
