#!/usr/bin/env python3
"""The error constants of shaders/math, proven by Gappa from the headers' own text.

  proofs_test.py            every theorem holds with the constants of the headers, and with the weakest of its own; it does
                            not with one that is weaker, nor with another formula. 77 where there is no gappa
  proofs_test.py --table    the table of docs/proofs.md
  proofs_test.py NAME...    these proofs alone, each case that fails with Gappa's message

docs/proofs.md lists the proofs and their tools.
"""

import os
import shutil
import sys
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import counterexamples
import linear_proofs
import rounding_lemmas
from headers import ROOT, Changed, Headers
from proof import contradictions, failed, failures, holds_with, template

TEMPLATES = sorted(Path(__file__).parent.glob("*.g"))
PROOFS = [*linear_proofs.PROOFS, *map(template, TEMPLATES)]
PAGE = ROOT / "docs" / "proofs.md"
WORKERS = os.cpu_count() or 1

# Changes to a formula that a proof must not survive: header, text, replacement, the proof.
CHANGES = [
    ("two_float.h", "d.lo + (a.lo - b.lo)", "d.lo + a.lo", "difference"),
    ("two_float.h", "(p.lo + q.lo)", "p.lo", "combination"),
    ("two_float.h", "((base.lo + s.lo) + t.lo)", "(base.lo + s.lo)", "combination"),
    ("two_float.h", "(t.lo + (dot3(a.hi, b.lo)", "((dot3(a.hi, b.lo)", "dot"),
    ("two_float.h", " + al * bl", "", "product"),
    ("two_float.h", "(a - from_a) + (b - from_b)", "(b - from_b)", "sums"),
    ("certified.h", "- square.lo) + x.lo;", "- square.lo);", "sharp"),
    ("certified.h", " - q * extra", "", "quotient_above"),
    ("certified.h", "next_down(next_down(q + remainder / b))", "next_down(q + remainder / b)", "quotient"),
    ("certified.h", "round_up(root(dot3(v, v)), 8.0f)", "root(dot3(v, v))", "norms"),
    ("triangle.h", "both(w >= 0.0f, v + w <= 1.0f - 4.0f * kUlp)", "v + w <= 1.0f - 4.0f * kUlp", "closest"),
    ("triangle.h", "norm_up(rounded(offset)) + s.slack", "norm_up(rounded(offset))", "distance_up"),
    ("lower.h", "s.slack * norm_up(r.hi)", "s.slack", "lower"),
    ("bounds.h", "d.x + max(ab, ca)", "d.x + ab", "bounds"),
    ("bary.h", "norm_up(r.origin.hi) + norm_up(r.ab.hi) + norm_up(r.ac.hi)", "norm_up(r.origin.hi)", "slack"),
]


def side_by_side(f, *columns):
    with ThreadPoolExecutor(WORKERS) as pool:
        return list(pool.map(f, *columns))


def broken(proof, headers):
    try:
        return failed(proof, headers)
    except Changed as change:
        return [("the header", str(change))]


class Proofs(unittest.TestCase):
    def test_the_headers_constants(self):
        for proof, cases in zip(PROOFS, side_by_side(lambda p: broken(p, Headers()), PROOFS)):
            self.assertEqual(cases, [], proof.name)

    def test_facts_contradict_nothing(self):
        for proof, cases in zip(PROOFS, side_by_side(lambda p: list(contradictions(p, Headers())), PROOFS)):
            self.assertEqual(cases, [], proof.name)

    def test_weaker_constants(self):
        steps = [(proof, w) for proof in PROOFS for w in proof.weakened]
        for (proof, w), holds in zip(steps, side_by_side(lambda s: holds_with(s[0], s[1].name, s[1].holds), steps)):
            self.assertTrue(holds, f"{proof.name} with {w.name} = {w.holds}")
        steps = [(proof, w) for proof, w in steps if w.fails is not None]
        for (proof, w), holds in zip(steps, side_by_side(lambda s: holds_with(s[0], s[1].name, s[1].fails), steps)):
            self.assertFalse(holds, f"{proof.name} with {w.name} = {w.fails} should not hold")

    def test_the_headers_are_no_weaker(self):
        for proof in PROOFS:
            known = proof.constants(Headers())
            for w in proof.weakened:
                if w.name in known:
                    self.assertGreaterEqual(known[w.name], w.holds, f"{proof.name}: {w.name}")

    def test_other_formulas(self):
        texts = Headers().raw
        by_name = {proof.name: proof for proof in PROOFS}

        def survives(change):
            header, old, new, name = change
            self.assertIn(old, texts[header])
            other = Headers(texts={**texts, header: texts[header].replace(old, new)})
            try:
                return next(failures(by_name[name], other), None) is None
            except Changed:
                return False

        for change, alive in zip(CHANGES, side_by_side(survives, CHANGES)):
            self.assertFalse(alive, change)

    def test_rounding_in_small_floats(self):
        self.assertEqual(rounding_lemmas.failures(), [])

    def test_counterexamples(self):
        self.assertEqual(counterexamples.failures(), [])

    def test_the_page(self):
        page = PAGE.read_text()
        for line in table():
            self.assertIn(line, page, "docs/proofs.md is out of date: tests/verification/proofs/proofs_test.py --table")


def shortly(x):
    power = x.denominator.bit_length() - 1
    if x.numerator == 1 and power > 9:
        return f"2^-{power}"
    return f"{float(x):.4g}"


def table():
    """A line for each constant that a proof weakens."""
    headers = Headers()
    yield "| theorem | constant | there | proven with | not with |"
    yield "|---|---|---|---|---|"
    for proof in PROOFS:
        known = proof.constants(headers)
        head = f"{proof.theorem} (`{proof.name}`)"
        for w in proof.weakened or [None]:
            if w is None:
                yield f"| {head} | - | - | - | - |"
                continue
            there = shortly(known[w.name]) if w.name in known else "-"
            yield f"| {head} | `{w.name}` | {there} | {shortly(w.holds)} | {'-' if w.fails is None else shortly(w.fails)} |"
            head = ""


def main():
    if sys.argv[1:] == ["--table"]:
        print("\n".join(table()))
        return 0
    if not shutil.which("gappa"):
        print("no gappa here (Debian and Ubuntu: apt-get install gappa): the constants' proofs are not checked")
        return 77
    if sys.argv[1:]:
        wrong = [(p.name, case) for p in PROOFS if p.name in sys.argv[1:] for case in broken(p, Headers())]
        print("\n".join(f"{name}, {case}: {said}" for name, (case, said) in wrong) or "proven")
        return 1 if wrong else 0
    return 0 if unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
