#!/usr/bin/env python3
"""Holds a batch's results of vkh_moved's pairs against the results of the pairs that were moved.

  check_moved.py RESULTS.jsonl MOVES.csv BASE_RESULTS.jsonl

Each interval, divided by its power of two, must meet that of its base: both enclose the same number. Exit code 1 where
one does not, or a pair has no interval. Exact: doubles are compared as fractions.
"""

import csv
import json
import sys
from fractions import Fraction


def intervals(path):
    found, without = {}, []
    with open(path) as lines:
        for line in lines:
            result = json.loads(line)
            if "interval" not in result:
                without.append(result["id"])
                continue
            ends = (result["interval"][key] for key in ("lower_hex", "upper_hex"))
            found[result["id"]] = [Fraction(float.fromhex(end)) if end != "inf" else None for end in ends]
    return found, without


def main():
    results, without = intervals(sys.argv[1])
    bases, _ = intervals(sys.argv[3])
    wrong, checked = [], 0
    with open(sys.argv[2]) as moves:
        for row in csv.DictReader(moves):
            if row["id"] not in results:
                continue
            factor = Fraction(2) ** int(row["exponent"])
            lower, upper = results[row["id"]]
            base_lower, base_upper = (end * factor for end in bases[row["base"]])
            checked += 1
            if lower > base_upper or upper is None or upper < base_lower:
                wrong.append(row["id"])
    print(f"{checked} checked, {len(wrong)} do not meet their base's interval, {len(without)} without an interval")
    for name in (wrong + without)[:10]:
        print(f"  {name}")
    return 1 if wrong or without or not checked else 0


if __name__ == "__main__":
    sys.exit(main())
