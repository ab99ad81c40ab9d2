import numpy as np
import vkhausdorff as vkh

va = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=np.float64)
faces = np.array([[0, 1, 2]])
levels = {"fine": va + [0, 0, 0.25], "coarse": va + [0, 0, 0.5]}


def tell(fraction: float, lower: float, upper: float) -> None:
    print(f"{100 * fraction:.0f} %  [{lower}, {upper}]")


print([d["name"] for d in vkh.devices() if d["usable"]])
with vkh.Device() as device:  # or Device("gpu"), Device(0), Device("H100")
    solvers = {name: vkh.Solver(vb, faces, device=device) for name, vb in levels.items()}
    for name, solver in solvers.items():
        r = solver.distance(va, faces, field=True, on_progress=tell)
        print(name, r.interval, r.gap, r.witness.barycentric)
        r.field.save(f"{name}.ply")  # or .glb
