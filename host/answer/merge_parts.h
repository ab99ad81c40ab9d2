// The answers of A's parts, as they were written, as one answer for all of A.
#pragma once

#include <string>
#include <vector>

#include "host/answer/json_object.h"

namespace vkh {

/// An answer, and where it was read: a file, and a place in it.
struct WrittenAnswer {
  std::string file, place;
  Json json;
};

/// Whether it says that it is of a part alone.
bool is_part(const Json& answer);

/// All lines of the files, where the first one of the first file is a part's; else none. Throws
/// InputError for what cannot be read, and for lines that are no JSON.
std::vector<WrittenAnswer> read_parts(const std::vector<std::string>& files);

/// One line of JSON, of docs/schema/answer.schema.json: lower the largest, with its witness; upper
/// the largest; their bits are carried, and only compared. It is closed where that width is at most
/// the tolerance in exact arithmetic, whatever became of the parts: one that was pruned by a known
/// lower bound has an upper end like any other. Throws InputError, naming file and place, unless
/// they are all parts of one A and one B (the SHA-256 of both files), each once, of one tolerance
/// and one version. There is at least one.
std::string merge_parts(const std::vector<WrittenAnswer>& parts);

}  // namespace vkh
