"""GLB files of one mesh: with floats, and quantized, whose positions may be packed as EXT_meshopt_compression has it."""

import json
import struct

FLOAT, SHORT, INT = 5126, 5123, 5125  # componentType: float32, uint16, uint32


def container(document, data):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(data), len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data


def document_of(vertices, faces, kind, node):
    """A document whose view 0 has the positions and view 1 the corners; both views are still to be made."""
    low, high = ([pick(axis) for axis in zip(*vertices)] for pick in (min, max))
    accessors = [{"bufferView": 0, "componentType": kind, "count": len(vertices), "type": "VEC3", "min": low, "max": high},
                 {"bufferView": 1, "componentType": INT, "count": 3 * len(faces), "type": "SCALAR"}]
    return {"asset": {"version": "2.0"}, "accessors": accessors, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "nodes": [{"mesh": 0, **node}], "scenes": [{"nodes": [0]}], "scene": 0}


def view(offset, size, **more):
    return {"buffer": 0, "byteOffset": offset, "byteLength": size, **more}


def as_glb(vertices, faces):
    """The mesh in float32."""
    points, corners = (b"".join(struct.pack(form, *row) for row in rows) for form, rows in (("<3f", vertices), ("<3I", faces)))
    document = document_of(vertices, faces, FLOAT, {})
    document["buffers"] = [{"byteLength": len(points + corners)}]
    document["bufferViews"] = [view(0, len(points)), view(len(points), len(corners))]
    return container(document, points + corners)


def quantized(vertices, bits):
    """Whole numbers below 2^bits for each vertex, the step between two of them, and where 0 lies."""
    low = [min(axis) for axis in zip(*vertices)]
    step = max(max(axis) - least for axis, least in zip(zip(*vertices), low)) / (2 ** bits - 1)
    return [[round((x - least) / step) for x, least in zip(vertex, low)] for vertex in vertices], step, low


def packed(rows, stride):
    """The rows as mode ATTRIBUTES of EXT_meshopt_compression: each byte's differences, zigzag, in groups of 16 that are
    left out where all are 0, and stand as they are otherwise. The first row ends the stream."""
    out, before, block = b"\xa0", rows[0], min(8192 // stride // 16 * 16, 256)
    for start in range(0, len(rows), block):
        part = rows[start:start + block]
        for k in range(stride):
            column = [before[k], *(row[k] for row in part)]
            differences = [(new - old + 128) % 256 - 128 for old, new in zip(column, column[1:])]
            signless = bytes(2 * d if d >= 0 else -2 * d - 1 for d in differences) + bytes(-len(part) % 16)
            groups = [signless[i:i + 16] for i in range(0, len(signless), 16)]
            modes = [3 if any(group) else 0 for group in groups] + [0] * (-len(groups) % 4)
            out += bytes(a + 4 * b + 16 * c + 64 * d for a, b, c, d in zip(*[iter(modes)] * 4))
            out += b"".join(group for group in groups if any(group))
        before = part[-1]
    return out + bytes(max(32 - stride, 0)) + rows[0]


def as_quantized_glb(vertices, faces, bits, is_packed):
    """The mesh by KHR_mesh_quantization, its node scaled by the step."""
    numbers, step, low = quantized(vertices, bits)
    rows = [struct.pack("<3Hxx", *row) for row in numbers]
    points = packed(rows, 8) if is_packed else b"".join(rows)
    size = len(points)
    points += bytes(-size % 4)
    corners = b"".join(struct.pack("<3I", *face) for face in faces)
    document = document_of(numbers, faces, SHORT, {"translation": low, "scale": [step] * 3})
    document["buffers"] = [{"byteLength": len(points + corners)}]
    document["bufferViews"] = [view(0, 8 * len(rows), byteStride=8), view(len(points), len(corners))]
    document["extensionsRequired"] = ["KHR_mesh_quantization"]
    if is_packed:
        document["extensionsRequired"].append("EXT_meshopt_compression")
        document["buffers"].append({"byteLength": 8 * len(rows), "extensions": {"EXT_meshopt_compression": {"fallback": True}}})
        document["bufferViews"][0]["buffer"] = 1
        document["bufferViews"][0]["extensions"] = {"EXT_meshopt_compression": {
            "buffer": 0, "byteOffset": 0, "byteLength": size, "byteStride": 8, "count": len(rows), "mode": "ATTRIBUTES"}}
    return container(document, points + corners)
