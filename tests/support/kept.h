// Objects that a test program keeps from their first use to its end, and the checks that it makes
// there. main.cpp needs no device for them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace vkh::test {

// An object that a test program makes once and uses to its end: a device, a solver.
inline std::vector<std::shared_ptr<void>>& all_kept() {
  static std::vector<std::shared_ptr<void>> all;
  return all;
}

/// The object is made now, and destroyed by release_kept. A static object would be destroyed among
/// the exit handlers of drivers and layers, some of which have then taken themselves apart: they
/// crash.
template <class T, class... Args>
T& kept(Args&&... args) {
  auto made = std::make_shared<T>(std::forward<Args>(args)...);
  T& one = *made;
  all_kept().push_back(std::move(made));
  return one;
}

/// Destroys them in the opposite order. main.cpp calls it.
inline void release_kept() {
  while (!all_kept().empty()) all_kept().pop_back();
}

/// Gives the number of the validation layer's messages so far; the test device sets it when it is
/// made. Any message fails the program (main.cpp).
inline std::function<uint32_t()>& validation_messages() {
  static std::function<uint32_t()> count = [] { return 0u; };
  return count;
}

}  // namespace vkh::test
