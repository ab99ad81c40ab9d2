#!/usr/bin/env bash
# README's commands in one checkout, in more than one order: any of them may configure first. A
# scratch copy of the sources; ccache, where there is one, makes most of it quick.
# usage: orders_test.sh SOURCE quick|by_hand
set -euo pipefail
source=$1 order=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "orders_test: $*" >&2; tail -n 40 "$folder/log" >&2; exit 1; }
step() { "$@" >"$folder/log" 2>&1 || fail "$* in $PWD"; }
unset CMAKE_GENERATOR
if command -v ccache >/dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$folder CCACHE_NOHASHDIR=1
fi

copy() {
  mkdir "$1"
  cp -R "$source"/{CMakeLists.txt,CMakePresets.json,LICENSE,README.md,check,cmake,docs,engine,examples,host,shaders,tests,tools} "$1"
  cd "$1"
}
# install_says FOLDER YES|NO: it succeeds, and has the Python module or reports that it is not there.
install_says() {
  rm -rf "$folder/prefix"
  step cmake --install "$1" --prefix "$folder/prefix"
  [ -x "$folder/prefix/bin/vkhausdorff" ] && [ -e "$folder/prefix/lib/pkgconfig/vkhausdorff.pc" ] ||
    fail "the installation is not whole"
  case $2 in
    NO) grep -q 'Not installed: the Python module' "$folder/log" || fail "nothing is said of the Python module" ;;
    YES) [ -n "$(find "$folder/prefix" -name '_core*.so')" ] || fail "the Python module is not installed" ;;
  esac
}
built_by_hand() { step cmake -S . -B out; step cmake --build out -j "$(nproc)"; }
has_python=YES
python3 -c 'import numpy, pybind11' 2>/dev/null || [ -d /usr/share/cmake/pybind11 ] || [ -d /usr/lib/cmake/pybind11 ] || has_python=NO

# The commands by hand first, with the default generator; then quickstart, install, by hand again.
by_hand() {
  copy "$folder/by_hand"
  step cmake -S . -B out -G 'Unix Makefiles'
  step tools/quickstart
  grep -q 'interval' "$folder/log" || fail "quickstart printed no interval"
  install_says out/program NO
  built_by_hand
  for program in examples/vkh_embed examples/vkh_frames examples/vkh_renderer tools/vkh_bench; do
    [ -x "out/$program" ] || fail "out/$program, which the pages name, is not built"
  done
  install_says out "$has_python"
  step cmake --preset release
  step tools/quickstart
}

# quickstart first; then install, by hand.
quick() {
  copy "$folder/quick"
  step tools/quickstart
  install_says out/program NO
  step cmake -S . -B out
  step cmake --build out -j "$(nproc)" --target vkhausdorff vkh_embed
  step cmake --preset release
}

case $order in
  quick | by_hand) "$order" ;;
  *) echo "orders_test: $order is neither quick nor by_hand" >&2; exit 2 ;;
esac
