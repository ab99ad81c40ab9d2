// Errors about input that name the file, the place, the error and the expected form.
#pragma once

#include <string>
#include <string_view>

namespace vkh {

/// Throws "name: place: what; expected so and so", on one line whatever the name holds. `place` is
/// empty if nothing of the file was read.
[[noreturn]] void reject(std::string_view name, const std::string& place, const std::string& what,
                         const std::string& expected);

/// The place in a line that reject() made for that name; empty if it has none.
std::string place_in(std::string_view line, std::string_view name);

/// A word of a file for an error line: quoted, at most 32 bytes, unprintable bytes as \xNN.
std::string quoted(std::string_view word);

}  // namespace vkh
