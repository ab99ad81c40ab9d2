#!/usr/bin/env python3
"""The man page and the shells' completions know the options that --help-all has, and no others.

usage: completion_test.py PROGRAM SOURCE PRINT_OPTIONS
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

PROGRAM, SOURCE, PRINT_OPTIONS = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
COMMANDS = ("distance", "gate", "metrics", "batch", "merge", "simplify", "demo", "doctor")
OPTION = r"--[a-z]+(?:-[a-z]+)*"


def helped(command):
    text = subprocess.run([PROGRAM, command, "--help-all"], capture_output=True, text=True, timeout=60, check=True).stdout
    return set(re.findall(rf"^ +(?:-\w,)?({OPTION})", text, re.MULTILINE))


def completed(command, *typed):
    """Bash's completions behind `vkhausdorff COMMAND`, and these words or `--`."""
    words = " ".join(f"'{word}'" for word in typed or ("--",))
    script = f"""source '{SOURCE}/tools/completion/vkhausdorff.bash'
        COMP_WORDS=(vkhausdorff {command} {words}) COMP_CWORD={1 + (len(typed) or 1)}
        _vkhausdorff; printf '%s\\n' "${{COMPREPLY[@]}}" """
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=60, check=True)
    return set(done.stdout.split())


class Options(unittest.TestCase):
    def test_what_is_made_from_the_table_is_up_to_date(self):
        done = subprocess.run([sys.executable, "-B", SOURCE / "tools/options/make_pages.py", PRINT_OPTIONS, "--check"],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_help_is_short_and_says_where_the_rest_is(self):
        for command in COMMANDS:
            with self.subTest(command):
                text = subprocess.run([PROGRAM, command, "--help"], capture_output=True, text=True, timeout=60, check=True).stdout
                few = set(re.findall(rf"^ +(?:-\w,)?({OPTION})", text, re.MULTILINE)) - {"--help", "--help-all"}
                every = helped(command) - {"--help", "--help-all"}
                self.assertLessEqual(few, every)
                self.assertLessEqual(len(few), 10)
                more = re.findall(r"^--help-all shows (\d+) more options\.$", text, re.MULTILINE)
                self.assertEqual(list(map(int, more)), [len(every) - len(few)] if few != every else [])
                self.assertIn("\nExit codes: 0 ", text)
                self.assertNotIn("\n\n\n", text)

    def test_all_options_stand_in_groups(self):
        for command in ("distance", "gate", "metrics", "batch", "simplify", "demo"):
            with self.subTest(command):
                text = subprocess.run([PROGRAM, command, "--help-all"], capture_output=True, text=True, timeout=60, check=True).stdout
                first, *groups = re.split(r"^(?:Options|What .*|How .*):$", text.split("Exit codes:")[0], flags=re.MULTILINE)[1:]
                self.assertEqual(set(re.findall(rf"^ +(?:-\w,)?({OPTION})", first, re.MULTILINE)), {"--help", "--help-all"}, "an option without a group")
                self.assertGreaterEqual(len(groups), 4)

    def test_bash_completes_them(self):
        for command in COMMANDS:
            with self.subTest(command):
                self.assertEqual(completed(command), helped(command))

    def test_bash_offers_all_devices_where_it_may_be_several(self):
        for command in COMMANDS:
            if "--device" not in helped(command):
                continue
            with self.subTest(command):
                found = completed(command, "--device", "")
                several = {"all"} if command in ("distance", "batch") else set()
                self.assertEqual(found, {"gpu", "cpu", "native"} | several)

    def test_rules_name_options_of_the_table(self):
        table = json.loads(subprocess.run([PRINT_OPTIONS], capture_output=True, text=True, timeout=60, check=True).stdout)
        known = {option["name"] for option in table["options"]} | {"option"}
        text = (SOURCE / "host/answer/rules.cpp").read_text()
        braced, quoted = set(re.findall(r"\{([a-z-]+)\}", text)), set(re.findall(r'"([a-z]+(?:-[a-z]+)*)"', text))
        self.assertGreater(len(braced), 30)
        self.assertLessEqual(braced | quoted, known)

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
