#!/usr/bin/env bash
# A driver's permanent allocation is no leak of ours if the driver is kept loaded (keep_driver.c),
# on every make of processor: the driver here leaks on all of them.
# usage: leaks_test.sh PROBE DRIVER
set -euo pipefail
probe=$1 driver=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "leaks_test: $*" >&2; cat "$folder/log" >&2; exit 1; }

printf '{ "ICD": { "api_version": "1.3", "library_path": "%s" } }\n' "$driver" >"$folder/icd.json"
echo "leak:$(basename "$driver")" >"$folder/supp"
export ASAN_OPTIONS=detect_leaks=1 LSAN_OPTIONS=suppressions=$folder/supp:print_suppressions=0
# run FILES ARGUMENTS...: the probe with FILES for the loader's variable.
run() {
  local files=$1
  shift
  env -u VK_ICD_FILENAMES VK_DRIVER_FILES="$files" "$probe" "$driver" "$@" >"$folder/log" 2>&1
}

run "$folder/icd.json" || fail "a driver that is kept loaded: its leak is reported, or the probe failed"
run "/nowhere.json:$folder/icd.json" || fail "the second of two manifests is not read"
! run "" || fail "without it the driver's leak is not seen: this test shows nothing"
grep -q '128 byte(s) in 1' "$folder/log" || fail "without it something else is wrong"
! run "$folder/icd.json" ours || fail "a leak of ours is not reported"
grep -q 'SUMMARY: AddressSanitizer: 64 byte(s) leaked in 1 allocation' "$folder/log" || fail "not that leak alone"
