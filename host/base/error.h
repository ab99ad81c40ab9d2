// The errors that the outside world can cause. host/ throws these; main catches once and maps them
// to exit codes.
#pragma once

#include <stdexcept>
#include <string>

namespace vkh {

/// A file, mesh or array that cannot be accepted. One line: file, place, the error, the expected
/// form.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A Vulkan device or driver that is missing, lacks a feature, was lost or ran out of memory.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// No memory for the data that the device is to work on.
struct MemoryError : DeviceError {
  using DeviceError::DeviceError;
};

/// An answer exists, but a file, pipe or disk does not take it.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The caller called it off before there was an answer.
struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A command line or option that makes no sense.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace vkh
