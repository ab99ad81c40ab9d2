#!/usr/bin/env python3
"""The templates, styles and viewer of pages as one C++ source: embed.py FOLDER OUT.cpp.

FOLDER is tools/page. Style and viewer stand in elements of their own, so nothing in them may end one.
"""

import base64
import hashlib
import sys
from pathlib import Path

PIECE = 96  # characters of a line; compilers take long literals in pieces
MOST = 60_000  # bytes of a literal: MSVC takes 65,535

HEAD = """// Made by tools/page/embed.py.
#include <bit>
#include <cstdint>

#include "host/show/page_assets.h"

namespace vkh {
static_assert(std::endian::native == std::endian::little);
"""


def literal(text):
    """A C++ string literal of UTF-8, in lines. Octal escapes end after three digits; hexadecimal ones do not."""
    out = []
    data = text.encode()
    for at in range(0, len(data), PIECE):
        line = "".join(
            f"\\{byte:03o}" if byte < 0x20 or byte > 0x7E or chr(byte) in "\"\\?" else chr(byte)
            for byte in data[at : at + PIECE])
        out.append(f'    "{line}"')
    return "\n".join(out) if out else '    ""'


def checked(name, text, forbidden):
    for part in forbidden:
        if part in text.lower():
            sys.exit(f"embed.py: {name} has {part!r}, which would end its element")
    return text


def words(name, data):
    """An array of the bytes, eight a number, the first the lowest."""
    padded = data + bytes(-len(data) % 8)
    numbers = [f"{int.from_bytes(padded[at : at + 8], 'little'):#x}" for at in range(0, len(padded), 8)]
    lines = ",\n".join(", ".join(numbers[at : at + 5]) for at in range(0, len(numbers), 5))
    return (f"static constexpr uint64_t {name}Words[] = {{\n{lines}}};\n"
            f"const std::string_view {name}(reinterpret_cast<const char*>({name}Words), {len(data)});\n")


def constant(name, text):
    if len(text.encode()) > MOST:
        return words(name, text.encode())
    return f"const std::string_view {name} =\n{literal(text)};\n"


def sha256(text):
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def source(folder):
    style = checked("style.css", (folder / "src/style.css").read_text(), ["</style"])
    viewer = checked("viewer.js", (folder / "viewer.js").read_text(), ["</script", "<!--", "\r"])
    index_style = checked("index.css", (folder / "src/index.css").read_text(), ["</style"])
    return (HEAD + constant("kPageTemplate", (folder / "src/page.html").read_text())
            + constant("kIndexTemplate", (folder / "src/index.html").read_text())
            + constant("kIndexStyle", index_style) + constant("kIndexStyleHash", sha256(index_style))
            + constant("kPageStyle", style) + constant("kPageViewer", viewer)
            + constant("kPageStyleHash", sha256(style)) + constant("kPageViewerHash", sha256(viewer))
            + "}  // namespace vkh\n")


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__)
    Path(arguments[1]).write_text(source(Path(arguments[0])))


if __name__ == "__main__":
    main(sys.argv[1:])
