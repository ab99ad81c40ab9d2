#!/usr/bin/env bash
# README's two commands on a Debian 12 that has nothing, and programs that use the engine and the host, built against the
# release's packages on another such system. Both are made by debootstrap in FOLDER and entered by chroot.
# usage: bare_debian_test.sh BUILD SOURCE FOLDER [quickstart] [tests] [packages]; all three when none is named
# VKH_MIRROR: the mirror [http://deb.debian.org/debian]. FOLDER/times has the minutes and megabytes of each step.
# Exit code 77: no root, debootstrap, git, unshare or mirror here.
set -euo pipefail
build=$1 source=$2 folder=$3
shift 3
parts=("$@")
[ ${#parts[@]} -gt 0 ] || parts=(quickstart tests packages)
mirror=${VKH_MIRROR:-http://deb.debian.org/debian}
fail() { echo "bare_debian_test: $*" >&2; exit 1; }
skip() { echo "bare_debian_test: skipped, $*"; exit 77; }

[ "$(id -u)" -eq 0 ] || skip "not root"
for tool in debootstrap git unshare curl dpkg-shlibdeps; do
  command -v $tool >/dev/null || skip "no $tool"
done
curl -fsIL --max-time 20 "$mirror/dists/bookworm/Release" >/dev/null || skip "no mirror at $mirror"
unshare --mount --pid --fork true 2>/dev/null || skip "no mount namespaces"
git -C "$source" rev-parse HEAD >/dev/null 2>&1 || skip "no git checkout"

# The network's settings are this machine's, and nothing else is.
environment=(HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin)
for name in http_proxy https_proxy no_proxy; do
  [ -z "${!name-}" ] || environment+=("$name=${!name}")
done

# enter ROOT COMMAND...: the mounts and all processes end with the command.
enter() {
  local root=$1
  shift
  unshare --mount --pid --fork --kill-child bash -c 'root=$1; shift
    mount -t proc proc "$root/proc" && mount -t tmpfs tmpfs "$root/dev/shm" && mount -t devpts devpts "$root/dev/pts" &&
      exec chroot "$root" "$@"' enter "$root" env -i "${environment[@]}" "$@"
}

# Bytes of the packages and lists that apt has fetched in ROOT.
fetched() { { find "$1"/var/cache/apt/archives "$1"/var/lib/apt/lists -type f -printf '%s\n' 2>/dev/null || true; } | awk '{s += $1} END {print s + 0}'; }

# step NAME ROOT COMMAND...: its output is in FOLDER/NAME.log, its line in FOLDER/times.
step() {
  local name=$1 root=$2 begun=$SECONDS before status=0
  before=$(fetched "$root")
  "${@:3}" >"$folder/$name.log" 2>&1 </dev/null || status=$?
  awk -v name="$name" -v s=$((SECONDS - begun)) -v b=$(($(fetched "$root") - before)) -v status=$status \
    'BEGIN {printf "%-12s %6.1f minutes %8.1f MB fetched, exit code %d\n", name, s / 60, b / 1e6, status}' | tee -a "$folder/times"
  [ "$status" -eq 0 ] || { tail -n 40 "$folder/$name.log" >&2; fail "$name failed; all of it is in $folder/$name.log"; }
}

bootstrap() { debootstrap --variant=minbase bookworm "$1" "$mirror"; }

# The checkout's files in a Debian of their own.
copy_sources() {
  mkdir "$1/vkhausdorff"
  git -C "$source" archive HEAD | tar -x -C "$1/vkhausdorff"
}

# The packages on a Debian that has no other file of this repository, except the two programs' sources.
use_packages() {
  local root=$1
  "$source/tools/release" --to "$folder/release" --tree "$build" deb >"$folder/release.log" 2>&1 || { cat "$folder/release.log" >&2; fail "tools/release deb"; }
  mkdir "$root/release" "$root/use"
  cp "$folder"/release/files/*.deb "$root/release"
  cp "$source"/tests/package/consumer/* "$root/use"
  printf 'OFF\n3 1 0\n0 0 0.25\n1 0 0.25\n0 1 0.25\n3 0 1 2\n' >"$root/use/a.off"
  printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >"$root/use/b.off"
  # Before the loader comes with the drivers: apt only recommends it.
  step native "$root" enter "$root" bash -ec 'apt-get -q update
    DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends /release/vkhausdorff_*.deb /release/python3-vkhausdorff_*.deb
    [ -z "$(find /usr/lib -name "libvulkan*")" ] && cd /use && vkhausdorff gate a.off b.off --max 0.3abs --device native
    python3 -c "import vkhausdorff; print(vkhausdorff.distance(\"b.off\", \"a.off\", device=\"native\"))"'
  step install "$root" enter "$root" bash -c 'apt-get -q update && DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends \
    g++ cmake make glslang-tools python3 mesa-vulkan-drivers /release/*.deb'
  step use "$root" enter "$root" bash -ec 'cd /use && cmake -S . -B out -DCMAKE_BUILD_TYPE=Release && cmake --build out && out/engine && out/host b.off a.off && vkhausdorff doctor && python3 -c "import vkhausdorff; print(vkhausdorff.distance(\"b.off\", \"a.off\"))"'
  grep -qE '^0\.2[45][0-9]* <= h\(a.off, B\) <= 0\.25[0-9]*: closed$' "$folder/use.log" || { cat "$folder/use.log"; fail "the host's program"; }
}

wants() { [[ " ${parts[*]} " == *" $1 "* ]]; }
rm -rf --one-file-system "$folder"
mkdir -p "$folder"
step debootstrap "$folder/bare" bootstrap "$folder/bare"
if wants quickstart || wants tests; then
  cp -a "$folder/bare" "$folder/checkout"
  copy_sources "$folder/checkout"
  # On lavapipe the demo may end undecided (3).
  step quickstart "$folder/checkout" enter "$folder/checkout" bash -c 'cd /vkhausdorff && { tools/quickstart || [ $? = 3 ]; }'
  grep -q '^  interval ' "$folder/quickstart.log" || fail "quickstart printed no interval"
  ! wants tests || step tests "$folder/checkout" enter "$folder/checkout" bash -c 'cd /vkhausdorff && tools/setup --tests && tools/test'
fi
if wants packages; then
  use_packages "$folder/bare"
fi
echo "bare_debian_test: passed, ${parts[*]}; $(du -sm "$folder" | cut -f1) MB on the disk"
