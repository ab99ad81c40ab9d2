// Ends the program when this machine has no memory left, without allocating any.
#pragma once

namespace vkh {

/// Prints one line on stderr. Returns `code`.
int complain_of_memory(int code);

/// From now on, running out of memory prints the line and ends with `code` instead of
/// std::terminate, also where no exception may pass, such as in the destructors of JSON values,
/// which allocate.
void end_where_memory_ends(int code);

}  // namespace vkh
