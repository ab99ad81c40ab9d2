"""The program on a device that has less: every fallback runs, with the same bits; and a device with
too little is refused.

usage: fallbacks_test.py BUILD

The test layer (docs/test_layer.md) lowers limits and hides extensions, and aborts a program that does not keep to them.
"""

import json
import os
import pathlib
import re
import subprocess
import sys

BUILD = pathlib.Path(sys.argv[1]).resolve()
LAYERS = f"{BUILD}/layer:/usr/share/vulkan/explicit_layer.d"
SAME = ("lower_hex", "upper_hex", "status", "candidates", "queries", "waves", "peak_frontier", "culled")


def answer_of(done):
    """The compared part of one direction; empty if there is no answer."""
    if done.returncode != 0:
        return {}
    answer = json.loads(done.stdout)
    way = answer["directions"][0]
    return way | way["counts"] | answer | answer["interval"]


NO_PUSH = {"VKH_LAYER_HIDE": "VK_KHR_push_descriptor"}


def demo(*words, **environment):
    variables = os.environ | {"VK_LAYER_PATH": LAYERS, "VK_INSTANCE_LAYERS": "VK_LAYER_VKH_test"} | environment
    done = subprocess.run([BUILD / "vkhausdorff", "demo", "--tol=1e-6", "--json", *words], env=variables, capture_output=True, text=True, timeout=200)
    # The program reports progress in a run of more than ten seconds.
    done.stderr = "".join(line for line in done.stderr.splitlines(True) if not re.match(r"\d+ %  \[", line))
    return done


def limits(**given):
    return {"VKH_LAYER_LIMITS": ",".join(f"{name}={value}" for name, value in given.items())}


# On these the program works as on the device itself.
SERVED = {
    "no push descriptors": NO_PUSH,
    "12 push descriptors": limits(maxPushDescriptors=12),
    "synchronization2 of Vulkan 1.3": {"VKH_LAYER_HIDE": "VK_KHR_synchronization2"},
    "the least shared memory that Vulkan allows": limits(maxComputeSharedMemorySize=16384),
    "workgroups of 256": limits(maxComputeWorkGroupInvocations=256, maxComputeWorkGroupSize0=256),
    "65535 workgroups": limits(maxComputeWorkGroupCount0=65535, maxComputeWorkGroupCount1=65535),
    "offsets of 256 bytes": limits(minStorageBufferOffsetAlignment=256),
    "no timestamps": limits(timestampValidBits=0),
    "all at once": NO_PUSH | limits(maxComputeSharedMemorySize=16384, maxComputeWorkGroupInvocations=256, maxComputeWorkGroupSize0=256,
                                    minStorageBufferOffsetAlignment=256),
}
# On these it names the missing part in one line, exit code 5.
REFUSED = {
    "no synchronization2": ({"VKH_LAYER_HIDE": "VK_KHR_synchronization2"} | limits(apiVersion="1.2"), "synchronization2 is missing"),
    "no scalar layout": ({"VKH_LAYER_HIDE": "scalarBlockLayout"}, "scalarBlockLayout is missing"),
    "Vulkan 1.1": (limits(apiVersion="1.1"), "Vulkan 1.2 is missing"),
    "workgroups of 128": (limits(maxComputeWorkGroupInvocations=128, maxComputeWorkGroupSize0=128), "workgroups of 256 are not possible"),
    "few buffers a kernel": (limits(maxPerStageDescriptorStorageBuffers=8), "storage buffers a kernel are not possible"),
    "little shared memory": (limits(maxComputeSharedMemorySize=8192), "bytes of shared memory are missing"),
    "subgroups of 2": (limits(subgroupSize=2), "subgroups are 2 wide, not 4 to 128"),
    "a small binding": (limits(maxStorageBufferRange=1 << 15), "too large"),
}

failures = 0


def fail(what, done):
    global failures
    failures += 1
    print(f"fallbacks_test: {what}: exit code {done.returncode}\n{done.stdout[-500:]}\n{done.stderr[-1500:]}")


plain = demo(VK_INSTANCE_LAYERS="")
expected = answer_of(plain)
for what, environment in SERVED.items():
    done = demo(**environment)
    answer = answer_of(done)
    different = [key for key in SAME if answer.get(key) != expected[key]]
    if different or done.stderr:
        fail(f"{what}: {different}", done)
for what, (environment, reason) in REFUSED.items():
    done = demo(**environment)
    if done.returncode != 5 or reason not in done.stderr or done.stderr.count("\n") != 1:
        fail(what, done)

# A smaller binding holds fewer candidates at once: others wait, and the interval is as true. B's nodes are ranked in 1 MiB.
for mib in (1, 2, 4):
    done = demo("--verify", **limits(maxStorageBufferRange=mib << 20))
    answer = answer_of(done)
    meets = answer and answer["lower"] <= expected["upper"] and expected["lower"] <= answer["upper"]
    if not meets or answer["status"] != "closed" or not all(answer["verified"].values()):
        fail(f"bindings of {mib} MiB", done)
# Half of that holds not all of B, which is then given by address, and in several allocations: the same bits, with the same
# memory for the search.
little = "--memory=1300KiB"
expected = answer_of(demo(little, VK_INSTANCE_LAYERS=""))
for what, environment in {
    "bindings of 512 KiB": limits(maxStorageBufferRange=1 << 19),
    "allocations of 4 MiB": limits(maxMemoryAllocationSize=4 << 20),
    "both": limits(maxStorageBufferRange=1 << 19, maxMemoryAllocationSize=4 << 20),
    "both, and no push descriptors": NO_PUSH | limits(maxStorageBufferRange=1 << 19, maxMemoryAllocationSize=4 << 20),
}.items():
    done = demo(little, **environment)
    answer = answer_of(done)
    different = [key for key in SAME if answer.get(key) != expected[key]]
    if different or done.stderr:
        fail(f"{what}: {different}", done)
# A device with memory of its own, which the host does not see: meshes are copied there. If it does
# not hold all of B, B lies in the host's memory.
for what, environment, in_host in (
    ("memory apart", limits(localMemory=64 << 20), False),
    ("2 MiB of its own", limits(localMemory=2 << 20), True),
    ("1 MiB of its own, less than the search's memory", limits(localMemory=1 << 20), True),
    ("2 MiB of its own, by address", limits(localMemory=2 << 20, maxStorageBufferRange=1 << 19), True),
    ("next to none of its own", limits(localMemory=4096), True),
):
    done = demo(little, **environment)
    answer = answer_of(done)
    different = [key for key in SAME if answer.get(key) != expected[key]]
    noted = any("from the host's, slowly" in note["text"] for note in answer.get("notes", ()))
    if different or done.stderr or noted != in_host:
        fail(f"{what}: {different}, noted: {noted}", done)
# If the search's memory is not given, it is cut, and grows into the rest.
for what, environment in {
    "2 MiB of its own": limits(localMemory=2 << 20),
    "7 MiB of its own": limits(localMemory=7 << 20),
    "4 KiB of its own": limits(localMemory=4096),
}.items():
    done = demo("--verify", "--symmetric", **environment)
    answer = answer_of(done)
    parts = answer.get("directions", [])
    good = [part["status"] == "closed" and all(part["verified"].values()) for part in parts]
    noted = any("from the host's, slowly" in note["text"] for note in answer.get("notes", ()))
    if done.stderr or good != [True, True] or not noted:
        fail(f"{what}, cut: {good}, noted: {noted}", done)
# Without addresses the refusal states the size that it would hold.
done = demo(VKH_LAYER_HIDE="bufferDeviceAddress", **limits(maxStorageBufferRange=1 << 19))
words = ("mesh B is too large for this device: 16780 faces", "take about ", "simplify the mesh")
if done.returncode != 5 or not all(word in done.stderr for word in words) or done.stderr.count("\n") != 1:
    fail("bindings of 512 KiB", done)
print(f"fallbacks_test: {len(SERVED)} devices served, {len(REFUSED)} refused, {failures} failures")
sys.exit(1 if failures else 0)
