#!/usr/bin/env bash
# The house rules that a search can check; prints 'file:line: rule' for each breach and exits 1 if there is any.
#   - calls of vkCmdPipelineBarrier in engine/: only in engine/command.cpp.
#   - clang-format, if it is the version that the project is written with (others disagree).
# usage: tools/lint/check_style.sh [ROOT]
set -euo pipefail
cd "${1:-$(dirname "$0")/../..}"

kClangFormat=14
failures=$(mktemp)
trap 'rm -f "$failures"' EXIT

# files FOLDER... -- EXTENSION...: the files that exist, sorted.
files() {
  local folders=() names=()
  while [ "$1" != -- ]; do
    [ ! -d "$1" ] || folders+=("$1")
    shift
  done
  shift
  for extension in "$@"; do names+=(-o -name "*.$extension"); done
  [ ${#folders[@]} -eq 0 ] || find "${folders[@]}" -type f \( "${names[@]:1}" \) | sort
}

mapfile -t recording < <(files engine -- cpp h)
mapfile -t formatted < <(files shaders engine host check examples tests tools -- comp vert frag glsl h c cpp)

# Prints 'file:line:<tab>code' for every line with code on it, comments and #includes taken out.
code_lines() {
  awk '
    FNR == 1 { in_comment = 0 }
    {
      line = $0
      code = ""
      while (line != "") {
        if (in_comment) {
          end = index(line, "*/")
          if (!end) break
          line = substr(line, end + 2)
          in_comment = 0
          continue
        }
        if (!match(line, /\/\/|\/\*/)) { code = code line; break }
        code = code substr(line, 1, RSTART - 1)
        if (substr(line, RSTART, 2) == "//") break
        line = " " substr(line, RSTART + 2)
        in_comment = 1
      }
      if (code ~ /^[ \t]*$/) next
      if (code !~ /^[ \t]*#[ \t]*(include|extension)/) print FILENAME ":" FNR ":\t" code
    }' "$@"
}

check_barriers() {
  [ ${#recording[@]} -gt 0 ] || return 0
  code_lines "${recording[@]}" | awk -F '\t' '
    $2 ~ /CmdPipelineBarrier[0-9A-Z]*[ ]*\(/ && $1 !~ /^engine\/command\.cpp:/ { print $1 " a barrier outside engine/command.cpp" }'
}

check_format() {
  [ ${#formatted[@]} -gt 0 ] || return 0
  if ! clang-format --version 2>/dev/null | grep -q "version $kClangFormat\."; then
    echo "check_style: no clang-format $kClangFormat here; formatting not checked" >&2
    return 0
  fi
  # All files in one process: starts took 40 times as long as the reading.
  clang-format --dry-run "${formatted[@]}" 2>&1 |
    sed -nE "s/^([^ :]+):([0-9]+):[0-9]+: .*-Wclang-format-violations.*/\\1:\\2: not as clang-format $kClangFormat writes it/p" | uniq
}

{
  check_barriers
  check_format
} >"$failures"

cat "$failures"
[ ! -s "$failures" ] || { echo "check_style: $(wc -l <"$failures") breaches" >&2; exit 1; }
