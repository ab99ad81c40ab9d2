"""The parts of the headers of shaders/math that the proofs use: constants, quoted lines, functions.

A quotation is a piece of a header as it stands, except for white space. `{name}` in it stands for a number or a constant's
name there, and takes its value, as the float that it is.
"""

import ast
import functools
import re
import struct
from fractions import Fraction
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
FOLDER = ROOT / "shaders" / "math"
NUMBER = r"(?P<{}>[0-9.]+(?:e[-+]?[0-9]+)?)"


class Changed(Exception):
    """A header no longer has the text that a proof is about."""


def as_float(text):
    """The float32 nearest to a literal, exactly."""
    return Fraction(struct.unpack("f", struct.pack("f", float(text)))[0])


@functools.cache
def all_texts():
    return {path.name: path.read_text() for path in sorted(FOLDER.glob("*.h"))}


@functools.cache
def without_comments(text):
    return re.sub(r"//[^\n]*", "", text)


@functools.cache
def squeezed(text):
    """The text without white space that separates nothing."""
    return re.sub(r" ?([^\w ]) ?", r"\1", re.sub(r"\s+", " ", text)).strip()


class Headers:
    """The texts, with `instead` a value in place of a header's, by the name that a quotation or a header gives it."""

    def __init__(self, instead=None, texts=None):
        self.instead = instead or {}
        self.raw = texts or all_texts()
        self.text = {name: without_comments(text) for name, text in self.raw.items()}
        self.squeezed = {name: squeezed(text) for name, text in self.text.items()}
        self.comments = {name: squeezed(re.sub(r"\n *// ?", " ", text)) for name, text in self.raw.items()}
        self.constants = {name: as_float(value) for text in self.text.values() for name, value in
                          re.findall(r"VKH_CONST float (\w+) = ([0-9.e+-]+)f;", text)}
        for name, value in self.instead.items():
            if name in self.constants:
                self.constants[name] = value
        self.seen = {}

    def says(self, header, text):
        """The same as quote, for text of its comments."""
        return self.quote(header, text, self.comments)

    def quote(self, header, text, texts=None):
        """The numbers that a quotation names; Changed if the header has no such text."""
        names = re.findall(r"\{(\w+)\}", text)
        pattern = re.escape(squeezed(re.sub(r"\{(\w+)\}", r"NUMBER_\1_", text)))
        for name in names:
            pattern = pattern.replace(f"NUMBER_{name}_", NUMBER.format(name))
        found = re.search(pattern, (texts or self.squeezed)[header])
        if not found:
            raise Changed(f"shaders/math/{header} no longer has: {text}")
        values = {name: self.instead.get(name, as_float(found[name])) for name in names}
        self.seen.update(values)
        return values

    def function(self, name, arguments=None):
        """Parameters and statements of a function, the one with this many parameters; loops and branches are refused."""
        for text in self.text.values():
            for found in re.finditer(rf"VKH_FN \w+ {name}\(([^)]*)\) \{{(.*?)\n?\}}\n", text, re.S):
                parameters = [p.split() for p in found[1].split(",")]
                if arguments is None or all(p[0] == a for p, a in zip(parameters, arguments)):
                    return [p[1] for p in parameters], [s.strip() for s in found[2].split(";") if s.strip()]
        raise Changed(f"shaders/math has no straight {name}{arguments or ''}")


def parsed(statement):
    """A statement of the headers in Python's grammar: (target, expression), the target None if it returns."""
    text = re.sub(r"\b([0-9.]+(?:e[-+]?[0-9]+)?)f\b", r"\1", re.sub(r"\s+", " ", statement))
    text = re.sub(r"^(VKH_PRECISE )?(const )?(float|vec3|Two3|Two|uint|bool) (?=\w+ = )", "", text)
    if re.match(r"(Two3|Two|float|vec3) \w+$", text):
        return None
    if text.startswith("return "):
        return "return", ast.parse(text[7:], mode="eval").body
    target, expression = text.split(" = ", 1)
    return target, ast.parse(expression, mode="eval").body
