"""OFF: three counts, and as many rows as they state."""

from cases import FACE_ROWS, VERTEX_ROWS, Cases, with_suffix

ROWS = VERTEX_ROWS + FACE_ROWS
BASE = 'OFF\n4 4 6\n' + ROWS


def counts(cases):
    refused = {
        'vertices_negative': '-4 4 0', 'faces_negative': '4 -4 0', 'edges_negative': '4 4 -1',
        'int64_greatest': '9223372036854775807 4 0', 'uint64_greatest': '18446744073709551615 4 0',
        'wraps_64_bits': '3074457345618258603 4 0', 'faces_wrap': '4 9223372036854775808 0',
        'billions': '1000000000 1000000000 0', 'out_of_memory': '353535235358 6 0',
        'million_faces': '4 1000000 0', 'point': '4.0 4 0', 'one': '4', 'four': '4 4 6 7',
        'edges_word': '4 4 x', 'zero': '0 0 0', 'no_faces': '4 0 0',
    }
    for name, line in refused.items():
        cases.refuse(f'counts_{name}', f'OFF\n{line}\n{ROWS}')
    cases.accept('counts_without_edges', 4, f'OFF\n4 4\n{ROWS}')
    cases.accept('counts_without_edges_or_keyword', 4, f'4 4\n{ROWS}')
    cases.refuse('counts_without_edges_too_few', f'OFF\n4 3\n{ROWS}', 'a row more than announced')
    cases.refuse('points_alone', f'OFF\n4 0 0\n{VERTEX_ROWS}', '4 points and no face')
    more = 'a row more than announced'
    cases.refuse('faces_too_few', f'OFF\n4 2 6\n{ROWS}', 'line 9: ' + more)
    cases.refuse('faces_too_few_after_a_note',
                 f'OFF\n4 3 6\n{VERTEX_ROWS}{FACE_ROWS[:-8]}note\n{FACE_ROWS[-8:]}', more)
    cases.refuse('faces_too_many', f'OFF\n4 5 6\n{ROWS}', 'the file ends at face 4')
    cases.refuse('vertices_too_few', f'OFF\n3 4 6\n{ROWS}')
    cases.refuse('vertices_too_few_unused',
                 f'OFF\n3 2 6\n{VERTEX_ROWS}3 0 1 2\n3 2 1 0\n', more)
    cases.refuse('vertices_too_many', f'OFF\n5 4 6\n{ROWS}')
    cases.refuse('vertex_for_face', f'OFF\n5 3 6\n{ROWS}', '4 words in vertex 4; expected 3')
    cases.accept('rows_and_words', 4, BASE + 'junk\n', 'unread: what follows the last row ignored, from line 11')
    cases.accept('zero_byte_behind', 4, BASE + '\0', 'what follows the last row ignored')
    cases.accept('comment_behind', 4, BASE + '\n# 3 0 1 2\n')


def keywords(cases):
    cases.accept('plain', 4, BASE)
    cases.accept('counts_on_first_line', 4, BASE.replace('OFF\n', 'OFF '))
    cases.accept('no_keyword', 4, BASE[4:])
    cases.accept('coff', 4, 'COFF\n4 4 6\n' + with_suffix(VERTEX_ROWS, '255 0 0 255') + FACE_ROWS)
    cases.accept('stoff', 4, 'ST' + BASE)
    cases.accept('byte_order_mark', 4, '\xef\xbb\xbf' + BASE)
    # ModelNet40 has such files: a line end is missing.
    cases.accept('glued', 4, BASE.replace('OFF\n', 'OFF'))
    cases.accept('glued_coff', 4, 'COFF4 4\n' + with_suffix(VERTEX_ROWS, '255 0 0 255') + FACE_ROWS)
    cases.refuse('glued_alone', 'OFF4\n4 6\n' + ROWS, 'line 1: no face count')
    cases.refuse('glued_word', BASE.replace('OFF\n', 'OFF4a '), "line 1: the file begins with 'OFF4a'")
    cases.refuse('glued_beyond_64_bits', BASE.replace('OFF\n', 'OFF9999999999999999999'), 'as vertex count')
    for name, content in {'binary': 'OFF BINARY\n' + '\0' * 50, '4off': '4' + BASE,
                          'noff': 'nOFF\n3\n' + BASE[4:], 'lower': BASE.lower(), 'empty': '',
                          'cut': 'OFF', 'cut_in_counts': 'OFF\n4',
                          'cut_in_vertex': 'OFF\n4 4 6\n0 0', 'rubbish': '2\r20',
                          'resource_fork': '\0\5\x16\7\0\2\0\0Mac OS X'}.items():
        cases.refuse(name, content)


def lines(cases):
    cases.accept('cr', 4, BASE.replace('\n', '\r'))
    cases.accept('crlf', 4, BASE.replace('\n', '\r\n'))
    commented = VERTEX_ROWS.replace('\n', ' # v\n')
    cases.accept('comments', 4, 'OFF # c\n# c\n4 4 6 # c\n' + commented + '\n# c\n' + FACE_ROWS)
    cases.refuse('several_vertices_a_line', 'OFF\n4 4 6\n0 0 0 1 0 0 0 1 0 0 0 1\n' + FACE_ROWS)
    cases.refuse('several_faces_a_line',
                 'OFF\n4 4 6\n' + VERTEX_ROWS + FACE_ROWS.replace('\n', ' ') + '\n', 'the file ends at face 1')
    cases.accept('wrapped_faces', 4, 'OFF\n4 4 0\n' + VERTEX_ROWS + FACE_ROWS.replace('3 ', '3\n\n'))
    cases.accept('wrapped_rows', 4, 'OFF\n4 4 0\n' + ROWS.replace(' ', ' # more\n'))
    cases.accept('wrapped_one_face', 4, BASE.replace('3 0 1 3', '3 0\n1 3'))
    # A row that lacks a word is not filled from the next one.
    behind = ', which begins in line '
    cases.refuse('face_cut_among_good', BASE.replace('3 0 2 1', '3 0 2'), "line 8: '0' behind face 0" + behind + '7')
    cases.refuse('vertices_of_two', BASE.replace(' 0\n', '\n'), 'line ')
    cases.refuse('wrapped_and_colour', BASE.replace('3 0 2 1', '3 0\n2 1 255 0 0'), "'255' behind face 0")
    cases.refuse('wrapped_vertex_and_colour', BASE.replace('1 0 0', '1 0\n0 255', 1), "'255' behind vertex 1")
    cases.refuse('wrapped_last', BASE[:-2], 'no vertex index')
    cases.refuse('one_line', BASE.replace('\n', ' '))
    cases.refuse('cr_in_comment', BASE.replace('OFF\n', 'OFF\n# a\r# b\n'),
                 'a carriage return inside')


def faces(cases):
    refused = {
        'count_negative': '-3 0 2 1', 'count_billion': '1000000000 0 2 1',
        'count_int64': '9223372036854775807 0 2 1', 'two_corners': '2 0 2', 'no_corners': '0',
        'index_negative': '3 0 -1 2', 'index_beyond': '3 0 4 2', 'index_from_1': '3 1 2 4',
        'index_point': '3 0 1.0 2', 'short': '3 0 1',
    }
    for name, row in refused.items():
        cases.refuse(f'face_{name}', f'OFF\n4 1 6\n{VERTEX_ROWS}{row}\n')
    cases.accept('face_colours', 4,
                 'OFF\n4 4 6\n' + VERTEX_ROWS + with_suffix(FACE_ROWS, '0.5 0.5 0.5'))
    cases.accept('face_colour_index', 4, BASE.replace('3 0 2 1', '3 0 2 1 3'))


def coordinates(cases):
    cases.refuse('coordinate_nan', BASE.replace('1 0 0', 'nan 0 0', 1), 'vertex 1: (nan, 0, 0) is not finite')
    cases.refuse('coordinate_infinite', BASE.replace('1 0 0', '-inf 0 0', 1), 'vertex 1: (-inf, 0, 0) is not finite')
    for i, word in enumerate('1e400 0x1p3 0,5 abc 1/3'.split()):
        cases.refuse(f'coordinate_refused_{i}', BASE.replace('1 0 0', f'{word} 0 0', 1), 'line 4: ')
    cases.accept('coordinate_below_least_double', 4, BASE.replace('1 0 0', '1e-400 -1e-400 1', 1))
    cases.refuse('vertex_cut', BASE.replace('1 0 0\n', '1 0\n', 1),
                 "line 5: '1' behind vertex 1, which begins in line 4")


def points(cases):
    cases.accept_points('without_faces', 4, f'OFF\n4 0 0\n{VERTEX_ROWS}')
    cases.refuse_points('and_faces', BASE, '4 faces in a file of points')


def all_cases():
    cases = Cases('off')
    for part in (counts, keywords, lines, faces, coordinates, points):
        part(cases)
    return cases
