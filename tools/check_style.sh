#!/usr/bin/env bash
# The house rules that a search can check; prints 'file:line: rule' for each breach and exits 1 if there is any.
#   - sqrt length distance normalize inversesqrt and '/' in shaders/: only in math/certified.h, or with
#     '// uncertified: why' on the line or in the comment right above it. A '/' whose divisor is an unsigned literal or
#     a 'const uint' passes, if nothing on its line is or looks like a float.
#   - calls of vkCmdPipelineBarrier in engine/: only in engine/command.cpp.
#   - 400 lines a file, 250 a kernel (*.comp).
#   - clang-format, where it is the version that the project is written with (others disagree in details).
# usage: tools/check_style.sh [ROOT]
set -euo pipefail
cd "${1:-$(dirname "$0")/..}"

kClangFormat=14
failures=$(mktemp)
trap 'rm -f "$failures"' EXIT

# files FOLDER... -- EXTENSION...: those that exist, sorted.
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

mapfile -t shaders < <(files shaders -- comp glsl h)
mapfile -t recording < <(files engine -- cpp h)
mapfile -t formatted < <(files shaders engine host examples tests tools -- comp vert frag glsl h c cpp)
mapfile -t counted < <(files engine host examples tests tools cmake -- cpp h py sh cmake)

# Prints 'file:line:<tab>marked<tab>code' for every line with code on it, comments and #includes taken out; marked is 1
# where an '// uncertified: why' covers the line. 'why' may not be empty.
code_lines() {
  awk '
    FNR == 1 { in_comment = 0; above = 0 }
    {
      line = $0
      marked = line ~ /\/\/ *uncertified: *[^ ]/
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
      if (code ~ /^[ \t]*$/) { above = $0 ~ /^[ \t]*$/ ? 0 : above || marked; next }
      if (code !~ /^[ \t]*#[ \t]*(include|extension)/) print FILENAME ":" FNR ":\t" (marked || above) "\t" code
      above = 0
    }' "$@"
}

check_certified() {
  [ ${#shaders[@]} -gt 0 ] || return 0
  code_lines "${shaders[@]}" | awk -F '\t' '
    # An array'\''s .length() is a count; a longer name that ends in a forbidden one is another function.
    function has_root(code) {
      return (" " code) ~ /[^A-Za-z0-9_.](sqrt|inversesqrt|length|distance|normalize)[ ]*\(/
    }
    function looks_float(file, code,    rest, word) {
      if ((" " code) ~ /[^A-Za-z0-9_]([0-9]+\.|\.[0-9]|(float|double|d?vec[234])[ ]*\()/) return 1
      for (rest = code; match(rest, /[A-Za-z_][A-Za-z0-9_]*/); rest = substr(rest, RSTART + RLENGTH)) {
        word = substr(rest, RSTART, RLENGTH)
        if ((file, word) in is_float) return 1
      }
      return 0
    }
    function has_float_division(file, code,    rest, divisor) {
      if (code !~ /\//) return 0
      if (looks_float(file, code)) return 1
      for (rest = code; match(rest, /\/=?[ ]*/);) {
        rest = substr(rest, RSTART + RLENGTH)
        if (!match(rest, /^[A-Za-z0-9_]+/)) return 1
        divisor = substr(rest, 1, RLENGTH)
        if (divisor !~ /^[0-9]+u$/ && !(divisor in is_uint)) return 1
      }
      return 0
    }
    {
      place[NR] = $1; marked[NR] = $2; code[NR] = $3
      file[NR] = $1
      sub(/:.*/, "", file[NR])
      if (match($3, /const uint(32_t)? +k[A-Za-z0-9_]+/)) {
        name = substr($3, RSTART, RLENGTH)
        sub(/.* /, "", name)
        is_uint[name] = 1
      }
      for (rest = " " $3; match(rest, /[^A-Za-z0-9_](float|double|d?vec[234]) +[A-Za-z_][A-Za-z0-9_]*/);) {
        name = substr(rest, RSTART, RLENGTH)
        rest = substr(rest, RSTART + RLENGTH)
        sub(/.* /, "", name)
        is_float[file[NR], name] = 1
      }
    }
    END {
      for (i = 1; i <= NR; ++i) {
        if (marked[i] || place[i] ~ /^shaders\/math\/certified\.h:/) continue
        if (has_root(code[i])) print place[i] " a root outside certified.h:" code[i]
        if (has_float_division(file[i], code[i])) print place[i] " a division outside certified.h:" code[i]
      }
    }'
}

check_barriers() {
  [ ${#recording[@]} -gt 0 ] || return 0
  code_lines "${recording[@]}" | awk -F '\t' '
    $3 ~ /CmdPipelineBarrier[0-9A-Z]*[ ]*\(/ && $1 !~ /^engine\/command\.cpp:/ { print $1 " a barrier outside engine/command.cpp" }'
}

# check_length LIMIT FILE...
check_length() {
  local limit=$1 lines
  shift
  for file in "$@"; do
    lines=$(wc -l <"$file")
    [ "$lines" -le "$limit" ] || echo "$file:$lines: more than $limit lines"
  done
}

check_format() {
  [ ${#formatted[@]} -gt 0 ] || return 0
  if ! clang-format --version 2>/dev/null | grep -q "version $kClangFormat\."; then
    echo "check_style: no clang-format $kClangFormat here; formatting not checked" >&2
    return 0
  fi
  for file in "${formatted[@]}"; do
    clang-format --dry-run -Werror "$file" 2>/dev/null || echo "$file:1: not as clang-format $kClangFormat writes it"
  done
}

{
  check_certified
  check_barriers
  check_length 250 shaders/*/*.comp
  check_length 400 "${counted[@]}"
  check_format
} >"$failures"

cat "$failures"
[ ! -s "$failures" ] || { echo "check_style: $(wc -l <"$failures") breaches" >&2; exit 1; }
