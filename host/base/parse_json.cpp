#include "host/base/parse_json.h"

namespace vkh {

Json parse_json(std::string_view text) {
  return Json::parse(text.data(), text.data() + text.size(), nullptr, false);
}

}  // namespace vkh
