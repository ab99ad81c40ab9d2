// The end where this machine has no memory left: without allocating any.
#pragma once

namespace vkh {

/// One line on stderr. Returns `code`.
int complain_of_memory(int code);

/// From now on also where no exception may pass, such as the destructors of JSON values, which
/// allocate: the line, and the end with `code`, instead of std::terminate.
void end_where_memory_ends(int code);

}  // namespace vkh
