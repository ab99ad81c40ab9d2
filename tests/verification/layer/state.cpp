#include "tests/verification/layer/state.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

#include "tests/verification/layer/settings.h"

namespace vkh::layer {
namespace {

struct Objects {
  std::mutex mutex;
  // A driver may return one handle twice.
  std::multimap<std::pair<std::string, uint64_t>, uint64_t> owners;
};
struct Calls {
  std::mutex mutex;
  std::map<std::string, uint64_t> by_name;
  std::map<VkResult, uint64_t> by_error;  // calls that may return it
  std::string log;
};
struct Tables {
  std::mutex mutex;
  std::map<void*, std::unique_ptr<Table>> by_key;
};

// Never destroyed: threads of the program may still be at work at its end.
template <class T>
T& only() {
  static T* one = new T;
  return *one;
}

std::atomic<uint32_t> g_violations = 0, g_injected = 0;

// Writes whole lines at once, so that no end of the program loses one.
void append(const std::string& path, const std::string& line, int flags) {
  if (path.empty()) return;
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, 0600);
  if (file < 0) return;
  if (write(file, line.data(), line.size()) < 0) std::perror("vkh-layer: writing");
  close(file);
}

void note(Calls& calls, const std::string& line) {
  calls.log += line + "\n";
  append(settings().log, line + "\n", O_APPEND);
}

bool is_due(const Fault& fault, const std::string& function, unsigned errors, Calls& calls) {
  if (fault.function != "*" && fault.function != function) return false;
  if ((errors & bit_of(fault.result)) == 0) return false;
  const uint64_t n = fault.function == "*" ? calls.by_error[fault.result] : calls.by_name[function];
  return fault.onwards ? n >= fault.n : n == fault.n;
}

std::optional<VkResult> fault_due(const std::string& function, unsigned errors) {
  Calls& calls = only<Calls>();
  const std::lock_guard lock(calls.mutex);
  ++calls.by_name[function];
#define VKH_COUNT(bit, result) \
  if ((errors & (bit)) != 0) ++calls.by_error[result];
  VKH_LAYER_ERRORS(VKH_COUNT)
#undef VKH_COUNT
  for (const Fault& fault : settings().faults) {
    if (!is_due(fault, function, errors, calls)) continue;
    ++g_injected;
    note(calls, function + " " + name_of(fault.result));
    return fault.result;
  }
  note(calls, function);
  return std::nullopt;
}

}  // namespace

Table& table_of(void* key) {
  Tables& tables = only<Tables>();
  const std::lock_guard lock(tables.mutex);
  const auto found = tables.by_key.find(key);
  if (found != tables.by_key.end()) return *found->second;
  std::fprintf(stderr, "vkh-layer: a handle of no instance or device\n");
  std::abort();
}

Table& add_table(void* key) {
  Tables& tables = only<Tables>();
  const std::lock_guard lock(tables.mutex);
  return *(tables.by_key[key] = std::make_unique<Table>());
}

void remove_table(void* key) {
  Tables& tables = only<Tables>();
  const std::lock_guard lock(tables.mutex);
  tables.by_key.erase(key);
}

void violation(const std::string& what) {
  ++g_violations;
  std::fprintf(stderr, "vkh-layer: %s\n", what.c_str());
  append(settings().log, "violation: " + what + "\n", O_APPEND);
  if (!settings().keeps_going) std::abort();
}

uint32_t violations() { return g_violations; }
uint32_t injected() { return g_injected; }

std::optional<VkResult> fault_of(const char* function, unsigned errors, Table& table) {
  const std::optional<VkResult> fault = fault_due(function, errors);
  if (fault == VK_ERROR_DEVICE_LOST && table.device != VK_NULL_HANDLE && !table.is_lost) {
    // A lost device ends its work in a finite time; this one is given it, for its memory is freed.
    table.DeviceWaitIdle(table.device);
    table.is_lost = true;
  }
  if (!fault && table.is_lost && (errors & kLost) != 0) return VK_ERROR_DEVICE_LOST;
  return fault;
}

uint64_t count_call(const std::string& function) {
  Calls& calls = only<Calls>();
  const std::lock_guard lock(calls.mutex);
  return ++calls.by_name[function];
}

uint64_t count_of(const std::string& function) {
  Calls& calls = only<Calls>();
  const std::lock_guard lock(calls.mutex);
  const auto found = calls.by_name.find(function);
  return found == calls.by_name.end() ? 0 : found->second;
}

void write_counts() {
  Calls& calls = only<Calls>();
  const std::lock_guard lock(calls.mutex);
  std::string text = "violations " + std::to_string(g_violations) + "\ninjected " +
                     std::to_string(g_injected) + "\nlive " + std::to_string(live_objects()) + "\n";
  for (const auto& [name, count] : calls.by_name) text += name + " " + std::to_string(count) + "\n";
  append(settings().count, text, O_TRUNC);
}

bool arm(const char* faults) {
  std::vector<Fault> parsed;
  if (!parse_faults(faults, parsed)) return false;
  Calls& calls = only<Calls>();
  const std::scoped_lock lock(calls.mutex, only<Tables>().mutex);
  settings().faults = parsed;
  for (const auto& [key, table] : only<Tables>().by_key) table->is_lost = false;
  calls.by_name.clear();
  calls.by_error.clear();
  calls.log.clear();
  g_violations = 0;
  g_injected = 0;
  return true;
}

std::string log_text() {
  Calls& calls = only<Calls>();
  const std::lock_guard lock(calls.mutex);
  return calls.log;
}

void add_object(const char* type, uint64_t handle, uint64_t owner) {
  Objects& objects = only<Objects>();
  const std::lock_guard lock(objects.mutex);
  objects.owners.insert({{type, handle}, owner});
}

bool remove_object(const char* type, uint64_t handle) {
  if (handle == 0) return true;
  Objects& objects = only<Objects>();
  {
    const std::lock_guard lock(objects.mutex);
    const auto found = objects.owners.find({type, handle});
    if (found != objects.owners.end()) {
      objects.owners.erase(found);
      return true;
    }
  }
  violation(std::string("a ") + type + " is destroyed that " +
            (handle == kPoison ? "failed to be made" : "does not live"));
  return false;
}

void remove_objects_of(uint64_t owner) {
  if (owner == 0) return;  // a null handle owns nothing
  Objects& objects = only<Objects>();
  const std::lock_guard lock(objects.mutex);
  std::erase_if(objects.owners, [&](const auto& entry) { return entry.second == owner; });
}

std::string objects_of(uint64_t owner) {
  Objects& objects = only<Objects>();
  const std::lock_guard lock(objects.mutex);
  std::map<std::string, int> counts;
  for (const auto& [name, of] : objects.owners) {
    if (of == owner) ++counts[name.first];
  }
  std::string text;
  for (const auto& [type, count] : counts) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + type;
  }
  return text;
}

uint32_t live_objects() {
  Objects& objects = only<Objects>();
  const std::lock_guard lock(objects.mutex);
  return static_cast<uint32_t>(objects.owners.size());
}

}  // namespace vkh::layer
