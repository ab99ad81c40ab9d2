#!/usr/bin/env python3
"""The package's types (__init__.pyi) say what the module has: names, signatures, properties; mypy agrees where it is there.

usage: types_test.py; vkhausdorff is imported from PYTHONPATH. Exit code 1: they disagree.
"""

import ast
import importlib.util
import inspect
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import vkhausdorff as vkh

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = pathlib.Path(vkh.__file__).parent
STUB = ast.parse((PACKAGE / "__init__.pyi").read_text())
SQUARE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=np.float64), np.array([[0, 1, 2]])

# Right and wrong uses, for a type checker: the wrong lines, and no others, are errors.
USES = """\
import pathlib
from typing import Any
import numpy as np
import vkhausdorff as vkh
v, f = np.zeros((3, 3)), np.array([[0, 1, 2]])
r = vkh.distance(v, f, v, f, tol="0.1%", symmetric=True, time=1, memory="2GiB", disable=["u3"])
lower: float = r.lower
x, y, z = r.witness_a
with vkh.Solver(v, f, "cpu") as solver:
    face: int = solver.distance(v, f, 1e-3, progress=lambda wave, lower, upper: True).face_a
within: bool = vkh.gate((v, f), (v, f), 0.1, symmetric=True).verdict == "pass"
vkh.assert_within((v, f), (v, f), "0.1%")
found = vkh.distance(v, f, v, f, field=0.01, statistics=True, bands=(0.1, "1%"))
if found.mean is not None and found.field is not None:
    least, most = found.mean
    share: float = found.area_within("1%").lower + float(found.field.upper.max())
mesh: vkh.Mesh = vkh.read("a.stl")
cloud: bool = vkh.read(v, points=True).are_points
number: int = int(mesh.file_faces[found.face_a])
for found in vkh.distances([(mesh, "b.ply"), ("id", (v, f), mesh)], max="1%", device="all"):
    place = (found.index, found.id, found.error)
vkh.distance(mesh, (v, f), tol=1e-3, field=True)
vkh.Solver(mesh, device="cpu").distance(mesh)
area: bool = vkh.gate((v, f), (v, f), 0.1, area="99%", survey_time=None).survey_met is True
vkh.distance(v, f, v, f, certificate=pathlib.Path("out.vhc"))
distances, points, rows = vkh.closest((v, f), v, device="cpu")
both: float = float(vkh.closest((v, f), v, device="0,1").upper[0])
vkh.Solver((v, f), device="all").closest(v)
moved: np.ndarray[Any, np.dtype[np.float64]] = vkh.align(mesh, (v, f)).matrix
usable: list[str] = [d["name"] for d in vkh.devices() if d["usable"]]
light: float = vkh.simplify(mesh, "0.1%", one_way=True, time=1.5).interval.upper
errors: list[float] = [level.interval.upper for level in vkh.simplify_levels(mesh, "1%", levels=3, ratio=0.4)]
with vkh.Solver(mesh) as solver:
    low: float = float(solver.closest([[0, 0, 1]]).lower[0])
with vkh.Device("cpu") as device:
    name: str = device.info["name"]
    vkh.Solver(mesh, device=device).distance(mesh, on_progress=lambda fraction, lower, upper: fraction < 0.5)
    vkh.gate(mesh, mesh, 0.1, device=device, on_progress=print)
vkh.distance(v, f, v, f, field=True).field.save(pathlib.Path("f.ply"), map="batlow")
weights: tuple[float, float, float] = r.witness.barycentric
width: float = r.gap + r.interval.upper
figures = vkh.metrics((v, f), mesh, percentile=90, bands=[0.5, "1%"], effort=1000)
figure: float = figures.hd90.lower + figures.assd.upper + figures.f1["1%"].upper
masks: bool = vkh.metrics(np.ones((3, 3, 3), dtype=bool), np.ones((3, 3, 3), dtype=bool), spacing=(1, 1, 2.5)).met
vkh.distances([], device=vkh.Device())  # wrong
vkh.simplify_levels(mesh, "1%", levels=0.5)  # wrong
vkh.closest((v, f), v, device=["0"])  # wrong
vkh.align(mesh)  # wrong
vkh.distance(v, f, v, f, on_progress=lambda fraction: None)  # wrong
vkh.Device(1.5)  # wrong
vkh.distance(v, f, v, f, field=[1])  # wrong
vkh.closest((v, f))  # wrong
vkh.metrics((v, f))  # wrong
vkh.metrics((v, f), mesh, max=1)  # wrong
vkh.gate((v, f), (v, f), 0.1, certificate=1)  # wrong
vkh.gate(v, 1, 0.1)  # wrong
vkh.distance(v, f, v)  # wrong
vkh.distances([1])  # wrong
vkh.read(1)  # wrong
vkh.distance(v, f, v, f, tolerance=1)  # wrong
r.lower = 1.0  # wrong
text: str = r.upper  # wrong
r.middle  # wrong
"""


def signature_text(arguments: ast.arguments) -> str:
    """The signature as inspect.signature writes it, without the types."""
    bare = ast.parse(ast.unparse(arguments).join(("def f(", "): ..."))).body[0].args
    for argument in (*bare.args, *bare.kwonlyargs, bare.vararg, bare.kwarg):
        if argument is not None:
            argument.annotation = None
    namespace = {}
    exec(f"def f({ast.unparse(bare)}): ...", namespace)
    return str(inspect.signature(namespace["f"]))


def signature_of(function) -> str:
    """The signature of what the module has, without the types."""
    said = inspect.signature(function)
    bare = [one.replace(annotation=one.empty) for one in said.parameters.values()]
    return str(said.replace(parameters=bare, return_annotation=said.empty))


def stub_of(body: list) -> dict:
    return {node.name: node for node in body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}


def is_property(node: ast.AST) -> bool:
    return any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list)


# The names that the pages' sentences use.
CALLS = """\
import numpy as np
import vkhausdorff as vkh
from vkhausdorff import Solver, distance
va, fa = np.zeros((3, 3)), np.array([[0, 1, 2]])
a = b = vkh.read("part.stl")
path = "part.stl"
points = np.zeros((5, 3))
mask_a = mask_b = np.ones((3, 3, 3), dtype=bool)
solver = Solver(b)
r = distance(a, b)
d = vkh.Device()
m = vkh.metrics(a, b)
light = vkh.simplify(a, max=0.1)
"""
README = ROOT / "README.md"
PAGES = [README, *sorted(set((ROOT / "docs").glob("*.md")) - {ROOT / "docs/embedding.md"})]  # that one is of C++
PROGRAMS = [*sorted((ROOT / "docs").rglob("*.py")), *sorted((ROOT / "tests/package").glob("*example.py"))]  # quoted by pages


def documented() -> tuple[list[str], list[str]]:
    """README's block of Python, and the programs that pages quote parts of; the expressions in the pages' sentences that are
    whole: a call or a member of what CALLS names."""
    blocks = [program.read_text() for program in PROGRAMS] + re.findall(r"^```python\n(.*?)^```", README.read_text(), re.M | re.S)
    calls = set()
    for page in PAGES:
        text = page.read_text()
        prose = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
        for code in re.findall(r"`([^`\n]+)`", prose):
            is_of_python = re.match(r"(vkh|solver|r|d|m|light)\.[a-z]\w*([.(]|$)|(Solver|distance)\([^)]", code)
            if is_of_python and not code.endswith((".cpp", ".h")):
                calls.add(code)
    return blocks, sorted(calls)


def used_calls() -> set[str]:
    """The functions and the methods of Solver, Device and Result that documented code or USES calls."""
    blocks, calls = documented()
    nodes = [node for code in (*blocks, CALLS + "\n".join(calls), USES) for node in ast.walk(ast.parse(code))]
    return {node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            for node in nodes if isinstance(node, ast.Call)}


def errors_of_mypy(test: unittest.TestCase, files: dict) -> str:
    if importlib.util.find_spec("mypy") is None:
        test.skipTest("no mypy here")
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            (pathlib.Path(folder) / name).write_text(text)
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", folder, *files],
                              cwd=folder, capture_output=True, text=True)
        test.assertEqual(done.stderr, "")
        return "" if done.returncode == 0 else done.stdout


# The names that every class of pybind11 has.
COMMON = {"__module__", "__doc__", "__new__", "__repr__", "__init__", "__contains__", "__len__", "__iter__", "__getattr__"}


class Types(unittest.TestCase):
    def test_the_names_are_those_of_the_module(self):
        public = {name for name in dir(vkh) if not name.startswith("_")}
        core = {name for name in dir(sys.modules["vkhausdorff._core"]) if not name.startswith("_")}
        said = {name for name in stub_of(STUB.body) if not name.startswith("_")}
        self.assertEqual(said, public)
        in_python = {"Alignment", "Closest", "Field", "Interval", "Metrics", "Result", "SidedPoint", "Signed", "SignedField", "Simplified", "Survey", "Witness", "assert_within", "distances", "metrics"}
        self.assertEqual(core | in_python, public, "the package does not pass on what the module has")
        self.assertEqual(set(vkh.__all__), public | {"__version__"})

    def test_functions_have_its_signatures(self):
        for name, node in stub_of(STUB.body).items():
            if isinstance(node, ast.FunctionDef):
                self.assertEqual(signature_text(node.args), signature_of(getattr(vkh, name)), name)

    def test_classes_have_its_members(self):
        for name, node in stub_of(STUB.body).items():
            if not isinstance(node, ast.ClassDef) or name == "DeviceError" or name.startswith("_"):
                continue
            cls = getattr(vkh, name)
            members = stub_of(node.body)
            fields = getattr(cls, "__match_args__", ())  # of a dataclass or a named tuple
            stub = stub_of(STUB.body)
            bases = [base.id for base in node.bases if isinstance(base, ast.Name) and base.id in stub]
            body = [member for base in bases for member in stub[base].body] + node.body
            said = [member.target.id for member in body if isinstance(member, ast.AnnAssign)]
            values = [value for value in said if value in fields or value not in vars(cls)]
            self.assertEqual(values, list(fields), name)
            there = {key for key in vars(cls) if not key.startswith("_") or key in ("__enter__", "__exit__")}
            self.assertEqual(set(members) - COMMON, there - set(said), name)
            for key, member in members.items():
                with self.subTest(f"{name}.{key}"):
                    if is_property(member):
                        self.assertIsInstance(inspect.getattr_static(cls, key), property)
                    else:
                        self.assertEqual(signature_text(member.args), signature_of(getattr(cls, key)))

    def test_the_module_takes_what_its_signatures_say(self):
        """The signatures are texts: the parser's own list is in what it says to a stranger."""
        with vkh.Solver(*SQUARE) as solver:
            for function, said in ((vkh.distance, vkh.distance), (vkh.Solver, vkh.Solver), (solver.distance, solver.distance), (vkh.Device, vkh.Device),
                                   (vkh.closest, vkh.closest), (solver.closest, solver.closest), (vkh.read, vkh.read),
                                   (vkh.simplify, vkh.simplify), (vkh.simplify_levels, vkh.simplify_levels), (vkh.align, vkh.align)):
                with self.assertRaises(TypeError) as refused:
                    function(stranger=1)
                taken = re.search(r"it takes (.*)$", str(refused.exception))[1].split(", ")
                self.assertEqual(sorted(taken), sorted(inspect.signature(said).parameters), function)

    def test_properties_have_the_types_that_they_say(self):
        result = vkh.distance(*SQUARE, *SQUARE, field=True, statistics=True, signed=True, symmetric=True)
        bare = vkh.distance(*SQUARE, *SQUARE)
        for key, member in stub_of(stub_of(STUB.body)["Result"].body).items():
            if not is_property(member) or key in ("index", "id", "error"):  # of distances()
                continue
            said, value = ast.unparse(member.returns), getattr(result, key)
            with self.subTest(key):
                if said.endswith((" | None", " | Any")):
                    self.assertIsNone(getattr(bare, key))
                if said.startswith("Literal["):
                    self.assertIn(value, [one.value for one in ast.walk(member.returns) if isinstance(one, ast.Constant)])
                else:
                    self.assertIs(type(value), eval(re.split(r"\[| \| ", said)[0], dict(vars(vkh))))

    def test_words_are_those_of_the_schema(self):
        """A test of the schema compares them with what the program writes."""
        schema = json.loads((ROOT / "docs" / "schema" / "answer.schema.json").read_text())["$defs"]
        known = {("Result", "status"): schema["status"], ("Result", "verdict"): schema["common"]["properties"]["verdict"],
                 ("Survey", "ended"): schema["survey_work"]["properties"]["ended"], ("Signed", "inside"): schema["signed_figures"]["properties"]["inside"],
                 ("Signed", "inside_out"): {"enum": ["none", *schema["signed_figures"]["properties"]["inside_out"]["enum"]]}}
        for (name, member), said in known.items():
            body = stub_of(STUB.body)[name].body
            (kind,) = [node.returns if isinstance(node, ast.FunctionDef) else node.annotation for node in body
                       if getattr(node, "name", None) == member or ast.unparse(getattr(node, "target", ast.Constant(0))) == member]
            words = {one.value for one in ast.walk(kind) if isinstance(one, ast.Constant) and one.value is not None}
            self.assertEqual(words, set(said["enum"]), (name, member))

    def test_it_is_marked_as_typed(self):
        self.assertTrue((PACKAGE / "py.typed").exists())

    def test_mypy_reads_it(self):
        found = errors_of_mypy(self, {"uses.py": USES})
        wrong = {int(line) for line in re.findall(r"^uses\.py:(\d+): error", found, re.M)}
        expected = {i for i, line in enumerate(USES.splitlines(), 1) if line.endswith("# wrong")}
        self.assertEqual(wrong, expected, found)

    def test_every_documented_call_passes_mypy(self):
        """The code blocks of the pages, and the calls that stand in their sentences."""
        blocks, calls = documented()
        self.assertGreaterEqual(len(blocks), 12)
        self.assertGreater(len(calls), 30)
        files = {f"block_{i}.py": block for i, block in enumerate(blocks)}
        files["distributed.pyi"] = "from typing import Any\ndef Client(*, scheduler_file: str) -> Any: ...\n"
        files["calls.py"] = CALLS + "".join(f"{call}\n" for call in calls)
        self.assertEqual(errors_of_mypy(self, files), "")

    def test_every_function_is_called(self):
        """No function is left out of the pages' code and of the uses above."""
        functions = {name for name, node in stub_of(STUB.body).items() if isinstance(node, ast.FunctionDef)}
        self.assertEqual(functions - used_calls(), set())


if __name__ == "__main__":
    unittest.main()
