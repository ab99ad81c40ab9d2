#!/usr/bin/env bash
# Makes host/draw/font/NotoSans-subset.ttf: what names of files and figures are written with in pictures.
# Noto Sans, for its licence reserves no name: a subset may keep it (host/draw/font/OFL.txt).
# Latin, Greek, Cyrillic, and the signs that mathematics and units need; no hints, for the rasteriser knows none.
# usage: tools/draw/font.sh     with Debian 12's archive: apt-get downloads the font and fonttools, installs nothing.
set -euo pipefail
out=$(cd "$(dirname "$0")/../../host/draw/font" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

kPackages=(fonts-noto-core=20201225-1 python3-fonttools=4.38.0-1+deb12u1)
kSigns=U+2010-2015,U+2018-201E,U+2020,U+2022,U+2026,U+2030,U+2032,U+2033,U+20AC,U+2190-2193,U+2212,U+221E,U+2248,U+2260,U+2264,U+2265,U+25CF
kDigits=U+2070,U+2074-207F,U+2080-208E  # raised and lowered
kLetters=U+0020-007E,U+00A0-017F,U+0218-021B,U+0386-03CE,U+0401-040C,U+040E-044F,U+0451-045C,U+045E-045F,U+0490-0491,U+FFFD

cd "$work"
apt-get download -q "${kPackages[@]}"
for package in ./*.deb; do dpkg -x "$package" .; done
PYTHONPATH=usr/lib/python3/dist-packages python3 -m fontTools.subset usr/share/fonts/truetype/noto/NotoSans-Regular.ttf \
  --unicodes="$kLetters,$kDigits,$kSigns" --no-hinting --desubroutinize --layout-features=kern --notdef-outline --glyph-names= \
  --name-IDs=0,1,2,3,4,5,6,13,14 --drop-tables+=GDEF,GSUB,DSIG,gasp --output-file="$out/NotoSans-subset.ttf"
ls -l "$out/NotoSans-subset.ttf"
