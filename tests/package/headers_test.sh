#!/usr/bin/env bash
# Each public header of the host brings the errors that it names, and says at C++17 what it needs, before all else.
# usage: headers_test.sh SOURCE INCLUDE...
set -euo pipefail
source=$1
folders=("${@:2}")
log=$(mktemp)
trap 'rm -f "$log"' EXIT
fail() { cat "$log" >&2; echo "headers_test: $*" >&2; exit 1; }
# compile STANDARD: the program on the standard input.
compile() { ${CXX:-c++} "-std=$1" -fsyntax-only -x c++ - "${folders[@]/#/-I}" >"$log" 2>&1; }

for header in "$source"/host/include/vkhausdorff/*.h; do
  name=vkhausdorff/$(basename "$header")
  error=$(grep -oE '\b((Usage|Input|Device|Memory|Output)Error|Interrupted|DeviceLost)\b' "$header" | head -n 1) || true
  if [ -n "$error" ]; then
    compile c++20 <<<"#include <$name>
const char* text(const vkh::$error& error) { return error.what(); }" || fail "<$name> does not bring vkh::$error"
  fi
  if compile c++17 <<<"#include <$name>"; then fail "<$name> compiles as C++17"; fi
  grep -m 1 error: "$log" | grep -q "need C++20: compile with -std=c++20" || fail "<$name> as C++17 says something else first"
done
echo "headers_test: passed"
