"""A barrier that is left out is noticed: by synchronization validation, of Debian's layer.

usage: barriers_test.py BUILD

The test layer stands above the validation layer and leaves out one of the engine's barriers,
another in each run. Not every one is noticed: the layer follows neither reads by an index in a
shader, nor the size of an indirect dispatch.
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

if not (LAYERS / "VkLayer_khronos_validation.json").exists():
    print("barriers_test: skipped: no Khronos validation layer here")
    sys.exit(77)


def run(**environment):
    variables = os.environ | {"VK_LAYER_PATH": f"{BUILD}/layer:{LAYERS}", "VK_INSTANCE_LAYERS": "VK_LAYER_VKH_test",
                              "VKH_VALIDATION": "1"} | environment
    done = subprocess.run(TEST, env=variables, capture_output=True, text=True, timeout=200)
    return done.returncode, done.stdout + done.stderr


count = BUILD / "barriers.txt"
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
