#!/usr/bin/env bash
# Makes host/show/font/OpenSans-subset.ttf: the font of file names and figures in pictures. Open
# Sans has this project's own licence, and the signs of bounds, which Noto Sans lacks. The subset
# has Latin, Greek, Cyrillic, and the signs of mathematics and units; no hints, since the rasteriser
# uses none.
# usage: tools/draw/font.sh     on Debian 12: apt-get downloads the font and fonttools, and installs nothing.
set -euo pipefail
out=$(cd "$(dirname "$0")/../../host/show/font" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

kPackages=(fonts-open-sans=1.11-2 python3-fonttools=4.38.0-1+deb12u1)
kSigns=U+2013,U+2014,U+2018-201E,U+2020,U+2022,U+2026,U+2030,U+2032,U+2033,U+20AC,U+2212,U+221E,U+2248,U+2260,U+2264,U+2265
kDigits=U+2070,U+2074-2079,U+2080-2089  # raised and lowered
kLetters=U+0020-007E,U+00A0-017F,U+0218-021B,U+0386-03CE,U+0401-040C,U+040E-044F,U+0451-045C,U+045E-045F,U+0490-0491,U+FFFD

cd "$work"
apt-get download -q "${kPackages[@]}"
for package in ./*.deb; do dpkg -x "$package" .; done
PYTHONPATH=usr/lib/python3/dist-packages python3 -m fontTools.subset \
  usr/share/fonts/truetype/open-sans/OpenSans-Regular.ttf --unicodes="$kLetters,$kDigits,$kSigns" \
  --no-hinting --layout-features=kern --notdef-outline --name-IDs=0,1,2,3,4,5,6,13,14 \
  --drop-tables+=GDEF,GSUB,DSIG,gasp --output-file="$out/OpenSans-subset.ttf"
ls -l "$out/OpenSans-subset.ttf"
