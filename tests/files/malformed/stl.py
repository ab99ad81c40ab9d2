"""STL: binary by its size, text by its words; no triangle behind the last one counted."""

import math
import struct

from cases import FACES, POSITIONS, Cases, utf16


def triangle(corners, attribute=0, normal=(0, 0, 0)):
    coordinates = [x for corner in corners for x in corner]
    return struct.pack('<12fH', *normal, *coordinates, attribute)


TRIANGLES = [triangle([POSITIONS[i] for i in face]) for face in FACES]
BODY = b''.join(TRIANGLES)


def binary(count, body, header=b''):
    return header.ljust(80, b'\0')[:80] + struct.pack('<I', count) + body


def facet(face):
    vertices = ''.join('vertex %g %g %g\n' % POSITIONS[i] for i in face)
    return f'facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n'


TEXT = 'solid a\n' + ''.join(facet(face) for face in FACES) + 'endsolid a\n'


def binary_counts(cases):
    cases.accept('binary', 4, binary(4, BODY))
    cases.accept('binary_litter', 4, binary(4, BODY + b'litter'), '6 bytes after the last triangle')
    signature = b'\n2024-03-04 12:33:11.000000 1.0 2.0 3.0 4.0 1234567 '
    cases.accept('binary_signature', 4, binary(4, BODY + signature), 'after the last triangle')
    cases.accept('binary_text_behind', 4, binary(4, BODY + b'garbage\0' * 9),
                 '72 bytes after the last')
    cases.accept('binary_sentences_behind', 4, binary(4, BODY + b'Exported by some program. ' * 10))
    cases.accept('binary_zeros_behind', 4, binary(4, BODY + bytes(4096)))
    cases.refuse('binary_one_too_many', binary(5, BODY), '5 triangles announced, 4 present')
    cases.refuse('binary_one_too_few', binary(3, BODY), '3 triangles announced, 4 present')
    behind = 'a triangle after the last one announced'
    for name, stray in {'one': b'\n', 'forty_nine': bytes(49), 'word': b'end'}.items():
        for count in (1, 3):
            cases.refuse(f'binary_{count}_of_4_{name}_behind', binary(count, BODY + stray), behind)
            body = BODY[:50 * count] + stray + BODY[50 * count:]
            cases.refuse(f'binary_{count}_of_4_{name}_between', binary(count, body), behind)
    cases.refuse('binary_far_triangle_behind', binary(4, BODY + b'x' + triangle(
        [(1000, 0, 0), (1001, 0, 0), (1000, 1, 0)])), behind)
    cases.refuse('binary_none_announced', binary(0, BODY))
    cases.refuse('binary_none_announced_and_litter', binary(0, BODY + b'x'))
    cases.refuse('binary_empty', binary(0, b''), 'the file ends without a face')
    cases.refuse('binary_greatest_count', binary(0xffffffff, BODY))
    cases.refuse('binary_80_million', binary(0x05000000, BODY))
    cases.refuse('binary_cut', binary(4, BODY[:-1]))
    for size in (0, 5, 79, 80, 83):
        cases.refuse(f'zeros_{size}', bytes(size))


def binary_bodies(cases):
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    cases.refuse('binary_nan', binary(1, triangle([(math.nan, 0, 0)] + corners[1:])))
    cases.refuse('binary_infinite', binary(1, triangle([(0, -math.inf, 0)] + corners[1:])))
    cases.accept('binary_nan_normal', 1, binary(1, triangle(corners, 0, (math.nan, math.inf, 0))))
    cases.accept('binary_denormal', 1, binary(1, triangle([(1e-45, 0, 0)] + corners[1:])))
    cases.accept('binary_largest', 1, binary(1, triangle([(3.4e38, 0, 0), (-3.4e38, 0, 0),
                                                          (0, 1, 0)])))
    attributes = b''.join(t[:48] + b'\xff\xff' for t in TRIANGLES)
    cases.accept('binary_attributes', 4, binary(4, attributes))
    cases.accept('binary_degenerate', 2, binary(2, triangle([(1, 1, 1)] * 3) * 2))
    cluster = [(1, 1, 1), (1 + 2**-23, 1, 1), (1, 1 + 2**-23, 1)]
    cases.accept('binary_cluster', 20000, binary(20000, triangle(cluster) * 20000))


def binary_headers(cases):
    cases.accept('solid_binary', 4, binary(4, BODY, b'solid foo'))
    cases.accept('solid_binary_line_end', 4, binary(4, BODY + b'\n', b'solid foo'))
    cases.refuse('solid_binary_cut', binary(4, BODY[:-1], b'solid foo'))
    blank = b''.join(t.replace(b'\0', b' ') for t in TRIANGLES)  # of the exact size, no zero byte
    cases.accept('solid_binary_no_zero', 4, binary(4, blank, b'solid '.ljust(80)))
    cases.accept('gzip_magic', 4, binary(4, BODY, b'\x1f\x8b'))
    cases.accept('not_utf8', 4, binary(4, BODY, b' solid \xff\xfe\xe9'))


def text(cases):
    def spoiled(old, new):
        return TEXT.replace(old, new, 1)

    accepted = {
        'plain': (4, TEXT), 'upper': (4, TEXT.upper()), 'cr': (4, TEXT.replace('\n', '\r')),
        'crlf': (4, TEXT.replace('\n', '\r\n')), 'two_solids': (8, TEXT + TEXT),
        'empty_solid_first': (4, 'solid a\nendsolid a\n' + TEXT),
        'empty_solid_last': (4, TEXT + 'solid b\nendsolid b\n'),
        'nameless': (4, TEXT.replace('solid a\n', 'solid\n')),
        'name_of_keywords': (4, spoiled('solid a', 'solid facet normal')),
        'name_of_vertex': (4, spoiled('solid a', 'solid vertex 0 0 0')),
        'chinese_name': (4, TEXT.replace('solid a', 'solid \xe6\x9c\x88')),
        'nan_normal': (4, spoiled('normal 0 0 0', 'normal nan nan nan')),
        'beyond_float': (4, spoiled('vertex 1 0 0', 'vertex 1e39 0 0')),  # no type to contradict
        'below_least_double': (4, spoiled('vertex 1 0 0', 'vertex 1 1e-400 -1e-400')),
        'blank_first': (4, '\n\n  ' + TEXT), 'byte_order_mark': (4, '\xef\xbb\xbf' + TEXT),
        'zero_byte': (4, TEXT + '\0'), 'ctrl_z': (4, TEXT + '\x1a'),
        'colour': (4, spoiled('facet normal', 'color 1 0 0\nfacet normal')),
        'glued_end': (4, TEXT.replace('endsolid a', 'endsolida')),
        'split_end': (4, TEXT.replace('endloop', 'end loop')),
        'solid_twice': (4, 'solid\n' + TEXT + 'endsolid\n'),
        'long_name': (4, spoiled('solid a', 'solid ' + 'y' * 5000000)),
    }
    for name, (faces, content) in accepted.items():
        cases.accept(f'text_{name}', faces, content)
    vertex = 'vertex 1 0 0'
    refused = {
        'no_end': TEXT.replace('endsolid a\n', ''), 'cut': TEXT[:-60],
        'junk_behind': TEXT + 'junk\n',
        'facet_behind': TEXT + facet(FACES[0]),
        'four_vertices': spoiled('endloop', 'vertex 5 5 5\nendloop'),
        'two_vertices': spoiled('vertex 0 0 0\n', ''),
        'nan': spoiled(vertex, 'vertex nan 0 0'), 'comma': spoiled(vertex, 'vertex 0,5 0 0'),
        'hex': spoiled(vertex, 'vertex 0x1 0 0'),
        'beyond_double': spoiled(vertex, 'vertex 1e309 0 0'),
        'short_normal': spoiled('normal 0 0 0', 'normal 0 0'),
        'zero_byte_inside': spoiled('endloop', 'endloop\0'),
        'four_numbers': spoiled(vertex, vertex + ' 9'),
        'split_vertex': spoiled(vertex, 'vertex 1\n0 0'),
        'utf16': b'\xff\xfe' + utf16(TEXT), 'solid_only': 'solid', 'no_facet': 'solid\nendsolid\n',
        'glued_words': spoiled('endfacet\nfacet', 'endfacetfacet'),
    }
    for name, content in refused.items():
        cases.refuse(f'text_{name}', content)


def text_without_line_ends(cases):
    """Text on the line of a solid's name would be lost in it."""
    hidden = "'endfacet'; expected a facet to begin on a line of its own"
    one_line = TEXT.replace('\n', ' ')
    cases.refuse('text_one_line', one_line, hidden)
    cases.refuse('text_first_facet_on_name', TEXT.replace(facet(FACES[0]), '', 1).replace(
        'solid a\n', 'solid a ' + facet(FACES[0]).replace('\n', ' ') + '\n', 1), hidden)
    cases.refuse('text_second_solid_on_name', TEXT[:-1] + ' ' + one_line + '\n', hidden)
    inside = 'a carriage return inside the line'
    cases.refuse('text_cr_after_lf', TEXT + TEXT.replace('\n', '\r'), inside)
    cases.refuse('text_cr_in_name', TEXT.replace('solid a\n', 'solid a\r', 1), 'a line feed inside')


def all_cases():
    cases = Cases('stl')
    cases.refuse_points('text', TEXT, 'an STL file, of which points are not read; expected points as PLY')
    for part in (binary_counts, binary_bodies, binary_headers, text, text_without_line_ends):
        part(cases)
    cases.accept('is_ply', 4, 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n'
                 'property float y\nproperty float z\nelement face 4\n'
                 'property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n'
                 '3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n')
    return cases
