#!/usr/bin/env bash
# Installs the build, moves the installation, and uses it as strangers would: find_package,
# pkg-config, the program, the Python module. usage: package_test.sh BUILD SOURCE PYTHON|none
set -euo pipefail

build=$1 source=$2 python=$3
consumer=$source/tests/package/consumer
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "package_test: $*" >&2; exit 1; }

cmake --install "$build" --prefix "$folder/first" >"$folder/log" || { cat "$folder/log"; fail "cmake --install"; }
package=$folder/moved
mv "$folder/first" "$package"
if grep -rIlE "$folder|$build|$source" "$package"; then fail "absolute paths of the build in the files above"; fi

# A shared library made of all of the archive exports the API and nothing else of ours. The inline
# functions of std (weak) that libstdc++ forces to be visible are in every library of C++ and are
# accepted; symbols_test.py looks at the archives themselves.
${CXX:-c++} -shared -o "$folder/engine.so" -Wl,--whole-archive "$package/lib/libvkhausdorff.a" -Wl,--no-whole-archive
nm -D --defined-only "$folder/engine.so" | awk '!($2 ~ /[WV]/ && $3 !~ /3vkh/) {print $3}' | sort >"$folder/exported"
grep -ohE '\bvkh[A-Z]\w*\(' "$package"/include/vkhausdorff{,_experimental}.h | tr -d '(' | sort -u >"$folder/declared"
diff "$folder/declared" "$folder/exported" || fail "the engine exports (>) other symbols than it declares (<)"
nm -g --undefined-only "$package/lib/libvkhausdorff.a" | grep -E ' vk[A-Z]' && fail "the engine links to the Vulkan loader"

printf 'OFF\n3 1 0\n0 0 0.25\n1 0 0.25\n0 1 0.25\n3 0 1 2\n' >"$folder/a.off"
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >"$folder/b.off"
expected="0.25 <= h($folder/a.off, B) <= 0.25"
# check_consumers FOLDER: the programs there.
check_consumers() {
  "$1/engine" | grep -qE '^[0-9]+\.[0-9]+\.[0-9]+$' || fail "$1/engine printed something else"
  local line
  line=$("$1/host" "$folder/b.off" "$folder/a.off") || fail "$1/host failed"
  awk '{exit !($1 <= 0.25 && $6 >= 0.25 && $6 - $1 < 1e-5 && $7 == "closed")}' <<<"${line/:/}" ||
    fail "$1/host printed '$line', not about '$expected'"
  "$1/prove" "$folder/a.off" "$folder/b.off" "$folder/ab.vhc" >"$folder/log" || fail "$1/prove failed"
  if [ -x "$package/bin/vkh_check" ]; then
    "$package/bin/vkh_check" "$folder/ab.vhc" "$folder/a.off" "$folder/b.off" >"$folder/log" || fail "$1/prove's certificate"
  fi
  "$1/everything" "$folder/a.off" "$folder/b.off" "$folder/field.ply" "$folder/all.vhc" >"$folder/log" || fail "$1/everything failed"
  grep -q '<= h(A, B) <= .*: closed' "$folder/log" && grep -q 'mean in \[0.2' "$folder/log" || { cat "$folder/log"; fail "$1/everything"; }
  head -c 3 "$folder/field.ply" | grep -qx ply || fail "$1/everything's field"
  if [ -x "$package/bin/vkh_check" ]; then
    "$package/bin/vkh_check" "$folder/all.vhc" "$folder/a.off" "$folder/b.off" >"$folder/log" || fail "$1/everything's certificate"
  fi
  "$1/many" "$folder/b.off" "$folder/a.off" "$folder/a.off" >"$folder/log" || fail "$1/many failed"
  [ "$(grep -cE '^[01]: 0\.2[45][0-9]* <= h <= 0\.25[0-9]*$' "$folder/log")" = 2 ] && grep -q '^pass; ' "$folder/log" ||
    { cat "$folder/log"; fail "$1/many printed something else"; }
}

cmake -S "$consumer" -B "$folder/cmake" -DCMAKE_PREFIX_PATH="$package" -DCMAKE_BUILD_TYPE=Release >"$folder/log" &&
  cmake --build "$folder/cmake" >>"$folder/log" 2>&1 || { cat "$folder/log"; fail "the consumer does not build"; }
check_consumers "$folder/cmake"
sed 's/VkHausdorff 0.3/VkHausdorff 0.4/' "$consumer/CMakeLists.txt" >"$folder/CMakeLists.txt"
if cmake -S "$folder" -B "$folder/newer" -DCMAKE_PREFIX_PATH="$package" >"$folder/log" 2>&1; then
  fail "find_package took this version for 0.4"
fi
grep -q 'version: 0.3' "$folder/log" || { cat "$folder/log"; fail "find_package failed, but not for the version"; }

# A CTest that a mesh is within a limit, in a project that compiles nothing.
mkdir "$folder/gated"
cp "$folder/a.off" "$folder/b.off" "$folder/gated"
cp "$source/tests/package/gate/CMakeLists.txt" "$folder/gated"
cmake -S "$folder/gated" -B "$folder/gated/out" -DVkHausdorff_DIR="$package/lib/cmake/VkHausdorff" >"$folder/log" || { cat "$folder/log"; fail "the gated project, which names the package alone"; }
ctest --test-dir "$folder/gated/out" >"$folder/log" && fail "a gate that is beyond its limit passes"
grep -qE 'within \.+ +Passed' "$folder/log" && grep -qE 'beyond \.+\*\*\*Failed' "$folder/log" || { cat "$folder/log"; fail "the gates"; }
grep -q 'failures="0" errors="0"' "$folder/gated/out/within.xml" || fail "the gate's JUnit file"

# The lines of docs/packages.md for the host.
export PKG_CONFIG_PATH=$package/lib/pkgconfig
block() { python3 "$source/tests/package/page_block.py" "$source/docs/packages.md" "$1"; }
"$source/tests/package/page_project.sh" "$source" "$folder/page" program host
cmake -S "$folder/page" -B "$folder/page/out" -DCMAKE_PREFIX_PATH="$package" -DCMAKE_BUILD_TYPE=Release >"$folder/log" &&
  cmake --build "$folder/page/out" >>"$folder/log" 2>&1 || { cat "$folder/log"; fail "the page's lines of CMake for the host"; }
(cd "$folder/page" && sh -e -c "$(block "host pkg-config")") >"$folder/log" 2>&1 || { cat "$folder/log"; fail "the page's lines of pkg-config for the host"; }
for program in "$folder/page/out/program" "$folder/page/program"; do
  "$program" "$folder/b.off" "$folder/a.off" | grep -q ': closed$' || fail "$program"
done

pkg_config() { pkg-config "$@" || fail "pkg-config $*"; }
mkdir "$folder/pc"
# Words are split on purpose.
# shellcheck disable=SC2046
${CC:-cc} -std=c11 -pedantic -Wall -Werror "$consumer/engine.c" -o "$folder/pc/engine" \
  $(pkg_config --cflags --libs vkhausdorff)
# shellcheck disable=SC2046
for program in host prove everything many; do
  # shellcheck disable=SC2046
  ${CXX:-c++} -std=c++20 -Wall -Wextra -Werror "$consumer/$program.cpp" -o "$folder/pc/$program" \
    $(pkg_config --cflags --libs vkhausdorff-host)
done
check_consumers "$folder/pc"

"$package/bin/vkhausdorff" distance "$folder/a.off" "$folder/b.off" >/dev/null || fail "the installed program"
if [ "$python" != none ]; then
  module=$(find "$package" -name '_core*.so')
  PYTHONPATH=$(dirname "$module")/.. "$python" "$source/tests/package/example.py" >"$folder/log" || fail "example.py"
  grep -c closed "$folder/log" | grep -qx 3 || { cat "$folder/log"; fail "example.py printed something else"; }
fi
