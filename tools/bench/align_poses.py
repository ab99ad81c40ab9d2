#!/usr/bin/env python3
"""Fits of scans in random poses: how many come back, and how exactly.

usage: PYTHONPATH=OUT/host/python tools/bench/align_poses.py PAIRS [--poses 10] [--noise 0.001] [--kinds whole,half20,half]
       tools/bench/align_poses.py --time FILE        one mesh against itself, moved: seconds of a second fit
PAIRS is the folder of the public meshes. A scan is a mesh whose vertices are moved by normal noise, its deviation along
each axis `noise` of the diagonal, and then posed: whole, anywhere; half of its faces (on one side of a plane) turned by
up to 20 degrees and moved by up to 5 % of the diagonal; or half of them, anywhere. The error of a fit is the root mean
square distance of the scan's vertices, without their noise, from where they were. A fit is back if that is under a tenth
of the noise's deviation. Seeds are fixed. The meshes: sculpted and scanned ones of 15,000 vertices or more without a
symmetry, since fewer do not average the noise to a tenth of itself.
"""
import argparse
import pathlib
import time

import numpy as np
import vkhausdorff as vkh

MESHES = ("alecjacobson_stanford-bunny.ply", "alecjacobson_nefertiti.ply", "alecjacobson_igea__vcg50.ply",
          "odedstein_scorpion.ply", "odedstein_mountain.ply", "pyvista_Grey_Nurse_Shark.ply", "cnr-isti-vclab_lato000.ply",
          "ghd_beast.ply", "thingi10k_64764_norm.ply", "thingi10k_252119.ply")


def turn_of(q):
    x, y, z, w = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def turn_about(axis, angle):
    return turn_of(np.append(axis / np.linalg.norm(axis) * np.sin(angle / 2), np.cos(angle / 2)))


def half_of(points, faces, rng):
    height = points[faces].mean(1) @ rng.normal(size=3)
    kept = faces[height <= np.median(height)]
    used, rows = np.unique(kept, return_inverse=True)
    return used, rows.reshape(kept.shape)


def scan_of(points, faces, kind, noise, rng):
    """The scan, its faces, and the places of its vertices before and after the pose, without noise."""
    diagonal = np.linalg.norm(points.max(0) - points.min(0))
    rows = np.arange(len(points))
    if kind != "whole":
        rows, faces = half_of(points, faces, rng)
    if kind == "half20":
        turn, shift = turn_about(rng.normal(size=3), np.radians(rng.uniform(0, 20))), rng.uniform(-1, 1, 3) * 0.05 * diagonal
    else:
        turn, shift = turn_of(rng.normal(size=4)), rng.normal(size=3) * diagonal
    centre, truth = points.mean(0), points[rows]
    moved = lambda p: (p - centre) @ turn.T + centre + shift
    return moved(truth + rng.normal(size=truth.shape) * noise * diagonal), faces, truth, moved(truth)


def error_of(matrix, truth, posed):
    off = posed @ matrix[:3, :3].T + matrix[:3, 3] - truth
    return np.sqrt((off * off).sum(1).mean())


def measure(args):
    for kind in args.kinds.split(","):
        back = near = told = 0
        for name in MESHES:
            mesh = vkh.read(pathlib.Path(args.pairs) / name)
            points, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
            errors, seconds = [], []
            for pose in range(args.poses):
                scan, of_scan, truth, posed = scan_of(points, faces, kind, args.noise, np.random.default_rng([pose, 7]))
                start = time.time()
                fit = vkh.align((scan, of_scan), mesh)
                seconds.append(time.time() - start)
                deviation = args.noise * np.linalg.norm(points.max(0) - points.min(0))
                errors.append(error_of(fit.matrix, truth, posed) / deviation)
                told += errors[-1] > 1 and (fit.poor or fit.rival is not None)
            back += sum(e < 0.1 for e in errors)
            near += sum(e < 1 for e in errors)
            print(f"{kind} {name}: {sum(e < 0.1 for e in errors)} of {args.poses} back, {sum(e < 1 for e in errors)} within the "
                  f"noise, median error {np.median(errors):.3f}, largest {max(errors):.3g}, {np.median(seconds):.1f} s", flush=True)
        print(f"{kind}: {back} of {args.poses * len(MESHES)} back, {near} within the noise, {told} of the others told by a note",
              flush=True)


def time_one(path):
    mesh = vkh.read(path)
    points, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    scan, of_scan, truth, posed = scan_of(points, faces, "whole", 0.001, np.random.default_rng(1))
    for run in range(4):
        start = time.time()
        fit = vkh.align((scan, of_scan), mesh)
        print(f"{len(faces)} faces, run {run}: {time.time() - start:.3f} s, error {error_of(fit.matrix, truth, posed):.3g}, {fit}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("pairs", nargs="?")
    parser.add_argument("--poses", type=int, default=10)
    parser.add_argument("--noise", type=float, default=0.001)
    parser.add_argument("--kinds", default="whole,half20,half")
    parser.add_argument("--time", metavar="FILE")
    args = parser.parse_args()
    if args.time:
        time_one(args.time)
    else:
        measure(args)


if __name__ == "__main__":
    main()
