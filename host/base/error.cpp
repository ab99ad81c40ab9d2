#include "vkhausdorff/error.h"

#include <algorithm>
#include <new>
#include <utility>

namespace vkh {
namespace {

/// Names of files may hold anything, and the error is one line.
std::string without_controls(std::string line) {
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, '?');
  return line;
}

std::string subject_of(const ErrorParts& parts) {
  return parts.option.empty() ? parts.file : parts.option + " '" + parts.file + "'";
}

std::string line_of(ErrorKind kind, const ErrorParts& parts) {
  std::string line;
  for (const std::string& before : {subject_of(parts), parts.place}) {
    if (!before.empty()) line += before + ": ";
  }
  line += parts.problem;
  if (!parts.expected.empty()) line += "; expected " + parts.expected;
  return kind == ErrorKind::kInput ? without_controls(std::move(line)) : line;
}

}  // namespace

ExitCode code_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
      return kExitUsage;
    case ErrorKind::kInput:
      return kExitBadInput;
    case ErrorKind::kDevice:
    case ErrorKind::kDeviceLost:
    case ErrorKind::kMemory:
      return kExitDevice;
    case ErrorKind::kOutput:
      return kExitNotWritten;
    case ErrorKind::kInterrupted:
      return kExitNotClosed;
    case ErrorKind::kInternal:
      break;
  }
  return kExitInternal;
}

Error::Error(ErrorKind kind, ErrorParts parts)
    : std::runtime_error(line_of(kind, parts)), kind_(kind), parts_(std::move(parts)) {}

Error Error::renamed(const std::string& file) const {
  ErrorParts parts = parts_;
  parts.file = file;
  return {kind_, std::move(parts)};
}

Error error_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return {ErrorKind::kMemory, {.problem = "no memory"}};
  } catch (const std::exception& error) {
    return {ErrorKind::kInternal, {.problem = error.what()}};
  } catch (...) {
    return {ErrorKind::kInternal, {.problem = "internal error"}};
  }
}

}  // namespace vkh
