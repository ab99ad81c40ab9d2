#include "host/read/threemf_volumes.h"

#include <algorithm>
#include <string_view>

#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/read/threemf_xml.h"

namespace vkh::threemf {
namespace {

// PrusaSlicer's file, and the files that relatives write in its place or, with the same contents,
// beside it.
constexpr const char* kSlic3rConfigs[] = {"Metadata/Slic3r_PE_model.config",
                                          "Metadata/SuperSlicer_model.config",
                                          "Metadata/Slic3r_model.config"};
constexpr const char* kBambuConfig = "Metadata/model_settings.config";

struct NamedRole {
  std::string_view name;
  Role role;
};
constexpr NamedRole kRoles[] = {{"0", Role::kBody},  // before they had names
                                {"1", Role::kModifier},
                                {"ModelPart", Role::kBody},
                                {"ParameterModifier", Role::kModifier},
                                {"SupportBlocker", Role::kBlocker},
                                {"SupportEnforcer", Role::kEnforcer},
                                {"NegativeVolume", Role::kNegative},
                                {"normal_part", Role::kBody},
                                {"modifier_part", Role::kModifier},
                                {"support_blocker", Role::kBlocker},
                                {"support_enforcer", Role::kEnforcer},
                                {"negative_part", Role::kNegative}};

/// Reads either file: their elements have names of their own.
class Config : public XmlReader {
 public:
  Config(const MeshSource& source, std::string part, Volumes& volumes)
      : source_(source), part_(std::move(part)), volumes_(volumes) {}

  void open(std::string_view name, const Attributes& attributes) override {
    if (name == "object") object_ = number(attributes, "id");
    if (name == "volume") open_volume(attributes);
    if (name == "metadata" && is_volume_) add_metadata(attributes);
    if (name == "part") add_part(attributes);
  }
  void close(std::string_view name) override {
    if (name != "volume" || !is_volume_) return;
    volumes_.ranges[object_].push_back(range_);
    is_volume_ = false;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
    reject(source_.name, place_in(part_, line), what, expected);
  }

  uint32_t number(const Attributes& attributes, const char* name) const {
    const char* text = attributes.find(name);
    uint32_t value = 0;
    if (text == nullptr || !parse_number(std::string_view(text), value)) {
      fail(std::string(name) + " is " + (text == nullptr ? "not there" : vkh::quoted(text)),
           "a number");
    }
    return value;
  }

  Role role_of(std::string_view name) const {
    const auto* const found = std::find_if(std::begin(kRoles), std::end(kRoles),
                                           [&](const NamedRole& r) { return r.name == name; });
    if (found == std::end(kRoles))
      fail("a volume of type " + vkh::quoted(name), "a body, a modifier or one for supports");
    return found->role;
  }

  void open_volume(const Attributes& attributes) {
    range_ = {.first = number(attributes, "firstid"), .last = number(attributes, "lastid")};
    if (range_.last < range_.first)
      fail("a volume of faces " + std::to_string(range_.first) + " to " +
               std::to_string(range_.last),
           "firstid to lastid, which is not less");
    is_volume_ = true;
  }

  // Before there were types, a modifier was marked by a key of its own.
  void add_metadata(const Attributes& attributes) {
    const char* key = attributes.find("key");
    const char* value = attributes.find("value");
    if (key == nullptr || value == nullptr) return;
    const std::string_view named = key, valued = value;
    if (named == "volume_type") range_.role = role_of(valued);
    if (named == "modifier" && valued == "1" && range_.role == Role::kBody)
      range_.role = Role::kModifier;
  }

  void add_part(const Attributes& attributes) {
    const char* subtype = attributes.find("subtype");
    if (subtype == nullptr) return;
    volumes_.components[{object_, number(attributes, "id")}] = role_of(subtype);
  }

  const MeshSource& source_;
  const std::string part_;
  Volumes& volumes_;
  uint32_t object_ = 0;
  Volumes::Range range_;
  bool is_volume_ = false;
};

void sort_ranges(const MeshSource& source, const char* part, Volumes& volumes) {
  for (auto& [id, ranges] : volumes.ranges) {
    std::sort(ranges.begin(), ranges.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (size_t i = 1; i < ranges.size(); ++i) {
      if (ranges[i - 1].last < ranges[i].first) continue;
      reject(source.name, "byte 0",
             "part " + vkh::quoted(part) + ": volumes of object " + std::to_string(id) +
                 " overlap at face " + std::to_string(ranges[i].first),
             "volumes of different faces");
    }
  }
}

}  // namespace

std::string name_of(Role role) {
  switch (role) {
    case Role::kBody:
      return "body";
    case Role::kModifier:
      return "modifier";
    case Role::kBlocker:
      return "support blocker";
    case Role::kEnforcer:
      return "support enforcer";
    case Role::kNegative:
      return "negative volume";
    case Role::kSupport:
      return "support object";
    case Role::kSurface:
      return "surface object";
    case Role::kOther:
      return "other object";
    case Role::kUnprinted:
      return "unprinted item";
  }
  return "";
}

Volumes read_volumes(const MeshSource& source, Package& package) {
  Volumes volumes;
  const auto read = [&](const char* part) {
    if (!package.has(part)) return false;
    Config config(source, part, volumes);
    read_xml(source, package, part, config);
    sort_ranges(source, part, volumes);
    return true;
  };
  for (const char* part : kSlic3rConfigs) {
    if (read(part)) break;
  }
  read(kBambuConfig);
  return volumes;
}

}  // namespace vkh::threemf
