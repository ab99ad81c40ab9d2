#!/usr/bin/env bash
# tools/release writes packages, kernels, sources and their sums; the sources and the kernels alone build an engine, without
# glslang. usage: release_test.sh BUILD SOURCE FOLDER. Exit code 77: no dpkg or git here.
set -euo pipefail
build=$1 source=$2 folder=$3
fail() { echo "release_test: $*" >&2; exit 1; }
step() { "$@" >"$folder/log.test" 2>&1 || { tail -n 40 "$folder/log.test" >&2; fail "$*"; }; }
command -v dpkg-shlibdeps >/dev/null || { echo "release_test: skipped, no dpkg-dev"; exit 77; }
git -C "$source" rev-parse HEAD >/dev/null 2>&1 || { echo "release_test: skipped, no git checkout"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder"
step "$source/tools/release" --to "$folder" --tree "$build" deb kernels source
version=$(sed -nE 's/^#define VKH_VERSION_(MAJOR|MINOR|PATCH) //p' "$source/engine/vkhausdorff.h" | paste -sd.)
cd "$folder/files"
step sha256sum --strict -c SHA256SUMS
[ "$(find . -type f ! -name SHA256SUMS | wc -l)" = "$(wc -l <SHA256SUMS)" ] || fail "SHA256SUMS does not name every file"
grep -q "$(git -C "$source" rev-parse HEAD)" RELEASE.txt || fail "RELEASE.txt does not name the commit"
for name in vkhausdorff libvkhausdorff-dev; do
  made=("$name"_"$version"_*_"$(dpkg --print-architecture)".deb)
  [ "$(dpkg-deb -f "${made[0]}" Package Version | paste -sd' ')" = "Package: $name Version: $version" ] || fail "$name is another package"
done

step tar -C "$folder" -xzf "vkhausdorff-$version.tar.gz"
step tar -C "$folder" -xzf "vkhausdorff-$version-kernels.tar.gz"
step env -u VKH_KERNELS cmake -S "$folder/vkhausdorff-$version" -B "$folder/engine" -DCMAKE_BUILD_TYPE=Release -DVKH_HOST=OFF \
  -DVKH_EXAMPLES=OFF -DVKH_INSTALL=OFF "-DVKH_KERNELS=$folder/kernels" -DVKH_GLSLANG=/nowhere/glslang
step cmake --build "$folder/engine" -j "$(nproc)"
[ -e "$folder/engine/libvkhausdorff.a" ] || fail "no engine"
if "$source/tools/release" --to "$folder" nonsense 2>/dev/null; then fail "a part that there is not is taken"; fi
echo "release_test: passed, $version"
