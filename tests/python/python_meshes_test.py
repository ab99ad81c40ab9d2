#!/usr/bin/env python3
"""read() of the Python module, and all other forms of a mesh. Run through ctest."""
import base64
import gc
import itertools
import json
import os
import pathlib
import pickle
import tempfile
import types
import unittest

import numpy as np
import vkhausdorff as vkh

from python_distances_test import B, PAIRS, obj


class Meshes(unittest.TestCase):
    def test_read(self):
        a, b = PAIRS[3]
        with tempfile.TemporaryDirectory() as folder:
            file = obj(folder, "ü a.obj", a)
            file.write_text(file.read_text() + "v 9 9 9\nf 1 2 3 4\n")
            for polygons in ({}, {"polygons": "refuse"}):
                with self.assertRaisesRegex(ValueError, f"face {len(a[1])}: an outline that crosses itself"):
                    vkh.read(file, **polygons)
            with self.assertRaisesRegex(ValueError, "^polygons.*expected "):
                vkh.read(file, polygons="all")
            self.assertIsInstance(next(vkh.distances([(file, b)])).error, ValueError)
            self.assertIsNone(next(vkh.distances([(file, b)], polygons="fan")).error)
            mesh = vkh.read(file, polygons="fan")
            self.assertEqual(repr(vkh.read(str(file), polygons="fan")), repr(mesh))
        self.assertEqual((mesh.vertices.dtype, mesh.faces.dtype), (np.float64, np.uint32))
        self.assertTrue((mesh.vertices == a[0]).all())
        self.assertEqual(len(mesh.faces), len(a[1]) + 2)
        self.assertEqual((mesh.path, mesh.unit, mesh.delta), (str(file), None, 0))
        self.assertEqual((mesh.counts["unreferenced"], mesh.counts["polygons"], mesh.counts["faces"]), (1, 1, len(a[1]) + 2))
        self.assertTrue(any(note.startswith("polygons: ") for note in mesh.notes), mesh.notes)
        for array in (mesh.vertices, mesh.faces):
            with self.assertRaises(ValueError):
                array[0] = 1
            with self.assertRaises(ValueError):
                array.setflags(write=True)
        vertices = mesh.vertices
        again = pickle.loads(pickle.dumps(mesh))
        for name in ("path", "unit", "delta", "counts", "notes"):
            self.assertEqual(getattr(again, name), getattr(mesh, name))
        expected = vkh.distance(mesh.vertices, mesh.faces, *b)
        for other in (mesh, again):
            self.assertEqual(vkh.distance(other, b), expected)
        del mesh
        gc.collect()
        self.assertTrue((vertices == a[0]).all())  # which has kept it

    def test_bodies(self):
        triangle = base64.b64encode(np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]).tobytes()).decode()
        hidden = {"mesh": 0, "translation": [0, 0, 9], "extensions": {"KHR_node_visibility": {"visible": False}}}
        scene = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, hidden],
                 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
                 "bufferViews": [{"buffer": 0, "byteLength": 36}],
                 "buffers": [{"byteLength": 36, "uri": "data:;base64," + triangle}]}
        b = np.float64([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.uint32([[0, 1, 2]])
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "scene.gltf"
            file.write_text(json.dumps(scene))
            for bodies, count, fate in (({}, 1, "left out"), ({"bodies": "solid"}, 1, "left out"), ({"bodies": "all"}, 2, "included")):
                mesh = vkh.read(file, **bodies)
                self.assertEqual(len(mesh.faces), count)
                self.assertTrue(mesh.notes[0].startswith(f"bodies: {fate}"), mesh.notes)
                self.assertEqual(next(vkh.distances([(file, b)], **bodies)).lower > 8.9, count == 2)
            with self.assertRaisesRegex(ValueError, "^bodies.*expected "):
                vkh.read(file, bodies="none")

    def test_points(self):
        random = np.random.default_rng(40)
        points = random.uniform(-1, 1, (50, 3))
        b = np.float64([[-9, -9, 0], [9, -9, 0], [0, 9, 0]]), np.uint32([[0, 1, 2]])
        heights = np.abs(points[:, 2])
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "scan.xyz"
            file.write_text("".join("{!r} {!r} {!r}\n".format(*p) for p in points.tolist()))
            with self.assertRaisesRegex(ValueError, "points, no faces.*; points=True measures points, 'b' those of the second mesh"):
                vkh.read(file)
            with self.assertRaisesRegex(ValueError, "points=True measures points"):
                vkh.distance(file, b)
            with self.assertRaisesRegex(TypeError, "^a: expected a mesh, such as .vertices, faces.; of points alone points=True says so$"):
                vkh.distance(points, b)
            with self.assertRaisesRegex(TypeError, "^b: expected a mesh.*points='b' says so$"):
                vkh.distance(b, points)
            with self.assertRaisesRegex(TypeError, "'vb' is missing"):
                vkh.distance(points, b[1])
            clouds = vkh.read(file, points=True), vkh.read(points, points=True)
            by_name = next(vkh.distances([(file, b)], points="a", tol=1e-6))
            self.assertIsInstance(next(vkh.distances([(file, b)])).error, ValueError)
            with self.assertRaisesRegex(ValueError, "points: expected True for a, 'a', 'b' or 'both'"):
                vkh.distances([(file, b)], points="c")
            with_b = next(vkh.distances([file], against=b, points=True, tol=1e-6))
            self.assertTrue(with_b.lower <= heights.max() <= with_b.upper)
            with self.assertRaisesRegex(ValueError, "faces in a file of points"):
                vkh.read(obj(folder, "mesh.obj", PAIRS[0][0]), points=True)
        again = pickle.loads(pickle.dumps(clouds[0]))
        for cloud in (*clouds, again):
            self.assertTrue(cloud.are_points)
            self.assertTrue((cloud.vertices == points).all())
            self.assertTrue((cloud.faces == np.arange(50)[:, None]).all())
            r = vkh.distance(cloud, b, statistics=True, max_distance=0.5)
            self.assertEqual((r.lower, r.upper), (by_name.lower, by_name.upper))
            self.assertTrue(r.lower <= heights.max() <= r.upper)
            self.assertEqual((r.survey.points, r.survey.area), (50, 0))
            kept = heights[heights <= 0.5]
            self.assertTrue(r.survey.kept.lower <= len(kept) / 50 <= r.survey.kept.upper)
            self.assertTrue(r.survey.mean.lower <= kept.mean() <= r.survey.mean.upper)
        self.assertIn("50 points", repr(clouds[1]))
        for wrong, kind in ((np.zeros((3, 2)), ValueError), (np.zeros((0, 3)), ValueError), (np.full((1, 3), np.nan), ValueError), ("no file", OSError)):
            with self.assertRaises(kind):
                vkh.read(wrong, points=True)
        with self.assertRaises(TypeError):
            vkh.read(points)
        with self.assertRaisesRegex(ValueError, "no sides"):
            vkh.distance(b, clouds[0], signed=True)

    def test_arrays_of_points(self):
        """An array is the same cloud as read() makes of it, wherever a mesh goes."""
        random = np.random.default_rng(41)
        points = random.uniform(-1, 1, (60, 3))
        vb, fb = np.float64([[-9, -9, 0], [9, -9, 0], [0, 9, 0]]), np.uint32([[0, 1, 2]])
        b, cloud = (vb, fb), vkh.read(points, points=True)
        truth = vkh.distance(cloud, b, field=True, statistics=True)
        ends = (truth.lower, truth.upper)
        holder = type("PointCloud", (), {"vertices": points})()
        of_pyvista = type("PolyData", (), {"points": points, "regular_faces": np.zeros((0, 3), int)})()
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "scan.xyz"
            file.write_text("".join("{!r} {!r} {!r}\n".format(*p) for p in points.tolist()))
            forms = (points, points.tolist(), cloud, holder, of_pyvista, file, str(file))
            for a, side in zip(forms, itertools.cycle((True, "a"))):
                r = vkh.distance(a, b, points=side)
                self.assertEqual((r.lower, r.upper), ends)
                self.assertEqual(vkh.gate(a, b, 2.0, points=side).verdict, "pass")
            vkh.assert_within(points, b, 2.0, points=True)
            for found in vkh.distances([(a, b) for a in forms], points=True, tol=1e-6):
                self.assertEqual((found.lower, found.upper), ends)
            proof = pathlib.Path(folder) / "out.vhc"
            vkh.distance(points, b, points=True, certificate=proof)
            self.assertGreater(proof.stat().st_size, 100)
        self.assertEqual((vkh.distance(points, None, vb, fb, points=True).lower), ends[0])
        r = vkh.distance(points, b, points=True, field=True, statistics=True)
        self.assertTrue((r.field.upper == truth.field.upper).all())
        self.assertEqual((r.survey.points, r.survey.mean.lower), (60, truth.survey.mean.lower))
        with vkh.Solver(b) as solver:
            r = solver.distance(points, points=True)
            self.assertTrue(r.lower <= np.abs(points[:, 2]).max() <= r.upper)
            with self.assertRaisesRegex(ValueError, "B is the Solver's"):
                solver.distance(points, points="both")
        both = vkh.distance(points, points + [0, 0, 0.5], points="both", tol=1e-3)
        nearest = np.linalg.norm(points[:, None] - (points + [0, 0, 0.5])[None], axis=2).min(axis=1).max()
        self.assertTrue(both.lower <= nearest * (1 + 1e-12) and nearest <= both.upper * (1 + 1e-12))
        back = vkh.distance(b, points, points="b", tol=1e-2)
        self.assertGreater(back.upper, 7)
        self.assertEqual(np.shape(vkh.align(points, b, points=True).matrix), (4, 4))
        mesh = vb + [0, 0, 1], fb
        for a, message in (((vb, fb), "points|shape|array"), (type("Mesh", (), {"vertices": vb, "faces": fb})(), "va: expected points alone"),
                           (np.zeros((0, 3)), "no point"), (np.full((1, 3), np.nan), "not finite")):
            with self.assertRaisesRegex(ValueError, message):
                vkh.distance(a, b, points=True)
        with tempfile.TemporaryDirectory() as folder:
            whole = vkh.read(obj(folder, "mesh.obj", mesh))
            with self.assertRaisesRegex(ValueError, "a: a Mesh with faces"):
                vkh.gate(whole, b, 1.0, points=True)
        with self.assertRaises(TypeError):
            vkh.distance(points, b)
        with self.assertRaises(TypeError):
            vkh.distance(points, b, points=1)

    def test_faces_of_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "mixed.obj"
            file.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 2 3 4\nf 1 2\nf 1 3 4\n")
            mixed = vkh.read(file)
            triangles = vkh.read(obj(folder, "a.obj", PAIRS[0][0]))
        for mesh, numbers in ((mixed, [0, 1, 1, 3]), (triangles, list(range(len(triangles.faces))))):
            for one in (mesh, pickle.loads(pickle.dumps(mesh))):
                self.assertEqual(one.file_faces.dtype, np.uint32)
                self.assertEqual(one.file_faces.tolist(), numbers)
            with self.assertRaises(ValueError):
                mesh.file_faces[0] = 1
        state = mixed.__getstate__()
        for runs in ([[9, 1]], [[2, 0]], [1, 2]):
            with self.assertRaises(ValueError):
                vkh.Mesh.__new__(vkh.Mesh).__setstate__((*state[:8], np.array(runs, np.uint32), *state[9:]))

    def test_pickles_keep_how_polygons_became_triangles(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "concave.obj"
            file.write_text("v 0 0 0\nv 4 0 0\nv 1 1 0.5\nv 0 4 0\nv 9 9 9\nf 1 2 5\nf 2 3 4 1\n")
            mesh = vkh.read(file)
        state = mesh.__getstate__()
        again = pickle.loads(pickle.dumps(mesh)).__getstate__()
        clipped, fanned, first, kind, ambiguity, face, triangulations, is_any = state[9]
        self.assertEqual((clipped, fanned, face, len(triangulations), is_any), (1, 0, 1, 1, False))
        self.assertGreater(ambiguity, 0)
        self.assertEqual(again[9][:6], state[9][:6])
        (number, corners, axis, triangles), (*numbers, others) = triangulations[0], again[9][6][0]
        self.assertEqual((numbers, others.tolist()), ([number, corners, axis], triangles.tolist()))
        for wrong in ((1, 3, 2, triangles[:1]), (1, 4, 4, triangles), (1, 4, 2, triangles + np.uint32(2)), (1, 4, 2, triangles[:1]), (1, 4, 3, triangles)):
            with self.assertRaises(ValueError):
                vkh.Mesh.__new__(vkh.Mesh).__setstate__((*state[:9], (*state[9][:6], [wrong], False), *state[10:]))

    def test_any_triangulation(self):
        """The interval is wider by what polygons leave open, and figures are refused. That this holds every triangulation: polygon_test.cpp."""
        triangle = (np.array([[0, 0, 1], [1, 0, 1], [0, 1, 1.0]]), [[0, 1, 2]])
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "bent.obj"
            file.write_text("v 0 0 0\nv 1 0 0.1\nv 1 1 0\nv 0 1 0.1\nf 1 2 3 4\n")
            plain, mesh = vkh.read(file), vkh.read(file, polygons="any")
            self.assertTrue(0.1 <= mesh.delta < 0.2 and mesh.notes[1].endswith("the interval is wider by it"), mesh.notes)
            ours, bare = vkh.distance(mesh, triangle), vkh.distance(plain, triangle)
            self.assertTrue(ours.lower < bare.lower and bare.upper < ours.upper)
            for more in ({"statistics": True}, {"certificate": pathlib.Path(folder) / "c.vhc"}):
                with self.assertRaisesRegex(ValueError, "of one triangulation, and polygons of any were asked for"):
                    vkh.distance(mesh, triangle, **more)
                with self.assertRaisesRegex(ValueError, "of one triangulation"):
                    vkh.distance(triangle, mesh, **more)
            self.assertIsNotNone(vkh.distance(mesh, triangle, field=True, effort=100).field)
            kept = pickle.loads(pickle.dumps(mesh))
            with self.assertRaisesRegex(ValueError, "of one triangulation"):
                vkh.distance(kept, triangle, statistics=True)

    def test_wherever_a_mesh_goes(self):
        a, b = PAIRS[4]
        expected, gated = vkh.distance(*a, *b), vkh.gate(a, b, 0.1)
        with vkh.Solver(*b) as solver:
            prepared = solver.distance(*a)
        with tempfile.TemporaryDirectory() as folder:
            files = obj(folder, "a.obj", a), str(obj(folder, "b.obj", b))
            meshes = tuple(map(vkh.read, files))
            objects = types.SimpleNamespace(vertices=a[0], faces=a[1]), types.SimpleNamespace(vertices=b[0], triangles=b[1])
            forms = (files, meshes, objects, (a, b), (files[0], b))
            for r in vkh.distances(forms):
                self.assertEqual(r, expected)
            for x, y in forms:
                self.assertEqual(vkh.distance(x, y), expected)
                self.assertEqual(vkh.gate(x, y, 0.1), gated)
            for x, y in (files, objects):
                self.assertEqual(next(vkh.distances([x], against=y)), prepared)
                with vkh.Solver(y) as solver:
                    self.assertEqual(solver.distance(x), prepared)
            vkh.assert_within(*files, 10)
        both = vkh.distance(meshes[0], meshes[0], symmetric=True, field=True)
        self.assertEqual((len(both.field), len(both.field_back)), 2 * (len(a[1]),))

    def test_delta_is_in_the_interval(self):
        # A rotation of a scene is rounded: arrays do not know it, a Mesh does.
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "turned.gltf"
            file.write_text(gltf(*PAIRS[0][0]))
            mesh = vkh.read(file)
        self.assertEqual(mesh.unit, "m")
        self.assertGreater(mesh.delta, 0)
        self.assertEqual(pickle.loads(pickle.dumps(mesh)).delta, mesh.delta)
        known, bare = vkh.distance(mesh, B), vkh.distance((mesh.vertices, mesh.faces), B)
        self.assertLess(known.lower, bare.lower)
        self.assertGreater(known.upper, bare.upper)

    def test_meshes_of_other_libraries(self):
        points, faces = np.array(B[0]), np.array(B[1])
        plain = vkh.distance(PAIRS[0][0], B)
        as_cells = types.SimpleNamespace(points=points, cells_dict={"triangle": faces, "line": np.array([[0, 1]])})
        as_regular = types.SimpleNamespace(points=points, regular_faces=faces, n_strips=0)
        for mesh in (as_cells, as_regular):
            self.assertEqual(vkh.distance(PAIRS[0][0], mesh), plain)
            self.assertEqual(vkh.Solver(mesh).distance(PAIRS[0][0]), plain)
            self.assertEqual(next(vkh.distances([(PAIRS[0][0], mesh)])), plain)
        quad = types.SimpleNamespace(points=points, cells_dict={"triangle": faces, "quad": np.array([[0, 1, 2, 3]])})
        strips = types.SimpleNamespace(points=points, regular_faces=faces, n_strips=1)
        fours = types.SimpleNamespace(points=points, regular_faces=np.array([[0, 1, 2, 3]]), n_strips=0)
        for mesh, said in ((quad, "^b: expected triangles, not cells of type quad: "), (strips, "^b: expected triangles, not strips: "),
                           (fours, "^b: expected triangles, not polygons: ")):
            with self.assertRaisesRegex(ValueError, said):
                vkh.gate(B, mesh, 1)
        with self.assertRaisesRegex(TypeError, "^b: expected .vertices, faces., .*meshio"):
            vkh.gate(B, types.SimpleNamespace(points=points, cells_dict={"line": np.array([[0, 1]])}), 1)

    def test_meshio(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("meshio is missing")
        with tempfile.TemporaryDirectory() as folder:
            file = obj(folder, "a.obj", PAIRS[0][0])
            read = meshio.read(file)
            self.assertEqual(vkh.distance(read, B), vkh.distance(PAIRS[0][0], B))

    def test_vtk(self):
        try:
            from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
            from vtkmodules.vtkCommonCore import vtkPoints
            from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
        except ImportError:
            self.skipTest("VTK is missing")

        def poly_data(rows):
            points, cells = vtkPoints(), vtkCellArray()
            points.SetData(numpy_to_vtk(np.array(PAIRS[0][0][0], dtype=np.float64), deep=True))
            flat = np.concatenate([[len(row), *row] for row in rows])
            cells.SetCells(len(rows), numpy_to_vtkIdTypeArray(flat.astype(np.int64), deep=True))
            mesh = vtkPolyData()
            mesh.SetPoints(points)
            mesh.SetPolys(cells)
            return mesh

        rows = np.array(PAIRS[0][0][1]).tolist()
        self.assertEqual(vkh.distance(poly_data(rows), B), vkh.distance(PAIRS[0][0], B))
        with self.assertRaisesRegex(ValueError, "polygons: use vtkTriangleFilter"):
            vkh.distance(poly_data([*rows, [0, 1, 2, 3]]), B)

    def test_what_is_no_mesh_is_named(self):
        points, faces = B
        duck, headless = types.SimpleNamespace(vertices=points), types.SimpleNamespace(faces=faces)
        strange = [(None, "None$"), (5, "a value of type int$"), (object(), "a value of type object$"),
                   (duck, "SimpleNamespace that has .vertices and neither .faces nor .triangles$"),
                   (types.SimpleNamespace(vertices=points, faces=None), "neither .faces nor .triangles$"),
                   (headless, "SimpleNamespace that has faces and no .vertices$")]
        with vkh.Solver(B) as solver:
            for given, said in strange:
                calls = [("a", lambda: vkh.distance(given, B)), ("b", lambda: vkh.distance(B, given)), ("a", lambda: vkh.gate(given, B, 1)),
                         ("b", lambda: vkh.gate(B, given, 1)), ("b", lambda: vkh.Solver(given)), ("a", lambda: solver.distance(given)),
                         ("a", lambda: vkh.metrics(given, B)), ("a", lambda: vkh.align(given, B))]
                for name, call in calls:
                    with self.subTest(said, name=name), self.assertRaisesRegex(TypeError, f"^{name}: expected .vertices, faces.*, not .*{said}"):
                        call()
        with self.assertRaisesRegex(ValueError, "^A's vertices: None; expected an array"):
            vkh.distance(None, faces, points, faces)
        self.assertIsInstance(vkh.distance(duck, B, points=True), vkh.Result)

    def test_masks_of_numpy_hide_nothing_in_silence(self):
        points, faces = map(np.array, B)
        voxels = np.zeros((4, 4, 4), dtype=bool)
        voxels[1:3, 1:3, 1:3] = True

        def masked(values, hides=True):
            made = np.ma.array(values, mask=np.zeros(np.shape(values), dtype=bool))
            made.mask.flat[0] = hides
            return made

        uses = {"A's vertices": (points, lambda x: vkh.distance((x, faces), B)), "A's faces": (faces, lambda x: vkh.distance((points, x), B)),
                "B's vertices": (points, lambda x: vkh.distance(points, faces, x, faces)),
                "points": (points, lambda x: vkh.closest(B, x)), "max": (np.ones(len(faces)), lambda x: vkh.gate(B, B, x)),
                "transform": (np.eye(4), lambda x: vkh.distance(B, B, transform=x)), "a": (voxels, lambda x: vkh.metrics(x, voxels, effort=100)),
                "spacing": (np.ones(3), lambda x: vkh.metrics(voxels, voxels, spacing=x, effort=100)),
                "affine": (np.eye(4), lambda x: vkh.metrics(voxels, voxels, affine=x, effort=100))}
        for name, (values, use) in uses.items():
            with self.subTest(name):
                use(masked(values, hides=False))  # it hides nothing
                for given in (masked(values), list(masked(values))):
                    if isinstance(given, list) and values.ndim != 2:
                        continue
                    with self.assertRaisesRegex(ValueError, f"^{name}: a mask hides 1 of its values; expected an array without a mask"):
                        use(given)

    def test_refusals(self):
        with tempfile.TemporaryDirectory() as folder:
            bad = pathlib.Path(folder) / "bad.stl"
            bad.write_text("solid x\n facet\n")
            locked = pathlib.Path(folder) / "locked.stl"
            locked.write_text("")
            locked.chmod(0)
            cases = [(bad, ValueError, "bad.stl"), ("nonesuch.stl", FileNotFoundError, "nonesuch"),
                     (folder, IsADirectoryError, None), ("a\0b", ValueError, "^path: expected"), ("", ValueError, "^path: expected"),
                     (5, TypeError, "^path: expected"), (None, TypeError, "^path: expected")]
            if os.getuid() != 0:
                cases.append((locked, PermissionError, "locked"))
            for path, kind, said in cases:
                with self.assertRaisesRegex(kind, said or ""):
                    vkh.read(path)
        with tempfile.TemporaryDirectory() as folder:
            file = obj(folder, "a.obj", PAIRS[0][0])
            self.assertEqual(len(vkh.read(file, max_input="1M").faces), len(PAIRS[0][0][1]))
            with self.assertRaisesRegex(ValueError, "a.obj"):
                vkh.read(file, max_input=100)
            self.assertIsInstance(next(vkh.distances([(file, B)], max_input="0.1K")).error, ValueError)
            for wrong, kind in ((0, ValueError), ("x", ValueError), (1.5, TypeError)):
                with self.assertRaisesRegex(kind, "^max_input.*expected "):
                    vkh.read(file, max_input=wrong)
        with self.assertRaisesRegex(TypeError, "No constructor"):
            vkh.Mesh()
        with self.assertRaisesRegex(TypeError, "was never made"):
            vkh.Mesh.__new__(vkh.Mesh).vertices
        with self.assertRaisesRegex(TypeError, "'vb' is missing"):
            vkh.distance(B[0], B[1])
        with self.assertRaises(ValueError):
            vkh.Mesh.__new__(vkh.Mesh).__setstate__((1, 2))


def gltf(vertices, faces):
    points, corners = vertices.astype("<f4").tobytes(), faces.astype("<u4").tobytes()
    uri = "data:application/octet-stream;base64," + base64.b64encode(points + corners).decode()
    low, high = vertices.astype("<f4").min(0).tolist(), vertices.astype("<f4").max(0).tolist()
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "rotation": [0.1, 0.2, 0.3, 0.9273618495495703]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(points) + len(corners), "uri": uri}],
        "bufferViews": [{"buffer": 0, "byteLength": len(points)},
                        {"buffer": 0, "byteOffset": len(points), "byteLength": len(corners)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(vertices), "type": "VEC3", "min": low, "max": high},
                      {"bufferView": 1, "componentType": 5125, "count": 3 * len(faces), "type": "SCALAR"}]})


if __name__ == "__main__":
    unittest.main()
