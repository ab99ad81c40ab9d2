"""PLY: the header is understood whole, the body has the rows that it announces, and no others."""

import math
import struct

from cases import FACE_ROWS, FACES, POSITIONS, VERTEX_ROWS, Cases, utf16, with_suffix

LITTLE = 'binary_little_endian'
BIG = 'binary_big_endian'
XYZ = ['property float x', 'property float y', 'property float z']
CORNERS = 'property list uchar int vertex_indices'
VERTEX = ['element vertex 4'] + XYZ
FACE = ['element face 4', CORNERS]
ONE_FACE = ['element face 1', CORNERS]


def ply(encoding, lines, body='', before=()):
    """A file; `before` are header lines between format and elements."""
    header = '\n'.join(['ply', f'format {encoding} 1.0', *before, *lines, 'end_header', ''])
    return header.encode('latin-1') + (body if isinstance(body, bytes) else body.encode('latin-1'))


def floats(*values, order='<'):
    return struct.pack(f'{order}{len(values)}f', *values)


def binary_vertices(order='<'):
    return b''.join(floats(*p, order=order) for p in POSITIONS)


def binary_faces(order='<'):
    return b''.join(struct.pack(f'{order}B3i', 3, *f) for f in FACES)


V = binary_vertices()
F = binary_faces()
ASCII = ply('ascii', VERTEX + FACE, VERTEX_ROWS + FACE_ROWS)
BINARY = ply(LITTLE, VERTEX + FACE, V + F)


def header_counts(cases):
    accepted = {'plus': '+4', 'blank': ' 4', 'zero': '04'}
    refused = ('-1 -9223372036854775808 9223372036854775807 9223372036854775808 '
               '18446744073709551615 18446744073709551616 4294967296 4294967300 2147483648 '
               '4294967295 1000000000000 1e3 4.0 0x4 four').split() + ['', '4 5']
    for name, word in accepted.items():
        cases.accept(f'count_{name}_vertices', 4,
                     ply('ascii', [f'element vertex {word}'] + XYZ + FACE, VERTEX_ROWS + FACE_ROWS))
        cases.accept(f'count_{name}_binary_faces', 4,
                     ply(LITTLE, VERTEX + [f'element face {word}', CORNERS], V + F))
    for i, word in enumerate(refused):
        cases.refuse(f'count_refused_{i}_vertices',
                     ply('ascii', [f'element vertex {word}'] + XYZ + FACE, VERTEX_ROWS + FACE_ROWS),
                     'line ')
        cases.refuse(f'count_refused_{i}_binary_faces',
                     ply(LITTLE, VERTEX + [f'element face {word}', CORNERS], V + F))


def rows_and_counts(cases):
    """A part never passes for the whole."""
    def counted(encoding, vertices, faces, body, name, says=''):
        header = [f'element vertex {vertices}'] + XYZ + [f'element face {faces}', CORNERS]
        cases.refuse(name, ply(encoding, header, body), says)

    rows = VERTEX_ROWS + FACE_ROWS
    more = 'a row more than announced'
    counted('ascii', 4, 2, rows, 'faces_too_few', more)
    counted('ascii', 4, 3, VERTEX_ROWS + FACE_ROWS[:-8] + 'note\n' + FACE_ROWS[-8:],
            'faces_too_few_after_a_note', more)
    counted('ascii', 4, 5, rows, 'faces_too_many', 'the file ends at face 4')
    counted('ascii', 3, 4, rows, 'vertices_too_few')
    counted('ascii', 5, 4, rows, 'vertices_too_many')
    counted('ascii', 5, 3, rows, 'vertex_for_face')
    counted('ascii', 3, 5, rows, 'face_for_vertex')
    generic = floats(*(0.1 + 0.37 * i for i in range(12)))
    for name, vertices in {'': V, '_generic': generic}.items():
        for encoding, body in {'little': vertices + F, 'padded': vertices + F + b'\0' * 64}.items():
            counted(LITTLE, 4, 2, body, f'{encoding}_faces_too_few{name}', 'after the last element')
            counted(LITTLE, 4, 3, body, f'{encoding}_face_too_few{name}', 'after the last element')
            counted(LITTLE, 5, 4, body, f'{encoding}_vertices_too_many{name}')
            counted(LITTLE, 5, 3, body, f'{encoding}_vertex_for_face{name}')
            counted(LITTLE, 3, 4, body, f'{encoding}_vertices_too_few{name}')
            counted(LITTLE, 3, 5, body, f'{encoding}_face_for_vertex{name}')
        counted(LITTLE, 4, 5, vertices + F, f'little_faces_too_many{name}')
    doubles = [f'property double {axis}' for axis in 'xyz']
    body = b''.join(struct.pack('<3d', *p) for p in POSITIONS) + F
    cases.accept('doubles', 4, ply(LITTLE, ['element vertex 4'] + doubles + FACE, body))
    cases.refuse('doubles_vertices_too_many',
                 ply(LITTLE, ['element vertex 5'] + doubles + FACE, body), 'no corners')
    big = binary_vertices('>') + binary_faces('>')
    counted(BIG, 5, 4, big, 'big_vertices_too_many')
    counted(BIG, 4, 3, big, 'big_face_too_few', 'after the last element')


def trailing(cases):
    note = 'after the last element ignored'
    cases.accept('binary_litter', 4, BINARY + b'garbage', '7 bytes ' + note)
    cases.accept('binary_blank_end', 4, BINARY + b'\r\n \t\0' * 20)
    cases.accept('ascii_blank_end', 4, ASCII + b'\n \t\r\n\n')
    cases.accept('ascii_words', 4, ASCII + b'junk 1 2\n', 'what follows the last row ignored')
    cases.refuse('ascii_number', ASCII + b'junk\n7\n', 'line 19: ')

    def ascii_faces(rows, vertices=VERTEX_ROWS):
        return ply('ascii', VERTEX + FACE, vertices + rows)

    words = 'with words behind a face'
    cases.accept('words_behind_faces', 4, ascii_faces(with_suffix(FACE_ROWS, '9 1 1 1 1 1 1 1 1 1')),
                 'unread: 4 lines ' + words + "'s properties, which were ignored, the first is line 14")
    cases.accept('words_behind_one_face', 4, ascii_faces(FACE_ROWS.replace('0 1 3', '0 1 3 red')),
                 'unread: 1 line ' + words + "'s properties, which were ignored, the first is line 15")
    cases.accept('words_behind_vertices', 4, ascii_faces(FACE_ROWS, with_suffix(VERTEX_ROWS, '7')),
                 "unread: 4 lines with words behind a vertex's properties, which were ignored, the first is line 10")
    cases.refuse('words_behind_one_vertex', ascii_faces(FACE_ROWS, VERTEX_ROWS.replace('0 1 0', '0 1 0 7')),
                 "line 12: 1 word behind the vertex's last property; expected 0, as in the first")
    cases.refuse('rows_begin_with_their_number', ascii_faces(FACE_ROWS, '0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n'),
                 'rows that begin with their number')
    # A face read as a vertex.
    cases.refuse('vertex_more_face_less', ply('ascii', ['element vertex 5'] + XYZ + ['element face 3', CORNERS],
                                              VERTEX_ROWS + FACE_ROWS), 'line 14: 1 word behind')
    cases.refuse('words_behind_a_short_face', ascii_faces(FACE_ROWS.replace('3 0 2 1', '2 0 2 1')), "line 14: '1'")
    # Two faces a line are one too few.
    cases.refuse('faces_glued', ascii_faces(FACE_ROWS.replace('\n', ' ', 1)), 'the file ends at face 3')
    edge = ['element edge 1', 'property int vertex1', 'property int vertex2']
    cases.refuse('words_behind_an_edge', ply('ascii', VERTEX + edge + ['element face 3', CORNERS],
                                             VERTEX_ROWS + FACE_ROWS), "line 17: '2'")
    for name, size in {'vertex': len(V) + len(F) - 53, 'list': len(V) + len(F) - 1,
                       'count': len(V) + 39, 'faces': len(V) + 12}.items():
        cases.refuse(f'cut_in_{name}', ply(LITTLE, VERTEX + FACE, (V + F)[:size]))


def list_counts(cases):
    codes = {'char': 'b', 'short': 'h', 'int': 'i', 'uint': 'I', 'ushort': 'H'}
    for kind, code in codes.items():
        header = VERTEX + ['element face 1', f'property list {kind} int vertex_indices']
        for count in (-1, 0, 1, 2, 3, 255, 1000000000, 2147483647, 4294967295):
            bodies = {'_ascii': ply('ascii', header, VERTEX_ROWS + f'{count} 0 2 1\n')}
            try:
                row = struct.pack(f'<{code}3i', count, 0, 2, 1)
                bodies['_binary'] = ply(LITTLE, header, V + row)
            except struct.error:
                pass  # no such count in that type
            for name, content in bodies.items():
                if count == 3:
                    cases.accept(f'list_{kind}_{count}{name}', 1, content)
                else:
                    cases.refuse(f'list_{kind}_{count}{name}', content)
    for kind, code in {'float': 'f', 'double': 'd'}.items():
        header = VERTEX + ['element face 1', f'property list {kind} int vertex_indices']
        cases.refuse(f'list_{kind}_ascii', ply('ascii', header, VERTEX_ROWS + '3 0 2 1\n'))
        cases.refuse(f'list_{kind}', ply(LITTLE, header, V + struct.pack(f'<{code}3i', 3, 0, 1, 2)))
    # Two bad faces among good ones, in text and binary.
    two = struct.pack('<B2i', 2, 0, 1)
    cases.accept('two_corners', 3, ply(LITTLE, VERTEX + FACE, V + F[:39] + two),
                 '1 face of fewer than three corners ignored')
    cases.accept('no_corners_ascii', 3, ASCII[:-8] + b'0\n', '1 face of fewer than three')
    cases.refuse('no_corners', ply(LITTLE, VERTEX + FACE, V + F[:39] + b'\0'),
                 'a face of no corners')
    cases.accept('quads', 2, ply('ascii', VERTEX + ONE_FACE, VERTEX_ROWS + '4 0 1 2 3\n'), 'polygons: 1 face')


def skipped_lists(cases):
    def skipped(kind, code, count):
        lines = ['element foo 1', f'property list {kind} double a'] + VERTEX + FACE
        return ply(LITTLE, lines, struct.pack(f'<{code}', count) + V + F)

    cases.accept('skipped_empty_list', 4, skipped('uint', 'I', 0))
    cases.refuse('skipped_huge_list', skipped('uint', 'I', 0xffffffff))
    cases.refuse('skipped_wrapping_list', skipped('uint', 'I', 0x20000000))
    cases.refuse('skipped_negative_list', skipped('int', 'i', -1))
    quintillion = ['element foo 1000000000000000000']
    cases.refuse('empty_rows', ply(LITTLE, quintillion + VERTEX + FACE, V + F))
    cases.accept('empty_rows_none', 4, ply(LITTLE, ['element foo 0'] + VERTEX + FACE, V + F))
    texture = 'property list uchar float texcoord'
    cases.accept('texture_list', 4, ply('ascii', VERTEX + FACE + [texture],
                                        VERTEX_ROWS + with_suffix(FACE_ROWS, '6 0 0 0 0 0 0')))
    cases.refuse('one_corner_and_texture', ply('ascii', VERTEX + ONE_FACE + [texture],
                                               VERTEX_ROWS + '1 0 6 0 0 0 0 0 0\n'))


def indices(cases):
    def one_face(kind, body, encoding=LITTLE):
        header = VERTEX + ['element face 1', f'property list uchar {kind} vertex_indices']
        return ply(encoding, header, (V if encoding == LITTLE else VERTEX_ROWS.encode()) + body)

    cases.refuse('index_negative', one_face('int', struct.pack('<B3i', 3, 0, -1, 2)))
    cases.refuse('index_beyond', one_face('int', struct.pack('<B3i', 3, 0, 4, 2)))
    cases.refuse('index_uint_greatest', one_face('uint', struct.pack('<B3I', 3, 0, 0xffffffff, 2)))
    cases.refuse('index_char_negative', one_face('char', struct.pack('<B3b', 3, 0, -1, 2)))
    cases.accept('index_ushort', 1, one_face('ushort', struct.pack('<B3H', 3, 0, 1, 2)))
    cases.refuse('index_wraps_32_bits', one_face('int', b'3 4294967296 2 1\n', 'ascii'))
    cases.refuse('index_as_float', one_face('int', b'3 0.0 2.0 1.0\n', 'ascii'))
    cases.refuse('index_of_float_type', one_face('float', b'3 0 2 1\n', 'ascii'))
    scalar = ['element face 4', 'property int vertex_indices']
    cases.refuse('index_scalar', ply('ascii', VERTEX + scalar, VERTEX_ROWS + '0\n1\n2\n3\n'))
    # A value has to be of its column's type.
    uchar = ['element face 1', 'property list uchar uchar vertex_indices']
    cases.refuse('index_302_in_uchar', ply('ascii', ['element vertex 400'] + XYZ + uchar,
                                           VERTEX_ROWS * 100 + '3 0 1 302\n'),
                 "line 410: 302 does not fit its column's type; expected 0 to 255")
    cases.accept('index_255_in_uchar', 1, ply('ascii', ['element vertex 400'] + XYZ + uchar,
                                              VERTEX_ROWS * 100 + '3 0 1 255\n'))
    limits = {'char': (-128, 127), 'uchar': (0, 255), 'short': (-32768, 32767),
              'ushort': (0, 65535), 'int': (-2**31, 2**31 - 1), 'uint': (0, 2**32 - 1)}
    for kind, (least, greatest) in limits.items():
        header = ['element vertex 4'] + [f'property {kind} {axis}' for axis in 'xyz'] + FACE
        rows = '0 0 1\n1 0 0\n0 1 0\n'
        cases.accept(f'integers_{kind}', 4,
                     ply('ascii', header, f'{least} {greatest} 0\n' + rows + FACE_ROWS))
        for name, word in {'below': least - 1, 'above': greatest + 1, 'half': '0.5',
                           'point': '1.0', 'exponent': '1e0'}.items():
            cases.refuse(f'integers_{kind}_{name}',
                         ply('ascii', header, rows + f'0 {word} 0\n' + FACE_ROWS), 'line 13: ')


def formats(cases):
    def header(old, new):
        return ASCII.replace(old, new, 1)

    cases.refuse('version_2', header(b'ascii 1.0', b'ascii 2.0'), "line 2: '2.0' as version")
    cases.refuse('version_none', header(b'ascii 1.0', b'ascii'), 'line 2: no version')
    cases.refuse('version_and_more', header(b'ascii 1.0', b'ascii 1.0 x'), "line 2: 'x'")
    cases.refuse('format_none', header(b'format ascii 1.0\n', b''))
    cases.refuse('format_twice', header(b'element vertex', b'format ' + LITTLE.encode() +
                                        b' 1.0\nelement vertex'), 'a second format line')
    cases.refuse('format_middle_endian', ply('binary_middle_endian', VERTEX + FACE, V + F))
    cases.accept('format_late', 4, header(b'format ascii 1.0\n', b'').replace(
        b'end_header', b'format ascii 1.0\nend_header'))
    cases.refuse('end_header_and_more', header(b'end_header', b'end_header foo'),
                 "line 9: 'foo' after a header's line")
    cases.refuse('magic_and_more', header(b'ply\n', b'ply x\n'), "line 1: 'x'")
    cases.refuse('property_and_more', header(b'float x\n', b'float x y\n'), "line 4: 'y'")
    cases.refuse('end_header_none', 'ply\nformat ascii 1.0\n')
    cases.refuse('end_header_last', ply('ascii', ['element vertex 0'] + XYZ +
                                        ['element face 0', CORNERS])[:-1])
    cases.accept('comments_end_nothing', 4, ply('ascii', VERTEX + FACE, VERTEX_ROWS + FACE_ROWS,
                                                ['comment end_header', 'obj_info end_header']))
    cases.refuse('upper_case', header(b'ply', b'PLY'))
    cases.accept('byte_order_mark', 4, b'\xef\xbb\xbf' + ASCII)
    cases.refuse('utf16', b'\xff\xfe' + utf16(ASCII.decode()))
    cases.refuse('unknown_keyword', ply('ascii', VERTEX + FACE, VERTEX_ROWS, ['foo bar']))
    cases.refuse('property_first', ply('ascii', XYZ))
    for name, line in {'half': 'property half w', 'int64': 'property list uchar int64 w',
                       'list_of_lists': 'property list list uchar int w',
                       'nameless': 'property list uchar int',
                       'element_nameless': 'element'}.items():
        cases.refuse(f'header_{name}',
                     ply('ascii', VERTEX + FACE + [line], VERTEX_ROWS + FACE_ROWS), 'line 9: ')
    cases.refuse('gzip', b'\x1f\x8b\x08\0' + bytes(200))
    cases.refuse('junk_in_header', header(b'property float y\n', b'property \0\0\0\xff y\n'))


def header_line_ends(cases):
    header = ply(LITTLE, VERTEX + FACE)
    crlf = header.replace(b'\n', b'\r\n')
    cases.accept('crlf', 4, ASCII.replace(b'\n', b'\r\n'))
    cases.accept('cr', 4, ASCII.replace(b'\n', b'\r'))
    cases.accept('crlf_binary', 4, crlf + V + F)
    cases.accept('cr_binary', 4, header.replace(b'\n', b'\r') + V + F)
    cases.accept('crlf_then_lf', 4, crlf[:-2] + b'\n' + V + F)
    cases.accept('lf_then_crlf', 4, header[:-1] + b'\r\n' + V + F)
    cases.refuse('cr_then_lf', b'ply\r' + BINARY[4:])
    cases.refuse('cr_in_comment', ply('ascii', VERTEX + FACE, VERTEX_ROWS + FACE_ROWS,
                                      ['comment a\robj_info b']), 'a carriage return inside')
    uchar = ['element vertex 3'] + [f'property uchar {axis}' for axis in 'xyz'] + [
        'element face 1', 'property list uchar uchar vertex_indices']
    cases.accept('body_begins_with_line_ends', 1,
                 ply(LITTLE, uchar, b'\n\r\n\0\0\0\1\1\1' + b'\3\0\1\2'))


def elements(cases):
    cases.refuse('vertex_twice', ply('ascii', VERTEX + VERTEX + FACE, VERTEX_ROWS * 2 + FACE_ROWS))
    cases.refuse('face_twice', ply('ascii', VERTEX + FACE + FACE, VERTEX_ROWS + FACE_ROWS * 2))
    cases.refuse('x_twice', ply('ascii', VERTEX + XYZ[:1] + FACE,
                                with_suffix(VERTEX_ROWS, '0') + FACE_ROWS))
    second = ['property list uchar int vertex_index']
    cases.refuse('corners_twice',
                 ply('ascii', VERTEX + FACE + second, VERTEX_ROWS + '3 0 2 1 3 0 2 1\n' * 4))
    listed = ['element vertex 4', 'property list uchar float x'] + XYZ[1:]
    cases.refuse('x_list', ply('ascii', listed + FACE, '1 0 0 0\n' * 4 + FACE_ROWS))
    cases.refuse('no_z', ply('ascii', VERTEX[:3] + FACE, '0 0\n' * 4 + FACE_ROWS))
    cases.refuse('no_face_element', ply('ascii', VERTEX, VERTEX_ROWS),
                 "line 7: 4 points and no element 'face'; expected a mesh")
    cases.refuse('no_elements', 'ply\nformat ascii 1.0\nend_header\n')
    cases.refuse('no_faces', ply('ascii', VERTEX + ['element face 0', CORNERS], VERTEX_ROWS),
                 '4 points and no face')
    cases.refuse('nothing', ply(LITTLE, ['element vertex 0'] + XYZ + ['element face 0', CORNERS]))
    cases.accept('face_first', 4, ply(LITTLE, FACE + VERTEX, F + V))
    strips = ['element tristrips 1', 'property list int int vertex_indices']
    cases.accept('strips', 3, ply('ascii', VERTEX + strips, VERTEX_ROWS + '8 0 1 3 2 -1 0 1 2\n'))
    cases.accept('strips_with_a_corner_twice', 1,
                 ply('ascii', VERTEX + strips, VERTEX_ROWS + '5 0 1 3 3 2\n'),
                 'unread: 2 triangles of strips with a corner twice ignored')
    cases.refuse('strips_beyond', ply('ascii', VERTEX + strips, VERTEX_ROWS + '4 0 1 3 4\n'), 'index 4')
    cases.refuse('strips_minus_2', ply('ascii', VERTEX + strips, VERTEX_ROWS + '4 0 1 3 -2\n'), 'index -2')
    both = VERTEX_ROWS + '3 0 2 1\n5 0 1 3 -1 2\n'
    cases.accept('strips_too', 2, ply('ascii', VERTEX + ONE_FACE + strips, both))
    strips[1] = 'property list int int strip'
    cases.refuse('strips_of_another_list', ply('ascii', VERTEX + ONE_FACE + strips, both),
                 "line 9: element 'tristrips'")
    cases.refuse('quads_too', ply('ascii', VERTEX + ONE_FACE + [
        'element quad 1', 'property list uchar int vertex_index'],
        VERTEX_ROWS + '3 0 2 1\n4 0 1 2 3\n'), "line 9: element 'quad'")
    cases.accept('strips_none', 1, ply('ascii', VERTEX + ONE_FACE + [
        'element tristrips 0', 'property list int int vertex_indices'], VERTEX_ROWS + '3 0 2 1\n'))
    edges = ['element edge 1', 'property int vertex1', 'property int vertex2']
    cases.accept('edges', 4, ply('ascii', VERTEX + FACE + edges, VERTEX_ROWS + FACE_ROWS + '0 1\n'))
    cases.accept('edges_as_lists', 4, ply('ascii', VERTEX + FACE + [
        'element edge 1', 'property list uchar int vertex_indices'],
        VERTEX_ROWS + FACE_ROWS + '2 0 1\n'))
    cases.accept('many_properties', 4, ply(
        'ascii', VERTEX + [f'property char p{i}' for i in range(20000)] + FACE,
        with_suffix(VERTEX_ROWS, '0 ' * 20000) + FACE_ROWS))
    cases.accept('many_elements', 4, ply(
        'ascii', [f'element e{i} 0\nproperty char a' for i in range(100000)] + VERTEX + FACE,
        VERTEX_ROWS + FACE_ROWS))
    cases.accept('long_comment', 4, ply('ascii', VERTEX + FACE, VERTEX_ROWS + FACE_ROWS,
                                        ['comment ' + 'x' * 5000000]))
    cases.refuse('long_name', ply('ascii', VERTEX + FACE + [
        'element ' + 'n' * 1000000 + ' 1', 'property int a'], VERTEX_ROWS + FACE_ROWS))


def coordinates(cases):
    def first(*position):
        return ply(LITTLE, VERTEX + FACE, floats(*position) + V[12:] + F)

    def ascii_first(row, kind='float'):
        lines = [line.replace('float', kind) for line in VERTEX] + FACE
        return ply('ascii', lines, row + '\n' + VERTEX_ROWS[6:] + FACE_ROWS)

    cases.accept('big_endian', 4, ply(BIG, VERTEX + FACE, binary_vertices('>') + binary_faces('>')))
    cases.refuse('big_endian_wrong', ply(BIG, VERTEX + FACE, V + F))
    cases.refuse('nan', first(math.nan, 0, 0))
    cases.refuse('infinite', first(0, math.inf, 0))
    cases.refuse('signalling_nan', ply(LITTLE, VERTEX + FACE, b'\0\0\xa0\x7f' + V[4:] + F))
    cases.accept('nan_unreferenced', 4, ply(LITTLE, ['element vertex 5'] + XYZ + FACE,
                                            V + floats(math.nan, math.nan, math.nan) + F))
    cases.accept('denormal', 4, first(1e-42, 0, 0))
    cases.accept('large', 4, first(1e30, 0, 0))
    for name, row in {'nan': 'nan 0 0', 'hex': '0x1p3 0 0', 'comma': '0,5 0 0',
                      'wrapped': '0 0 0 1 0 0', 'extra': '0 0 0 7', 'short': '0 0',
                      'comment': 'comment 0 0'}.items():
        cases.refuse(f'ascii_{name}', ascii_first(row))
    for name, word in {'1e40': '1e40', '-1e40': '-1e40', 'just': '3.4028235677973366e38'}.items():
        cases.refuse(f'ascii_float_beyond_{name}', ascii_first(f'0 {word} 0'), 'line 10: ')
        cases.accept(f'ascii_double_{name}', 4, ascii_first(f'0 {word} 0', 'double'))
    cases.accept('ascii_float_largest', 4, ascii_first('0 3.4028235e38 0'))
    cases.accept('ascii_float_below_its_least', 4, ascii_first('1e-60 0 0'))
    cases.accept('ascii_below_least_float', 4, ascii_first('1e-400 0 0'))
    cases.accept('ascii_below_least_double', 4, ascii_first('1e-400 0 0', 'double'))
    cases.refuse('ascii_beyond_double', ascii_first('1e400 0 0', 'double'))
    cases.accept('ascii_blank_lines', 4, ply('ascii', VERTEX + FACE,
                                             '\n\n' + VERTEX_ROWS + '\n' + FACE_ROWS))
    cases.accept('ascii_comment_in_body', 4,
                 ply('ascii', VERTEX + FACE, VERTEX_ROWS + 'comment x\n' + FACE_ROWS),
                 'unread: 1 line of comment in the body ignored, the first is line 14')
    cases.accept('ascii_comments_before_rows', 4,
                 ply('ascii', VERTEX + FACE, 'obj_info x\n ' + (VERTEX_ROWS + FACE_ROWS).replace('\n', '\ncomment\n')),
                 'unread: 8 lines of comment in the body ignored, the first is line 10')
    cases.refuse('ascii_comment_glued', ply('ascii', VERTEX + FACE, VERTEX_ROWS + 'comments\n' + FACE_ROWS))
    cases.accept('one_point', 4, ply('ascii', VERTEX + FACE, '0 0 0\n' * 4 + FACE_ROWS))
    cases.accept('one_line', 4, ply('ascii', VERTEX + FACE,
                                    '0 0 0\n1 0 0\n2 0 0\n3 0 0\n' + FACE_ROWS))


def points(cases):
    big = binary_vertices('>')
    cases.accept_points('ascii', 4, ply('ascii', VERTEX, VERTEX_ROWS))
    cases.accept_points('little', 4, ply(LITTLE, VERTEX, V))
    cases.accept_points('big', 4, ply(BIG, VERTEX, big))
    grid = ['element range_grid 6', CORNERS]
    places = ((0,), (), (1,), (2,), (), (3,))
    rows = b''.join(struct.pack(f'<B{len(p)}i', len(p), *p) for p in places)
    cases.accept_points('grid', 4, ply('ascii', VERTEX + grid, VERTEX_ROWS + '1 0\n0\n1 1\n1 2\n0\n1 3\n', ['obj_info num_cols 3', 'obj_info num_rows 2']))
    cases.accept_points('grid_binary', 4, ply(LITTLE, VERTEX + grid, V + rows))
    cases.accept_points('grid_first', 4, ply(LITTLE, grid + VERTEX, rows + V))
    cases.refuse_points('grid_cut', ply(LITTLE, VERTEX + grid, V + rows[:-1]), "row 5 of 'range_grid'")
    cases.refuse('grid_alone', ply(LITTLE, VERTEX + grid, V + rows), "4 points and no element 'face'")
    cases.accept('grid_beside_faces', 4, ply(LITTLE, VERTEX + grid + FACE, V + rows + F))
    cases.refuse_points('strips_alone', ply('ascii', VERTEX + ['element tristrips 1', CORNERS], VERTEX_ROWS + '3 0 1 2\n'), '1 strip in a file of points')
    cases.accept_points('no_faces_announced', 4, ply(LITTLE, VERTEX + ['element face 0', CORNERS], V))
    cases.accept_points('face_element_of_nothing', 4, ply('ascii', VERTEX + ['element face 0'], VERTEX_ROWS))
    cases.accept_points('colours', 4, ply('ascii', VERTEX + ['property uchar red'], VERTEX_ROWS.replace('\n', ' 7\n')))
    cases.accept_points('other_element', 4, ply(LITTLE, ['element camera 1', 'property float f'] + VERTEX, floats(1) + V))
    cases.refuse_points('ascii_mesh', ASCII, 'line 7: 4 faces in a file of points; expected points alone')
    cases.refuse_points('binary_mesh', BINARY, '4 faces in a file of points')
    cases.refuse_points('strips', ply('ascii', VERTEX + ['element tristrips 1', CORNERS], VERTEX_ROWS + '3 0 1 2\n'), '1 strip in a file of points')
    cases.refuse_points('nan', ply(LITTLE, VERTEX, floats(0, math.nan, 0) + V[12:]), 'vertex 0: (0, nan, 0) is not finite')
    cases.refuse_points('cut', ply(LITTLE, VERTEX, V[:-1]))
    cases.refuse_points('row_more', ply('ascii', VERTEX, VERTEX_ROWS + '1 1 1\n'), 'a row more than announced')
    cases.refuse_points('row_less', ply('ascii', VERTEX, VERTEX_ROWS[:-6]), 'a count that fits the file')
    cases.refuse_points('none', ply('ascii', ['element vertex 0'] + XYZ), 'without a point')
    cases.refuse_points('no_vertices', ply('ascii', ['element face 0', CORNERS]), "a header without element 'vertex'")


def all_cases():
    cases = Cases('ply')
    cases.accept('base_ascii', 4, ASCII)
    cases.accept('base_binary', 4, BINARY)
    cases.refuse('empty', '')
    for part in (header_counts, rows_and_counts, trailing, list_counts, skipped_lists, indices,
                 formats, header_line_ends, elements, coordinates, points):
        part(cases)
    return cases
