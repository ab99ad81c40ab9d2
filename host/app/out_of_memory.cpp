#include "host/app/out_of_memory.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "host/base/system.h"

namespace vkh {
namespace {

int g_code = 0;  // global, since a handler can reach nothing else

[[noreturn]] void on_terminate() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    end_process(complain_of_memory(g_code));
  } catch (...) {  // a bug of ours: abort as without a handler
  }
  std::abort();
}

}  // namespace

int complain_of_memory(int code) {
  std::fputs("vkhausdorff: this machine has not enough memory for these meshes\n", stderr);
  return code;
}

void end_where_memory_ends(int code) {
  g_code = code;
  std::set_terminate(on_terminate);
}

}  // namespace vkh
