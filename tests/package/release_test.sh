#!/usr/bin/env bash
# tools/release writes packages, kernels, sources and their sums, and where mingw-w64 and pip are here, the zip for Windows and
# the wheel; the sources and the kernels alone build an engine, without glslang.
# usage: release_test.sh BUILD SOURCE FOLDER PYTHON. Exit code 77: no dpkg or git here.
set -euo pipefail
build=$1 source=$2 folder=$3
export PYTHON=$4
fail() { echo "release_test: $*" >&2; exit 1; }
step() { "$@" >"$folder/log.test" 2>&1 || { tail -n 40 "$folder/log.test" >&2; fail "$*"; }; }
command -v dpkg-shlibdeps >/dev/null || { echo "release_test: skipped, no dpkg-dev"; exit 77; }
git -C "$source" rev-parse HEAD >/dev/null 2>&1 || { echo "release_test: skipped, no git checkout"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder"
parts=(deb kernels source)
if ! command -v x86_64-w64-mingw32-g++-posix >/dev/null; then
  echo "release_test: no zip, there is no g++-mingw-w64-x86-64-posix"
elif ! "$source/tools/packages/libraries" windows "$folder/windows-libraries" >"$folder/log.libraries" 2>&1; then
  echo "release_test: no zip, its libraries cannot be built: $(grep -v '^$' "$folder/log.libraries" | tail -n 1)"
else
  parts+=(windows)
fi
if ! "$PYTHON" -c "import setuptools, pip, wheel" 2>/dev/null; then
  echo "release_test: no wheel, $PYTHON has no pip, wheel or setuptools"
elif ! "$source/tools/packages/libraries" linux "$folder/linux-libraries" >"$folder/log.linux" 2>&1; then
  echo "release_test: no wheel, its libraries cannot be built: $(grep -v '^$' "$folder/log.linux" | tail -n 1)"
else
  parts+=(wheel)
fi
step "$source/tools/release" --to "$folder" --tree "$build" "${parts[@]}"
version=$(sed -nE 's/^#define VKH_VERSION_(MAJOR|MINOR|PATCH) //p' "$source/engine/vkhausdorff.h" | paste -sd.)
cd "$folder/files"
step sha256sum --strict -c SHA256SUMS
[ "$(find . -type f ! -name SHA256SUMS | wc -l)" = "$(wc -l <SHA256SUMS)" ] || fail "SHA256SUMS does not name every file"
grep -q "$(git -C "$source" rev-parse HEAD)" RELEASE.txt || fail "RELEASE.txt does not name the commit"
for name in vkhausdorff libvkhausdorff-dev; do
  made=("$name"_"$version"_*_"$(dpkg --print-architecture)".deb)
  [ "$(dpkg-deb -f "${made[0]}" Package Version | paste -sd' ')" = "Package: $name Version: $version" ] || fail "$name is another package"
done

# has_notices FILE: of us, three.js and what comes from packages.
has_notices() { for name in "The VkHausdorff authors" three.js "Henry Schreiner" "Niels Lohmann"; do grep -q "$name" "$1" || fail "no notice of $name in $1"; done; }
if [[ " ${parts[*]} " == *" windows "* ]]; then
  step cmake -E chdir "$folder" cmake -E tar xf "files/vkhausdorff-$version-windows-x86_64.zip"
  zip=$folder/vkhausdorff-$version-windows-x86_64
  [ "$(head -c 2 "$zip/vkhausdorff.exe")" = MZ ] || fail "no program in the zip"
  grep -q "^usage: vkh_check.py CERTIFICATE A B" <("$PYTHON" -B "$zip/vkh_check.py" 2>&1) || fail "the zip's checker"
  for library in meshopt_simplify zip_open XML_Parse deflate; do
    grep -q " T $library" <(x86_64-w64-mingw32-nm "$folder/windows/vkhausdorff.exe") || fail "the zip's program lacks $library"
  done
  has_notices "$zip/THIRD_PARTY.txt"
fi
if [[ " ${parts[*]} " == *" wheel "* ]]; then
  step "$PYTHON" -m pip install --no-deps --no-index --target "$folder/site" vkhausdorff-"$version"-*-manylinux_2_*.whl
  found=$(cd "$folder/site" && "$PYTHON" -c "import vkhausdorff; print(vkhausdorff.__version__)")
  [ "$found" = "$version" ] || fail "the wheel is of version $found"
  has_notices "$folder/site/vkhausdorff-$version.dist-info/THIRD_PARTY.txt"
  # What each manylinux of PEP 600 has, and every Debian, however slim.
  more=$(readelf -d "$folder"/site/vkhausdorff/_core.*.so | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' |
    grep -vxE 'libstdc\+\+\.so\.6|libgcc_s\.so\.1|lib[cm]\.so\.6|libz\.so\.1|ld-linux.*' || true)
  [ -z "$more" ] || fail "the wheel needs $more"
fi

step tar -C "$folder" -xzf "vkhausdorff-$version.tar.gz"
step tar -C "$folder" -xzf "vkhausdorff-$version-kernels.tar.gz"
step env -u VKH_KERNELS cmake -S "$folder/vkhausdorff-$version" -B "$folder/engine" -DCMAKE_BUILD_TYPE=Release -DVKH_HOST=OFF \
  -DVKH_EXAMPLES=OFF -DVKH_INSTALL=OFF "-DVKH_KERNELS=$folder/kernels" -DVKH_GLSLANG=/nowhere/glslang
step cmake --build "$folder/engine" -j "$(nproc)"
[ -e "$folder/engine/libvkhausdorff.a" ] || fail "no engine"
if "$source/tools/release" --to "$folder" nonsense 2>/dev/null; then fail "a part that there is not is taken"; fi
echo "release_test: passed, $version"
