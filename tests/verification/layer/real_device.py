"""A device's limits, and the features that it lacks, of a profile that vulkan.gpuinfo.org exports: a row of real_devices.json.

usage: real_device.py NAME discrete|integrated PROFILE.json; the profiles do not have a device's type
"""

import json
import sys

TYPES = {"integrated": 1, "discrete": 2}
LIMITS = ("maxStorageBufferRange", "maxUniformBufferRange", "maxPushConstantsSize", "maxMemoryAllocationCount", "maxBoundDescriptorSets",
          "maxPerStageDescriptorStorageBuffers", "maxPerStageResources", "maxDescriptorSetStorageBuffers", "maxComputeSharedMemorySize",
          "maxComputeWorkGroupInvocations", "minStorageBufferOffsetAlignment", "minMemoryMapAlignment", "optimalBufferCopyOffsetAlignment",
          "nonCoherentAtomSize", "bufferImageGranularity", "maxDrawIndirectCount")
AXES = ("maxComputeWorkGroupCount", "maxComputeWorkGroupSize")
CHAINED = ("maxPushDescriptors", "maxMemoryAllocationSize", "maxBufferSize", "subgroupSize", "minSubgroupSize", "maxSubgroupSize")
OPERATIONS = ("BASIC", "VOTE", "ARITHMETIC", "BALLOT", "SHUFFLE", "SHUFFLE_RELATIVE", "CLUSTERED", "QUAD")
FEATURES = ("scalarBlockLayout", "synchronization2", "bufferDeviceAddress", "timelineSemaphore", "subgroupSizeControl", "robustBufferAccess",
            "shaderInt64", "shaderFloat64")
EXTENSIONS = ("VK_KHR_push_descriptor", "VK_KHR_synchronization2", "VK_EXT_subgroup_size_control")


def merged(capabilities, part):
    """All members of all structures of that part, as one dictionary."""
    structures = [one for block in capabilities.values() for one in block.get(part, {}).items()]
    return {name: value for structure, members in structures if structure != "VkPhysicalDeviceProperties" for name, value in members.items()}


def limits_of(capabilities):
    base = next(block["properties"]["VkPhysicalDeviceProperties"] for block in capabilities.values())
    limits = {name: int(base["limits"][name]) for name in LIMITS if name in base["limits"]}
    for name in AXES:
        limits |= {f"{name}{axis}": int(value) for axis, value in enumerate(base["limits"].get(name, ()))}
    chained = merged(capabilities, "properties")
    limits |= {name: int(chained[name]) for name in CHAINED if name in chained}
    if "subgroupSupportedOperations" in chained:
        limits["subgroupSupportedOperations"] = sum(
            1 << bit for bit, name in enumerate(OPERATIONS) if f"VK_SUBGROUP_FEATURE_{name}_BIT" in chained["subgroupSupportedOperations"])
    return limits


def timestamp_bits(capabilities):
    """Those of the first family that computes."""
    families = [next(iter(family.values())) for block in capabilities.values() for family in block.get("queueFamiliesProperties", ())]
    return next(family["timestampValidBits"] for family in families if "VK_QUEUE_COMPUTE_BIT" in family["queueFlags"])


def row_of(name, kind, profile):
    described = next(iter(profile["profiles"].values()))
    capabilities = profile["capabilities"]
    features = merged(capabilities, "features")
    extensions = {one for block in capabilities.values() for one in block["extensions"]}
    version = ".".join(described["api-version"].split(".")[:2])
    limits = {"apiVersion": version, "deviceType": TYPES[kind], "timestampValidBits": timestamp_bits(capabilities)} | limits_of(capabilities)
    hidden = [one for one in FEATURES if not features.get(one)] + [one for one in EXTENSIONS if one not in extensions]
    return {"device": name, "driver": described["label"].split(" driver ")[1], "limits": limits, "hidden": hidden}


if __name__ == "__main__":
    with open(sys.argv[3]) as file:
        print(json.dumps(row_of(sys.argv[1], sys.argv[2], json.load(file))))
