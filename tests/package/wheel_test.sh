#!/usr/bin/env bash
# `pip wheel` makes a wheel of these sources, in pip's own environment and without the network; in a fresh virtual environment
# it works, has its types, and goes without a trace. NumPy is the system's. usage: wheel_test.sh SOURCE FOLDER PYTHON; FOLDER/tree: engine_test.sh's.
# Exit code 77: a part of Python is not there.
set -euo pipefail
source=$1 folder=$2 python=$3
fail() { echo "wheel_test: $*" >&2; exit 1; }
step() { "$@" >"$folder/log" 2>&1 || { tail -n 40 "$folder/log" >&2; fail "$*"; }; }
for module in pip setuptools wheel venv ensurepip; do
  "$python" -c "import $module" 2>/dev/null || { echo "wheel_test: skipped, $python has no $module"; exit 77; }
done
unset PYTHONPATH
if command -v ccache >/dev/null; then export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
version=$(sed -nE 's/^#define VKH_VERSION_(MAJOR|MINOR|PATCH) //p' "$source/engine/vkhausdorff.h" | paste -sd.)

# setuptools writes beside setup.py: into a folder of links to the sources.
rm -rf "$folder"/{checkout,dist,venv}
mkdir "$folder/checkout"
ln -s "$source"/{pyproject.toml,setup.py,MANIFEST.in,README.md,LICENSE,engine,host,tools} "$folder/checkout"
VKH_BUILD_DIR=$folder/tree step "$python" -m pip wheel --no-index --no-deps -w "$folder/dist" "$folder/checkout"
wheels=("$folder"/dist/*)
wheel=${wheels[0]}
[ ${#wheels[@]} -eq 1 ] || fail "wrote ${wheels[*]}"
case $(basename "$wheel") in
  "vkhausdorff-$version-cp3"*-cp3*-linux_*.whl) ;;
  *) fail "$wheel is not named for this version, Python and machine" ;;
esac
"$python" -m zipfile -l "$wheel" | awk 'NR > 1 {print $1}' | grep -v '\.dist-info/' | sed -E 's/_core\..*\.so$/_core.so/' | sort >"$folder/files"
printf 'vkhausdorff/%s\n' __init__.py __init__.pyi _align.py _closest.py _core.so _keywords.py _many.py _masks.py _meshes.py _metrics.py _result.py _simplify.py _survey.py dask.py py.typed | diff - "$folder/files" || fail "the wheel has other files (>)"

step "$python" -m venv --system-site-packages "$folder/venv"
new=$folder/venv/bin/python
before=$(find "$folder/venv" | sort)
step "$new" -m pip install --no-index "$wheel"  # with its dependencies: NumPy has to be there
cd "$folder"
[ "$("$new" -c 'import vkhausdorff as v; print(v.__file__, v.__version__)')" = \
  "$(echo "$folder"/venv/lib/python3*/site-packages/vkhausdorff/__init__.py) $version" ] || fail "another vkhausdorff is imported"
step "$new" "$source/tests/package/example.py"
[ "$(grep -c closed "$folder/log")" = 3 ] || { cat "$folder/log"; fail "example.py printed something else"; }
step "$new" -B "$source/tests/package/types_test.py"
step "$new" -m pip uninstall -y vkhausdorff
find "$folder/venv" -name '__pycache__' -prune -o -print | sort >"$folder/after"
left=$(comm -13 <(echo "$before") "$folder/after")
[ -z "$left" ] || fail "pip uninstall leaves $left"
echo "wheel_test: passed, $(basename "$wheel")"
