#!/usr/bin/env python3
"""How a Python program with streams of distances() ends and forks, in every order. Run through ctest."""
import os
import unittest

from python_lives import Lives

FIRST = """
import itertools
"""
MANY = "itertools.cycle([((va, fa), (vb, fb)), ((vb, fb), (va, fa))])"


class Exits(Lives):
    def ends(self, program, **expected):
        self.lives(program, first=FIRST, **expected)

    def test_with_a_stream_in_a_global(self):
        self.ends(f"""
            fresh = vkh.distances({MANY})
            begun = vkh.distances({MANY})
            next(begun)
            over = vkh.distances([((va, fa), (vb, fb))])
            list(over)
            kept = [fresh, begun]
            kept.append(kept)
            sys.modules["os"].kept = kept  # outlives the module's own names
            print("done")
        """)

    def test_in_the_middle_of_a_loop(self):
        self.ends(f"""
            for r in vkh.distances({MANY}):
                if r.index > 5:
                    print("done", flush=True)
                    sys.exit(7)
        """, exit_code=7)
        self.ends(f"""
            print("done", flush=True)
            for r in vkh.distances({MANY}):
                raise LookupError("enough")
        """, exit_code=1, err="LookupError: enough")

    def test_while_a_long_pair_runs(self):
        self.ends("""
            stream = vkh.distances(itertools.repeat((dense, (vb, fb))), **LONG)
            thread = threading.Thread(target=lambda: next(stream), daemon=True)
            thread.start()
            time.sleep(0.5)
            print("done")
        """)

    def test_while_daemons_take_results(self):
        for wait in ("0.0", "0.5"):
            with self.subTest(wait=wait):
                self.ends(f"""
                    def work():
                        for r in vkh.distances({MANY}):
                            r.lower
                    for _ in range(2):
                        threading.Thread(target=work, daemon=True).start()
                    time.sleep({wait})
                    print("done")
                """)

    def test_while_a_daemon_makes_streams(self):
        self.ends(f"""
            def work():
                while True:
                    next(vkh.distances({MANY}))
            threading.Thread(target=work, daemon=True).start()
            time.sleep(0.5)
            print("done")
        """)

    def test_while_a_daemon_waits_for_a_pair(self):
        self.ends("""
            def pairs():
                yield (va, fa), (vb, fb)
                threading.Event().wait()
            threading.Thread(target=lambda: list(vkh.distances(pairs())), daemon=True).start()
            time.sleep(0.5)
            print("done")
        """)

    def test_while_another_stays_in_a_callback(self):
        self.ends(f"""
            s = vkh.Solver(vb, fb)
            stay = threading.Event()
            began = threading.Event()
            def progress(*p):
                began.set()
                stay.wait()
            threading.Thread(target=lambda: s.distance(*dense, progress=progress, **LONG), daemon=True).start()
            began.wait()
            stream = vkh.distances({MANY})
            next(stream)
            print("done")
        """)

    def test_while_files_are_read(self):
        self.ends("""
            import tempfile
            v, f = grid(300)
            with tempfile.TemporaryDirectory() as folder:
                file = folder + "/large.obj"
                with open(file, "w") as out:
                    out.writelines("v %r %r %r\\n" % tuple(row) for row in v.tolist())
                    out.writelines("f %d %d %d\\n" % tuple(row) for row in (f + 1).tolist())
                stream = vkh.distances(itertools.repeat((file, file)))
                threading.Thread(target=lambda: next(stream), daemon=True).start()
                time.sleep(0.2)
            print("done")
        """)

    def test_what_comes_later_is_refused(self):
        self.lives(f"""
            stream = vkh.distances({MANY})
            next(stream)
            def last():
                raises(RuntimeError, "the interpreter is ending", lambda: next(stream))
                raises(RuntimeError, "the interpreter is ending", lambda: vkh.distances([]))
                raises(RuntimeError, "the interpreter is ending", lambda: vkh.read("x"))
                stream.close()
                print("done")
            late.append(last)
        """, first=FIRST + "import atexit; late = []; atexit.register(lambda: late[0]())")


class Forks(Lives):
    FORKED = "was used before this process was forked"

    # GCC 12's does not lock its allocator over a fork: a thread may be in it then, and the child waits forever.
    @unittest.skipIf("asan" in os.environ.get("LD_PRELOAD", ""), "AddressSanitizer does not survive it")
    def test_the_child_is_told_and_the_parent_goes_on(self):
        self.lives(f"""
            stream, other = vkh.distances({MANY}), vkh.distances({MANY})
            next(stream)
            def fork():
                pid = os.fork()
                if pid == 0:
                    started = time.monotonic()
                    raises(RuntimeError, "{self.FORKED}", lambda: next(stream))
                    raises(RuntimeError, "{self.FORKED}", lambda: next(other))
                    raises(RuntimeError, "{self.FORKED}", lambda: vkh.distances([]))
                    stream.close()
                    assert time.monotonic() - started < 1
                    sys.exit(5)
                return pid
            codes = [child_of(fork) for _ in range(3)]
            assert codes == [5] * 3, codes
            before = next(stream).index
            assert {{next(stream).index for _ in range(9)}} - {{before}}
            stream.close()
            print("done")
        """, first=FIRST)

    @unittest.skipIf("asan" in os.environ.get("LD_PRELOAD", ""), "AddressSanitizer does not survive it")
    def test_a_child_that_drops_it_ends_well(self):
        self.lives(f"""
            stream, fresh = vkh.distances({MANY}), vkh.distances({MANY})
            next(stream)
            def fork():
                pid = os.fork()
                if pid == 0:
                    del globals()["stream"], globals()["fresh"]
                    gc.collect()
                    sys.exit(5)
                return pid
            assert child_of(fork) == 5
            next(stream)
            print("done")
        """, first=FIRST)

    def test_before_the_first_use_all_is_well(self):
        self.lives(f"""
            def fork():
                pid = os.fork()
                if pid == 0:
                    sys.exit(5 if next(vkh.distances({MANY})).closed else 6)
                return pid
            assert child_of(fork) == 5
            assert next(vkh.distances({MANY})).closed
            print("done")
        """, first=FIRST)


if __name__ == "__main__":
    unittest.main()
