#!/usr/bin/env python3
"""Writes a file's bytes as a C++ header: const unsigned char kFont[].

usage: tools/draw/embed_font.py FILE HEADER
"""
import pathlib
import sys

A_LINE = 24


def main():
    content = pathlib.Path(sys.argv[1]).read_bytes()
    lines = [",".join(map(str, content[i:i + A_LINE])) for i in range(0, len(content), A_LINE)]
    text = "static const unsigned char kFont[] = {\n" + ",\n".join(lines) + "};\n"
    pathlib.Path(sys.argv[2]).write_text(text)


if __name__ == "__main__":
    main()
