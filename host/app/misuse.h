// Messages about a wrong command line, with a guess at what was meant.
#pragma once

#include <string>

#include "host/app/arguments.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace vkh {

/// Rewrites an error of the parser: with the option or the command that a misspelt one may mean.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error,
                          const Words& words);

}  // namespace vkh
