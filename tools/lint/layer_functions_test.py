#!/usr/bin/env python3
"""The test layer's table of functions against the specification's: the possible results of each.

usage: layer_functions_test.py FUNCTIONS_H SOURCE_FOLDER...
Every Vulkan function that may fail and is named in the sources has to be in the table, so that faults reach it.
Exits with 77 where the Vulkan registry (vk.xml) is not installed.
"""

import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

REGISTRIES = ["/usr/share/vulkan/registry/vk.xml", "/usr/local/share/vulkan/registry/vk.xml"]
# No layer of this kind is called before there is an instance.
BEFORE_LAYERS = {"EnumerateInstanceLayerProperties", "EnumerateInstanceExtensionProperties", "EnumerateInstanceVersion"}
# Errors of extensions that this project does not enable.
EXTENSIONS = {"VK_ERROR_INVALID_EXTERNAL_HANDLE", "VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS", "VK_ERROR_INVALID_SHADER_NV",
              "VK_ERROR_COMPRESSION_EXHAUSTED_EXT", "VK_ERROR_UNKNOWN", "VK_ERROR_VALIDATION_FAILED",
              "VK_ERROR_VALIDATION_FAILED_EXT"}


def specified(registry):
    """Name without vk -> its errors; None for a function that returns no VkResult."""
    commands = {}
    aliases = {}
    for command in ElementTree.parse(registry).getroot().find("commands"):
        if command.get("alias"):
            aliases[command.get("name")] = command.get("alias")
            continue
        prototype = command.find("proto")
        errors = set(filter(None, (command.get("errorcodes") or "").split(",")))
        is_result = prototype.find("type").text == "VkResult"
        commands[prototype.find("name").text] = {modern(e) for e in errors} - EXTENSIONS if is_result else None
    for name, alias in aliases.items():
        commands[name] = commands.get(alias)
    return {name[2:]: errors for name, errors in commands.items()}


def modern(error):
    if error in ("VK_ERROR_FRAGMENTATION_EXT", "VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS_KHR"):
        return error[:-4]
    return error


def table(text):
    """The same from functions.h."""
    values = dict(re.findall(r"X\((k\w+), (VK_ERROR_\w+)\)", text))
    values = {bit: {error} for bit, error in values.items()}
    values["kMemory"] = values["kHostMemory"] | values["kDeviceMemory"]
    values["kMemoryOrLost"] = values["kMemory"] | values["kLost"]

    def errors(expression):
        return set().union(*(values[word] for word in re.findall(r"k\w+", expression)))

    functions = {name: errors(e) for name, e in re.findall(r"X\((\w+),\s*(k[\w |]+)\)", text) if name not in values}
    functions["CreateInstance"] = errors(re.search(r"kCreateInstanceErrors =([^;]*);", text)[1])
    functions["CreateDevice"] = errors(re.search(r"kCreateDeviceErrors =([^;]*);", text)[1])
    return functions


def named_in(folders, functions):
    """Functions that may fail and stand in a list of functions or are loaded by name."""
    names = set()
    for folder in folders:
        for path in Path(folder).rglob("*"):
            if path.suffix in (".h", ".cpp"):
                words = set(re.findall(r"\b(?:vk)?([A-Z]\w+)\b", path.read_text()))
                names |= {word for word in words if functions.get(word)}
    return names


def main():
    registry = next((path for path in REGISTRIES if Path(path).exists()), None)
    if registry is None:
        print("SKIP: no Vulkan registry (vk.xml, package libvulkan-dev)")
        return 77
    functions, ours = specified(registry), table(Path(sys.argv[1]).read_text())
    wrong = [f"{name}: {sorted(errors)} here, {sorted(functions.get(name) or [])} in {registry}"
             for name, errors in ours.items() if functions.get(name) != errors]
    missing = named_in(sys.argv[2:], functions) - set(ours) - BEFORE_LAYERS
    wrong += [f"{name}: used, and not in the table" for name in sorted(missing)]
    print("\n".join(wrong) or f"{len(ours)} functions as in {registry}")
    return 1 if wrong or len(ours) < 40 else 0


if __name__ == "__main__":
    sys.exit(main())
