#!/usr/bin/env python3
"""A keyword means what its option does on the command line: both have the same line in a pair's key.

usage: python_options_test.py PRINT_OPTIONS
"""

import json
import subprocess
import sys
import unittest

from vkhausdorff import _core

PRINT_OPTIONS = sys.argv[1]
# Each kind has values in pairs: as Python takes them, and as they are typed.
SAMPLES = {"flag": [(True, None)], "length": [("0.1%", "0.1%"), ("0.2abs", "0.2abs")], "tolerance": [("0.1%", "0.1%"), ("1e-4", "1e-4")],
           "lengths": [(["0.1%", "0.3abs"], "0.1%,0.3abs"), (("0.2abs",), "0.2abs")], "percentile": [(90, "90"), ("0.5%", "0.5%")],
           "angle": [(10, "10deg"), (20.5, "20.5")], "size": [(2000, "2000"), ("1MiB", "1MiB")], "time": [(1, "1s"), (0.25, "250ms")],
           "count": [(3, "3"), (7, "7")]}


def run(*words, given=""):
    done = subprocess.run([PRINT_OPTIONS, *words], input=given, stdout=subprocess.PIPE, text=True, check=True, timeout=100)
    return json.loads(done.stdout)


def samples_of(option):
    if option["kind"] in ("choice", "unit"):
        return [(choice, choice) for choice in option["choices"]]
    if option["kind"] == "names":
        return [(option["choices"][:1], option["choices"][0]), (option["choices"][-2:], ",".join(option["choices"][-2:]))]
    return SAMPLES[option["kind"]]


def line_of(option, key):
    return [line for line in key.splitlines() if line.split(" ")[0] == option["name"]]


def typed(options):
    """The lines of each option's samples on a command line, by option and text; one process tells them all."""
    samples = [(option, text) for option in options for _, text in samples_of(option)]
    words = [["batch", "list.csv", "--out", "out.jsonl", f"--{option['name']}", *([] if text is None else [text])] for option, text in samples]
    keys = run("--keys", given=json.dumps(words))
    return {(option["name"], text): line_of(option, key) for (option, text), key in zip(samples, keys, strict=True)}


class Keywords(unittest.TestCase):
    def test_a_keyword_means_what_its_option_does(self):
        table, compared = run(), 0
        # The matrix of a file is in Python's key, and its name in that of a command line: batch reads it with the pair.
        # A device has no line.
        options = [one for one in table["options"] if any("batch" in use["of"] for use in one["uses"]) and one["bits"]
                   and one["name"] not in ("transform", "device")]
        beside = {"scale": {"transform": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}, "figures": {"bands": ["1%"], "normals": 5}}
        lines = typed(options)
        for option in options:
            for function, bit in option["bits"].items():
                found = set()
                for value, text in samples_of(option):
                    with self.subTest(option=option["name"], function=function, value=value):
                        keywords = {**beside.get(option["name"], {}), option["keyword"]: value}
                        line = line_of(option, _core._key(bit, **keywords))
                        self.assertEqual(line, lines[option["name"], text])
                        found.add(tuple(line))
                        compared += 1
                self.assertEqual(len(found), 1 if option["unlike"] else len(samples_of(option)), (option["name"], function))
        self.assertGreater(compared, 100)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
