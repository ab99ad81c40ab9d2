// What a test program makes once and uses to its end: a device, a solver.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace vkh::test {

inline std::vector<std::shared_ptr<void>>& all_kept() {
  static std::vector<std::shared_ptr<void>> all;
  return all;
}

/// Made now, destroyed by release_kept. A static object would be destroyed among the exit handlers
/// of drivers and layers, some of which have then taken themselves apart: they crash.
template <class T, class... Args>
T& kept(Args&&... args) {
  auto made = std::make_shared<T>(std::forward<Args>(args)...);
  T& one = *made;
  all_kept().push_back(std::move(made));
  return one;
}

/// In the opposite order. main.cpp calls it.
inline void release_kept() {
  while (!all_kept().empty()) all_kept().pop_back();
}

}  // namespace vkh::test
