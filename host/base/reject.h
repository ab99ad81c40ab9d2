// Errors about input that name the file, the place, the error and the expected form.
#pragma once

#include <string>
#include <string_view>

namespace vkh {

/// Throws InputError of these parts. `place` is empty if nothing of the file was read.
[[noreturn]] void reject(std::string_view name, const std::string& place, const std::string& what,
                         const std::string& expected);

/// A word of a file for an error line: quoted, at most 32 bytes, unprintable bytes as \xNN.
std::string quoted(std::string_view word);

}  // namespace vkh
