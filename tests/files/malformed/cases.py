"""The parts of the corpus: files, and a reader's expected action for each."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    content: bytes
    expected: str  # 'R': refused in one line that names the file; 'A4': accepted with 4 faces; 'Q', 'P4': the same as points
    says: str  # words of the refusal or a note; '' if any will do


class Cases(list):
    """The cases of one format. Text may be given as str; its characters are bytes."""

    def __init__(self, extension):
        super().__init__()
        self.extension = extension

    def refuse(self, name, content, says=''):
        self._add(name, content, 'R', says)

    def accept(self, name, faces, content, says=''):
        self._add(name, content, f'A{faces}', says)

    def refuse_points(self, name, content, says=''):
        self._add('points_' + name, content, 'Q', says)

    def accept_points(self, name, points, content, says=''):
        self._add('points_' + name, content, f'P{points}', says)

    def _add(self, name, content, expected, says):
        if isinstance(content, str):
            content = content.encode('latin-1')
        self.append(Case(f'{self.extension}_{name}.{self.extension}', content, expected, says))


def utf16(text):
    """Little-endian, without a byte order mark."""
    return text.encode('utf-16le')


# A tetrahedron, which most cases spoil in one place.
POSITIONS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
# The same as rows of OFF and of ASCII PLY.
VERTEX_ROWS = ''.join('%d %d %d\n' % p for p in POSITIONS)
FACE_ROWS = ''.join('3 %d %d %d\n' % f for f in FACES)


def with_suffix(rows, suffix):
    """Each row with more words behind it."""
    return ''.join(f'{row} {suffix}\n' for row in rows.splitlines())
