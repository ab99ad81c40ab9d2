// Deflates texts on all cores.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vkh {

/// Whether texts are deflated here: without zlib they cannot be.
bool can_deflate();

/// A quick or a thorough search for what repeats, by zlib's levels 3 and 6; or none, only a code
/// for each byte.
enum class Deflate { kQuick, kThorough, kCodes };

struct DeflatePart {
  std::string_view bytes;
  Deflate how;
};

/// Deflates parts, one after the other, to one text in zlib's format (RFC 1950): the same one on
/// any number of threads. Throws std::bad_alloc if there is no memory.
std::string deflated(std::span<const DeflatePart> parts);

}  // namespace vkh
