"""The Python module in odd floating-point environments: the same answers, and the environment as it was."""

import ctypes
import platform
import sys

import numpy as np
import vkhausdorff as vkh

# FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO
MODES = {"x86_64": (0x800, 0x400, 0xC00), "aarch64": (0x400000, 0x800000, 0xC00000)}
libm = ctypes.CDLL("libm.so.6")


def answers(pairs, heard):
    """The results for each, both ways; `heard`: the rounding modes that the callback saw."""
    found = []
    for va, fa, vb, fb in pairs:
        for symmetric in (False, True):
            r = vkh.distance(va, fa, vb, fb, symmetric=symmetric, progress=lambda *_: heard.append(libm.fegetround()))
            found.append((r.lower.hex(), r.upper.hex(), r.status, repr(r), r.stats["gap"].hex()))
        r = vkh.distance(va, fa, vb, fb, field="1%", bands=("0.1abs", 0.1), survey_time=None,
                         progress=lambda *_: heard.append(libm.fegetround()))
        found.append((r.lower.hex(), r.upper.hex(), repr(r.survey), r.field.lower.tobytes(), r.field.upper.tobytes(),
                      r.survey.bands and tuple(r.survey.bands.values())))
    return found


def made_pairs():
    """Subnormal float64, subnormal float32, and faces of any place (more of them: tests/unit/float_environment_test.cpp)."""
    one = np.array([[0, 1, 2]])
    tiny = np.array([[0, 0, 0], [1e-310, 0, 0], [0, 1e-310, 0]])
    small = np.array([[0, 0, 0], [1e-40, 0, 0], [0, 1e-40, 0]], dtype=np.float32)
    random = np.random.default_rng(15)
    soups = [random.uniform(-1, 1, (3 * n, 3)) for n in (12, 10)]
    return [(tiny, one, tiny + [0, 0, 2.5e-311], one), (small, one, small.astype(np.float64) + [0, 0, 2.5e-41], one),
            (soups[0], np.arange(36).reshape(-1, 3), soups[1], np.arange(30).reshape(-1, 3))]


def main() -> int:
    modes = MODES.get(platform.machine())
    if modes is None:
        return 77
    pairs = made_pairs()
    normal = answers(pairs, [])
    assert all(float.fromhex(upper) > 0 for _, upper, *_ in normal), normal
    for mode in modes:
        heard = []
        libm.fesetround(mode)
        try:
            found = answers(pairs, heard)
            after = libm.fegetround()
        finally:
            libm.fesetround(0)
        assert after == mode, (after, mode)
        assert heard and set(heard) == {mode}, heard
        assert found == normal, (found, normal)
    print("python_environment_test: passed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
