#!/usr/bin/env python3
"""The man page and the shells' completions know the options that --help has, and no others.

usage: completion_test.py PROGRAM SOURCE
"""

import pathlib
import re
import shutil
import subprocess
import sys
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
COMMANDS = ("distance", "gate", "batch", "merge", "demo", "doctor")
OPTION = r"--[a-z]+(?:-[a-z]+)*"


def helped(command):
    text = subprocess.run([PROGRAM, command, "--help"], capture_output=True, text=True, timeout=60, check=True).stdout
    return set(re.findall(rf"^ +(?:-\w,)?({OPTION})", text, re.MULTILINE))


def completed(command):
    """Bash's completions behind `vkhausdorff COMMAND --`."""
    script = f"""source '{SOURCE}/tools/completion/vkhausdorff.bash'
        COMP_WORDS=(vkhausdorff {command} --) COMP_CWORD=2
        _vkhausdorff; printf '%s\\n' "${{COMPREPLY[@]}}" """
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=60, check=True)
    return set(done.stdout.split())


class Options(unittest.TestCase):
    def test_bash_completes_them(self):
        for command in COMMANDS:
            with self.subTest(command):
                self.assertEqual(completed(command), helped(command))

    def test_zsh_knows_them(self):
        text = (SOURCE / "tools/completion/_vkhausdorff").read_text()
        self.assertEqual(set(re.findall(rf"'({OPTION})(?:=-)?\[", text)), set.union(*map(helped, COMMANDS)))
        if shutil.which("zsh"):
            subprocess.run(["zsh", "-n", SOURCE / "tools/completion/_vkhausdorff"], check=True, timeout=60)

    def test_the_man_page_has_them(self):
        text = (SOURCE / "docs/man/vkhausdorff.1").read_text().replace("\\-", "-")
        said = set(re.findall(rf"^\.B[IR]? .*?({OPTION})", text.split(".SH OPTIONS")[1].split(".SH EXIT")[0], re.MULTILINE))
        self.assertEqual(said, set.union(*map(helped, COMMANDS)) | {"--version"})
        version = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, timeout=60).stdout.strip()
        self.assertIn(f'"{version}"', text)
        if shutil.which("groff"):
            done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", SOURCE / "docs/man/vkhausdorff.1"], capture_output=True, text=True, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
