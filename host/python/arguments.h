// What Python passed, by name, and plain values of it. Whatever is wrong is a TypeError or a
// ValueError that names the argument and says what was expected.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vkh::python {

struct Signature {
  const char* function;
  std::vector<const char*> names;
  size_t required;    ///< how many of them, from the first, must be there
  size_t positional;  ///< how many may be given by position
};

class Arguments {
 public:
  Arguments(const Signature& signature, const pybind11::args& positional,
            const pybind11::kwargs& named);
  /// A required one.
  const pybind11::object& at(const char* name) const;
  /// Null if it was not given.
  const pybind11::object* find(const char* name) const;

  // Not given: false, "", none. `expected` is for messages.
  bool flag(const char* name) const;
  std::string text(const char* name, const char* expected) const;
  std::vector<std::string> texts(const char* name) const;
  // None, or not given: nothing. Never a NaN.
  std::optional<double> number(const char* name, const char* expected) const;
  std::optional<uint64_t> whole(const char* name, const char* expected) const;

 private:
  size_t place_of(const std::string& name) const;
  const Signature& signature_;
  std::vector<pybind11::object> values_;
};

// One value, which is there. `expected` is for messages; the argument's name is, too.
bool is_bool(pybind11::handle given);
std::string text_from(const char* name, const char* expected, pybind11::handle given);
double number_from(const char* name, const char* expected, pybind11::handle given);

/// "tol: expected ..., not 'x'".
[[noreturn]] void refuse_type(const char* name, const char* expected, pybind11::handle given);
[[noreturn]] void refuse_value(const char* name, const char* expected, pybind11::handle given);

}  // namespace vkh::python
