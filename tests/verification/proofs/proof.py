"""A stored proof: a theorem, the scripts for Gappa that show it, and how far its constants may be weakened."""

import re
import subprocess
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Callable

from claims import CLAIMS, claim
from headers import Headers
from linear import ULP, both_sides, number

TIME_LIMIT = 300  # seconds; a second or two, where nothing else runs


@dataclass
class Weakened:
    """A constant of a header: the smallest value tried that still proves the theorem, and the largest that does not. A
    value of None: there is none, that is, the theorem holds without the term."""
    name: str
    holds: Fraction
    fails: Fraction | None


@dataclass
class Proof:
    name: str
    theorem: str
    scripts: Callable  # of Headers: {case: script}
    weakened: list = field(default_factory=list)
    constants: Callable = lambda headers: {}  # of Headers: {name: value}


@dataclass
class Outcome:
    ok: bool
    said: str


def gappa(script):
    """Gappa's verdict on a script. A hint that is no identity is a failure, too: Gappa only warns."""
    done = subprocess.run(["gappa", "-Wno-null-denominator", "-Wno-unbound-variable"], input=script,
                          capture_output=True, text=True, timeout=TIME_LIMIT)
    false_hint = "are not trivially equal" in done.stderr
    return Outcome(done.returncode == 0 and not false_hint, done.stderr.strip())


def value_of(expression, constants):
    """A constant of a template, exactly; a pair of bounds if the expression is both(x) or a tuple."""
    value = evaluated(expression, {"both": both_sides, "min": min, **constants})
    return value if isinstance(value, str) else number(value)


def evaluated(expression, names):
    """Python's arithmetic, in fractions."""
    exact_text = re.sub(r"(?<![\w.])(\d+(?:\.\d+)?)(?![\w.])", r"F('\1')", expression)
    return eval(exact_text, {"__builtins__": {}}, {"F": Fraction, **names})  # noqa: S307: the templates' own text


def faithful(body):
    """Lines `name := expression;` are rounded operations: a variable within kUlp of the exact result, both named."""
    out, facts = [], []
    for line in body.split("\n"):
        found = re.fullmatch(r"(\w+) :(\w*)= (.*);(.*)", line)
        if not found:
            out.append(line)
            continue
        name, bound, expression, rest = found.groups()
        out.append(f"{name}_exact = {expression};{rest}")
        facts.append(f"{name} -/ {name}_exact in @{{both({bound or 'ulp'})}}")
    text = "\n".join(out)
    return text.replace("{ ", "{ " + " /\\ ".join(facts) + " /\\ ", 1) if facts else text


def template(path):
    """A proof from a template: its directives, and a script for each case."""
    head, *cases = re.split(r"^#@ case ", path.read_text(), flags=re.M)
    directives = re.findall(r"^#@ (\w+) (.*)$", head, re.M)
    theorem = " ".join(text for kind, text in directives if kind == "theorem")
    common = "".join(line for line in head.splitlines(True) if not line.startswith("#"))

    def constants(headers):
        out = {"ulp": ULP, **{name: claim(name) for name in CLAIMS}, **headers.constants}
        for kind, text in directives:
            if kind == "quote":
                out.update(headers.quote(*text.split(": ", 1)))
            if kind == "says":
                out.update(headers.says(*text.split(": ", 1)))
        for kind, text in directives:
            if kind == "let":
                name, expression = text.split(" = ", 1)
                out[name] = headers.instead.get(name, evaluated(expression, out))
        return out

    def scripts(headers):
        known = constants(headers)
        out = {}
        for case in cases:
            title, body = case.split("\n", 1)
            body = faithful(common + body)
            out[title] = re.sub(r"@\{((?:[^{}])*)\}", lambda m: value_of(m[1], known), body)
        return out

    weakened = []
    for kind, text in directives:
        if kind == "weakest":
            name, holds, fails = re.fullmatch(r"(\w+): holds at (\S+), fails at (\S+)", text).groups()
            weakened.append(Weakened(name, exact(holds), None if fails == "none" else exact(fails)))
    return Proof(path.stem, theorem, scripts, weakened, constants)


def exact(text):
    """A decimal, or 2^-44."""
    found = re.fullmatch(r"2\^(-?\d+)", text)
    return Fraction(2) ** int(found[1]) if found else Fraction(text)


def failures(proof, headers):
    """The cases that Gappa does not prove, each with its message, one by one."""
    for case, script in proof.scripts(headers).items():
        outcome = gappa(script)
        if not outcome.ok:
            yield case, outcome.said


def failed(proof, headers):
    """All failing cases; an empty list is a proof."""
    return list(failures(proof, headers))


def contradictions(proof, headers):
    """The cases whose facts Gappa can conclude anything from: they would prove nothing."""
    for case, script in proof.scripts(headers).items():
        start = script.index("->", script.index("{ "))
        if gappa(script[:start] + "-> 0 in [1,1] " + script[script.index("}", start):]).ok:
            yield case


def holds_with(proof, name, value, headers=Headers):
    """Whether the theorem is proven with another value of the constant. A wrong literal is a proof's failure, too."""
    return next(failures(proof, headers({name: value})), None) is None
