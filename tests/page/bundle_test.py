"""The committed viewer is built from its sources: tools/page/build once more, and the same bytes.

usage: bundle_test.py SOURCE SCRATCH. Exit code 77: no node, or npm's packages are not available.
"""

import pathlib
import shutil
import subprocess
import sys

SOURCE, SCRATCH = (pathlib.Path(path).resolve() for path in sys.argv[1:3])


def skip(why):
    print(f"bundle_test: skipped, {why}")
    sys.exit(77)


def main():
    if not shutil.which("node") or not shutil.which("npm"):
        skip("no node here")
    page = SCRATCH / "page"
    shutil.rmtree(page, ignore_errors=True)
    shutil.copytree(SOURCE / "tools/page", page, ignore=shutil.ignore_patterns("node_modules", "viewer.js"))
    done = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=page, capture_output=True, text=True)
    if done.returncode:
        skip("npm cannot fetch three and esbuild: " + done.stderr.strip()[-200:])
    subprocess.run([page / "build", SCRATCH / "again.js"], check=True)
    committed = (SOURCE / "tools/page/viewer.js").read_bytes()
    if (SCRATCH / "again.js").read_bytes() != committed:
        sys.exit("tools/page/viewer.js is not what its sources make: run tools/page/build")
    licence = (page / "node_modules/three/LICENSE").read_bytes()
    if licence not in committed or licence.decode() not in (SOURCE / "tools/page/THIRD_PARTY.md").read_text():
        sys.exit("three's licence is not in viewer.js and THIRD_PARTY.md as it is")


main()
