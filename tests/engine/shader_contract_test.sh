#!/usr/bin/env bash
# usage: shader_contract_test.sh GENERATED_DIR REPO_ROOT
# The generated headers and shaders/gpu_types.h hold each other: a changed or moved float of the C++
# side, a buffer left out, misspelt or of another type does not compile, for the reason it should;
# the unchanged tree does.
set -euo pipefail
generated=$1 root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/changed/shaders"
failures=0

# $work/changed comes first, so that a header there replaces the repository's.
compile() {
  "${CXX:-g++}" -std=c++20 -fsyntax-only -I"$work/changed" -I"$generated" -I"$root" "$1" \
    2>"$work/messages"
}

expect_compiles() {
  compile "$2" && echo "ok: $1 compiles" && return
  echo "FAILED: $1 does not compile"; head -20 "$work/messages"; failures=$((failures + 1))
}

expect_rejected() {  # what, file, a pattern of the message
  if compile "$2"; then
    echo "FAILED: $1 compiles"
  elif ! grep -qE -- "$3" "$work/messages"; then
    echo "FAILED: $1 is rejected without '$3':"; head -20 "$work/messages"
  else
    echo "ok: $1 is rejected: $(grep -m1 -E -- "$3" "$work/messages")" && return
  fi
  failures=$((failures + 1))
}

# The first float of a shared struct that stands on a line of its own, as "Struct field".
a_float() {
  grep -hoE 'decltype\(gpu::\w+::\w+\), float>' "$generated"/kernels/*.h | sort -u |
    sed -E 's/.*gpu::(\w+)::(\w+)\).*/\1 \2/' | while read -r type field; do
    if sed -n "/struct $type\b/,/};/p" "$root/shaders/gpu_types.h" |
      grep -qE "\bfloat $field;"; then
      echo "$type $field"
      break
    fi
  done
}

change_types() {  # a sed script for the C++ side's gpu_types.h; it must change exactly one line
  sed -E "$1" "$root/shaders/gpu_types.h" >"$work/changed/shaders/gpu_types.h"
  local lines
  lines=$(diff "$root/shaders/gpu_types.h" "$work/changed/shaders/gpu_types.h" |
    grep -c '^>') || true
  [[ $lines == 1 ]] && return
  echo "FAILED: '$1' changed $lines lines of gpu_types.h"
  failures=$((failures + 1))
}

echo '#include "kernels/all_kernels.h"' >"$work/all.cpp"
expect_compiles "the unchanged tree" "$work/all.cpp"

read -r type field <<<"$(a_float)" || true
[[ -n ${field:-} ]] || { echo "FAILED: no float in any shared struct"; exit 1; }
because="static.assert.*gpu::$type::$field differs between C\+\+ and"
change_types "/struct $type\b/,/};/s/\bfloat $field;/int $field;/"
expect_rejected "int $type::$field instead of float" "$work/all.cpp" "$because"
change_types "/struct $type\b/,/};/s/\bfloat $field;/float stowaway, $field;/"
expect_rejected "a float before $type::$field" "$work/all.cpp" "$because"
rm "$work/changed/shaders/gpu_types.h"

# Arguments, tried on the kernel that has the most: "type name" a line.
header=$(grep -c 'Argument<' "$generated"/kernels/*.h | sort -t: -k2 -n | tail -1 | cut -d: -f1)
kernel=$(sed -nE 's/^struct (\w+) \{/\1/p' "$header")
mapfile -t buffers < <(sed -nE 's/^ *Argument<(.*)> (\w+);/\1 \2/p' "$header")
((${#buffers[@]} >= 2)) || { echo "FAILED: no kernel has two buffers"; exit 1; }

write_args() {  # file, then "type name" each
  local file=$1 buffer
  shift
  {
    echo '#include "kernels/all_kernels.h"'
    echo "namespace vkh::k { const auto args = $kernel::Args{"
    for buffer in "$@"; do echo "  .${buffer##* } = Slice<${buffer% *}>{},"; done
    echo '}; }'
  } >"$file"
}

last=$((${#buffers[@]} - 1))
write_args "$work/args.cpp" "${buffers[@]}"
expect_compiles "$kernel with all buffers" "$work/args.cpp"
for left_out in 0 $last; do
  write_args "$work/args.cpp" "${buffers[@]:0:left_out}" "${buffers[@]:left_out+1}"
  expect_rejected "$kernel without ${buffers[left_out]##* }" "$work/args.cpp" 'Argument<'
done
write_args "$work/args.cpp" "${buffers[@]:0:last}" "${buffers[last]}_misspelt"
name=${buffers[last]##* }
expect_rejected "$kernel with $name misspelt" "$work/args.cpp" "${name}_misspelt"
write_args "$work/args.cpp" "${buffers[@]:0:last}" "double $name"
expect_rejected "$kernel with a Slice<double> for $name" "$work/args.cpp" 'Slice<double>'

exit $((failures > 0))
