"""Error analysis of functions of the headers that are linear in their inputs: the sums and products
of two_float.h and their compositions. Their statements are read out of the headers and written as a
script for Gappa.

Take one run, on any device. Each rounded operation gives its exact result times 1 + t, abs(t) <= kUlp, and adds a flush.
For these t and flushes the result is linear in the inputs. So its error is a sum over the inputs, each times a factor,
and the factor of an input is the error of the same run where that input is 1 and all others are 0. The script has a copy
of the operations for each such *unit*, and bounds the factors. The effect of flushes is the unit
"flush": all inputs 0. Vectors are taken by their components: for abs(e_i) <= sum c_k abs(x_k,i)
Minkowski gives abs(e) <= sum c_k abs(x_k).
"""

import ast
from dataclasses import dataclass, field
from fractions import Fraction

from headers import parsed

ULP = Fraction(1, 2**23)
FLUSH = Fraction(1, 2**126)
# two_sum's and two_product's own errors, from sums.g and product.g: of the operands, and by flushes.
TWO_SUM = ULP * ULP / 2
TWO_SUM_FLUSH = 6 * FLUSH
TWO_PRODUCT_FLUSH = 64 * FLUSH
# A low part is at most this fraction of both parts: it is an ulp of the high part at most.
LOW = ULP * (1 + 2 * ULP)


def number(x):
    """A dyadic literal: exactly x where it is one, else the next one towards 0 (a tighter bound)."""
    x = Fraction(x)
    bits = min(x.denominator.bit_length() - 1, 200)
    if x.denominator != 1 << bits:
        return f"{int(x * 2**200)}b-200"
    return f"{x.numerator}b-{bits}" if bits else str(x.numerator)


def both_sides(x):
    return f"[{number(-x)}, {number(x)}]"


# A polynomial in the weights: {sorted names: coefficient}.
def plus(p, q):
    out = dict(p)
    for name, c in q.items():
        out[name] = out.get(name, 0) + c
    return {name: c for name, c in out.items() if c}


def times(p, q):
    out = {}
    for m, c in p.items():
        for n, d in q.items():
            out = plus(out, {tuple(sorted(m + n)): c * d})
    return out


def poly_text(p):
    return "(" + (" + ".join("*".join([f"({number(c)})", *m]) for m, c in p.items()) or "0") + ")"


@dataclass
class Value:
    """A computed number: its name in the script, its exact value, and its error as a sum of atoms."""
    text: str
    ideal: str
    error: dict = field(default_factory=dict)
    weight: dict = None  # of a weight or constant: the polynomial that it is, exactly

    def __neg__(self):
        if self.weight == {}:
            return self
        return Value(f"(-{self.text})", f"(-{self.ideal})", {a: times(p, {(): Fraction(-1)}) for a, p in self.error.items()},
                     None if self.weight is None else times(self.weight, {(): Fraction(-1)}))


@dataclass
class Pair:
    hi: Value
    lo: Value


def weight(name):
    return Value(name, name, {}, {(name,): Fraction(1)})


def constant(x):
    x = Fraction(x)
    return Value(number(x), number(x), {}, {(): x} if x else {})


def exact_input(text):
    return Value(text, text)


class Unit:
    """One copy of the operations."""

    def __init__(self, name, headers, flush=False):
        self.name, self.headers, self.flush = name, headers, flush
        self.count = 0
        self.lines, self.given, self.atoms = [], [], {}

    def fresh(self, kind):
        self.count += 1
        return f"{kind}{self.count}_{self.name}"

    def free(self, kind, size):
        name = self.fresh(kind)
        self.given.append(f"{name} in {both_sides(size)}")
        return name

    def atom(self, text):
        name = self.fresh("d")
        self.lines.append(f"{name} = {text};")
        return name

    def rounded(self, exact, ideal, error, flush=FLUSH):
        """A rounded operation: a variable next to its exact result, and the difference an atom of its error."""
        name, of = self.fresh("v"), self.fresh("e")
        self.lines.append(f"{of} = {exact};")
        self.given.append(f"{name} -/ {of} in {both_sides(ULP)}")
        d = self.atom(f"{name} - {of}")
        value, error = Value(name, ideal, plus_errors(error, {d: {(): Fraction(1)}})), d
        if self.flush:
            f = self.free("f", flush)
            value = Value(f"({name} + {f})", ideal, plus_errors(value.error, {f: {(): Fraction(1)}}))
        return value, error

    def add(self, a, b, sign=1):
        if sign < 0:
            b = -b
        return self.rounded(f"{a.text} + {b.text}", f"({a.ideal} + {b.ideal})", plus_errors(a.error, b.error))[0]

    def multiply(self, a, b, is_exact=False):
        if a.weight is None:
            a, b = b, a
        if a.weight is None:
            raise ValueError("a product of two values is not linear")
        if {} in (a.weight, b.weight):
            return constant(0)
        error = {atom: times(p, a.weight) for atom, p in b.error.items()}
        power = list(a.weight) == [()] and abs(a.weight[()].numerator) & (abs(a.weight[()].numerator) - 1) == 0
        text, ideal = f"{a.text} * {b.text}", f"({a.ideal} * {b.ideal})"
        if (is_exact or power) and not self.flush:
            return Value(f"({text})", ideal, error)
        return self.rounded(text, ideal, error)[0]

    def two_sum(self, a, b):
        hi, d = self.rounded(f"{a.text} + {b.text}", f"({a.ideal} + {b.ideal})", plus_errors(a.error, b.error))
        p, q = self.free("n", TWO_SUM), self.free("n", TWO_SUM)
        n = self.atom(f"{p} * {a.text} + {q} * {b.text}")
        minus = {d: {(): Fraction(-1)}, n: {(): Fraction(1)}}
        text = f"({n} - {d})"
        if self.flush:  # hi's own flush is taken back by lo, except for lo's own flush
            f, g = list(hi.error)[-1], self.free("f", TWO_SUM_FLUSH)
            minus = plus_errors(minus, {f: {(): Fraction(-1)}, g: {(): Fraction(1)}})
            text = f"({n} - {d} - {f} + {g})"
        return Pair(hi, Value(text, "0", minus))

    def two_product(self, a, b):
        if a.weight is None:
            a, b = b, a
        if {} in (a.weight, b.weight):
            return Pair(constant(0), constant(0))
        error = {atom: times(p, a.weight) for atom, p in b.error.items()}
        hi, d = self.rounded(f"{a.text} * {b.text}", f"({a.ideal} * {b.ideal})", error)
        minus, text = {d: {(): Fraction(-1)}}, f"(-{d})"
        if self.flush:
            f, g = list(hi.error)[-1], self.free("f", TWO_PRODUCT_FLUSH)
            minus = plus_errors(minus, {f: {(): Fraction(-1)}, g: {(): Fraction(1)}})
            text = f"(-{d} - {f} + {g})"
        return Pair(hi, Value(text, "0", minus))

    # ---- inputs, and the statements to show

    def two(self, x):
        """A pair that is x exactly."""
        if self.flush or x == 0:
            return Pair(constant(0), constant(0))
        m = self.free("m", LOW)
        return Pair(exact_input(f"((1 - {m}) * {number(x)})"), exact_input(f"({m} * {number(x)})"))

    def plain(self, x):
        return constant(0) if self.flush or x == 0 else exact_input(number(x))

    def measure(self, out, ideal):
        """The error of a result, and the hint that Gappa checks and bounds it by."""
        hi, lo = (out.hi, out.lo) if isinstance(out, Pair) else (out, constant(0))
        error = plus_errors(hi.error, lo.error)
        text = f"({hi.text} + {lo.text}) - ({ideal})"
        total = " + ".join(f"{poly_text(p)} * {atom}" for atom, p in error.items()) or "0"
        return f"({text})", f"{text} -> {total};"

    # ---- the headers' statements

    def call(self, name, arguments):
        if name == "two_sum":
            return self.two_sum(*arguments)
        if name == "two_product":
            return self.two_product(*arguments)
        if name == "two":
            return Pair(arguments[0], constant(0))
        if name == "vec3":
            return arguments[0]
        return self.run(name, arguments)

    def run(self, name, arguments, types=None, preset=None, skip=()):
        """The function of the headers, statement by statement; `skip`: statements that `preset` replaces."""
        parameters, statements = self.headers.function(name, types)
        env = dict(zip(parameters, arguments), **(preset or {}))
        for statement in statements:
            if statement in skip or parsed(statement) is None:
                continue
            target, expression = parsed(statement)
            value = self.value(expression, env)
            if target == "return":
                return value
            if "." in target:
                owner, part = target.split(".")
                env[owner] = Pair(**{**env[owner].__dict__, part: value})
            else:
                env[target] = value
        raise ValueError(f"{name} returns nothing")

    def value(self, node, env):
        if isinstance(node, ast.Name):
            return env[node.id] if node.id in env else constant(self.headers.constants[node.id])
        if isinstance(node, ast.Attribute):
            return getattr(self.value(node.value, env), node.attr)
        if isinstance(node, ast.Constant):
            return constant(Fraction(str(node.value)))
        if isinstance(node, ast.UnaryOp):
            return -self.value(node.operand, env)
        if isinstance(node, ast.Call):
            return self.call(node.func.id, [self.value(a, env) for a in node.args])
        a, b = self.value(node.left, env), self.value(node.right, env)
        if isinstance(node.op, ast.Mult):
            return self.multiply(a, b)
        return self.add(a, b, -1 if isinstance(node.op, ast.Sub) else 1)


def script(units, results, given, goals):
    """The units' operations, the facts about weights, the statements to show, and Gappa's decomposition of errors."""
    lines = [line for unit in units for line in unit.lines]
    facts = [fact for unit in units for fact in unit.given] + list(given)
    hints = [hint for _, hint in results]
    return "\n".join([*lines, "{ " + "\n/\\ ".join(facts), "-> " + "\n/\\ ".join(goals) + " }", *hints]) + "\n"


def plus_errors(p, q):
    out = dict(p)
    for atom, poly in q.items():
        out[atom] = plus(out.get(atom, {}), poly)
    return {atom: poly for atom, poly in out.items() if poly}
