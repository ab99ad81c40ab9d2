#!/usr/bin/env bash
# The engine without the host, in projects of C: as a subproject (add_subdirectory, FetchContent), and as a package with
# COMPONENTS engine and through pkg-config, static and shared, by the orders that the recipes of vcpkg and Conan give.
# usage: engine_test.sh SOURCE FOLDER; FOLDER/tree is left for wheel_test.sh.
set -euo pipefail
source=$1 folder=$2
here=$source/tests/package
rm -rf "$folder"
mkdir -p "$folder"
fail() { echo "engine_test: $*" >&2; exit 1; }
step() { "$@" >"$folder/log" 2>&1 || { tail -n 40 "$folder/log" >&2; fail "$*"; }; }
VKH_JOBS=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
export VKH_JOBS
if command -v ccache >/dev/null; then export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
version=$(sed -nE 's/^#define VKH_VERSION_(MAJOR|MINOR|PATCH) //p' "$source/engine/vkhausdorff.h" | paste -sd.)

# A find_package of these fails if REQUIRED; a quiet one leaves an entry in the cache.
hidden=()
for name in glm CLI11 nlohmann_json pybind11 Python doctest CGAL; do
  hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$name=ON")
done
found_of_host='^(glm|CLI11|nlohmann_json|pybind11|doctest|CGAL)_DIR|^(VKH_PYTHON_EXECUTABLE|VKH_PYTHON_DIR)[:=]'
# check_tree BUILD: nothing of the host, and no -Werror.
check_tree() {
  if grep -E "$found_of_host" "$1/CMakeCache.txt"; then fail "$1 looked for what the host needs (above)"; fi
  if grep -rq -e -Werror "$1" --include=flags.make --include=build.ninja; then fail "$1 makes warnings errors"; fi
}
# check_program PROGRAM
check_program() {
  [ "$("$1")" = "$version" ] || fail "$1 printed something else"
}

echo "-- add_subdirectory and FetchContent"
step cmake -S "$here/subproject" -B "$folder/subproject" -DVKH_SOURCE="$source" "${hidden[@]}"
check_tree "$folder/subproject"
step cmake --build "$folder/subproject" -j "$VKH_JOBS"
check_program "$folder/subproject/engine"
step cmake --install "$folder/subproject" --prefix "$folder/nothing"
[ ! -e "$folder/nothing" ] || fail "a subproject installs: $(find "$folder/nothing")"
rm "$folder/subproject/engine"
step cmake -S "$here/subproject" -B "$folder/subproject" -DFETCH=ON
step cmake --build "$folder/subproject" -j "$VKH_JOBS"
check_program "$folder/subproject/engine"

# use_package PACKAGE: found by CMake and by pkg-config, from C.
use_package() {
  step cmake -S "$here/alone" -B "$folder/use" -DCMAKE_PREFIX_PATH="$1" -DWANTED=engine "${hidden[@]}"
  check_tree "$folder/use"
  step cmake --build "$folder/use"
  check_program "$folder/use/engine"
  rm -r "$folder/use"
  step cmake -S "$here/alone" -B "$folder/use" -DCMAKE_PREFIX_PATH="$1"  # without COMPONENTS: all
  if cmake -S "$here/alone" -B "$folder/host" -DCMAKE_PREFIX_PATH="$1" -DWANTED=host >"$folder/log" 2>&1; then
    fail "find_package found a host that is not in $1"
  fi
  grep -q 'host' "$folder/log" || fail "find_package does not say that the host is missing"
  rm -r "$folder/use" "$folder/host"
  # Words are split on purpose.
  # shellcheck disable=SC2046
  ${CC:-cc} -std=c11 -pedantic -Wall -Werror "$here/consumer/engine.c" -o "$folder/pc_engine" -Wl,-rpath,"$1/lib" \
    $(PKG_CONFIG_PATH=$1/lib/pkgconfig pkg-config --cflags --libs vkhausdorff)
  check_program "$folder/pc_engine"
  [ "$(PKG_CONFIG_PATH=$1/lib/pkgconfig pkg-config --modversion vkhausdorff)" = "$version" ] || fail "another version in the .pc file"
}

# install_engine SHARED PREFIX
install_engine() {
  step cmake -S "$source" -B "$folder/tree" -DCMAKE_BUILD_TYPE=Release -DVKH_HOST=OFF "-DBUILD_SHARED_LIBS=$1" "-DCMAKE_INSTALL_PREFIX=$2"
  step cmake --build "$folder/tree" -j "$VKH_JOBS"
  step cmake --install "$folder/tree"
}

echo "-- the package, static"
python3 -m json.tool "$source/tools/packages/vcpkg/vkhausdorff/vcpkg.json" >/dev/null || fail "vcpkg.json is not JSON"
install_engine OFF "$folder/static"
check_tree "$folder/tree"
[ -e "$folder/static/lib/libvkhausdorff.a" ] || fail "no archive"
mv "$folder/static" "$folder/moved"
use_package "$folder/moved"

echo "-- the package, shared"
install_engine ON "$folder/shared"
library=$folder/shared/lib/libvkhausdorff.so.$version
[ -e "$library" ] || fail "no $library"
readelf -d "$library" | grep -q "SONAME.*\[libvkhausdorff.so.${version%.*}\]" || fail "another SONAME than ${version%.*}"
if readelf -d "$library" | grep "NEEDED.*vulkan"; then fail "the engine links to the Vulkan loader"; fi
# The same as in package_test.sh: vkh* alone, and the symbols that libstdc++ forces to be visible.
nm -D --defined-only "$library" | awk '!($2 ~ /[WVu]/ && $3 !~ /3vkh/) {print $3}' | sort >"$folder/exported"
grep -ohE '\bvkh[A-Z]\w*\(' "$folder/shared/include/vkhausdorff.h" | tr -d '(' | sort -u >"$folder/declared"
diff "$folder/declared" "$folder/exported" || fail "the shared engine exports (>) other symbols than it declares (<)"
use_package "$folder/shared"
echo "engine_test: passed"
