#!/usr/bin/env bash
# guarded_malloc.c ends a program that touches memory beyond a block, and no other. usage: guarded_test.sh PROBE LIBRARY
set -uo pipefail
probe=$1 library=$2
# run WAY: its exit code, as the shell has it
run() { (LD_PRELOAD=$library exec "$probe" "$1") >/dev/null 2>&1; echo $?; }
fail() { echo "guarded_test: $*" >&2; exit 1; }

[ "$(run none)" = 0 ] || fail "a program that touches its own is ended"
[ "$(run read)" = 139 ] || fail "a read beyond a block is not noticed"
[ "$(run write)" = 139 ] || fail "a write beyond a block is not noticed"
[ "$(run freed)" = 139 ] || fail "a write to a block that was freed is not noticed"
[ "$(run slack)" = 134 ] || fail "a write to the last 15 bytes is not noticed when the block is freed"
