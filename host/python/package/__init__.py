"""Certified Hausdorff distance between triangle meshes, on the GPU (Vulkan)."""

from vkhausdorff._core import DeviceError, Result, Solver, __version__, distance

__all__ = ["DeviceError", "Result", "Solver", "__version__", "distance"]
