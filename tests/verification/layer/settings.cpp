#include "tests/verification/layer/settings.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "tests/verification/layer/functions.h"
#include "tests/verification/layer/limits.h"

namespace vkh::layer {
namespace {

std::string variable(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? "" : text;
}

std::vector<std::string> split(const std::string& text, char mark) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, mark);) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

[[noreturn]] void refuse(const std::string& why) {
  std::fprintf(stderr, "vkh-layer: %s\n", why.c_str());
  std::abort();
}

// Decimal, or 0x..., or a version such as 1.2.
std::optional<uint64_t> number(const std::string& text) {
  char* end = nullptr;
  const uint64_t value = std::strtoull(text.c_str(), &end, 0);
  if (end == text.c_str()) return std::nullopt;
  if (*end == '\0') return value;
  if (*end != '.') return std::nullopt;
  const uint64_t minor = std::strtoull(end + 1, &end, 10);
  if (*end != '\0') return std::nullopt;
  return VK_MAKE_API_VERSION(0u, static_cast<uint32_t>(value), static_cast<uint32_t>(minor), 0u);
}

void read_limits(Settings& s) {
  for (const std::string& part : split(variable("VKH_LAYER_LIMITS"), ',')) {
    const size_t at = part.find('=');
    const auto value = at == std::string::npos ? std::nullopt : number(part.substr(at + 1));
    const std::string name = part.substr(0, at);
    if (!value || !is_limit(name)) refuse("VKH_LAYER_LIMITS: '" + part + "' makes no sense");
    s.limits[name] = *value;
  }
}

void read_hidden(Settings& s) {
  for (const std::string& name : split(variable("VKH_LAYER_HIDE"), ',')) {
    if (!name.starts_with("VK_") && !is_feature(name))
      refuse("VKH_LAYER_HIDE: '" + name + "' is no feature that this layer can hide");
    s.hidden.insert(name);
  }
}

uint64_t read_number(const char* name) {
  const std::string text = variable(name);
  const auto value = number(text.empty() ? "0" : text);
  if (!value) refuse(std::string(name) + ": '" + text + "' is no number");
  return *value;
}

Settings read() {
  Settings s;
  read_limits(s);
  read_hidden(s);
  if (!parse_faults(variable("VKH_LAYER_FAIL"), s.faults))
    refuse("VKH_LAYER_FAIL: '" + variable("VKH_LAYER_FAIL") + "' makes no sense");
  s.dropped_barrier = read_number("VKH_LAYER_DROP_BARRIER");
  s.dropped_plain_barrier = read_number("VKH_LAYER_DROP_PLAIN_BARRIER");
  s.finds_hazards = !variable("VKH_LAYER_HAZARDS").empty();
  s.log = variable("VKH_LAYER_LOG");
  s.count = variable("VKH_LAYER_COUNT");
  s.keeps_going = !variable("VKH_LAYER_KEEP_GOING").empty();
  s.regroups = !variable("VKH_LAYER_REGROUP").empty();
  return s;
}

bool parse_fault(const std::string& text, Fault& fault) {
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() != 3) return false;
  std::string count = parts[1];
  fault.onwards = count.ends_with('+');
  if (fault.onwards) count.pop_back();
  const auto n = number(count);
  fault.function = parts[0];
  fault.n = n.value_or(0);
  fault.result = result_named(parts[2]);
  const unsigned bit = bit_of(fault.result);
  const bool may_return = fault.function == "*" || (errors_of(fault.function) & bit) != 0;
  return fault.n > 0 && bit != 0 && may_return;
}

}  // namespace

Settings& settings() {
  static Settings& instance = *new Settings(read());  // never destroyed: an instance may outlive it
  return instance;
}

bool parse_faults(const std::string& text, std::vector<Fault>& faults) {
  faults.clear();
  for (const std::string& part : split(text, ',')) {
    Fault fault;
    if (!parse_fault(part, fault)) return false;
    faults.push_back(fault);
  }
  return true;
}

VkResult result_named(const std::string& name) {
#define VKH_NAMED(bit, result) \
  if (name == #result) return (result);
  VKH_LAYER_ERRORS(VKH_NAMED)
#undef VKH_NAMED
  return VK_SUCCESS;
}

const char* name_of(VkResult result) {
#define VKH_NAME(bit, code) \
  if (result == (code)) return #code;
  VKH_LAYER_ERRORS(VKH_NAME)
#undef VKH_NAME
  return "VK_SUCCESS";
}

unsigned bit_of(VkResult result) {
#define VKH_BIT(bit, code) \
  if (result == (code)) return (bit);
  VKH_LAYER_ERRORS(VKH_BIT)
#undef VKH_BIT
  return 0;
}

unsigned errors_of(const std::string& function) {
  if (function == "vkCreateInstance") return kCreateInstanceErrors;
  if (function == "vkCreateDevice") return kCreateDeviceErrors;
#define VKH_ERRORS(name, errors) \
  if (function == "vk" #name) return (errors);
  VKH_LAYER_INSTANCE_FALLIBLE(VKH_ERRORS)
  VKH_LAYER_DEVICE_FALLIBLE(VKH_ERRORS)
#undef VKH_ERRORS
  return 0;
}

}  // namespace vkh::layer
