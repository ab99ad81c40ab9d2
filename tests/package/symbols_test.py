"""What the archives and the Python module show to a program that links or loads them.

usage: symbols_test.py ARCHIVE... [--module MODULE]. In an archive each global symbol is vkh* or in namespace vkh, or an inline
function (weak) of a library of headers; none is unique, for a shared library with such a symbol is never unloaded. The module
shows the function that Python calls, and nothing else.
"""

import re
import subprocess
import sys

# _ZN3vkh: a template whose lambdas c++filt cannot read.
OURS = re.compile(r"(vkh[A-Z]\w*|(\w+ for |non-virtual thunk to )*vkh::.*|_ZNK?3vkh.*)$")
# Names of those who use the same headers, which mean the same there. DW.ref: what C++ compilers make for exceptions.
SHARED = re.compile(r"(std|__gnu_cxx|__cxxabiv1|glm|nlohmann|VkhContext_T|vkh)\b|operator |DW\.ref\.|__clang_call_terminate")


def symbols(*words: str) -> list[tuple[str, str]]:
    """The kind and the demangled name of each."""
    lines = subprocess.run(["nm", "--defined-only", *words], check=True, capture_output=True, text=True).stdout.splitlines()
    found = [fields[1:] for line in lines if len(fields := line.split(maxsplit=2)) == 3]
    plain = subprocess.run(["c++filt"], input="\n".join(name for _, name in found), check=True, capture_output=True, text=True).stdout
    return list(zip((kind for kind, _ in found), plain.splitlines()))


def is_allowed(kind: str, name: str) -> bool:
    if kind == "u":
        return False
    return bool(OURS.match(name)) or (kind in "WV" and bool(SHARED.search(name)))


archives, module = sys.argv[1:], None
if "--module" in archives:
    module = archives.pop()
    archives.pop()
wrong, count = [], 0
for archive in archives:
    found = symbols("-g", archive)
    count += len(found)
    wrong += [f"{archive}: {kind} {name}" for kind, name in found if not is_allowed(kind, name)]
if module is not None:
    shown = [name.partition("@")[0] for _, name in symbols("-D", module)]
    count += len(shown)
    wrong += [f"{module}: {name}" for name in shown if name != "PyInit__core"]
print(*(f"symbols_test: {line}" for line in wrong), f"symbols_test: {count} symbols", sep="\n")
sys.exit(1 if wrong or count == 0 else 0)
