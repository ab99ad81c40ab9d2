#!/usr/bin/env bash
# One pair over two drivers at once: lavapipe, and SwiftShader if tools/second_driver has fetched
# it; otherwise it is skipped (77). It uses the validation layer that came with it.
# usage: two_drivers.sh BUILD
set -euo pipefail
build=$1 drivers=$(dirname "$0")/../../out/drivers
lavapipe=/usr/share/vulkan/icd.d/lvp_icd.x86_64.json
[ -e "$drivers/version" ] && [ -e "$lavapipe" ] || { echo "skipped: no second driver in out/drivers"; exit 77; }
export VK_DRIVER_FILES=$lavapipe:$drivers/vk_swiftshader_icd.json
export VK_ICD_FILENAMES=$VK_DRIVER_FILES VK_LAYER_PATH=$drivers VKH_VALIDATION=1 NODEVICE_SELECT=1
export VKH_TEST_DEVICE=llvmpipe VKH_TEST_SECOND_DEVICE=SwiftShader
exec "$build/tests/solve_tests" '--source-file=*/over_test.cpp'
