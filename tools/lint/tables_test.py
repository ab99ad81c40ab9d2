"""tools/bench/tables.py on a benchmark of eight rows whose tables are known."""
import csv
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

TABLES = pathlib.Path(__file__).resolve().parents[2] / "tools/bench/tables.py"
HEADER = "pair,family,preset,status,verdict,load_ms,setup_ms,upload_ms,hierarchy_ms,solve_ms,gpu_ms"

# solve_ms of a, b, c; a run that is not closed has a status in its place.
TIMES = {
    "default": [1, 2, 4],
    "paper": [2, 2, 8],
    "baseline-gpu@8GiB": [10, 8, "memory"],
    "-thin": [1, 6, 3],
    "+sort": [2, 3, 5],
    "paper-packet": [1, 1, "time"],
}
PAIRS = (("a", "tetwild"), ("b", "tetwild"), ("c", "decimation"))
PEER = {"a": 100, "b": 1000, "c": 200}


def row(pair, family, preset, value, verdict="ok"):
    closed = not isinstance(value, str)
    solve = value if closed else 99
    return f"{pair},{family},{preset},{'closed' if closed else value},{verdict},3,50,1,2,{solve},{solve + 2}"


def bench_rows():
    return [row(pair, family, preset, times[i]) for preset, times in TIMES.items() for i, (pair, family) in enumerate(PAIRS)]


class Tables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_tables(self, rows, *more):
        bench = self.folder / "bench.csv"
        bench.write_text("\n".join(["# device d", HEADER, *rows, "# default: 3 closed"]) + "\n")
        peer = self.folder / "peer.csv"
        peer.write_text("pair,solve_ms,status\n" + "".join(f"{p},{t},closed\n" for p, t in PEER.items()))
        command = [sys.executable, "-B", TABLES, "--bench", bench, "--peer", peer, "--out", self.folder / "out", *more]
        return subprocess.run(command, capture_output=True, text=True)

    def table(self, name):
        with open(self.folder / "out" / f"{name}.csv", newline="") as file:
            return list(csv.reader(file))[1:]

    def page(self):
        return (self.folder / "out" / "README.md").read_text()

    def test_peer(self):
        self.assertEqual(self.run_tables(bench_rows()).returncode, 0)
        # The ratios for a and b, which all three presets close: 1100 over 3, sqrt(100 * 500), 100 and
        # 500 between.
        self.assertEqual(self.table("peer-tetwild"),
                         [["default", "2", "550.00", "1.50", "366.67x", "223.61x", "460.00x", "496.00x"],
                          ["paper", "2", "550.00", "2.00", "275.00x", "158.11x", "455.00x", "495.50x"],
                          ["baseline-gpu", "2", "550.00", "9.00", "61.11x", "35.36x", "113.50x", "123.85x"]])
        self.assertFalse((self.folder / "out" / "peer-decimation.csv").exists())  # baseline-gpu ran out of memory

    def test_breakdown(self):
        self.run_tables(bench_rows())
        self.assertEqual(self.table("breakdown")[0], ["tetwild", "2", "3.00", "3.00", "50.00", "56.00", "1.50", "57.50"])

    def test_top_and_baseline(self):
        self.run_tables(bench_rows())
        self.assertEqual(self.table("top-default"), [["a", "1.00", "10.00", "10.00x"], ["b", "2.00", "8.00", "4.00x"]])
        self.assertEqual(self.table("baseline")[0], ["default", "all", "2", "6.00x", "7.00x", "9.94x"])

    def test_ablations(self):
        self.run_tables(bench_rows())
        rows = {(r[1], r[2]): r for r in self.table("ablations")}
        self.assertEqual(rows["-thin", "all"], ["default", "-thin", "all", "3", "1.43x", "1.00x", "2.96x", "0", "0", "0", "thin pays"])
        self.assertEqual(rows["-thin", "decimation"][-1], "thin does not pay")
        self.assertEqual(rows["+sort", "all"][4:], ["1.43x", "1.50x", "1.99x", "0", "0", "0", "sort does not pay"])
        self.assertEqual(rows["paper-packet", "all"],
                         ["paper", "paper-packet", "all", "2", "0.50x", "0.50x", "0.50x", "1", "0", "0", "packet does not pay"])
        self.assertEqual(self.table("midpoint-default"), [["default", "b", "2.00", "6.00", "3.00x"]])
        self.assertIn("- baseline-gpu: 2 closed, 1 memory", self.page())

    def test_ablations_of_their_own(self):
        other = self.folder / "other.csv"
        other.write_text("\n".join([HEADER, row("a", "tetwild", "default", 5), row("a", "tetwild", "-u4", 10)]))
        self.run_tables(bench_rows(), "--ablations", other)
        self.assertEqual([r[1:5] for r in self.table("ablations")], [["-u4", "all", "1", "2.00x"], ["-u4", "tetwild", "1", "2.00x"]])
        self.assertEqual(self.table("baseline")[0][2], "2")

    def test_other_times_and_memory(self):
        memory = self.folder / "memory.csv"
        memory.write_text("\n".join([HEADER, row("a", "tetwild", "default@16MiB", 1), row("b", "tetwild", "default@16MiB", 2),
                                     row("a", "tetwild", "-defer@16MiB", "memory"), row("b", "tetwild", "-defer@16MiB", 2)]))
        self.run_tables(bench_rows(), "--time", "gpu_ms", "--memory", memory)
        self.assertEqual(self.table("top-default")[0], ["a", "3.00", "12.00", "4.00x"])
        self.assertEqual(self.table("memory"), [["default", "16MiB", "2", "2", "0", "0", "0", "7.00"],
                                                ["-defer", "16MiB", "2", "1", "0", "1", "0", "4.00"]])

    def test_what_is_wrong_is_said(self):
        result = self.run_tables([*bench_rows(), row("d", "tetwild", "default", 1, "DISJOINT")])
        self.assertEqual(result.returncode, 1)
        self.assertIn("WRONG, intervals that do not meet or repeats that differ: d", self.page())

    def test_plots(self):
        result = self.run_tables(bench_rows())
        if importlib.util.find_spec("matplotlib") is None:
            self.assertIn("no plots", result.stderr)
            self.skipTest("no matplotlib here (tools/setup --benchmarks): plots not tested")
        for figure in ("fig6", "fig7", "fig8"):
            self.assertGreater((self.folder / "out" / f"{figure}.png").stat().st_size, 1000)
            self.assertIn(f"{figure}.png", self.page())


if __name__ == "__main__":
    unittest.main()
