"""Terms that are needed: without each, here are inputs and roundings that the table of docs/certificate.md allows, for
which the bound is false; and with it, for the same, it is true. Exact arithmetic, in fractions.
"""

import math
from fractions import Fraction

from headers import ROOT, Headers

LEAST = Fraction(1, 2**126)


def ulp_of(x):
    """The step between floats at x."""
    return Fraction(2) ** (max(exponent_of(x), -126) - 23)


def exponent_of(x):
    x = abs(Fraction(x))
    e = x.numerator.bit_length() - x.denominator.bit_length()
    return e if x >= Fraction(2) ** e else e - 1


class Device:
    """A device that rounds in one direction (0: to nearest) and flushes or not. Quotients are off by `division` ulp."""

    def __init__(self, direction=0, flush=False, division=0):
        self.direction, self.flush, self.division = direction, flush, Fraction(division)

    def rounded(self, x):
        x = Fraction(x)
        if x == 0:
            return x
        step = ulp_of(x)
        steps = x / step
        count = {0: round(steps), 1: math.ceil(steps), -1: math.floor(steps)}[self.direction]
        return Fraction(0) if self.flush and abs(count * step) < LEAST else count * step

    def add(self, a, b):
        return self.rounded(a + b)

    def multiply(self, a, b):
        return self.rounded(a * b)

    def divide(self, a, b):
        """The farthest float upwards that is allowed."""
        x = a / b
        y = x + self.division * ulp_of(x)
        return math.floor(y / ulp_of(x)) * ulp_of(x)

    def two_product(self, a, b):
        half = lambda x: int(x / (ulp_of(x) * 2**12)) * ulp_of(x) * 2**12  # noqa: E731
        ah, bh = half(a), half(b)
        al, bl = self.add(a, -ah), self.add(b, -bh)
        p = self.multiply(a, b)
        e = self.add(self.multiply(ah, bh), -p)
        e = self.add(e, self.multiply(ah, bl))
        e = self.add(e, self.multiply(al, bh))
        return p, self.add(e, self.multiply(al, bl))

    def two_difference(self, a, b):
        s = self.add(a[0], -b[0])
        from_b = self.add(s, -a[0])
        from_a = self.add(s, -from_b)
        e = self.add(self.add(a[0], -from_a), self.add(-b[0], -from_b))
        return s, self.add(e, self.add(a[1], -b[1]))


def constants():
    return Headers().constants


def quotient_down_claims(k_tiny):
    """3 2^-110 over 2^-50 and a little: the remainder is flushed, so that the quotient's own 2.5 ulp stand."""
    Headers().quote("certified.h", "return max(next_down(next_down(q + remainder / b)) - kTiny, 0.0f);")
    device = Device(flush=True, division=2.5)
    a, b = Fraction(3, 2**110), Fraction(1, 2**50) * (1 + Fraction(5, 2**23))
    q = device.divide(a, b)
    hi, lo = device.two_product(q, b)
    remainder = device.add(device.add(a, -hi), -lo)
    assert q > constants()["kTiny"] and abs(q - a / b) <= Fraction(5, 2) * ulp_of(a / b)
    got = device.add(q, remainder / b) - 2 * ulp_of(q)
    return max(got - k_tiny, Fraction(0)) <= a / b


def norm_above_claims(k_tiny):
    """A vector (x, 0, 0) of 1e-15, the base its root, an ulp short: the low part of x^2 is flushed."""
    Headers().quote("certified.h", "VKH_FN float raised(float x) { return x + (4.0f * kUlp * abs(x) + kTiny); }")
    device = Device(flush=True)
    for i in range(10000):
        x = Fraction(9444800 + i) * ulp_of(Fraction(1, 2**50))
        hi, lo = device.two_product(x, x)
        if lo != 0 or hi <= Fraction("1e-30") or hi >= x * x:
            continue
        s = x - ulp_of(x)  # within the 4.5 ulp of a root
        back_hi, back_lo = device.two_product(s, s)
        e = device.add(device.add(hi, -back_hi), -back_lo)
        base = s
        more = device.multiply(constants()["kUlp2"], device.add(device.multiply(20, s), base))
        got = device.add(device.rounded(e / s) / 2, more)  # s - base is 0
        raised = got + (4 * constants()["kUlp"] * abs(got) + k_tiny)
        if raised < x - base:
            return False
    return True


def coarse_claims(with_slack):
    """A point of B next to the point, so near that the difference of their low parts is rounded by more than the other
    terms of coarse_distance_down take; the direction is 1 long."""
    Headers().quote("lower.h", "float off = round_up(4.25f * kUlp * radius_up(s.at) * norm_up(r) + s.slack * norm_up(r), 8.0f);")
    device, c = Device(1), constants()
    a = (1 + Fraction(1, 2**23), -Fraction(1, 2**24) + Fraction(3, 2**34))
    origin = (Fraction(1), Fraction(1, 2**24) - Fraction(2**23 + 1, 2**71))
    high, low = device.two_difference(a, origin)
    got, exact = device.add(high, low), sum(a) - sum(origin)
    up = lambda x, n: x * (1 + (n + 2) * c["kUlp"]) + c["kTiny"]  # noqa: E731
    radius, length = up(got, 14), up(Fraction(1), 14)  # norm_up, as much too large as it may be
    slack = up(c["kUlp2"] * (8 + 28 * radius), 6) if with_slack else 0
    off = up(Fraction("4.25") * c["kUlp"] * radius * length + slack * length, 10)
    reach = got * (1 - 4 * c["kUlp"]) - c["kTiny"] - off
    bound = reach / length * (1 - 8 * c["kUlp"]) - 2 * c["kTiny"]  # the quotient and lowered, generously
    return bound <= exact


def displacement_claims(more):
    """Displacements of 1 and 2^-60 along two axes: their sum in double is 1, their length is more."""
    assert "plan.displacement *= 1 + 0x1p-50;" in (ROOT / "host/mesh/frame.cpp").read_text()
    x, y = 1.0, 2.0**-60
    worst = Fraction(x + y) * (1 + more)
    return worst * worst >= Fraction(x) ** 2 + Fraction(y) ** 2


# Each entry: the claim with the term in place, and without it.
NEEDED = {
    "quotient_down's kTiny": (lambda: quotient_down_claims(constants()["kTiny"]), lambda: quotient_down_claims(0)),
    "raised's kTiny": (lambda: norm_above_claims(constants()["kTiny"]), lambda: norm_above_claims(0)),
    "coarse_distance_down's slack": (lambda: coarse_claims(True), lambda: coarse_claims(False)),
    "the largest displacement": (lambda: displacement_claims(Fraction(1, 2**50)), lambda: displacement_claims(0)),
}


def failures():
    """Terms that are not shown to be needed, or that do not help."""
    return [name for name, (with_it, without) in NEEDED.items() if not with_it() or without()]


if __name__ == "__main__":
    for name, (with_it, without) in NEEDED.items():
        print(f"{name}: holds with it {with_it()}, without {without()}")
