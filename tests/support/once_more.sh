#!/usr/bin/env bash
# Runs a test program, and once more where glibc ended it over a heap that was overwritten. The sanitizer tree runs the
# same program with every access of ours checked, so what is left to blame is what it does not instrument: the driver and
# the validation layer of the distribution. Seen once (lavapipe 22.3.6, layer 1.3.239, "unaligned fastbin chunk"), in some
# thousands of runs. Any other failure counts at once, and so does the second of this one.
# usage: once_more.sh PROGRAM [ARGUMENT...]
set -u
log=$(mktemp)
trap 'rm -f "$log"' EXIT
run() { "$@" 2>&1 | tee "$log"; return "${PIPESTATUS[0]}"; }

run "$@"
code=$?
heap='^(malloc|free|realloc|calloc|malloc_consolidate|munmap_chunk)\(\): |^double free or corruption|^corrupted (size|double-linked)'
if [ "$code" -eq 134 ] && grep -qE "$heap" "$log"; then
  echo "once_more: $1 ended over a heap that was overwritten; on $(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2)" >&2
  run "$@"
  code=$?
  echo "once_more: the second run ended with $code" >&2
fi
exit "$code"
