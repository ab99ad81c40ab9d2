#!/usr/bin/env python3
"""The theorems of proofs_test.py once more, by Coq's kernel: Gappa writes each proof as a Coq term, and coqc checks it.

  coq_test.py            every case of every proof. 77 where gappa, coqc or libcoq-gappa is missing
  coq_test.py NAME...    these proofs alone

Gappa takes the identities of its hints as given; here coqc proves them, too. docs/proofs.md says what no term covers.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from headers import Headers
from proofs_test import PROOFS

FACTS = Path(__file__).parent / "gappa_facts.v"
TIME_LIMIT = 900  # seconds; a second or two, where nothing else runs
# The axioms of Coq's real numbers, and excluded middle, which libcoq-gappa and Flocq use.
AXIOMS = {"ClassicalDedekindReals.sig_forall_dec", "ClassicalDedekindReals.sig_not_dec", "Classical_Prop.classic",
          "FunctionalExtensionality.functional_extensionality_dep"}
# Theorems of Gappa that libcoq-gappa 1.5 lacks, and those of gappa_facts.v in their place.
MISSING = {"UNKNOWN_float_absolute_wide_up": "absolute_wide rounded_up upper",
           "UNKNOWN_float_absolute_wide_dn": "absolute_wide rounded_down lower"}


def term(script):
    """Gappa's proof of a script as a Coq file that takes nothing as given."""
    done = subprocess.run(["gappa", "-Wno-null-denominator", "-Wno-unbound-variable", "-Bcoq"], input=script,
                          capture_output=True, text=True, timeout=TIME_LIMIT)
    if done.returncode:
        return None
    text = done.stdout.replace("Require Import Gappa.Gappa_library.", "Require Import gappa_facts Gappa.Gappa_library.", 1)
    text = re.sub(r"^Hypothesis (\w+) : (.*)\.$", r"Lemma \1 : \2.\nProof. identity. Qed.", text, flags=re.M)
    for name, instead in MISSING.items():
        text = re.sub(rf"refine \({name}\) ; finalize\.", f"{instead}.", text)
    return text + "Print Assumptions l1.\n"


class Coq:
    """A folder in which coqc finds gappa_facts."""

    def __init__(self, folder):
        self.folder = folder
        shutil.copy(FACTS, folder)

    def check(self, name):
        return subprocess.run(["coqc", f"{name}.v"], cwd=self.folder, capture_output=True, text=True, timeout=TIME_LIMIT)

    def failure(self, script):
        """An empty text if coqc accepts the proof and it rests on AXIOMS alone."""
        text = term(script)
        if text is None:
            return "Gappa does not prove it"
        given = re.search(r"^\s*(Hypothesis|Axiom|Parameter|Conjecture|Admitted)\b.*", text, re.M)
        if given:
            return f"it takes as given: {given[0]}"
        (Path(self.folder) / "case.v").write_text(text)
        done = self.check("case")
        if done.returncode:
            return done.stderr.strip()[-500:] or "coqc failed"
        if "Closed under the global context" in done.stdout:
            return ""
        used = set(re.findall(r"^([\w.]+)\s*:", done.stdout, re.M)) - {"Axioms"}
        return "" if used and used <= AXIOMS else f"it rests on {sorted(used - AXIOMS) or done.stdout}"


class Terms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.coq = Coq(cls.temporary.name)
        done = cls.coq.check("gappa_facts")
        if done.returncode:
            raise RuntimeError(f"gappa_facts.v: {done.stderr}")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_every_case(self):
        names, start, count = os.environ.get("VKH_PROOFS", "").split(), time.monotonic(), 0
        for proof in PROOFS:
            if names and proof.name not in names:
                continue
            for case, script in proof.scripts(Headers()).items():
                count += 1
                with self.subTest(proof=proof.name, case=case):
                    self.assertEqual(self.coq.failure(script), "")
        self.assertGreater(count, 0)
        print(f"{count} cases in {time.monotonic() - start:.0f} s")

    def test_a_false_identity(self):
        self.assertNotEqual(self.coq.failure("{ X in [0,1] -> X + 1 in [0,1] }\nX + 1 -> X;"), "")

    def test_an_identity_that_needs_a_condition(self):
        """Without 1 + X <> 0 the hint is no identity of Coq's numbers, whose 1 / 0 may be anything."""
        hint = "{{ X in [0,1] -> X / (1 + X) - 1 in [-2,2] }}\nX / (1 + X) - 1 -> -1 / (1 + X){};"
        self.assertNotEqual(self.coq.failure(hint.format("")), "")
        self.assertEqual(self.coq.failure(hint.format(" { 1 + X <> 0 }")), "")


def missing():
    for tool, package in (("gappa", "gappa"), ("coqc", "coq")):
        if not shutil.which(tool):
            return f"no {tool} here (Debian and Ubuntu: apt-get install {package})"
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "library.v").write_text("Require Gappa.Gappa_library.\n")
        found = subprocess.run(["coqc", "library.v"], cwd=folder, capture_output=True).returncode == 0
    return "" if found else "no Coq library of Gappa here (Debian and Ubuntu: apt-get install libcoq-gappa)"


def main():
    lacking = missing()
    if lacking:
        print(f"{lacking}: Gappa's proofs are not checked by Coq")
        return 77
    os.environ["VKH_PROOFS"] = " ".join(sys.argv[1:])
    return 0 if unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
