"""A barrier that is left out is noticed, and so is each access that one lacks.

usage: barriers_test.py BUILD

By the test layer: over the engine's tests it follows what commands read and write, sizes of
indirect dispatches too, and finds no hazard. Each access of a barrier between dispatches alone is
needed: without it there is one.

By synchronization validation, of Debian's layer: the test layer stands above it and leaves out one
of the engine's barriers, another in each run. Not every one is noticed: the layer follows neither
reads by an index in a shader, nor the size of an indirect dispatch.
"""

import os
import pathlib
import re
import subprocess
import sys

BUILD = pathlib.Path(sys.argv[1]).resolve()
LAYERS = pathlib.Path("/usr/share/vulkan/explicit_layer.d")
TEST = [BUILD / "tests" / "engine_tests", "--source-file=*/kernel_bvh_test.cpp", "-tc=built hierarchies*"]
TRIED = range(1, 13)  # of the first BVH
LEAST = 4             # 8 of 12 with layer 1.3.239

FOLLOWED = ["kernel_bvh_test", "kernel_sort_test", "api_tasks_test", "api_move_test", "api_contract_test",
            "api_frames_test", "embed_test"]  # whole runs, many at once, moved ones

if not (LAYERS / "VkLayer_khronos_validation.json").exists():
    print("barriers_test: skipped: no Khronos validation layer here")
    sys.exit(77)


def run(command=TEST, **environment):
    variables = os.environ | {"VK_LAYER_PATH": f"{BUILD}/layer:{LAYERS}", "VK_INSTANCE_LAYERS": "VK_LAYER_VKH_test",
                              "VKH_VALIDATION": "1"} | environment
    done = subprocess.run(command, env=variables, capture_output=True, text=True, timeout=600)
    return done.returncode, done.stdout + done.stderr


def check_accesses(count):
    """No hazard over the engine's tests, and none of what narrow barriers wait for is dispensable."""
    files = ",".join(f"*/{name}.cpp" for name in FOLLOWED)
    code, text = run([BUILD / "tests" / "engine_tests", f"--source-file={files}"], VKH_VALIDATION="0",
                     VKH_LAYER_HAZARDS="1", VKH_LAYER_KEEP_GOING="1", VKH_LAYER_COUNT=str(count))
    if code != 0 or "vkh-layer:" in text:
        sys.exit(f"barriers_test: a hazard, or a test failed: {text[-3000:]}")
    seen = dict(re.findall(r"^(accesses .*) (\d+)$", count.read_text(), re.M))
    for access in ("from shaders", "to shaders", "to sizes"):
        named = int(seen.get(f"accesses narrow {access}", 0))
        needed = int(seen.get(f"accesses narrow {access} needed", 0))
        print(f"barriers_test: {needed} of {named} barriers between dispatches need '{access}'")
        # A step may be ordered behind one that it does not need; a size that is waited for was written.
        least = named if access == "to sizes" else named - named // 100
        if needed == 0 or needed < least:
            sys.exit(f"barriers_test: '{access}' is waited for in vain, or by no barrier")
    for access in ("from transfers", "to transfers"):
        if int(seen.get(f"accesses {access} needed", 0)) == 0:
            sys.exit(f"barriers_test: no barrier needs '{access}'")


count = BUILD / "barriers.txt"
check_accesses(count)
count.unlink(missing_ok=True)
code, text = run(VKH_LAYER_COUNT=str(count))
if code != 0 or "SYNC-HAZARD" in text:
    sys.exit(f"barriers_test: not clean with all barriers: {text[-3000:]}")
barriers = int(re.search(r"^barriers (\d+)$", count.read_text(), re.M)[1])
if barriers < max(TRIED):
    sys.exit(f"barriers_test: {barriers} barriers seen, {max(TRIED)} to be left out")
noticed = []
for n in TRIED:
    code, text = run(VKH_LAYER_DROP_BARRIER=str(n))
    if "SYNC-HAZARD" in text:
        if code == 0:
            sys.exit(f"barriers_test: the message about barrier {n} did not fail the test")
        noticed.append(n)
print(f"barriers_test: {len(noticed)} of {len(TRIED)} that were left out are noticed: {noticed}")
sys.exit(0 if len(noticed) >= LEAST else 1)
