"""two_sum and two_product in small floats, by exhaustion: every pair of operands, every choice that a device may make at
each operation. The statements of sums.g and product.g, by hand for 24 bits, must hold here, for as
many bits as these have.

A float here has `bits` significant bits; numbers are integers, in units far below the operands' last bits. `least` is the
smallest normal number: a result under it may be 0, too.
"""

from itertools import product


def choices(x, bits, least=0):
    """A device's possible results for the exact result x: x if it is a float, otherwise either neighbour;
    or 0."""
    size = abs(x)
    shift = max(size.bit_length() - bits, 0)
    low = size >> shift << shift
    out = [low] if low == size else [low, low + (1 << shift)]
    out = [v if x > 0 else -v for v in out]
    return [*out, 0] if 0 < size < least else out


def sums(a, b, bits, least=0):
    """Every (s, e, exact) of two_sum; `exact`: from_a and one of the last three roundings are."""
    for s in choices(a + b, bits, least):
        for from_b in choices(s - a, bits, least):
            for from_a in choices(s - from_b, bits, least):
                for x, y in product(choices(a - from_a, bits, least), choices(b - from_b, bits, least)):
                    for e in choices(x + y, bits, least):
                        roundings = (x != a - from_a) + (y != b - from_b) + (e != x + y)
                        yield s, e, from_a == s - from_b and roundings <= 1


def two_sum_fails(bits):
    """A pair for which the theorem of sums.g is false, or None. kUlp2 / 8 is half of the square of kUlp."""
    unit = 1 << 2 * bits + 8
    significands = range(1 << bits - 1, 1 << bits)
    for i, j, shift, sign in product(significands, significands, range(-bits - 4, bits + 5), (1, -1)):
        a, b = i * unit, sign * j * (unit << shift if shift >= 0 else unit >> -shift)
        for s, e, exact in sums(a, b, bits):
            if not exact or 2 * abs(s + e - a - b) << 2 * (bits - 1) > abs(a) + abs(b):
                return i, sign * j, shift
    return None


def flushed_sum_fails(bits):
    """The same for operands a few bits above the smallest normal number: six flushes more."""
    unit = 1 << bits + 2
    least = unit << bits - 1
    significands = range(1 << bits - 1, 1 << bits)
    for i, j, p, q, sign in product(significands, significands, range(bits + 2), range(bits + 2), (1, -1)):
        a, b = i * unit << p, sign * j * unit << q
        for s, e, _ in sums(a, b, bits, least):
            if 2 * (abs(s + e - a - b) - 6 * least) << 2 * (bits - 1) > abs(a) + abs(b):
                return i, sign * j, p, q
    return None


def upper_half(a, bits, rounding):
    half = bits // 2
    return (a + (rounding << half - 1)) >> half << half


def two_product_fails(bits, rounding):
    """A pair whose product is not exact; `bits` is even. `rounding` 0: halves are cut off."""
    significands = range(1 << bits - 1, 1 << bits)
    for a, b in product(significands, significands):
        ah, bh = upper_half(a, bits, rounding), upper_half(b, bits, rounding)
        for p in choices(a * b, bits):
            steps = [a - ah, b - bh, ah * bh, ah * (b - bh), (a - ah) * bh, (a - ah) * (b - bh), ah * bh - p]
            steps.append(steps[-1] + ah * (b - bh))
            steps.append(steps[-1] + (a - ah) * bh)
            steps.append(a * b - p)
            if any(choices(x, bits) != [x] for x in steps):
                return a, b
    return None


def failures():
    """Each lemma that does not hold, with the operands."""
    checks = [(f"two_sum, {bits} bits", two_sum_fails(bits)) for bits in (3, 4, 5, 6)]
    checks += [(f"two_sum, flushed, {bits} bits", flushed_sum_fails(bits)) for bits in (3, 4)]
    checks += [(f"two_product, {bits} bits, rounding {r}", two_product_fails(bits, r)) for bits in (4, 6, 8) for r in (0, 1)]
    return [f"{name}: {found}" for name, found in checks if found]


if __name__ == "__main__":
    print("\n".join(failures()) or "all hold")
