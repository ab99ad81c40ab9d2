#!/usr/bin/env python3
"""Writes the package's types, __init__.pyi: the template's lines, the classes that Python defines, and the keywords of the options table.

usage: make_stub.py TEMPLATE PACKAGE KEYWORDS OUT; PACKAGE has the modules. A line "# class NAME of MODULE" of the template
stands for that class: its bases, the first line of its text, its annotated members, and the signatures of its methods.
A line "# keywords of FUNCTION" stands for the keywords that KEYWORDS, made by tools/options/make_pages.py, has for it
and that the function does not name before.
"""

import ast
import json
import pathlib
import re
import sys

SHOWN = {"__init__", "__new__", "__iter__", "__len__", "__contains__", "__getattr__"}  # besides names without an underscore
PROPERTIES = {"_Part"}  # what stands for a member that is read alone
BASES = {"NamedTuple", "_Bounds", "Field"}  # others are the package's own


class Unquoted(ast.NodeTransformer):
    """Types that stand in quotes in the module, since it does not know their names."""

    def visit_Subscript(self, node):  # a Literal's texts stay
        return node if isinstance(node.value, ast.Name) and node.value.id == "Literal" else self.generic_visit(node)

    def visit_Constant(self, node):
        return ast.parse(node.value, mode="eval").body if isinstance(node.value, str) else node


def type_text(node: ast.expr) -> str:
    return ast.unparse(Unquoted().visit(node))


def member_lines(node: ast.stmt) -> list[str]:
    if isinstance(node, ast.AnnAssign):
        name, kind = ast.unparse(node.target), type_text(node.annotation)
        is_property = isinstance(node.value, ast.Call) and ast.unparse(node.value.func) in PROPERTIES
        return ["    @property", f"    def {name}(self) -> {kind}: ..."] if is_property else [f"    {name}: {kind}"]
    if not isinstance(node, ast.FunctionDef) or (node.name.startswith("_") and node.name not in SHOWN):
        return []
    if node.returns is None:
        return []
    for argument in (*node.args.args, *node.args.kwonlyargs):
        if argument.annotation is not None:
            argument.annotation = Unquoted().visit(argument.annotation)
    decorators = [f"    @{ast.unparse(one)}" for one in node.decorator_list]
    return [*decorators, f"    def {node.name}({ast.unparse(node.args)}) -> {type_text(node.returns)}: ..."]


def class_text(module: pathlib.Path, name: str) -> str:
    (node,) = (one for one in ast.parse(module.read_text(encoding="utf-8")).body if isinstance(one, ast.ClassDef) and one.name == name)
    bases = ", ".join(one.id for one in node.bases if isinstance(one, ast.Name) and one.id in BASES)
    said = ast.get_docstring(node)
    first = [f'    """{said.splitlines()[0]}"""', ""] if said else []
    members = [line for one in node.body for line in member_lines(one)]
    return "\n".join([f"class {name}({bases}):" if bases else f"class {name}:", *first, *members])


# Types of keywords by their kind; "| None" is added where None is the default.
KINDS = {
    "flag": "bool", "tolerance": "_Number | str", "length": "_Number | str", "lengths": "_Bands", "names": "_Names", "share": "_Number | str",
    "percentile": "_Number | str", "angle": "_Number", "size": "SupportsIndex | str", "time": "_Number", "count": "SupportsIndex",
    "file": "_Path", "input": "npt.ArrayLike | _Path", "text": "str | SupportsIndex | Device",
}
OF_ONE = {("distances", "device"): "str | SupportsIndex", ("Solver.distance", "points"): 'Union[bool, Literal["a"], None]'}
NAMES = {"field": "bool | _Number | str", "points": "_Points"}


def keyword_line(row: dict, function: str) -> str:
    name, default = row["name"], row["default"].replace("'", '"')
    literals = [*([default.strip('"')] if row["kind"] == "choice" else []), *row["choices"]]
    known = ", ".join(f'"{one}"' for one in dict.fromkeys(literals))
    kind = NAMES.get(name) or KINDS.get(row["kind"]) or f"Literal[{known}]"
    kind = OF_ONE.get((function, name), kind)
    return f"{name}: {kind}{' | None' if default == 'None' and 'None' not in kind and name not in NAMES else ''} = {default},"


def with_keywords(text: str, keywords: dict) -> str:
    def lines(at):
        named = re.findall(r"(\w+): ", text[text.rindex("def ", 0, at.start()):at.start()])
        return "\n".join(at[1] + keyword_line(row, at[2]) for row in keywords[at[2]] if row["name"] not in named)

    return re.sub(r"^( +)# keywords of ([\w.]+)$", lines, text, flags=re.M)


def main() -> None:
    template, package, keywords, out = map(pathlib.Path, sys.argv[1:])
    text = re.sub(r"^# class (\w+) of (\w+)$", lambda at: class_text(package / f"{at[2]}.py", at[1]), template.read_text(encoding="utf-8"), flags=re.M)
    out.write_text(with_keywords(text, json.loads(keywords.read_text(encoding="utf-8"))), encoding="utf-8")


if __name__ == "__main__":
    main()
