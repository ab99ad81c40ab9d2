import json
import sys

import distributed
from vkhausdorff.dask import distances


def tell(fraction: float, lower: float, upper: float) -> None:
    print(f"{100 * fraction:.0f} %, the largest in [{lower}, {upper}]", file=sys.stderr)


with open("list.jsonl") as file:
    rows = [json.loads(line) for line in file]
client = distributed.Client(scheduler_file="scheduler.json")
pairs = [(row["id"], row["a"], row["b"]) for row in rows]
for r in distances(client, pairs, shard=1000, tol=1e-6, on_progress=tell):
    print(r.id, r.error or (r.lower, r.upper))
