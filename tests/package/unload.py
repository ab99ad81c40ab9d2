"""A shared library that was used and closed is gone from the process. usage: unload.py LIBRARY FUNCTION NAME...

FUNCTION takes nothing and returns 0, or 77 where there is nothing to use. NAME: parts of file names of which none may be left.
Exit code 77: as the function.
"""

import _ctypes
import ctypes
import pathlib
import sys

library, function, *names = sys.argv[1:]


def mapped() -> set[str]:
    lines = pathlib.Path("/proc/self/maps").read_text().splitlines()
    return {path for line in lines if len(fields := line.split(maxsplit=5)) == 6 and any(name in (path := fields[5]) for name in names)}


opened = ctypes.CDLL(library)
if len(mapped()) < len(names):
    sys.exit(f"unload: {names} are not all of the files that {library} needs: {mapped()}")
code = getattr(opened, function)()
if code not in (0, 77):
    sys.exit(f"unload: {function}() returned {code}")
_ctypes.dlclose(opened._handle)
if mapped():
    sys.exit(f"unload: closed, and still mapped: {', '.join(sorted(mapped()))}")
sys.exit(code)
