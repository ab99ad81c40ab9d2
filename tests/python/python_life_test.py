#!/usr/bin/env python3
"""How a Python program that uses the module lives and ends: close, callbacks, threads, exits, in every order. Run through ctest."""
import pathlib
import sys
import unittest

from python_lives import Lives


class Close(Lives):
    def test_in_its_own_callback(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            seen = []
            r = s.distance(*dense, progress=lambda *p: (seen.append(p), s.close())[0], waves=6, **LONG)
            assert len(seen) > 1 and r.lower <= r.upper and r.status != "cancelled", r
            raises(ValueError, "this Solver is closed", lambda: s.distance(va, fa))
            s.close()
            del s, r
            gc.collect()
            print("done")
        """)

    def test_in_a_callback_while_another_thread_waits(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            began, said = threading.Event(), []
            def wait():
                began.wait()
                raises(ValueError, "this Solver is closed", lambda: s.distance(va, fa))
                said.append("refused")
            def progress(*p):
                if not began.is_set():
                    began.set()
                    time.sleep(0.3)  # the other one waits for its turn
                    s.close()
            thread = threading.Thread(target=wait)
            thread.start()
            s.distance(*dense, progress=progress, waves=4, **LONG)
            thread.join()
            assert said == ["refused"]
            del s
            print("done")
        """)

    def test_while_others_run_and_wait(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            ends = []
            def work():
                try:
                    ends.append(s.distance(*dense, waves=4, **LONG).status)
                except ValueError as error:
                    ends.append(str(error))
            threads = [threading.Thread(target=work) for _ in range(4)]
            [t.start() for t in threads]
            time.sleep(0.05)
            s.close()
            s.close()
            [t.join() for t in threads]
            assert len(ends) == 4 and set(ends) <= {"waves", "closed", "this Solver is closed"}, ends
            print("done")
        """)

    def test_by_the_with_statement_in_a_callback(self):
        self.lives("""
            def progress(*p):
                with s:
                    pass
                return False
            s = vkh.Solver(vb, fb)
            assert s.distance(*dense, progress=progress, **LONG).status == "cancelled"
            raises(ValueError, "closed", lambda: s.distance(va, fa))
            print("done")
        """)

    def test_the_last_name_goes_in_a_callback(self):
        self.lives("""
            names = {"s": vkh.Solver(vb, fb)}
            r = names["s"].distance(*dense, progress=lambda *p: names.clear(), waves=4, **LONG)
            gc.collect()
            assert r.lower <= r.upper
            print("done")
        """)

    def test_deleted_in_a_thread(self):
        self.lives("""
            box = [vkh.Solver(vb, fb)]
            box[0].distance(va, fa)
            thread = threading.Thread(target=lambda: (box.clear(), gc.collect()))
            thread.start()
            thread.join()
            assert vkh.distance(va, fa, vb, fb).closed
            print("done")
        """)

    def test_a_shared_device_in_its_own_callback(self):
        self.lives("""
            d = vkh.Device()
            s, t = vkh.Solver(vb, fb, device=d), vkh.Solver(va, fa, device=d)
            seen = []
            def progress(*p):
                seen.append(p)
                if len(seen) == 1:
                    raises(RuntimeError, "a progress callback started another run", lambda: t.distance(vb, fb))
                s.close()
                t.close()
                d.close()
            assert s.distance(*dense, progress=progress, waves=6, **LONG).status != "cancelled"
            assert len(seen) > 1
            raises(ValueError, "this Solver is closed", lambda: s.distance(va, fa))
            raises(ValueError, "this Device is closed", lambda: vkh.Solver(vb, fb, device=d))
            print("done")
        """)

    def test_solvers_of_a_device_go_while_others_run(self):
        self.lives("""
            d = vkh.Device()
            kept = vkh.Solver(vb, fb, device=d)
            expected = kept.distance(va, fa)
            ends = []
            def work():
                for _ in range(5):
                    with vkh.Solver(vb, fb, device=d) as s:
                        ends.append(s.distance(va, fa) == expected)
                    vkh.Solver(vb, fb, device=d)  # goes with its last name
                    ends.append(kept.distance(va, fa) == expected)
            threads = [threading.Thread(target=work) for _ in range(4)]
            [t.start() for t in threads]
            [t.join() for t in threads]
            assert ends == [True] * 40, ends
            del d
            gc.collect()
            assert kept.distance(va, fa) == expected
            print("done")
        """)

    def test_in_another_order_than_made(self):
        self.lives("""
            solvers = [vkh.Solver(vb, fb) for _ in range(3)]
            vkh.distance(va, fa, vb, fb)
            expected = str(solvers[0].distance(va, fa))
            solvers[1].close()
            del solvers[0]
            assert str(solvers[1].distance(va, fa)) == expected
            print("done")
        """)


class Callbacks(Lives):
    def test_exceptions_pass_through_and_leave_the_solver_usable(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            class Own(BaseException):
                pass
            def failing(*p):
                raise Own("enough")
            class NoTruth:
                def __bool__(self):
                    raise LookupError("no truth")
            for call in (lambda f: s.distance(*dense, progress=f, **LONG),
                         lambda f: vkh.distance(*dense, vb, fb, progress=f, **LONG)):
                raises(Own, "enough", lambda: call(failing))
                raises(LookupError, "no truth", lambda: call(lambda *p: NoTruth()))
                raises(TypeError, "positional", lambda: call(lambda: None))
            assert s.distance(va, fa).closed and vkh.distance(va, fa, vb, fb).closed
            print("done")
        """)

    def test_nested_runs(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            inner = []
            def progress(*p):
                raises(RuntimeError, "a progress callback started another run", lambda: s.distance(va, fa))
                inner.append(vkh.distance(va, fa, vb, fb).closed)  # of another session
                return len(inner) < 2
            assert s.distance(*dense, progress=progress, **LONG).status == "cancelled"
            assert inner == [True, True]
            again = lambda *p: vkh.distance(va, fa, vb, fb)
            raises(RuntimeError, "a progress callback started another run",
                   lambda: vkh.distance(*dense, vb, fb, progress=again, **LONG))
            assert vkh.distance(va, fa, vb, fb).closed
            print("done")
        """)

    def test_interrupt_while_another_thread_waits(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            ends = []
            thread = threading.Thread(target=lambda: ends.append(s.distance(va, fa).status))
            def progress(*p):
                if not thread.is_alive() and not ends:
                    thread.start()
                    os.kill(os.getpid(), signal.SIGINT)
            raises(KeyboardInterrupt, "", lambda: s.distance(*dense, progress=progress, **LONG))
            thread.join()
            assert ends == ["closed"], ends
            print("done")
        """)

    def test_exit_in_a_callback(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            print("done", flush=True)
            s.distance(*dense, progress=lambda *p: sys.exit(7), **LONG)
        """, exit_code=7)


class Exits(Lives):
    def test_with_an_open_solver_in_a_global(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            s.distance(va, fa)
            kept = [s]
            kept.append(kept)  # a cycle
            sys.modules["os"].kept = kept  # outlives the module's own names
            print("done")
        """)

    def test_with_an_exception_that_nobody_catches(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            print("done", flush=True)
            s.distance(va, fa, tol="x")
        """, exit_code=1, err="ValueError: tol: expected a positive number")

    def test_while_a_daemon_runs(self):
        one, held = ("", "vkh.distance(*dense, vb, fb, **LONG)"), ("s = vkh.Solver(vb, fb)", "s.distance(*dense, **LONG)")
        for (made, call), wait in ((one, "0.0"), (held, "0.05"), (one, "0.5")):
            with self.subTest(call=call, wait=wait):
                self.lives(f"""
                    vkh.distance(va, fa, vb, fb)
                    {made}
                    def work():
                        while True:
                            {call}
                    threading.Thread(target=work, daemon=True).start()
                    time.sleep({wait})
                    print("done")
                """)

    def test_while_a_daemon_surveys(self):
        for call, wait in (("vkh.distance(*dense, vb, fb, field=1e-12, survey_time=60)", "1.0"),
                           ("vkh.distance(va, fa, vb, fb, statistics=True, survey_time=0.01).area_within(0.1)", "0.05")):
            with self.subTest(call=call, wait=wait):
                self.lives(f"""
                    vkh.distance(va, fa, vb, fb, field=True)
                    def work():
                        while True:
                            {call}
                    threading.Thread(target=work, daemon=True).start()
                    time.sleep({wait})
                    print("done")
                """)

    def test_while_daemons_wait_for_each_other(self):
        self.lives("""
            s = vkh.Solver(vb, fb)
            def work():
                while True:
                    s.distance(*dense, progress=lambda *p: True, **LONG)
            for _ in range(4):
                threading.Thread(target=work, daemon=True).start()
            time.sleep(0.3)
            print("done")
        """)

    def test_while_a_daemon_makes_devices(self):
        self.lives("""
            def work():
                while True:
                    vkh.Solver(vb, fb)
            threading.Thread(target=work, daemon=True).start()
            time.sleep(0.2)
            print("done")
        """)

    def test_while_a_daemon_is_in_a_callback(self):
        for inside in ("time.sleep(0.01)", "time.sleep(1.05)", "threading.Event().wait()", "sum(range(10**5))"):
            with self.subTest(inside=inside):
                self.lives(f"""
                    s = vkh.Solver(vb, fb)
                    began = threading.Event()
                    def progress(*p):
                        began.set()
                        {inside}
                    def work():
                        while True:
                            s.distance(*dense, progress=progress, **LONG)
                    threading.Thread(target=work, daemon=True).start()
                    threading.Thread(target=lambda: s.distance(va, fa), daemon=True).start()
                    began.wait()
                    print("done")
                """)

    def test_while_a_daemon_hands_over_arrays(self):
        self.lives("""
            v, f = grid(300)
            v = np.asfortranarray(v)
            def work():
                while True:
                    vkh.distance(v, f.astype(np.int32), vb, fb, waves=0)
            for _ in range(2):
                threading.Thread(target=work, daemon=True).start()
            time.sleep(0.5)
            print("done")
        """)

    def test_handlers_that_run_later_may_join_and_are_refused(self):
        self.lives("""
            thread = threading.Thread(target=lambda: [vkh.distance(*dense, vb, fb, **LONG) for _ in range(10**6)], daemon=True)
            s = vkh.Solver(vb, fb)
            def last():
                thread.join()
                for call in (lambda: vkh.distance(va, fa, vb, fb), lambda: vkh.Solver(vb, fb), lambda: s.distance(va, fa)):
                    raises(RuntimeError, "the interpreter is ending", call)
                print("done")
            late.append(last)
            thread.start()
            time.sleep(0.2)
        """, first="import atexit; late = []; atexit.register(lambda: late[0]())")

    def test_soon_after_a_thread_ended(self):
        self.lives("""
            thread = threading.Thread(target=lambda: vkh.distance(va, fa, vb, fb))
            thread.start()  # no daemon: the interpreter waits for it
            print("done")
        """)


if __name__ == "__main__":
    unittest.main()
