// The errors that the outside world can cause: one class, whose kind says what went wrong. host/
// throws them; main and Python catch once.
#pragma once

#include <concepts>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

/// The program's exit codes.
enum ExitCode {
  kExitClosed = 0,  ///< closed, or proven to be within the limit
  kExitBeyond = 1,  ///< beyond the limit, proven
  kExitUsage = 2,
  kExitNotClosed = 3,  ///< not closed, or undecided; the interval is true
  kExitBadInput = 4,
  kExitDevice = 5,
  kExitNotWritten = 6,  ///< the answer was given and an output could not be written
  kExitInternal = 70,   ///< a bug of ours; sysexits.h's EX_SOFTWARE
};

enum class ErrorKind {
  kUsage,        ///< a command line or option that makes no sense
  kInput,        ///< a file, mesh or array that cannot be accepted
  kDevice,       ///< a Vulkan device or driver that is missing, lacks a feature or failed
  kDeviceLost,   ///< the device was lost: the same one, opened again, may do the work
  kMemory,       ///< no memory on the device or the host: less work at once may fit
  kOutput,       ///< an answer exists, but a file, pipe or disk does not take it
  kInterrupted,  ///< the caller called it off before there was an answer
  kInternal,     ///< a bug of ours, or an exception of the caller's own, from a callback
};

/// The exit code of a run that such an error ends.
ExitCode code_of(ErrorKind kind);

/// The parts of an error. All but `problem` may be empty.
struct ErrorParts {
  std::string option = {};  ///< the option that names the file, such as "--json": an output's
  std::string file = {};    ///< the file, or the name of a mesh that is in none
  std::string place = {};   ///< the line, byte, face or element of the file
  std::string problem;
  std::string expected = {};  ///< the form that would have been accepted
};

/// An error. `what()` is its parts in one line: "file: place: problem; expected FORM", or
/// "option 'file': ..." with an option.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, ErrorParts parts);

  ErrorKind kind() const { return kind_; }
  const ErrorParts& parts() const { return parts_; }
  const std::string& file() const { return parts_.file; }
  const std::string& place() const { return parts_.place; }

  /// The same error about the same file under another name.
  Error renamed(const std::string& file) const;

 private:
  ErrorKind kind_;
  ErrorParts parts_;
};

/// Converts an exception to an Error: std::bad_alloc becomes one of memory, and anything else that
/// is no Error becomes a bug of ours.
Error error_of(const std::exception_ptr& thrown);

/// An error of one kind, under the name by which it is thrown and caught.
template <ErrorKind kKind, class Base = Error>
class ErrorOf : public Base {
 public:
  /// A template, because with a std::string parameter g++ would read {"x", "y"} as a string's begin
  /// and end instead of as two members of ErrorParts.
  template <std::convertible_to<std::string> Text>
  explicit ErrorOf(const Text& problem) : ErrorOf(ErrorParts{.problem = problem}) {}
  explicit ErrorOf(ErrorParts parts) : Base(kKind, std::move(parts)) {}

 protected:
  ErrorOf(ErrorKind kind, ErrorParts parts) : Base(kind, std::move(parts)) {}
};

struct UsageError : ErrorOf<ErrorKind::kUsage> {
  using ErrorOf::ErrorOf;
};
struct InputError : ErrorOf<ErrorKind::kInput> {
  using ErrorOf::ErrorOf;
};
/// Any error of a device, lost or without memory, too.
struct DeviceError : ErrorOf<ErrorKind::kDevice> {
  using ErrorOf::ErrorOf;
};
struct DeviceLost : ErrorOf<ErrorKind::kDeviceLost, DeviceError> {
  using ErrorOf::ErrorOf;
};
struct MemoryError : ErrorOf<ErrorKind::kMemory, DeviceError> {
  using ErrorOf::ErrorOf;
};
struct OutputError : ErrorOf<ErrorKind::kOutput> {
  using ErrorOf::ErrorOf;
};
struct Interrupted : ErrorOf<ErrorKind::kInterrupted> {
  using ErrorOf::ErrorOf;
};

}  // namespace vkh
