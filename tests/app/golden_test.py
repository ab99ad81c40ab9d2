#!/usr/bin/env python3
"""Every outlet of an answer says byte for byte what it said when the corpus was recorded, but for times and machines.

usage: golden_test.py PROGRAM [--record]; the corpus is golden/answers.json.xz beside this file. Exit code 77: it was recorded with
another device, driver or processor, whose answers may have other last digits. This test is for as long as outlets are rewritten: it goes
when what an answer says is to change.
"""

import difflib
import json
import lzma
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
CORPUS = pathlib.Path(os.environ.get("VKH_GOLDEN", pathlib.Path(__file__).with_name("golden") / "answers.json.xz"))
OUTPUTS = ("out.html", "out.csv", "points.csv", "out.xml", "out.jsonl", "table.csv", "transform.txt", "summary.md", "shown.json")
# Members since the corpus was recorded, and what only one run or machine has.
SINCE = re.compile(r',"diagonal_b":(?:null|[-+.e0-9]+)')
PROGRESS = re.compile(r"(?m)^\d+ %  \[.*\n")
OF_A_RUN = [(r'("(?:\w+_ms|memory_bytes|workspace_bytes|index)":)[-+.e0-9]+', r"\1 0"),
            (r'"(host|started|driver|key|api_version|sha256)":"[^"]*"', r'"\1":"-"'),
            (r'"device":\{[^}]*\}', '"device":{}'),
            (r'("stages":)\[[^\]]*\]', r"\1[]"),
            (r'<script.*?</script>|<style.*?</style>|(?:src|href)="data:[^"]*"', "-"),
            (r'(time|timestamp|hostname)="[^"]*"', r'\1=""'),
            (r"(?m)^  (device|times|pairs|time|devices) .*$", r"  \1"),
            (r"(?m)^  \S+ +\d+\.\d{4} +\d+$", "  -"),
            (r"workspace \S+ MiB|, in \S+ s$|in \S+ s(?=[\n:])", "-"),
            (r"\d+(\.\d+)?( |\xa0|&nbsp;)?(ms|s)\b", "0 s"),
            (r"nonce-[^']*|sha256-[^']*", "-"),
            (r",\d+\.\d{3},\d+\.\d{3},[^,\n]*,\d{4}-\d\d[^,\n]*", ",-"),
            (r"\d{4}-\d\d-\d\dT[\d:]+Z", "-"),
            (r"\b" + re.escape(platform.node()) + r"\b", "-")]


def hill(cells, height, seed, size=1.0):
    """A bumpy sheet in triangles; only whole numbers decide its heights."""
    side = cells + 1
    rows = [f"v {size * i / cells} {size * j / cells} {height * ((7 * i + 5 * j + seed * i * j) % 4) / 4}" for j in range(side) for i in range(side)]
    for j in range(cells):
        for i in range(cells):
            a = j * side + i + 1
            rows += [f"f {a} {a + 1} {a + side + 1}", f"f {a} {a + side + 1} {a + side}"]
    return "\n".join(rows) + "\n"


CUBE = """v {0} {0} {0}\nv {1} {0} {0}\nv {1} {1} {0}\nv {0} {1} {0}\nv {0} {0} {1}\nv {1} {0} {1}\nv {1} {1} {1}\nv {0} {1} {1}
f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 3 4 8\nf 3 8 7\nf 2 3 7\nf 2 7 6\nf 1 5 8\nf 1 8 4\n"""
SQUARE = "v 0 0 {z}\nv {x} 0 {z}\nv {x} 1 {z}\nv 0 1 {z}\nf 1 2 3\nf 1 3 4\n"


def write_inputs(folder):
    files = {"a.obj": hill(3, 0.1, 1), "b.obj": hill(4, 0.25, 3), "odd name.obj": hill(2, 0.2, 1), "flat.obj": SQUARE.format(x=1, z=0),
             "high.obj": SQUARE.format(x=1, z=0.25), "half.obj": SQUARE.format(x=0.5, z=0), "wide.obj": SQUARE.format(x=25.4, z=0),
             "cube.obj": CUBE.format(0, 1), "inner.obj": CUBE.format(0.2, 0.7), "tilt.obj": hill(3, 0.1, 1).replace("v 0.0 0.0 ", "v 0.01 0.0 "),
             "bad.obj": "v 0 0 0\nf 1 2 3\n", "none.obj": "", "twice.obj": SQUARE.format(x=1, z=0) + "f 1 2 3\nf 1 1 2\nv 9 9 9\n",
             "quad.obj": "v 0 0 0\nv 1 0 0\nv 1 1 0.01\nv 0 1 0\nf 1 2 3 4\n", "away.obj": SQUARE.format(x=1, z=50),
             "cloud.xyz": "".join(f"{i / 4} {j / 4} {((i * j) % 3) / 20}\n" for i in range(5) for j in range(5)) + "0.5 0.5 3\n",
             "move.txt": "1 0 0 0.01\n0 1 0 0\n0 0 1 0.02\n0 0 0 1\n", "limits.csv": "face,max\n" + "".join(f"{i},{0.3 - i / 100}\n" for i in range(0, 18, 3)),
             "tight.csv": "face,max\n" + "".join(f"{i},0.01\n" for i in range(0, 18, 3)),
             "list.csv": "id,a,b,max,symmetric,signed\nclosed,a.obj,b.obj,,,\nsame,a.obj,a.obj,,,\nboth,a.obj,b.obj,,1,\npass,flat.obj,high.obj,0.3abs,,\n"
                         "fail,a.obj,high.obj,0.05abs,1,\nsides,a.obj,b.obj,,,1\nwithin,flat.obj,high.obj,\"+0.1abs,-0.3abs\",,\n"
                         "gone,a.obj,gone.obj,,,\nbad,bad.obj,b.obj,,,\nno unit,a.obj,b.obj,1mm,,\n",
             "plain.csv": "id,a,b\none,a.obj,b.obj\ntwo,flat.obj,b.obj\nthree,cube.obj,inner.obj\n"}
    for name, text in files.items():
        (folder / name).write_text(text)
    for name in ("a", "b"):
        (folder / name).mkdir()
        (folder / name / "part.obj").write_text(files[f"{name}.obj"])
        (folder / name / f"only {name}.obj").write_text(files["flat.obj"])


def commands():
    """Each question in each outlet that has it."""
    distance = ["a.obj b.obj", "b.obj a.obj --symmetric", "a.obj a.obj", "flat.obj high.obj --tol 1%", "half.obj flat.obj --symmetric --stats",
                "a.obj b.obj --stats", "a.obj b.obj --stats --bands 0.05abs,10% --symmetric", "a.obj b.obj --signed --stats",
                "inner.obj cube.obj --signed --stats", "cube.obj inner.obj --signed --bands 0.1abs", "a.obj b.obj --field-tol 1% --field f.ply --stats",
                "flat.obj high.obj --stats --bands 0.25abs", "cloud.xyz flat.obj --points a --stats --max-distance 1abs --bands 0.1abs",
                "cloud.xyz flat.obj --points a --signed --stats", "a.obj b.obj --stats --max-distance 0.1abs", "a.obj b.obj --waves 1",
                "a.obj b.obj --waves 1 --stats", "a.obj b.obj --stats --effort 50", "a.obj b.obj --verify", "a.obj b.obj --unit mm", "a.obj b.obj --unit-a in --unit-b mm",
                "a.obj b.obj --transform move.txt", "a.obj b.obj --unit mm --transform move.txt --stats", "tilt.obj a.obj --align --save-transform transform.txt",
                "a.obj b.obj --part 0/2", "a.obj b.obj --part 1/2 --known-lower 0.01abs", "a.obj b.obj --certificate p.vhc", "a.obj b.obj --symmetric --certificate p.vhc",
                "twice.obj flat.obj", "quad.obj flat.obj --polygons fan", "quad.obj flat.obj --polygons any", "wide.obj flat.obj", "away.obj flat.obj", "bad.obj a.obj", "none.obj a.obj",
                "a.obj gone.obj", "a.obj b.obj --preset paper", "a.obj b.obj --preset baseline-gpu --enable thin", "a.obj b.obj --disable u3,thin",
                "'odd name.obj' b.obj --tol 0.001abs", "a.obj b.obj --tol 1mm"]
    gate = ["a.obj b.obj --max 0.3abs", "a.obj b.obj --max 0.05abs", "a.obj b.obj --max 0.05abs --worst", "a.obj b.obj --max 20% --symmetric",
            "flat.obj high.obj --max 0.25abs --tol 1e-3", "half.obj flat.obj --max 0.1abs", "half.obj flat.obj --max 0.1abs --symmetric", "a.obj b.obj --max 10% --area 90%",
            "a.obj b.obj --max 0.2abs --area 50% --stats", "a.obj b.obj --max 0.02abs --area 0.995 --symmetric", "a.obj b.obj --max +0.1abs,-0.3abs", "a.obj b.obj --max +0.01abs,-0.3abs --signed",
            "flat.obj high.obj --max -0.2abs,+0.1abs", "a.obj b.obj --max 0.3abs --stats --bands 0.1abs --field f.ply", "a.obj b.obj --max 0.3abs --face-max limits.csv",
            "a.obj b.obj --max 0.3abs --face-max tight.csv", "a.obj b.obj --max 0.3abs --face-max limits.csv --symmetric", "a.obj b.obj --max 1mm --unit cm", "away.obj flat.obj --max 60abs", "bad.obj a.obj --max 1abs", "a.obj b.obj --max 0.2abs --waves 1",
            "cloud.xyz flat.obj --points a --max 0.2abs --area 90%", "inner.obj cube.obj --max 1abs --transform move.txt"]
    metrics = ["a.obj b.obj", "a.obj b.obj --bands 0.1abs,5% --percentile 90", "a.obj b.obj --bands 0.05abs --normals 20deg --unit mm", "a.obj b.obj --figures f1,hd95 --bands 0.1abs",
               "flat.obj high.obj --bands 0.25abs --effort 2000", "a.obj b.obj --waves 1 --effort 10"]
    for words in distance:
        yield f"distance {words}"
        yield f"distance {words} --json"
    for words in gate:
        yield f"gate {words} --junit out.xml --github"
        yield f"gate {words} --json"
    for words in metrics:
        yield f"metrics {words}"
        yield f"metrics {words} --json"
    for words in ("distance a.obj b.obj", "distance a.obj b.obj --symmetric --bands 0.05abs", "gate a.obj b.obj --max 0.1abs", "gate a.obj b.obj --max +0.1abs,-0.2abs",
                  "distance cloud.xyz flat.obj --points a", "distance inner.obj cube.obj --unit mm --signed", "distance a.obj b.obj --max-distance 0.1abs",
                  "gate a.obj b.obj --max 5% --area 90%", "distance twice.obj flat.obj"):
        yield f"{words} --report out.html --figures-csv out.csv --points-out points.csv"
    yield "distance a.obj b.obj --verbose"
    yield "distance a.obj b.obj --json=shown.json"
    yield "demo --symmetric --stats --json"
    yield "demo"
    for words in ("list.csv", "plain.csv --metrics --bands 0.1abs,5% --normals 10deg --effort 2000", "plain.csv --signed", "plain.csv --max 0.2abs",
                  "plain.csv --max 50% --symmetric --unit mm", "a b", "a b --allow-unpaired --max 0.3abs", "a.obj flat.obj --against b.obj", "plain.csv --waves 1", "plain.csv --shard 0/2",
                  "plain.csv --transform move.txt"):
        yield f"batch {words} --out out.jsonl --csv table.csv --junit out.xml --github"
    yield "batch list.csv --out out.jsonl && merge out.jsonl --out again.jsonl --csv table.csv --junit out.xml --list list.csv"
    yield "batch list.csv --out out.jsonl && merge out.jsonl --out again.jsonl --csv table.csv --reproducible"
    yield "batch plain.csv --out out.jsonl && batch plain.csv --out out.jsonl --resume --csv table.csv"
    yield "distance a.obj b.obj --part 0/2 --json=p0.json && distance a.obj b.obj --part 1/2 --json=p1.json && merge p0.json p1.json --json=shown.json"
    yield "distance a.obj b.obj --part 0/2 --json=p0.json && distance a.obj b.obj --part 1/2 --json=p1.json && merge p0.json p1.json --out shown.json"
    for words in ("cube.obj --max 1%", "b.obj --max 0.05abs --one-way", "b.obj --max 20% --levels 3", "bad.obj --max 1%"):
        yield f"simplify {words} --out s.ply"
        yield f"simplify {words} --out s.ply --json"


def without_run(text):
    text = SINCE.sub("", text)
    text = PROGRESS.sub("", text)
    for pattern, instead in OF_A_RUN:
        text = re.sub(pattern, instead, text, flags=re.S if pattern.startswith("<script") else 0)
    return text


def said_by(command, folder):
    """What all of it prints and writes, files one after the other."""
    write_inputs(folder)
    text = ""
    for one in command.split(" && "):
        words = re.findall(r"'([^']*)'|(\S+)", one)
        done = subprocess.run([PROGRAM, *(quoted or word for quoted, word in words)], cwd=folder, capture_output=True, timeout=300,
                              env={**os.environ, "GITHUB_STEP_SUMMARY": str(folder / "summary.md")})
        out = done.stdout.decode(errors="replace")
        if words[0][1] in ("batch", "merge"):  # whoever ends first is named first
            out = "".join(sorted(out.replace("  failed   ", "           ").splitlines(keepends=True)))
        text += f"code {done.returncode}\n{out}\n{done.stderr.decode(errors='replace')}\n"
    for name in OUTPUTS:
        if (folder / name).exists():
            written = (folder / name).read_text(encoding="utf-8", errors="replace")
            if name == "out.jsonl":
                written = "".join(sorted(written.splitlines(keepends=True)))
            text += f"--- {name}\n{written}\n"
    return text


def record():
    found = {}
    for command in commands():
        with tempfile.TemporaryDirectory() as folder:
            found[command] = without_run(said_by(command, pathlib.Path(folder)))
    return found


def processor():
    """The model and the number of cores: lavapipe makes code for them."""
    try:
        model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    except OSError:
        model = None
    return f"{os.cpu_count()} of {model.group(1) if model else platform.machine()}"


def device():
    with tempfile.TemporaryDirectory() as folder:
        write_inputs(pathlib.Path(folder))
        done = subprocess.run([PROGRAM, "distance", "a.obj", "b.obj", "--json"], cwd=folder, capture_output=True, text=True)
    answer = json.loads(done.stdout)
    return [answer["device"]["name"], answer["driver"], processor()]


def main():
    if "--record" in sys.argv:
        CORPUS.parent.mkdir(exist_ok=True)
        CORPUS.write_bytes(lzma.compress(json.dumps({"device": device(), "said": record()}).encode(), preset=9))
        return 0
    corpus = json.loads(lzma.decompress(CORPUS.read_bytes()))
    if device() != corpus["device"]:
        print(f"skipped: recorded on {corpus['device']}, not on {device()}")
        return 77
    wrong = 0
    for command, now in record().items():
        was = corpus["said"].get(command)
        if was == now:
            continue
        wrong += 1
        print(f"OTHER: {command}")
        if was is not None:
            print("\n".join(list(difflib.unified_diff(was.splitlines(), now.splitlines(), "recorded", "now", lineterm="", n=0))[:12])[:3000])
    print(f"{len(corpus['said'])} commands, {wrong} others")
    return 1 if wrong or not corpus["said"] else 0


if __name__ == "__main__":
    sys.exit(main())
