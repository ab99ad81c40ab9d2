#!/usr/bin/env bash
# Writes a project around blocks of CMake on docs/packages.md, as a stranger would write it: they are run as they stand there.
# usage: page_project.sh SOURCE FOLDER renderer|program BLOCK...; renderer is a project of C, program one of C++.
set -euo pipefail
source=$1 folder=$2 target=$3
shift 3
here=$source/tests/package
mkdir -p "$folder"
if [ "$target" = renderer ]; then
  cp "$here/consumer/engine.c" "$folder/renderer.c"
  cp "$here/consumer/close.comp" "$folder"
  ln -sfn "$source" "$folder/vkhausdorff"
  language=C file=renderer.c
else
  cp "$here/consumer/host.cpp" "$folder/program.cpp"
  language="C CXX" file=program.cpp
fi
{
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(%s LANGUAGES %s)\nadd_executable(%s %s)\n' "$target" "$language" "$target" "$file"
  for block in "$@"; do python3 "$here/page_block.py" "$source/docs/packages.md" "$block"; done
} >"$folder/CMakeLists.txt"
