// Every option, one row each. The program makes its options, their help and the columns of lists
// from it; Python, its keywords; and a batch, the keys by which it recognises a pair. tools/options
// makes the man page, the completions and the package's signatures from it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "host/answer/request.h"

namespace vkh {

/// The reading of a text, and the shape that help shows.
enum class Kind {
  kFlag,
  kText,
  kFile,       ///< to be written
  kInput,      ///< to be read; in a list, from the list's folder
  kFolder,     ///< to be written into
  kUnit,       ///< of length
  kLength,     ///< with its unit
  kTolerance,  ///< a length, or a small fraction of the diagonal
  kLengths,    ///< between commas
  kNames,      ///< between commas
  kChoice,     ///< one of Option::choices
  kShare,      ///< of area
  kPercentile,
  kAngle,
  kSize,  ///< of memory or a file
  kTime,
  kCount,   ///< from Option::least to Option::most
  kNumber,  ///< from Option::least to Option::most
  kPart,    ///< I/N
};

/// The headings of --help-all, in its order.
enum class Group { kQuestion, kPlacement, kOutput, kDrawing, kMany, kCost };
const char* heading_of(Group group);

/// Says where a text comes from, which decides what a number alone means.
enum class Outlet {
  kTyped,         ///< on the command line or in a list: lengths have a unit or are shares
  kPythonText,    ///< a string of Python: no length has a unit, which arrays do not have
  kPythonNumber,  ///< a number of Python, in the decimals that are this very double
};

/// A text that was given for an option, and the option's name in messages: --unit-a of the command
/// line, unit_a of a list and of Python.
struct Given {
  std::string said;
  std::span<const std::string> texts;  ///< several where the kind has commas; none of a flag
  Outlet outlet = Outlet::kTyped;
  const std::string& text() const { return texts.front(); }
};

template <class T>
using Member = T& (*)(Request&);

/// An option that fills in more than one member, or one by a rule of its own.
struct Own {
  void (*put)(const Given& given, Request& asked);
  /// The text for keys, which differs for different values; null: the option is in no key.
  std::string (*text)(const Request& asked);
};

using Target =
    std::variant<Own, Member<bool>, Member<std::string>, Member<std::optional<std::string>>,
                 Member<std::vector<std::string>>, Member<Length>, Member<std::optional<Length>>,
                 Member<std::vector<Length>>, Member<double>, Member<std::optional<double>>,
                 Member<uint32_t>, Member<uint64_t>, Member<std::optional<uint64_t>>,
                 Member<PartOf>, Member<std::optional<PartOf>>>;

/// An option of some commands. In `help`, "{lengths}" stands for the forms of a length.
struct Use {
  Commands of = 0;
  std::string help;
  const char* otherwise = "";  ///< its value where it is not given, as help shows it
  bool required = false;
  std::vector<std::string> more = {};  ///< choices besides Option::choices
};

/// The functions of Python that take a keyword, one bit each.
using Functions = uint32_t;
constexpr Functions kPyDistance = 1, kPyGate = 2, kPyMetrics = 4, kPyMany = 8, kPySolver = 16,
                    kPyRead = 32, kPySimplify = 64;

struct Option {
  const char* name;
  Kind kind;
  Group group;
  Target target;
  std::vector<Use> uses;
  Commands few = 0;                       ///< the commands whose --help shows it
  bool is_column = false;                 ///< of lists
  Functions functions = 0;                ///< of Python
  const char* keyword = "";               ///< Python's name, where it is another one
  const char* shape = "";                 ///< of its value in help; empty: the kind's
  std::vector<std::string> choices = {};  ///< of other kinds than kChoice and kNames: some of many
  bool has_others = false;     ///< of names: `choices` is not complete, and complete() checks them
  const char* noun = "";       ///< what a count is of, in the plural
  const char* none = "";       ///< Python's default, where the kind does not say it
  double least = 0, most = 0;  ///< of counts and numbers
  std::vector<std::string> also = {};  ///< other names for it, in lower case without blanks
  const char* unlike =
      "";  ///< why its value does not change the question: not part of a pair's key
};

/// All options, in the order of their help.
const std::vector<Option>& options();

/// The row of this name on the command line, or null.
const Option* option_of(std::string_view name);
/// The row of a list's column, or null.
const Option* column_of(std::string_view name);

/// The option's name in lists, and in Python.
std::string column_name(const Option& option);
std::string keyword_name(const Option& option);

/// The default of a keyword, as Python writes it.
std::string keyword_default(const Option& option, Functions function);

/// The use of the option by a command; null: the command does not have it.
const Use* use_of(const Option& option, Commands command);

/// The shape of its value in help: LENGTH, FILE, fan|any; empty for a flag.
std::string shape_of(const Option& option);

/// Whether a count or a number is within the option's limits.
inline bool is_within(const Option& option, double number) {
  return number >= option.least && number <= option.most;
}

template <class T>
struct Unwrapped {
  using Type = T;
};
template <class T>
struct Unwrapped<std::optional<T>> {
  using Type = T;
};

/// Fills in the option's member with the value that `read` returns for the member's type, which is
/// never an optional. Options with a rule of their own have no such member, and are left alone.
template <class Read>
void fill(const Option& option, Request& asked, const Read& read) {
  const auto put_in = [&]<class T>(Member<T> member) {
    member(asked) = read.template value<typename Unwrapped<T>::Type>();
  };
  std::visit(
      [&](const auto& target) {
        if constexpr (!std::is_same_v<decltype(target), const Own&>) put_in(target);
      },
      option.target);
}

/// Puts what was given in its place. Throws UsageError that names the option, the text and the
/// expected form.
void put(const Option& option, const Given& given, Request& asked);

/// All that a pair's answer depends on: a line for each option that differs from its default.
std::string key_text(Request asked);

}  // namespace vkh
