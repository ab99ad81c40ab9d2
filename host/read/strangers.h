// Formats that are not read, by name: what a file is, and what to use instead.
#pragma once

#include <string>
#include <string_view>

namespace vkh {

/// Describes such a file, and what to do. `what` is empty if the format is not known.
struct Stranger {
  std::string what;      ///< "a STEP file (CAD surfaces, no triangles)"
  std::string expected;  ///< "a mesh: export the part as STL, OBJ, PLY, OFF, glTF or 3MF"
};

/// Recognises a format by a file's first bytes.
Stranger stranger_by_content(std::string_view head);
/// Recognises a format by a file's extension, which the caller gives in lower case and with its
/// point: ".step".
Stranger stranger_by_extension(std::string_view extension);

}  // namespace vkh
