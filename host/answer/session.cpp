#include "host/answer/session.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "host/base/parallel.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

Opened open_one(const std::string& selector, const SessionRequest& request) {
  Opened one;
  if (selector == kNative) {
    one.solver = std::make_unique<Solver>(NativeProcessor{request.threads});
  } else {
    one.device = std::make_unique<Device>(DeviceRequest{.selector = selector});
    one.solver = std::make_unique<Solver>(*one.device, request.cache_folder);
  }
  one.solver->make_ready(request.engine);
  return one;
}

// A device's name may have commas, which only opening one can tell; a list of indices is never a
// name.
bool is_one(const std::string& selector) {
  if (selector == "all") return false;
  if (selector.find(',') == std::string::npos) return true;
  if (selector.find_first_not_of("0123456789,") == std::string::npos) return false;
  try {
    const Device device({.selector = selector});
    return true;
  } catch (const DeviceError&) {
    return false;
  }
}

}  // namespace

std::vector<std::string> selectors_of(const std::string& text) {
  if (is_one(text)) return {text};
  std::vector<std::string> selectors;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (word.empty())
      throw UsageError("--device '" + text + "': expected names between commas, or all");
    if (word == "all") {
      const std::vector<DeviceDescription> all = list_devices();
      for (const DeviceDescription& d : all) {
        if (d.usable && d.type != "cpu") selectors.push_back(std::to_string(d.index));
      }
      if (selectors.empty()) selectors.emplace_back("");
    } else {
      selectors.push_back(word);
    }
    begin = end + 1;
  }
  if (std::find(selectors.begin(), selectors.end(), kNative) != selectors.end())
    throw UsageError("--device '" + text + "': native takes no part with other devices");
  return selectors;
}

Session open_session(const SessionRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::string> selectors =
      request.several ? selectors_of(request.selector) : std::vector<std::string>{request.selector};
  std::vector<Opened> opened(selectors.size());
  for_each_index(
      selectors.size(), [&](size_t i) { opened[i] = open_one(selectors[i], request); },
      selectors.size());
  Session session;
  session.device = std::move(opened[0].device);
  session.solver = std::move(opened[0].solver);
  session.more.assign(std::make_move_iterator(opened.begin() + 1),
                      std::make_move_iterator(opened.end()));
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  session.setup_ms = taken.count();
  return session;
}

}  // namespace vkh
