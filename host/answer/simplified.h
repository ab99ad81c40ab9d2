// The answer of `simplify`: in words, as a table, and as one JSON object.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "vkhausdorff/answer.h"
#include "vkhausdorff/levels.h"
#include "vkhausdorff/simplify.h"

namespace vkh {

inline constexpr const char* kSimplifySchema = "vkhausdorff.simplify/1";

/// A mesh that was written, and its deviation from A as it was read back.
struct SimplifiedFile {
  std::string path;
  std::string format;  ///< "PLY", "STL", "OBJ" or "GLB"
  std::string sha256 = {};
  MeshCounts counts;
  Deviation deviation;
};

struct SimplifyAnswer {
  std::vector<std::string> words;
  Input input;
  std::string unit;  ///< the unit of every length; empty: A's, which is not known
  Length max;
  Limit limit;  ///< the same length in the unit
  bool one_way = false, lock_borders = false;
  bool complete = false;  ///< the search, or the chain, came to its own end
  size_t tried = 0;
  bool is_chain = false;  ///< of levels, the finest first
  size_t levels = 0;      ///< of a chain: how many were asked for
  ChainEnd chain_end = ChainEnd::kAll;
  std::vector<std::string> removed;   ///< files of an earlier chain's further levels
  std::vector<SimplifiedFile> files;  ///< none: nothing was found
  std::string certificate;            ///< its path; empty: none
  DeviceDescription device;
  Waits waits;
};

/// "1,234 of 30,268 faces, proven within 0.1 mm of A, both ways (largest deviation 0.0987 mm)".
std::string in_words(const SimplifyAnswer& answer);
void print_table(std::ostream& out, const SimplifyAnswer& answer);
/// One line of docs/schema/simplify.schema.json.
std::string to_json(const SimplifyAnswer& answer);
/// The same line for an error.
std::string to_simplify_json(const Failure& failure);

}  // namespace vkh
