"""The program on real devices' limits (real_devices.json): a distance, a batch and doctor, each with the bits that the plain
device of the same type gives, or the refusal that names what is missing.

usage: real_devices_test.py BUILD

The test layer (docs/test_layer.md) plays them on the driver that is here. That reports a device's subgroup size, but runs its own.
"""

import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

import real_device

BUILD = pathlib.Path(sys.argv[1]).resolve()
DEVICES = json.loads((pathlib.Path(__file__).parent / "real_devices.json").read_text())
LAYER = {"VK_LAYER_PATH": str(BUILD / "layer"), "VK_INSTANCE_LAYERS": "VK_LAYER_VKH_test"}
PAIRS = 3


def write_pairs(folder):
    """Bumpy squares of 128 faces, OBJ, and their list."""
    rows = []
    for i in range(PAIRS):
        for side in "ab":
            bumps = random.Random(f"{i}{side}")
            lines = [f"v {x} {y} {bumps.random() / 4}" for y in range(9) for x in range(9)]
            corners = [y * 9 + x + 1 for y in range(8) for x in range(8)]
            lines += [f"f {c} {c + 1} {c + 10}\nf {c} {c + 10} {c + 9}" for c in corners]
            (folder / f"{i}{side}.obj").write_text("\n".join(lines) + "\n")
        rows.append(json.dumps({"id": str(i), "a": f"{i}a.obj", "b": f"{i}b.obj", "symmetric": i == 1}))
    (folder / "list.jsonl").write_text("\n".join(rows) + "\n")


def environment_of(device):
    limits = ",".join(f"{name}={value}" for name, value in device["limits"].items())
    return LAYER | {"VKH_LAYER_LIMITS": limits, "VKH_LAYER_HIDE": ",".join(device["hidden"])}


def run(folder, environment, *words):
    return subprocess.run([BUILD / "vkhausdorff", *words], env=os.environ | environment, cwd=folder, capture_output=True, text=True, timeout=300)


def kept(answer):
    """The members of an answer that no clock decides, and that do not depend on how much memory there is."""
    ways = [[way["interval"], way["witness"], way["status"], {key: value for key, value in way["counts"].items() if key != "workspace_bytes"}]
            for way in answer["directions"]]
    return [answer.get("id", ""), answer["interval"], ways]


def answers(folder, environment):
    """All answers of a distance and a batch, or the first run that is not as it should be."""
    distance = run(folder, environment, "demo", "--tol=1e-6", "--json")
    if distance.returncode != 0:
        return None, distance
    (folder / "results.jsonl").unlink(missing_ok=True)
    batch = run(folder, environment, "batch", "list.jsonl", "--out", "results.jsonl", "--tol=1e-6")
    if batch.returncode != 0:
        return None, batch
    lines = [json.loads(line) for line in (folder / "results.jsonl").read_text().splitlines()]
    return [kept(json.loads(distance.stdout))] + sorted((kept(line) for line in lines), key=lambda one: one[0]), batch


def plain_of_type(device):
    return {"limits": {"deviceType": device["limits"]["deviceType"]}, "hidden": []}


def is_refused(device, folder):
    """Each command ends with exit code 5 and one line that has every reason."""
    for words in (("demo", "--json"), ("batch", "list.jsonl", "--out", "refused.jsonl"), ("doctor",)):
        done = run(folder, environment_of(device), *words)
        if done.returncode != 5 or done.stderr.count("\n") != 1 or not all(reason in done.stderr for reason in device["refused"]):
            return f"{words[0]}: exit code {done.returncode}\n{done.stdout[-500:]}{done.stderr[-1500:]}"
    return ""


def is_served(device, folder, expected):
    found, done = answers(folder, environment_of(device))
    if found != expected or "vkh-layer" in done.stderr:
        return f"answers: {found}\nnot {expected}\n{done.stderr[-1500:]}"
    done = run(folder, environment_of(device), "doctor")
    passed = done.returncode == 0 and done.stdout.count("passed") == 2 and "vkh-layer" not in done.stderr
    return "" if passed else f"doctor: {done.stdout}{done.stderr}"


def check_conversion():
    """A profile as vulkan.gpuinfo.org writes them, invented and short."""
    family = {"queueFlags": ["VK_QUEUE_COMPUTE_BIT"], "timestampValidBits": 36}
    base = {"limits": {"maxComputeSharedMemorySize": 32768, "nonCoherentAtomSize": "256", "maxComputeWorkGroupSize": [1024, 512, 64]}}
    chained = {"subgroupSize": 32, "subgroupSupportedOperations": ["VK_SUBGROUP_FEATURE_BASIC_BIT", "VK_SUBGROUP_FEATURE_SHUFFLE_BIT"]}
    features = {name: name != "shaderFloat64" for name in real_device.FEATURES}
    block = {"extensions": {"VK_KHR_push_descriptor": 1, "VK_EXT_subgroup_size_control": 2}, "queueFamiliesProperties": [{"VkQueueFamilyProperties": family}],
             "features": {"VkPhysicalDeviceVulkan12Features": features},
             "properties": {"VkPhysicalDeviceProperties": base, "VkPhysicalDeviceSubgroupProperties": chained}}
    profile = {"profiles": {"one": {"api-version": "1.2.170", "label": "Card driver 7.1 on Linux"}}, "capabilities": {"device": block}}
    row = real_device.row_of("Card", "discrete", profile)
    expected = {"apiVersion": "1.2", "deviceType": 2, "timestampValidBits": 36, "maxComputeSharedMemorySize": 32768, "nonCoherentAtomSize": 256,
                "maxComputeWorkGroupSize0": 1024, "maxComputeWorkGroupSize1": 512, "maxComputeWorkGroupSize2": 64, "subgroupSize": 32,
                "subgroupSupportedOperations": 17}
    if row != {"device": "Card", "driver": "7.1 on Linux", "limits": expected, "hidden": ["shaderFloat64", "VK_KHR_synchronization2"]}:
        sys.exit(f"real_devices_test: a profile became {row}")


check_conversion()
with tempfile.TemporaryDirectory() as name:
    scratch = pathlib.Path(name)
    write_pairs(scratch)
    plain = {}
    failures = 0
    for one in DEVICES:
        kind = one["limits"]["deviceType"]
        if not one["refused"] and kind not in plain:
            plain[kind], done = answers(scratch, environment_of(plain_of_type(one)))
            if not plain[kind] or len(plain[kind]) != 1 + PAIRS:
                sys.exit(f"real_devices_test: the plain device of type {kind}: {done.stdout[-500:]}{done.stderr[-1500:]}")
        wrong = is_refused(one, scratch) if one["refused"] else is_served(one, scratch, plain[kind])
        failures += bool(wrong)
        print(f"real_devices_test: {one['device']}: {wrong or ('refused: ' + '; '.join(one['refused']) if one['refused'] else 'the same bits')}")
sys.exit(1 if failures else 0)
