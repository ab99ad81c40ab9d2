// Merges the written answers of A's parts into one answer for all of A.
#pragma once

#include <string>
#include <vector>

#include "host/answer/json_object.h"

namespace vkh {

/// An answer, and the file and the place in it where it was read.
struct WrittenAnswer {
  std::string file, place;
  Json json;
};

/// Whether the answer says that it covers a part alone.
bool is_part(const Json& answer);

/// All lines of the files, if the first one of the first file is a part's; else none. Throws
/// InputError for a file that cannot be read, and for lines that are no JSON.
std::vector<WrittenAnswer> read_parts(const std::vector<std::string>& files);

/// Returns the answer of all of A: lower is the largest, with its
/// witness; upper is the largest; their bits are carried, and only compared. It is closed if that
/// width is at most the tolerance in exact arithmetic, even if parts were not closed: a part that
/// was pruned by a known lower bound has an upper end like any other. Throws InputError, naming
/// file and place, unless they are all parts of one A and one B (the SHA-256 of both files), each
/// once, of one tolerance and one version. There is at least one.
Answer merge_parts(const std::vector<WrittenAnswer>& parts);

}  // namespace vkh
