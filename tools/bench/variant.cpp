#include "tools/bench/variant.h"

#include <algorithm>
#include <stdexcept>

#include "host/answer/quantities.h"

namespace vkh::bench {
namespace {

/// The preset that the text starts with, or "": default.
std::string preset_at_start(const std::string& text) {
  for (const std::string& preset : preset_names()) {
    const size_t end = preset.size();
    if (text.compare(0, end, preset) == 0 &&
        (text.size() == end || text.find_first_of("+-@", end) == end))
      return preset;
  }
  return "";
}

void check_switch(const std::string& text, const std::string& name) {
  const std::vector<std::string> known = switch_names();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw std::runtime_error("--presets: '" + text + "': no switch is called '" + name + "'");
}

}  // namespace

Variant variant_of(const std::string& name, const SolveOptions& common) {
  Variant variant{name, common};
  const std::string preset = preset_at_start(name);
  variant.options.engine.preset = preset;
  size_t at = preset.size();
  while (at < name.size() && (name[at] == '+' || name[at] == '-')) {
    const size_t end = std::min(name.find_first_of("+-@", at + 1), name.size());
    const std::string part = name.substr(at + 1, end - at - 1);
    check_switch(name, part);
    (name[at] == '+' ? variant.options.engine.enabled : variant.options.engine.disabled)
        .push_back(part);
    at = end;
  }
  if (at < name.size() && name[at] == '@') {
    variant.options.memory_bytes = parse_size("memory", name.substr(at + 1));
    at = name.size();
  }
  if (at < name.size() || name.empty())
    throw std::runtime_error("--presets: '" + name + "': expected a preset, +switch or -switch");
  return variant;
}

}  // namespace vkh::bench
