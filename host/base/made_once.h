// Values by key. The first thread that asks for a value makes it, once.
#pragma once

#include <future>
#include <map>
#include <mutex>

namespace vkh {

/// Threads may share it.
template <class Key, class Value>
class MadeOnce {
 public:
  /// Returns what make() returned for this key, or throws what it threw. A thread that asks while
  /// another one makes the value waits.
  template <class Make>
  Value get(const Key& key, const Make& make) {
    std::promise<Value> mine;
    const std::shared_future<Value> value = known_or(key, mine);
    if (value.valid()) return value.get();
    try {
      Value made = make();
      mine.set_value(made);
      return made;
    } catch (...) {
      mine.set_exception(std::current_exception());
      throw;
    }
  }

  /// Forgets a value. Threads that wait for it still get it.
  void forget(const Key& key) {
    const std::lock_guard lock(mutex_);
    values_.erase(key);
  }

 private:
  /// Returns the value that another thread makes. If there is none, returns nothing, and `mine` is
  /// the promise of this key from now on.
  std::shared_future<Value> known_or(const Key& key, std::promise<Value>& mine) {
    const std::lock_guard lock(mutex_);
    const auto [known, is_new] = values_.try_emplace(key);
    if (!is_new) return known->second;
    known->second = mine.get_future().share();
    return {};
  }

  std::mutex mutex_;
  std::map<Key, std::shared_future<Value>> values_;
};

}  // namespace vkh
