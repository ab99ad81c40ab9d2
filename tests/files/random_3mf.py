"""Random 3MF packages as slicers write them, with the triangles that are to be read from each.

The expected result is computed from the description that the package is written from. Its rules are
those of docs/formats.md and of the slicers' formats; no code is shared with the program.
"""

import dataclasses
import io
import xml.sax.saxutils
import zipfile

from random_mesh import affine, compose, moved, random_triangles

BODY, NEGATIVE, UNPRINTED = "body", "negative volume", "unprinted item"
# The order in which a note names them.
OTHERS = ("modifier", "support blocker", "support enforcer", NEGATIVE, "support object", "surface object", "other object",
          UNPRINTED)
PRUSA = {"ModelPart": BODY, "ParameterModifier": "modifier", "SupportBlocker": "support blocker",
         "SupportEnforcer": "support enforcer", "NegativeVolume": NEGATIVE}
BAMBU = {"normal_part": BODY, "modifier_part": "modifier", "support_blocker": "support blocker",
         "support_enforcer": "support enforcer", "negative_part": NEGATIVE}
CURA = {"infill_mesh": "modifier", "cutting_mesh": "modifier", "support_mesh": "support enforcer",
        "anti_overhang_mesh": "support blocker"}
TYPES = {"model": BODY, "support": "support object", "solidsupport": "support object", "surface": "surface object",
         "other": "other object"}
# The names of root parts: in the archive, and in the relationship that leads there.
ROOTS = [("3D/3dmodel.model", "/3D/3dmodel.model")] * 6 + [
    ("3D/a b.model", "/3D/a%20b.model"), ("3D/a b.model", "/3D/a b.model"), ("3D/100%.model", "/3D/100%.model"),
    ("3D/100%.model", "/3D/100%25.model"), ("3D/a%20b.model", "/3D/a%20b.model"), ("3D/Gehäuse.model", "/3D/Gehäuse.model"),
    ("3D/Gehäuse.model", "/3D/Geh%C3%A4use.model"), ("3D/a&b.model", "/3D/a&b.model"), ("3D/dot.model", "/3D/./dot.model")]
OTHER_PART = "/3D/Objects/object_1.model"
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"


@dataclasses.dataclass
class Volume:
    """Faces `first` to `last` of an object's mesh."""
    first: int
    last: int
    kind: str  # of PRUSA


@dataclasses.dataclass
class Object:
    id: int
    is_root: bool
    kind: str = "model"      # of TYPES
    cura: tuple = ()         # names and values of its settings
    triangles: list = dataclasses.field(default_factory=list)
    volumes: list = dataclasses.field(default_factory=list)
    uses: list = dataclasses.field(default_factory=list)      # components: (object, map)
    subtypes: dict = dataclasses.field(default_factory=dict)  # of BAMBU, by a component's id
    is_foreign: bool = False

    def role(self):
        for name, value in self.cura:
            if value in ("True", "true", "1"):
                return CURA[name]
        return TYPES[self.kind]

    def lacks_shape(self):
        return self.is_foreign or any(used.lacks_shape() for used, _ in self.uses)

    def face_count(self):
        return len(self.triangles) + sum(used.face_count() for used, _ in self.uses)


@dataclasses.dataclass
class Item:
    object: Object
    map: tuple
    printable: str  # "": the attribute is not there


class Expected:
    """The expected result for a package: triangles and a note, or one of some refusals."""

    def __init__(self, items, is_all):
        self.is_all, self.triangles, self.counts, self.refusals = is_all, [], {}, set()
        for item in items:
            is_printed = item.printable not in ("0", "false")
            self._use(item.object, item.map, item.object.role() if is_printed else UNPRINTED)
        if not self.triangles and not self.refusals:
            self.refusals.add("it has no bodies, only " if self.counts else "without a face")

    def note(self):
        if not self.counts:
            return None
        shapes = [f"{n} {what}{'s' if n > 1 else ''} ({faces} face{'s' if faces > 1 else ''})"
                  for what, (n, faces) in sorted(self.counts.items(), key=lambda entry: OTHERS.index(entry[0]))]
        return f"bodies: {'included, though not printed as body' if self.is_all else 'left out'}: {', '.join(shapes)}"

    def _count(self, what, faces):
        n, before = self.counts.get(what, (0, 0))
        if faces > 0:
            self.counts[what] = n + 1, before + faces

    def _use(self, used, place, role, is_counted=False):
        if role != BODY:
            if not is_counted:
                self._count(role, used.face_count())
            is_counted = True
            if not self.is_all:
                if role == NEGATIVE and used.face_count() > 0:
                    self.refusals.add("has a negative volume")
                return
        if used.lacks_shape():
            self.refusals.add("has a shape that is not read")
        kinds = [BODY] * len(used.triangles)
        for volume in used.volumes:
            what, count = PRUSA[volume.kind], volume.last + 1 - volume.first
            kinds[volume.first:volume.last + 1] = [what] * count
            if what != BODY and not is_counted:
                self._count(what, count)
            if what == NEGATIVE and not self.is_all:
                self.refusals.add("has a negative volume")
        self.triangles += [moved(place, t) for t, kind in zip(used.triangles, kinds) if kind == BODY or self.is_all]
        for below, own in used.uses:
            what = BAMBU[used.subtypes.get(below.id, "normal_part")]
            self._use(below, compose(place, own), below.role() if what == BODY else what, is_counted)


class Package:
    """A random package: .items describe its contents, bytes() is the file."""

    def __init__(self, random):
        self.random = random
        self.has_parts, self.is_bambu, self.is_prusa, self.is_cura = (random.random() < 0.4 for _ in range(4))
        # Most slicers write no negative volume; with many in each, hardly a package would be read.
        self.negative = random.choice((0, 0, 0, 0.2, 1))
        self.objects = []
        for id in range(1, random.randint(2, 9)):
            self.objects.append(self._leaf(id) if id == 1 or random.random() < 0.6 else self._composite(id))
        self.items = [Item(self._pick(self.objects, True), self._map(), random.choice(("", "", "", "1", "0", "false")))
                      for _ in range(random.randint(1, 4))]

    def _pick(self, objects, is_last):
        """Any of them, the later ones more often."""
        return objects[-1] if is_last and self.random.random() < 0.5 else self.random.choice(objects)

    def _map(self):
        return affine(self.random) if self.random.random() < 0.8 else None

    def _kind(self, kinds):
        names = [name for name in kinds if kinds[name] != NEGATIVE or self.random.random() < self.negative]
        return self.random.choice(names)

    def _leaf(self, id):
        made = Object(id, is_root=not self.has_parts or self.random.random() < 0.6)
        if self.random.random() < 0.03:
            made.is_foreign = True
            return made
        made.triangles = random_triangles(self.random, self.random.choice((0, 1, 2, 3, 5, 12)))
        self._add_kind(made)
        if self.is_prusa and made.is_root:
            made.volumes = self._volumes(len(made.triangles))
        return made

    def _composite(self, id):
        made = Object(id, is_root=True)
        below = self.random.choices(self.objects, k=self.random.randint(1, 3))
        made.uses = [(used, self._map()) for used in below]
        self._add_kind(made)
        if self.is_bambu:
            kinds = [self._kind(BAMBU)] * 3 if self.random.random() < 0.3 else [self._kind(BAMBU) for _ in below]
            made.subtypes = {used.id: kind for used, kind in zip(below, kinds) if self.random.random() < 0.7}
        return made

    def _add_kind(self, made):
        if self.random.random() < 0.15:
            made.kind = self.random.choice(list(TYPES))
        elif self.is_cura and self.random.random() < 0.5:
            made.cura = ((self.random.choice(list(CURA)), self.random.choice(("True", "true", "1", "False", "0"))),)

    def _volumes(self, count):
        """Some of the faces, in ranges that do not overlap, in any order."""
        volumes, first = [], 0
        while first < count:
            last = self.random.randint(first, count - 1)
            if self.random.random() < 0.8:
                volumes.append(Volume(first, last, self._kind(PRUSA)))
            first = last + 1
        self.random.shuffle(volumes)
        return volumes

    # The file.

    def bytes(self):
        root, target = self.random.choice(ROOTS)
        relation = ('<Relationship Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" '
                    f'Target={self._quoted(target)}/>')
        parts = {"_rels/.rels": '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
                                f"{relation}</Relationships>",
                 root: self._model(True)}
        if self.has_parts:
            parts[OTHER_PART[1:]] = self._model(False)
        if self.is_prusa:
            config = self._prusa_config()
            for name in self.random.choice((("Slic3r_PE",), ("Slic3r_PE", "SuperSlicer", "Slic3r"), ("SuperSlicer",), ("Slic3r",))):
                parts[f"Metadata/{name}_model.config"] = config
        if self.is_bambu:
            parts["Metadata/model_settings.config"] = self._bambu_config()
        names = list(parts)
        self.random.shuffle(names)
        packed = io.BytesIO()
        how = self.random.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))
        with zipfile.ZipFile(packed, "w", how) as archive:
            for name in names:
                archive.writestr(name, '<?xml version="1.0" encoding="UTF-8"?>\n' + parts[name])
        return packed.getvalue()

    def _quoted(self, text):
        """An attribute's value, some of its characters by their numbers."""
        text = xml.sax.saxutils.escape(text, {'"': "&quot;"})
        if self.random.random() < 0.2 and "&" not in text:
            text = "".join(f"&#x{ord(c):x};" if self.random.random() < 0.3 else c for c in text)
        return f'"{text}"'

    def _attributes(self, **named):
        return "".join(f" {name.replace('__', ':')}={self._quoted(str(value))}" for name, value in named.items())

    def _model(self, is_root):
        objects = "".join(self._object(o) for o in self.objects if o.is_root == is_root)
        items = "".join(f"<item{self._used(item.object, item.map, is_root)}"
                        f"{self._attributes(printable=item.printable) if item.printable else ''}/>"
                        for item in self.items) if is_root else ""
        unit = self._attributes(unit="millimeter") if self.random.random() < 0.5 else ""
        production = f' xmlns:p="{PRODUCTION}" requiredextensions="p"' if self.has_parts else ""
        return (f'<model xmlns="{CORE}" xmlns:cura="urn:cura"{production}{unit}><metadata name="cura:infill_mesh">True</metadata>'
                f"<resources>{objects}</resources><!-- {'<item/>' * 2} --><build>{items}</build></model>")

    def _used(self, used, place, is_root):
        text = self._attributes(objectid=used.id)
        if is_root and not used.is_root:
            text += self._attributes(p__path=OTHER_PART)
        if place is not None:
            rows, last = place
            numbers = [rows[r][c] for c in range(3) for r in range(3)] + list(last)
            text += self._attributes(transform=" ".join(self._number(x) for x in numbers))
        return text

    def _number(self, x):
        return self.random.choice((repr(x), f"{x:.4f}", f"{x:e}"))

    def _object(self, made):
        kind = self._attributes(type=made.kind) if made.kind != "model" or self.random.random() < 0.3 else ""
        inside = ""
        if made.cura:
            settings = "".join(f'<metadata name="cura:{name}" preserve="1" type="xs:string">{value}</metadata>'
                               for name, value in made.cura)
            inside += f"<metadatagroup>{settings}</metadatagroup>"
        if made.is_foreign:
            inside += '<b:booleanshape xmlns:b="urn:b" objectid="1"/>'
        elif made.uses:
            inside += f"<components>{''.join(f'<component{self._used(o, m, made.is_root)}/>' for o, m in made.uses)}</components>"
        else:
            inside += self._mesh(made.triangles)
        return f"<object{self._attributes(id=made.id)}{kind}>{inside}</object>"

    def _mesh(self, triangles):
        corners = sorted({corner for t in triangles for corner in t})
        self.random.shuffle(corners)
        numbers = {corner: i for i, corner in enumerate(corners)}
        vertices = "".join(f"<vertex{self._attributes(x=self._number(x), y=self._number(y), z=self._number(z))}/>"
                           for x, y, z in corners)
        faces = "".join(f"<triangle{self._attributes(**{f'v{i + 1}': numbers[t[i]] for i in range(3)})}/>" for t in triangles)
        return f"<mesh><vertices>{vertices}</vertices><triangles>{faces}</triangles></mesh>"

    def _prusa_config(self):
        objects = ""
        for made in self.objects:
            if not made.is_root:
                continue
            volumes = "".join(f"<volume{self._attributes(firstid=v.first, lastid=v.last)}>{self._volume_type(v)}</volume>"
                              for v in made.volumes)
            objects += f'<object{self._attributes(id=made.id)}><metadata type="object" key="modifier" value="1"/>{volumes}</object>'
        return f"<config>{objects}</config>"

    def _volume_type(self, volume):
        name = f'<metadata type="volume" key="name" value={self._quoted(self.random.choice(("a&b", "ParameterModifier", "%41")))}/>'
        if volume.kind == "ParameterModifier" and self.random.random() < 0.5:  # as before there were types
            return name + '<metadata type="volume" key="modifier" value="1"/>'
        if volume.kind == "ModelPart" and self.random.random() < 0.3:
            return name
        return name + f'<metadata type="volume" key="volume_type" value={self._quoted(volume.kind)}/>'

    def _bambu_config(self):
        objects = ""
        for made in self.objects:
            parts = "".join(f'<part{self._attributes(id=id, subtype=kind)}><metadata key="name" value="negative_part"/></part>'
                            for id, kind in made.subtypes.items())
            objects += f'<object{self._attributes(id=made.id)}><metadata key="name" value="x"/>{parts}</object>'
        return f"<config>{objects}</config>"
