"""Python programs that use the module, each in a process of its own with a time limit."""
import os
import subprocess
import sys
import textwrap
import unittest

LIMIT_S = 120  # a sanitizer tree on two busy cores
FINDS_SHAPES = os.environ | {"PYTHONPATH": os.pathsep.join([os.path.dirname(os.path.abspath(__file__)), os.environ.get("PYTHONPATH", "")])}

PRELUDE = '''
import atexit, gc, os, signal, sys, threading, time
import numpy as np
import vkhausdorff as vkh
from python_shapes import grid

va, fa = grid(12, 0.125)
vb, fb = grid(6)
LONG = dict(tol=1e-7, memory=1 << 18, disable=["centroid", "parent_samples", "u3"])
dense = grid(80)

def raises(kind, text, call):
    try:
        call()
    except kind as error:
        assert text in str(error), str(error)
        assert "\\n" not in str(error), str(error)
    else:
        raise AssertionError("nothing was raised")

def child_of(fork):
    """Runs fork() and gives back the child's exit code; -1 if it does not end."""
    pid = fork()
    end = time.monotonic() + 60
    while time.monotonic() < end:
        done, status = os.waitpid(pid, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.02)
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    return -1
'''


class Lives(unittest.TestCase):
    def lives(self, program, exit_code=0, out="done\n", err="", first=""):
        """Prints `out`, `err` is in stderr's last line ("": nothing there), ends with `exit_code`. `first`: before the module."""
        try:
            run = subprocess.run(
                [sys.executable, "-B", "-X", "faulthandler", "-c", first + PRELUDE + textwrap.dedent(program)],
                capture_output=True, text=True, timeout=LIMIT_S, env=FINDS_SHAPES)
        except subprocess.TimeoutExpired as late:
            self.fail(f"did not end: {late.stdout} {late.stderr}")
        self.assertEqual(run.returncode, exit_code, run.stdout + run.stderr)
        self.assertEqual(run.stdout, out, run.stderr)
        if err:
            self.assertIn(err, run.stderr.splitlines()[-1] if run.stderr else "")
        else:
            self.assertEqual(run.stderr, "")
