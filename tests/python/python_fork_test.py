#!/usr/bin/env python3
"""A Python program that forks, and objects and arrays that pretend to be others. Run through ctest."""
import os
import pathlib
import sys
import unittest

from python_lives import Lives


class Forks(Lives):
    FORKED = "was used before this process was forked"

    def test_the_child_is_told_and_the_parent_goes_on(self):
        self.lives(f"""
            s = vkh.Solver(vb, fb)
            expected = str(vkh.distance(va, fa, vb, fb)), str(s.distance(va, fa))
            def fork():
                pid = os.fork()
                if pid == 0:
                    started = time.monotonic()
                    for call in (lambda: vkh.distance(va, fa, vb, fb), lambda: s.distance(va, fa),
                                 lambda: vkh.Solver(vb, fb), s.close):
                        raises(RuntimeError, "{self.FORKED}", call)
                    assert time.monotonic() - started < 1
                    sys.exit(5)
                return pid
            assert child_of(fork) == 5
            assert (str(vkh.distance(va, fa, vb, fb)), str(s.distance(va, fa))) == expected
            print("done")
        """)

    def test_a_child_that_uses_nothing_ends_well(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            vkh.distance(va, fa, vb, fb)
            def fork():
                pid = os.fork()
                if pid == 0:
                    globals().pop("s")
                    gc.collect()
                    sys.exit(5)
                return pid
            assert child_of(fork) == 5
            assert s.distance(va, fa).closed
            print("done")
        """)

    # GCC 12's does not lock its allocator over a fork: a thread may be in it then, and the child waits forever.
    @unittest.skipIf("asan" in os.environ.get("LD_PRELOAD", ""), "AddressSanitizer does not survive it")
    def test_while_a_thread_runs(self):
        self.lives(f"""
            stop = []
            def work():
                while not stop:
                    vkh.distance(*dense, vb, fb, waves=3, **LONG)
            thread = threading.Thread(target=work)
            thread.start()
            time.sleep(0.5)
            def fork():
                pid = os.fork()
                if pid == 0:
                    raises(RuntimeError, "{self.FORKED}", lambda: vkh.distance(va, fa, vb, fb))
                    sys.exit(5)
                return pid
            codes = [child_of(fork) for _ in range(5)]
            stop.append(1)
            thread.join()
            assert codes == [5] * 5, codes
            print("done")
        """)

    def test_in_a_callback(self):
        self.lives(f"""
            s = vkh.Solver(vb, fb)
            codes = []
            def progress(*p):
                pid = os.fork()
                if pid == 0:
                    return True
                codes.append(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
                return False
            try:
                r = s.distance(*dense, progress=progress, **LONG)
            except RuntimeError as error:
                assert "{self.FORKED}" in str(error)
                sys.exit(5)
            assert codes == [5] and r.status == "cancelled", codes
            assert s.distance(va, fa).closed
            print("done")
        """)

    def test_before_the_first_use_all_is_well(self):
        self.lives("""
            def fork():
                pid = os.fork()
                if pid == 0:
                    sys.exit(5 if vkh.distance(va, fa, vb, fb).closed else 6)
                return pid
            assert child_of(fork) == 5
            assert vkh.distance(va, fa, vb, fb).closed
            print("done")
        """)

    def test_multiprocessing_says_it_in_the_parent(self):
        self.lives(f"""
            import multiprocessing
            def work():
                return vkh.distance(va, fa, vb, fb).lower
            work()
            with multiprocessing.get_context("fork").Pool(1) as pool:
                raises(RuntimeError, "{self.FORKED}", lambda: pool.apply(work))
            print("done")
        """)


class Objects(Lives):
    def test_never_made(self):
        self.lives("""
            class Early(vkh.Solver):
                def __init__(self):
                    raises(TypeError, "was never made", lambda: self.distance(va, fa))
                    raises(TypeError, "was never made", self.close)
                    super().__init__(vb, fb)
            assert Early().distance(va, fa).closed
            s = vkh.Solver.__new__(vkh.Solver)
            raises(TypeError, "this Solver was never made", lambda: s.distance(va, fa))
            raises(TypeError, "this Solver was never made", s.close)
            raises(TypeError, "this Solver was never made", lambda: s.__exit__(None, None, None))
            r = vkh.Result.__new__(vkh.Result)
            for name in ("lower", "upper", "closed", "status", "witness_a", "witness_b", "face_a", "face_b", "stats"):
                raises(TypeError, "this Result was never made", lambda: getattr(r, name))
            raises(TypeError, "this Result was never made", lambda: repr(r))
            raises(TypeError, "expected a vkhausdorff.Solver, not a value of type", lambda: vkh.Solver.distance(va, fa))
            half = vkh.Solver.__new__(vkh.Solver)
            raises(ValueError, "faces", lambda: half.__init__(vb, fb + 10**6))
            raises(TypeError, "this Solver was never made", lambda: half.distance(va, fa))
            del s, r, half
            gc.collect()
            print("done")
        """)

    def test_arrays_that_another_thread_writes_to(self):
        self.lives("""
            v, f = grid(250)
            stop = []
            for kind in (np.int64, np.int32, np.uint64):
                written = f.astype(kind)
                def write():
                    while not stop:
                        written[:] = 10**9
                        written[:] = f
                thread = threading.Thread(target=write)
                thread.start()
                ends = {}
                for _ in range(8):
                    try:
                        vkh.distance(v, written, vb, fb, waves=0)
                        end = "answered"
                    except ValueError as error:
                        assert "expected indices below" in str(error), error
                        end = "refused"
                    ends[end] = ends.get(end, 0) + 1
                stop.append(1)
                thread.join()
                stop.clear()
            print("done")
        """)


if __name__ == "__main__":
    unittest.main()
