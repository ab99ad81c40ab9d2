#!/usr/bin/env bash
# usage: arm64_sysroot.sh FOLDER
# Unpacks ARM64's lavapipe, Vulkan loader and run-time libraries into FOLDER, for qemu-aarch64-static -L FOLDER. Nothing
# is installed: apt works in folders of its own, as if on an ARM64 machine without any package, and
# needs no rights. Exits 77, with the reason, if there is no apt or no such packages.
set -euo pipefail
folder=$1
packages=(libvulkan1 mesa-vulkan-drivers libstdc++6)
skip() { echo "arm64_sysroot: $*" >&2; exit 77; }

[ ! -e "$folder/complete" ] || exit 0
for tool in apt-get dpkg-deb; do
  command -v "$tool" >/dev/null || skip "no $tool here"
done
. /etc/os-release
case "${ID-}" in
  debian) mirror=http://deb.debian.org/debian components=main ;;
  ubuntu) mirror=http://ports.ubuntu.com/ubuntu-ports components="main universe" ;;
  *) skip "neither Debian nor Ubuntu" ;;
esac
keys=/usr/share/keyrings/$ID-archive-keyring.gpg
[ -e "$keys" ] || skip "no $keys"

mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
work=$(mktemp -d "$folder/apt.XXXXXX")
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{state/lists/partial,cache/archives/partial,log}
: >"$work/status"
for suite in "$VERSION_CODENAME" "$VERSION_CODENAME-updates"; do
  echo "deb [signed-by=$keys] ${VKH_ARM64_MIRROR-$mirror} $suite $components"
done >"$work/sources.list"
options=(-o APT::Architecture=arm64 -o APT::Architectures=arm64 -o "Dir::State=$work/state" -o "Dir::Cache=$work/cache"
         -o "Dir::State::status=$work/status" -o "Dir::Etc::sourcelist=$work/sources.list" -o Dir::Etc::sourceparts=/dev/null
         -o Dir::Etc::preferencesparts=/dev/null -o "Dir::Log=$work/log" -o APT::Sandbox::User=root -o Acquire::Languages=none
         -o Acquire::Retries=2 -o Acquire::http::Timeout=30 -o Debug::NoLocking=true)
log=$work/apt.log
timeout 120 apt-get -q "${options[@]}" update >"$log" 2>&1 || { tail -n 5 "$log" >&2; skip "apt-get update failed"; }
timeout 300 apt-get -q -y --download-only --no-install-recommends "${options[@]}" install "${packages[@]}" >"$log" 2>&1 ||
  { tail -n 5 "$log" >&2; skip "${packages[*]} cannot be had for arm64"; }
for package in "$work"/cache/archives/*.deb; do
  dpkg-deb -x "$package" "$folder"
done
# A whole system has one folder as a link to another: programs look for the dynamic linker in /lib.
[ -e "$folder/lib/ld-linux-aarch64.so.1" ] || ln -sf usr/lib "$folder/lib"
for package in "${packages[@]}"; do
  dpkg-deb -W "$work"/cache/archives/"${package//+/%2b}"_*.deb 2>/dev/null || dpkg-deb -W "$work"/cache/archives/"$package"_*.deb
done >"$folder/versions"
touch "$folder/complete"
