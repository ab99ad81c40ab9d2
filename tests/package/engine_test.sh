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

# renderer NAME BLOCK...: a project around blocks of docs/packages.md, in $folder/NAME.
renderer() { "$here/page_project.sh" "$source" "$folder/$1" renderer "${@:2}"; }
# foreign_entries BUILD: of its cache, beyond what CMake and FetchContent make, and packages that are found.
foreign_entries() {
  sed -nE 's/^([A-Za-z][^:=]*):.*/\1/p' "$1/CMakeCache.txt" |
    grep -vE '^(VKH_|VkHausdorff_|CMAKE_|FETCHCONTENT_|FIND_PACKAGE_|_|(Vulkan|VulkanHeaders|Python3?|Threads)_|GLSLANG$|renderer_)' || true
}

echo "-- add_subdirectory and FetchContent"
renderer subproject subproject shader
cat >>"$folder/subproject/CMakeLists.txt" <<'END'
foreach(target IN ITEMS vkhausdorff vkh_host vkh_python vkh_bench vkh_embed vkh_test_support)
  if(TARGET ${target})
    message(FATAL_ERROR "a subproject is given the target ${target}")
  endif()
endforeach()
END
step cmake -S "$folder/subproject" -B "$folder/subproject/out" "${hidden[@]}"
check_tree "$folder/subproject/out"
left=$(foreign_entries "$folder/subproject/out")
[ -z "$left" ] || fail "a subproject puts into its parent's cache: $left"
step cmake --build "$folder/subproject/out" -j "$VKH_JOBS"
check_program "$folder/subproject/out/renderer"
step cmake --install "$folder/subproject/out" --prefix "$folder/nothing"
[ ! -e "$folder/nothing" ] || fail "a subproject installs: $(find "$folder/nothing")"
rm "$folder/subproject/out/renderer" "$folder/subproject/out/close.spv"
renderer subproject fetch shader
step cmake -S "$folder/subproject" -B "$folder/subproject/out" -DFETCHCONTENT_SOURCE_DIR_VKHAUSDORFF="$source" -DVKH_INSTALL=ON
step cmake --build "$folder/subproject/out" -j "$VKH_JOBS"
check_program "$folder/subproject/out/renderer"

# refused COMPONENT TEXT: find_package of it fails, and says TEXT.
refused() {
  sed -i -E "s/(find_package.*COMPONENTS) [a-z]+/\1 $1/" "$folder/use/CMakeLists.txt"
  if cmake -S "$folder/use" -B "$folder/use/out" -DCMAKE_PREFIX_PATH="$package" >"$folder/log" 2>&1; then
    fail "find_package found the component $1 in $package"
  fi
  tr -s ' \n' ' ' <"$folder/log" | grep -q "$2" || { cat "$folder/log"; fail "find_package does not say '$2'"; }
  rm -r "$folder/use/out"
}

# use_package PACKAGE: found by CMake and by pkg-config, from C.
use_package() {
  local package=$1
  renderer use package shader
  step cmake -S "$folder/use" -B "$folder/use/out" -DCMAKE_PREFIX_PATH="$package" "${hidden[@]}"
  check_tree "$folder/use/out"
  step cmake --build "$folder/use/out"
  check_program "$folder/use/out/renderer"
  rm -r "$folder/use/out"
  refused host "the component host is not installed here"
  refused nothing "there is no component 'nothing': COMPONENTS takes engine and host"
  sed -i 's/ COMPONENTS nothing//' "$folder/use/CMakeLists.txt"  # all that is there
  step cmake -S "$folder/use" -B "$folder/use/out" -DCMAKE_PREFIX_PATH="$package"
  export PKG_CONFIG_PATH=$package/lib/pkgconfig
  (cd "$folder/use" && step sh -e -c "$(python3 "$here/page_block.py" "$source/docs/packages.md" pkg-config)")
  LD_LIBRARY_PATH=$package/lib check_program "$folder/use/renderer"
  [ -s "$folder/use/close.spv" ] || fail "pkg-config's shader"
  rm -r "$folder/use"
  # Words are split on purpose.
  # shellcheck disable=SC2046
  ${CC:-cc} -std=c11 -pedantic -Wall -Werror -fsyntax-only "$here/consumer/engine.c" $(pkg-config --cflags vkhausdorff)
  [ "$(pkg-config --modversion vkhausdorff)" = "$version" ] || fail "another version in the .pc file"
}

# check_unload LIBRARY PART...: a plugin that makes a device and a context (tests/engine/api_c11.c) leaves nothing behind when
# it is closed.
check_unload() {
  # shellcheck disable=SC2046
  step ${CC:-cc} -shared -fPIC -Dmain=use_engine "-I$source" "$source/tests/engine/api_c11.c" -o "$folder/plugin.so" "-Wl,-rpath,$PKG_CONFIG_PATH/.." \
    $(pkg-config --cflags --libs vkhausdorff) -ldl
  local code=0
  python3 -B "$here/unload.py" "$folder/plugin.so" use_engine "$@" >"$folder/log" 2>&1 || code=$?
  [ $code -eq 0 ] || [ $code -eq 77 ] || { cat "$folder/log"; fail "a plugin stays in the process"; }
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
check_unload plugin.so

echo "-- the package, shared"
install_engine ON "$folder/shared"
library=$folder/shared/lib/libvkhausdorff.so.$version
[ -e "$library" ] || fail "no $library"
readelf -d "$library" | grep -q "SONAME.*\[libvkhausdorff.so.${version%.*}\]" || fail "another SONAME than ${version%.*}"
if readelf -d "$library" | grep "NEEDED.*vulkan"; then fail "the engine links to the Vulkan loader"; fi
nm -D --defined-only "$library" | awk '{print $NF}' | sort >"$folder/exported"
grep -ohE '\bvkh[A-Z]\w*\(' "$folder"/shared/include/vkhausdorff{,_experimental}.h | tr -d '(' | sort -u >"$folder/declared"
diff "$folder/declared" "$folder/exported" || fail "the shared engine exports (>) other symbols than it declares (<)"
use_package "$folder/shared"
check_unload plugin.so libvkhausdorff.so
echo "engine_test: passed"
