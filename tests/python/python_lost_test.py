#!/usr/bin/env python3
"""A Python program whose device is lost (docs/test_layer.md): a DeviceError, and the next call opens it anew. Run through ctest."""
import os
import textwrap
import unittest

from python_lives import Lives

LAYER = os.environ.get("VKH_LAYER_FOLDER", "")

# lose() arms the layer for the next calls, and resets its counts.
HELPERS = '''
import ctypes
layer = ctypes.CDLL(os.environ["VKH_LAYER_FOLDER"] + "/libVkLayer_vkh_test.so")
layer.vkhLayerArm.restype = ctypes.c_bool
layer.vkhLayerCount.restype = ctypes.c_uint64

def lose(*faults):
    text = ",".join(f"{fault}:VK_ERROR_DEVICE_LOST" for fault in faults)
    assert layer.vkhLayerArm(text.encode()), text

def injected():
    return layer.vkhLayerInjected()

def ends(r):
    return r.lower, r.upper, r.status, r.closed

LOST = "the device was lost; the next call opens a device anew"
'''


@unittest.skipIf(not LAYER, "no test layer")
class Lost(Lives):
    def lost(self, program):
        first = ("import os; os.environ.update(VK_LAYER_PATH=os.environ['VKH_LAYER_FOLDER'] + ':/usr/share/vulkan/explicit_layer.d', "
                 "VK_INSTANCE_LAYERS='VK_LAYER_VKH_test', NODEVICE_SELECT='1', VKH_LAYER_KEEP_GOING='1')\n")
        self.lives(HELPERS + textwrap.dedent(program), first=first)

    def test_distance_works_again(self):
        self.lost("""
            true = ends(vkh.distance(va, fa, vb, fb))
            for call in ("vkQueueSubmit:1", "vkQueueSubmit:2", "vkWaitForFences:1", "vkWaitForFences:2"):
                lose(call)
                raises(vkh.DeviceError, LOST, lambda: vkh.distance(va, fa, vb, fb))
                assert injected() == 1, call
                assert ends(vkh.distance(va, fa, vb, fb)) == true, call
            print("done")
        """)

    def test_a_solver_keeps_its_mesh(self):
        self.lost("""
            s = vkh.Solver(vb, fb)
            true = ends(s.distance(va, fa))
            for call in ("vkQueueSubmit:1", "vkWaitForFences:1"):
                lose(call)
                raises(vkh.DeviceError, LOST, lambda: s.distance(va, fa))
                assert ends(s.distance(va, fa)) == true, call
                assert ends(vkh.Solver(vb, fb).distance(va, fa)) == true, call
            s.close()
            raises(ValueError, "this Solver is closed", lambda: s.distance(va, fa))
            print("done")
        """)

    def test_closest_points_of_several_devices(self):
        self.lost("""
            points = np.random.default_rng(1).uniform(-1, 2, (20000, 3))
            s = vkh.Solver(vb, fb, "0,0")
            rows = lambda: [x.tolist() for x in s.closest(points)]
            true = rows()
            for call in ("vkQueueSubmit:1", "vkQueueSubmit:3", "vkWaitForFences:2"):
                lose(call)
                assert rows() == true, call  # the other device does it
                assert injected() == 1 and layer.vkhLayerCount(b"vkCreateDevice") == 0, call
                assert rows() == true, call
                assert layer.vkhLayerCount(b"vkCreateDevice") == 2, call  # both were opened anew
            lose("vkQueueSubmit:1+")
            raises(vkh.DeviceError, LOST, rows)
            lose()
            assert rows() == true
            print("done")
        """)

    def test_a_shared_device_prepares_all_of_its_meshes_again(self):
        self.lost("""
            with vkh.Device() as d:
                s, t = vkh.Solver(vb, fb, device=d), vkh.Solver(va, fa, device=d)
                true = ends(s.distance(va, fa)), ends(t.distance(vb, fb))
                lose("vkQueueSubmit:1")
                raises(vkh.DeviceError, LOST, lambda: s.distance(va, fa))
                assert (ends(s.distance(va, fa)), ends(t.distance(vb, fb))) == true
                assert layer.vkhLayerCount(b"vkCreateDevice") == 1
                lose("vkQueueSubmit:1")
                raises(vkh.DeviceError, LOST, lambda: vkh.Solver(vb, fb, device=d))
                t.close()
                assert ends(s.distance(va, fa)) == true[0]
                assert ends(vkh.Solver(va, fa, device=d).distance(vb, fb)) == true[1]
            print("done")
        """)

    def test_lost_at_any_submission(self):
        self.lost("""
            calls = {"symmetric": lambda: ends(vkh.distance(va, fa, vb, fb, symmetric=True)),
                     "gate": lambda: vkh.gate((va, fa), (vb, fb), 0.05).verdict,
                     "field": lambda: ends(vkh.distance(va, fa, vb, fb, field=0.05, survey_time=None))}
            for name, call in calls.items():
                lose()
                true = call()
                submissions = layer.vkhLayerCount(b"vkQueueSubmit")
                assert submissions > 0, name
                for n in sorted({1, 2, submissions // 2 + 1, submissions}):
                    lose(f"vkQueueSubmit:{n}")
                    raises(vkh.DeviceError, LOST, call)
                    assert call() == true, (name, n)
            print("done")
        """)

    def test_lost_again_while_it_is_opened_and_for_good(self):
        self.lost("""
            true = ends(vkh.distance(va, fa, vb, fb))
            s = vkh.Solver(vb, fb)
            prepared = ends(s.distance(va, fa))
            lose("vkQueueSubmit:1+")
            for again in range(3):
                raises(vkh.DeviceError, LOST, lambda: s.distance(va, fa))
                raises(vkh.DeviceError, LOST, lambda: vkh.distance(va, fa, vb, fb))
            raises(vkh.DeviceError, "the device was lost", lambda: vkh.Solver(vb, fb))
            lose("vkCreateDevice:1")
            raises(vkh.DeviceError, LOST, lambda: s.distance(va, fa))
            lose()
            assert ends(s.distance(va, fa)) == prepared
            assert ends(vkh.distance(va, fa, vb, fb)) == true
            print("done")
        """)

    def test_other_errors_keep_the_device(self):
        self.lost("""
            true = ends(vkh.distance(va, fa, vb, fb))
            layer.vkhLayerArm(b"vkQueueSubmit:1:VK_ERROR_OUT_OF_DEVICE_MEMORY")
            raises(vkh.DeviceError, "out of device memory", lambda: vkh.distance(va, fa, vb, fb))
            assert ends(vkh.distance(va, fa, vb, fb)) == true
            assert layer.vkhLayerCount(b"vkCreateDevice") == 0
            print("done")
        """)

    def test_exits_with_a_device_that_is_lost(self):
        self.lost("""
            s = vkh.Solver(vb, fb)
            lose("vkQueueSubmit:1+")
            raises(vkh.DeviceError, LOST, lambda: s.distance(va, fa))
            raises(vkh.DeviceError, "the device was lost", lambda: vkh.distance(va, fa, vb, fb))
            print("done")
        """)

    def test_threads_share_a_device_that_is_lost(self):
        self.lost("""
            s = vkh.Solver(vb, fb)
            true = ends(s.distance(va, fa))
            lose("vkQueueSubmit:5")
            found, lost = [], []
            def work():
                for again in range(4):
                    try:
                        found.append(ends(s.distance(va, fa)))
                    except vkh.DeviceError as error:
                        lost.append(str(error))
            threads = [threading.Thread(target=work) for _ in range(3)]
            [t.start() for t in threads]
            [t.join() for t in threads]
            assert len(lost) == 1 and LOST in lost[0], lost
            assert found == [true] * 11, found
            print("done")
        """)


if __name__ == "__main__":
    unittest.main()
