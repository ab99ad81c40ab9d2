#!/usr/bin/env bash
# The .deb files that cpack makes of a built tree: dpkg installs them into a folder, where the program, the engine and the Python
# module work; lintian finds no error; dpkg removes them and nothing is left. usage: deb_test.sh BUILD SOURCE FOLDER PYTHON|none
# Exit code 77: no dpkg here.
set -euo pipefail
build=$1 source=$2 folder=$3 python=$4
fail() { echo "deb_test: $*" >&2; exit 1; }
step() { "$@" >"$folder/log" 2>&1 || { tail -n 40 "$folder/log" >&2; fail "$*"; }; }
for tool in dpkg dpkg-deb dpkg-shlibdeps; do
  command -v $tool >/dev/null || { echo "deb_test: skipped, no $tool"; exit 77; }
done
rm -rf "$folder"
mkdir -p "$folder"
step cpack --config "$build/CPackConfig.cmake" -G DEB -B "$folder/made"
version=$(sed -nE 's/^#define VKH_VERSION_(MAJOR|MINOR|PATCH) //p' "$source/engine/vkhausdorff.h" | paste -sd.)
names=(libvkhausdorff-dev vkhausdorff)
[ "$python" = none ] || names+=(python3-vkhausdorff)
files=("$folder"/made/*.deb)
[ ${#files[@]} -eq ${#names[@]} ] || fail "made ${files[*]}"
for name in "${names[@]}"; do
  file=$folder/made/${name}_${version}_$(dpkg --print-architecture).deb
  [ -e "$file" ] || fail "no $file"
  dpkg-deb -f "$file" Depends | grep -qE 'libc6 \(|libvulkan-dev' || fail "$file names no dependencies"
  case $name in *-dev) continue ;; esac
  dpkg-deb -f "$file" Depends | grep -q libvulkan && fail "$file does not go without the Vulkan loader"
  dpkg-deb -f "$file" Recommends | grep -qx libvulkan1 || fail "$file does not recommend the Vulkan loader"
done

if command -v lintian >/dev/null; then
  lintian --no-cfg --fail-on error "${files[@]}" >"$folder/lintian" 2>&1 || { cat "$folder/lintian"; fail "lintian"; }
else
  echo "deb_test: not checked by lintian, which is not here"
fi

# This machine's list of installed packages, so that dependencies are checked; no file of it is touched.
root=$folder/root
mkdir -p "$root"/var/lib/dpkg/{info,updates,triggers}
cp /var/lib/dpkg/status "$root/var/lib/dpkg/status"
dpkg-query -W -f '${Package}\n' "${names[@]}" >"$folder/there" 2>/dev/null && fail "installed on this machine already: $(cat "$folder/there")"
dpkg=(dpkg --root="$root" --force-not-root --force-script-chrootless --log="$folder/dpkg.log")
[ "$(id -u)" -eq 0 ] || ! command -v fakeroot >/dev/null || dpkg=(fakeroot "${dpkg[@]}")
listed() { find "$root" -path "$root/var/lib/dpkg" -prune -o -print | sort; }
listed >"$folder/before"
step "${dpkg[@]}" -i "${files[@]}"

printf 'OFF\n3 1 0\n0 0 0.25\n1 0 0.25\n0 1 0.25\n3 0 1 2\n' >"$folder/a.off"
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >"$folder/b.off"
step "$root/usr/bin/vkhausdorff" distance "$folder/a.off" "$folder/b.off"
step "$source/tests/package/page_project.sh" "$source" "$folder/use" renderer package shader
step cmake -S "$folder/use" -B "$folder/use/out" -DCMAKE_PREFIX_PATH="$root/usr"
grep -q "VkHausdorff_DIR:PATH=$root/" "$folder/use/out/CMakeCache.txt" || fail "find_package found another package"
step cmake --build "$folder/use/out"
step "$folder/use/out/renderer"
if [ "$python" != none ]; then
  PYTHONPATH=$root/usr/lib/python3/dist-packages step "$python" -B "$source/tests/package/example.py"
  grep -c closed "$folder/log" | grep -qx 3 || { cat "$folder/log"; fail "example.py printed something else"; }
fi

step "${dpkg[@]}" --purge "${names[@]}"
listed | diff "$folder/before" - || fail "dpkg leaves the files above (>)"
echo "deb_test: passed, ${names[*]} $version"
