// The arguments that Python passed, by name, and plain values of them. A wrong one is a TypeError
// or a ValueError that names the argument and what was expected.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vkh::python {

struct Signature {
  std::string function;
  std::vector<std::string> names;
  size_t required;    ///< the number of required ones, which come first
  size_t positional;  ///< the number of ones that may be given by position
};

class Arguments {
 public:
  Arguments(const Signature& signature, const pybind11::args& positional,
            const pybind11::kwargs& named);
  /// Returns a required argument.
  const pybind11::object& at(const char* name) const;
  /// Whether the function takes such an argument.
  bool knows(const char* name) const { return place_of(name) < values_.size(); }
  /// Returns null if it was not given.
  const pybind11::object* find(const char* name) const;

  // Defaults if not given: false, "", none. `expected` is for messages.
  bool flag(const char* name) const;
  std::string text(const char* name, const char* expected) const;
  /// A device: text, or its index.
  std::string device(const char* expected) const;
  /// One device or several: a text for selectors_of(), or an index. Lists devices without the GIL.
  std::vector<std::string> devices(const char* expected) const;
  std::vector<std::string> texts(const char* name) const;
  // Returns nothing for None, or if not given. Never a NaN.
  std::optional<double> number(const char* name, const char* expected) const;
  std::optional<uint64_t> whole(const char* name, const char* expected) const;

 private:
  size_t place_of(const std::string& name) const;
  const Signature& signature_;
  std::vector<pybind11::object> values_;
};

// Converts one value, which is there. `expected` is for messages; the argument's name is, too.
bool is_bool(pybind11::handle given);
std::string text_from(const char* name, const char* expected, pybind11::handle given);
double number_from(const char* name, const char* expected, pybind11::handle given);

/// Throws TypeError "tol: expected ..., not 'x'"; refuse_value throws ValueError with the same
/// text.
[[noreturn]] void refuse_type(const char* name, const char* expected, pybind11::handle given);
[[noreturn]] void refuse_value(const char* name, const char* expected, pybind11::handle given);

}  // namespace vkh::python
