// Reads the keywords of a call from Python, each by its row of the options table.
#pragma once

#include <string>
#include <vector>

#include "host/answer/options_table.h"
#include "host/python/arguments.h"

namespace vkh::python {

/// The arguments of a function: its own first, and then the keywords that the table has for it,
/// unless they are among those.
Signature signature_of(Functions function, const char* name, const std::vector<std::string>& own,
                       size_t required, size_t positional);

/// The keywords with their defaults, except `own`, as a signature has them: "tol=1e-6, ...".
std::string keywords_text(Functions function, const std::vector<std::string>& own);

/// Returns paragraphs for the keywords that the text of a function does not name, with the help of
/// their rows.
std::string more_text(Functions function, const std::string& text);

/// Reads these keywords, except the device. Numbers are in terms of the arrays: a tolerance is a
/// fraction of A's diagonal, and other lengths are in the coordinates' unit. Strings are as on the
/// command line, without units, which arrays do not have. `command`: the name of the function in an
/// answer.
Request request_of(Functions function, const char* command, const Arguments& given);

/// key_text() of these keywords, for tests: the same as of an equivalent command line.
std::string key_of_keywords(Functions function, const pybind11::kwargs& given);

}  // namespace vkh::python
