// The features that a device must have, and further ones that the engine uses.
#pragma once

#include "engine/context.h"

namespace vkh {

Limits device_limits(const VkhDeviceInfo& info);
// Whether buffers can be given by address (VKH_CONTEXT_BY_ADDRESS).
bool has_addresses(const VkhDeviceInfo& info);

}  // namespace vkh
