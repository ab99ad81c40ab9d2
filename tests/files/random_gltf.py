"""Random glTF scenes with hidden nodes and escaped names, with the triangles that are to be read from each.

The expected result is computed from the description that the document is written from; no code is
shared with the program.
"""

import base64
import dataclasses
import json
import math
import struct
import urllib.parse

from random_mesh import TURNS, affine, compose, moved, random_triangles

# Name files beneath a document; the URI of each escapes its characters or leaves them.
NAMES = ["data.bin", "a b.bin", "Gehäuse.bin", "part 10%.bin", "50%25.bin", "a%20b.bin", "%41.bin", "日本.bin", "😀.bin",
         "it's (1).bin", "a+b&c=d.bin", "in side/x.bin", "deep/er/ü.bin", '"quoted".bin', "tab %09.bin"]
QUATERNIONS = [(0, 0, 0, 1), (0, 0, math.sqrt(0.5), math.sqrt(0.5)), (math.sqrt(0.5), 0, 0, math.sqrt(0.5)), (0, 0, 1, 0)]


@dataclasses.dataclass
class Node:
    mesh: int = None
    turn: int = None        # of TURNS and QUATERNIONS
    place: tuple = None
    visible: bool = None    # None: it does not say
    is_matrix: bool = False
    children: list = dataclasses.field(default_factory=list)


class Expected:
    """The expected result for a scene: triangles, a note, the files beneath it; or a refusal."""

    def __init__(self, scene, is_all):
        self.is_all, self.triangles, self.refusals, self.files, self.hidden = is_all, [], set(), set(), 0
        for root in scene.roots:
            self._use(scene, root, None, False)
        if not self.triangles:
            self.refusals.add("without a face")

    def note(self):
        if self.hidden == 0:
            return None
        what = f"{self.hidden} hidden node{'s' if self.hidden > 1 else ''} and what is below"
        return f"bodies: {'included, though not shown' if self.is_all else 'left out'}: {what}"

    def _use(self, scene, number, outer, is_counted):
        node = scene.nodes[number]
        if node.visible is False:
            self.hidden += not is_counted
            is_counted = True
            if not self.is_all:
                return
        place = compose(outer, node.place)
        if node.mesh is not None:
            self.triangles += [moved(place, t) for t in scene.meshes[node.mesh]]
            name = scene.buffers[scene.buffer_of[node.mesh]]
            if name is not None:
                self.files.add(name)
        for child in node.children:
            self._use(scene, child, place, is_counted)


class Scene:
    """A random scene: files() has its document and what lies beneath it."""

    def __init__(self, random):
        self.random = random
        self.meshes = [random_triangles(random, random.choice((1, 2, 3, 5, 12))) for _ in range(random.randint(1, 4))]
        self.is_glb = random.random() < 0.3
        count = random.randint(1, 2)
        # None: embedded.
        self.buffers = [None if random.random() < 0.3 else name for name in random.sample(NAMES, count)]
        self.buffer_of = [random.randrange(count) for _ in self.meshes]
        self.nodes = [self._node() for _ in range(random.randint(1, 10))]
        self.roots, order = [], list(range(len(self.nodes)))
        random.shuffle(order)
        for i, number in enumerate(order):
            if i == 0 or random.random() < 0.3:
                self.roots.append(number)
            else:
                self.nodes[random.choice(order[:i])].children.append(number)

    def _node(self):
        random = self.random
        made = Node(mesh=random.randrange(len(self.meshes)) if random.random() < 0.7 else None,
                    visible=random.choice((None, None, None, True, False)))
        if random.random() < 0.7:
            made.is_matrix = random.random() < 0.3
            made.turn = random.randrange(len(TURNS))
            made.place = affine(random, TURNS[made.turn])
        return made

    # The files.

    def files(self, stem):
        """(the document's name, the bytes of all files by name): some lie there to be mistaken for others."""
        binaries = self._binaries()
        document = self._document(binaries)
        files = {}
        for name, binary in zip(self.buffers, binaries):
            if name is None:
                continue
            files[name] = bytes(binary)
            if self.random.random() < 0.5:
                self._add_decoy(files, name, len(binary))
        if not self.is_glb:
            mark = b"\xef\xbb\xbf" if self.random.random() < 0.2 else b""
            return f"{stem}.gltf", {**files, f"{stem}.gltf": mark + document.encode()}
        text, data = document.encode(), bytes(binaries[0]) if self.buffers[0] is None else b""
        text += b" " * (-len(text) % 4)
        data += b"\0" * (-len(data) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        if data:
            chunks += struct.pack("<I4s", len(data), b"BIN\0") + data
        return f"{stem}.glb", {**files, f"{stem}.glb": b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks}

    def _add_decoy(self, files, name, size):
        """A file of the name as its URI writes it: the one with percents resolved goes before it."""
        written = urllib.parse.quote(name)
        if written != name and written not in self.buffers:
            files.setdefault(written, b"\x7f" * size)

    def _binaries(self):
        self.views, binaries = [], [bytearray(b"head") for _ in self.buffers]  # a buffer is not empty
        for triangles, buffer in zip(self.meshes, self.buffer_of):
            corners = sorted({corner for t in triangles for corner in t})
            self.random.shuffle(corners)
            numbers = {corner: i for i, corner in enumerate(corners)}
            positions = b"".join(struct.pack("<3f", *corner) for corner in corners)
            code, component = self.random.choice((("B", 5121), ("H", 5123), ("I", 5125)))
            indices = b"".join(struct.pack("<" + code, numbers[corner]) for t in triangles for corner in t)
            self.views.append([(buffer, self._append(binaries[buffer], part), len(part), kind, count, shape)
                               for part, kind, count, shape in ((positions, 5126, len(corners), "VEC3"),
                                                                (indices, component, 3 * len(triangles), "SCALAR"))])
        return binaries

    def _append(self, binary, part):
        binary.extend(b"\0" * (-len(binary) % 4))
        binary.extend(part)
        return len(binary) - len(part)

    def _document(self, binaries):
        views, accessors, meshes = [], [], []
        for pair in self.views:
            for buffer, offset, size, kind, count, shape in pair:
                views.append({"buffer": buffer, "byteOffset": offset, "byteLength": size})
                accessors.append({"bufferView": len(views) - 1, "componentType": kind, "count": count, "type": shape})
            meshes.append({"name": "nodes", "primitives": [{"attributes": {"POSITION": len(accessors) - 2},
                                                            "indices": len(accessors) - 1}]})
        whole = {"asset": {"version": "2.0", "generator": '\u007f" \\ / 😀'}, "scenes": [{"nodes": self.roots}],
                 "nodes": [self._written(node) for node in self.nodes], "meshes": meshes, "accessors": accessors,
                 "bufferViews": views, "buffers": [self._buffer(i, b) for i, b in enumerate(binaries)]}
        if self.random.random() < 0.5:
            whole["scene"] = 0
        for key in ("extensionsUsed", "extensionsRequired"):
            if self.random.random() < 0.5:
                whole[key] = ["KHR_node_visibility"]
        members = list(whole.items())
        self.random.shuffle(members)
        return self._json(dict(members))

    def _buffer(self, number, binary):
        name, written = self.buffers[number], {"byteLength": len(binary)}
        if name is not None:
            written["uri"] = self._uri(name)
        elif number > 0 or not self.is_glb:
            written["uri"] = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
        return written

    def _uri(self, name):
        """Percents where they must be, and where they may; a writer that escapes nothing is read, too, if that is clear."""
        how = self.random.random()
        if how < 0.3 and urllib.parse.unquote(name) == name:
            return name
        if how < 0.6:
            return urllib.parse.quote(name)
        return "".join(urllib.parse.quote(c) if c in '%" ' or self.random.random() < 0.5 else c for c in name)

    def _written(self, node):
        members = {"name": 'KHR_node_visibility":{"visible":false'}
        if node.mesh is not None:
            members["mesh"] = node.mesh
        if node.children:
            members["children"] = node.children
        if node.visible is not None:
            members["extensions"] = {"KHR_node_visibility": {"visible": node.visible}}
        if node.place is not None:
            rows, last = node.place
            if node.is_matrix:
                members["matrix"] = [x for c in range(3) for x in (*(row[c] for row in rows), 0)] + [*last, 1]
            else:
                scale = max(abs(x) for x in rows[0])
                members |= {"translation": last, "rotation": QUATERNIONS[node.turn], "scale": [scale] * 3}
        shuffled = list(members.items())
        self.random.shuffle(shuffled)
        return dict(shuffled)

    def _json(self, value):
        """JSON with some characters of names and strings by their numbers."""
        if isinstance(value, dict):
            return "{" + ",".join(f"{self._string(key)}:{self._json(of)}" for key, of in value.items()) + "}"
        if isinstance(value, (list, tuple)):
            return "[" + ", ".join(self._json(of) for of in value) + "]"
        return self._string(value) if isinstance(value, str) else json.dumps(value)

    def _string(self, text):
        share = self.random.choice((0, 0, 0.1, 1)) if len(text) < 2000 else 0.01
        return '"' + "".join(self._character(c, share) for c in text) + '"'

    def _character(self, c, share):
        if self.random.random() < share:
            if c == "/" and self.random.random() < 0.5:
                return "\\/"
            units = c.encode("utf-16-be")
            return "".join(f"\\u{units[i]:02x}{units[i + 1]:02X}" for i in range(0, len(units), 2))
        return json.dumps(c, ensure_ascii=self.random.random() < 0.5)[1:-1]
