"""docs/proven-check.md quotes the theorem as it is proven.

usage: proven_page_test.py
"""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]


class Page(unittest.TestCase):
    def test_quotations(self):
        page = (ROOT / "docs" / "proven-check.md").read_text()
        proofs = "\n".join(path.read_text() for path in sorted((ROOT / "check" / "proofs").glob("*.v")))
        flat = " ".join(proofs.split())
        quoted = [text for block in re.findall(r"^```coq\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
                  for text in re.split(r"(?<=\.)\n", block) if text.strip()]
        self.assertGreaterEqual(len(quoted), 8)
        for text in quoted:
            self.assertIn(" ".join(text.split()), flat)


if __name__ == "__main__":
    unittest.main()
