"""OBJ: every line is read, skipped as known, or refused."""

from cases import FACES, POSITIONS, Cases, utf16

VERTICES = ''.join('v %d %d %d\n' % p for p in POSITIONS)
TETRAHEDRON = VERTICES + ''.join('f %d %d %d\n' % tuple(i + 1 for i in f) for f in FACES)


def face_forms(cases):
    accepted = {
        'slash': 'f 1/ 3/ 2/',
        'two_slashes': 'f 1// 3// 2//',
        'texture': 'f 1/1 3/1 2/1',
        'mixed_forms': 'f 1/1 3//1 2',
        'texture_missing': 'f 1/7/9 3/7/9 2/7/9',
        'texture_beyond_32_bits': 'f 1/2147483648 3/1 2/1',  # not used
        'leading_plus': 'f +1 +3 +2',
        'leading_zero': 'f 01 03 02',
        'negative': 'f -4 -2 -3',
        'repeated': 'f 1 1 1',
    }
    refused = {
        'four_parts': 'f 1/1/1/1 3 2',
        'leading_slash': 'f /1 3 2',
        'word_in_corner': 'f 1/a 3 2',
        'texture_beyond_64_bits': 'f 1/99999999999999999999 3 2',
        'minus_zero': 'f -0 3 2',
        'zero': 'f 0 1 2',
        'point': 'f 1.0 3 2',
        'exponent': 'f 1e0 3 2',
        'hex': 'f 0x1 3 2',
        'int_least': 'f -2147483648 3 2',
        'int_least_minus_1': 'f -2147483649 3 2',
        'int_greatest': 'f 2147483647 3 2',
        'wraps_32_bits': 'f 4294967297 4294967299 4294967298',
        'wraps_64_bits': 'f 18446744073709551617 3 2',
        'int64_least': 'f -9223372036854775808 3 2',
        'beyond_last': 'f 1 2 99',
        'negative_beyond_first': 'f -5 -1 -2',
        'two_corners': 'f 1 2',
        'one_corner': 'f 1',
        'no_corner': 'f',
        'trailing_word': 'f 1 3 2 abc',
        'commas': 'f 1,3,2',
        'glued_comment': 'f 1 3 2#c',
    }
    for name, line in accepted.items():
        cases.accept(f'face_{name}', 1, VERTICES + line + '\n')
    for name, line in refused.items():
        cases.refuse(f'face_{name}', VERTICES + line + '\n', 'line')
    cases.accept('face_before_vertices', 1, 'f 1 2 3\n' + VERTICES)
    cases.accept('face_two_corners_among_good', 1, VERTICES + 'f 1 2\nf 1 2 3\n',
                 'short-faces: 1 face of fewer than three corners ignored')
    cases.refuse('face_negative_without_vertices', 'f -4 -3 -2\n')
    cases.accept('face_long_line', 1000, VERTICES + 'f 1 2' + ' 3' * 1000 + '\n')


def vertex_numbers(cases):
    accepted = {
        'below_least_double': 'v 1e-400 0 0',
        'below_least_double_negative': 'v -1e-400 0 0',
        'far_below_least_double': 'v 1e-99999999999999999999 0 0',
        'below_least_double_by_zeros': 'v 0.' + '0' * 400 + '1 0 0',
        'least_double': 'v 5e-324 0 0',
        'large': 'v 1e308 0 0',
        'no_whole_part': 'v .5 0 0',
        'no_fraction': 'v 5. 0 0',
        'exponent_with_zeros': 'v .8e-001 -.7e+02 0',
        'many_digits': 'v 0.' + '1' * 100000 + ' 0 0',
        'many_zeros': 'v ' + '0' * 100000 + '1 0 0',
        'long_number_short_value': 'v 0.' + '0' * 400 + '1e400 0 0',
        'zero_with_exponent': 'v 0e999999999 0 0',
        'colour': 'v 1 0 0 1 1 1 1',
        'colour_nan': 'v 1 0 0 nan nan nan',
        'colour_nan_of_windows': 'v 1 0 0 -nan(ind) 1.#QNAN -1.#IND',
        'colour_infinite_with_alpha': 'v 1 0 0 inf -Inf 0 1',
        'tabs': 'v\t0\t0\t0',
    }
    for i, word in enumerate('nan NaN -nan nan(0x1) -1.#IND 1.#QNAN inf Infinity -INF +inf'.split()):
        triangle = '\nv 1 0 0\nv 0 1 0\n'
        cases.refuse(f'number_not_finite_{i}', f'v {word} 0 0{triangle}f 1 2 3\n', 'vertex 0: (')
        cases.accept(f'number_not_finite_unreferenced_{i}', 1, f'v 0 0 0{triangle}f 1 2 3\nv {word} 0 0\n')
    refused = ('snan nan0 infinite 0x1p3 0,5 1e400 '
               '-1e400 1e 1e+ . ++1 +-1 --1 1d5 1_0 1.0f 1/3 3.1+e2 abc 0#c '
               '1e99999999999999999999').split()
    triangle = '\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'
    for name, line in accepted.items():
        cases.accept(f'number_{name}', 1, line + triangle)
    for i, word in enumerate(refused):
        cases.refuse(f'number_refused_{i}', f'v {word} 0 0' + triangle, 'line 1: ')
    for name, line in {
            'digits_beyond': 'v ' + '9' * 400 + ' 0 0', 'zeros_beyond': 'v 1' + '0' * 400 + ' 0 0',
            'two': 'v 1 2', 'none': 'v', 'nan_weight': 'v 1 0 0 nan', 'nan_of_two': 'v 1 0 0 1 nan',
            'colour_word': 'v 1 0 0 1 0 red', 'colour_and_vertex': 'v 1 0 0 nan 0 0 v 0 0 1',
            'unicode_minus': 'v \xe2\x88\x921 0 0', 'no_break_space': 'v\xc2\xa01 0 0'}.items():
        cases.refuse(f'number_{name}', line + triangle, 'line 1: ')


def continued_lines(cases):
    cases.accept('continued_face', 1, VERTICES + 'f 1 \\\n3 \\\n2\n')
    cases.accept('continued_vertex', 1, 'v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
    cases.accept('continued_to_the_end', 1, VERTICES + 'f 1 3 2 \\')
    cases.accept('continued_crlf', 1, VERTICES.replace('\n', '\r\n') + 'f 1 \\\r\n3 2\r\n')
    cases.accept('continued_after_word', 1, VERTICES + 'f 1 3\\\n 2\n')
    cases.accept('continued_before_comment', 1, VERTICES + 'f 1 3 \\\n2 # all \\\n')
    # 2 and 4, or 24?
    cases.refuse('continued_in_word', VERTICES + 'f 1 3 2\\\n4\n', 'line 5: ')
    cases.refuse('continued_into_face', VERTICES + 'f 1 3 2 \\\nf 1 2 4\n', "'f' in a face")
    cases.refuse('continued_before_half_a_face', VERTICES + 'f 1 \\\n3 # \\\n2\n', 'line 7: ')
    # A comment is never continued, and a skipped line never swallows one with a keyword.
    cases.accept('comment_ends_in_backslash', 3, VERTICES + 'f 1 3 2 # last \\\nf 1 2 4\nf 1 4 3\n')
    cases.accept('comment_with_path', 2, VERTICES + '# path C:\\tmp\\\nf 1 3 2\nf 1 2 4\n')
    cases.accept('vertex_comment_ends_in_backslash', 4,
                 TETRAHEDRON.replace('v 0 0 0\n', 'v 0 0 0 # first\\\n'))
    cases.accept('group_ends_in_backslash', 1, 'g name\\\n' + VERTICES + 'f 1 3 2\n')
    cases.accept('material_ends_in_backslash', 2,
                 VERTICES + 'usemtl C:\\mat\\\nf 1 3 2\nf 1 2 4\n')
    # A name ends in a backslash and continues nothing; numbers are continued by numbers alone.
    for name, line in (('upper', 'F 1 2 4'), ('glued', 'f1 2 4'), ('no_break_space', 'f\xa01 2 4'),
                       ('word', 'FACE 1 2 4')):
        for before, skipped in (('usemtl', 'usemtl C:\\tmp\\'), ('parm', 'parm u 0 1 \\'),
                                ('g', 'g left right \\')):
            cases.refuse(f'face_{name}_behind_{before}', f'{VERTICES}f 1 3 2\n{skipped}\n{line}\n')
    cases.accept('group_names_continued', 1, VERTICES + 'g left \\\nfront 2nd\nf 1 3 2\n')
    cases.accept('parameters_continued', 1, VERTICES + 'parm u 0 0.5 \\\n1 1e-3\nf 1 3 2\n')
    cases.accept('material_and_colours', 1,
                 VERTICES + 'newmtl a\nKd 1 0 0\nillum 2\nvc 1 0 0\nf 1 3 2\n')
    cases.accept('group_continued', 1, VERTICES + 'g a \\\n b \\\n c\nf 1 2 3\n')
    cases.refuse('group_continued_by_capital_face', VERTICES + 'f 1 3 2\ng a \\\nF 1 2 4\n', "'F'")
    cases.refuse('group_continuation_ends', VERTICES + 'g a \\\n b\n c\nf 1 2 3\n', "'c' begins")


def keywords(cases):
    cases.refuse('upper_case', 'V 0 0 0\nV 1 0 0\nV 0 1 0\nF 1 2 3\n', 'line 1: ')
    strangers = ['F', 'FO', 'Fo', 'face', 'f1', 'f#', '3', '"f"', 'vertex', 'V', 'Vt', '\xa0f']
    for i, keyword in enumerate(strangers):
        cases.refuse(f'keyword_unknown_{i}', VERTICES + f'f 1 3 2\n{keyword} 1 2 4\nf 1 4 3\n',
                     'line 6: ')
    skipped = ('vn 0 0 1\nvt 0 0\nvp 0 0\no a b\ng x y z\ng\ns 1\ns off\nmg 0\nusemtl m\nusemtl\n'
               'mtllib a.mtl b.mtl\nusemap m\nmaplib m\nbevel on\nc_interp on\nd_interp on\nlod 1\n'
               'shadow_obj a.obj\ntrace_obj a.obj\nvw 0 1\nt crease 2/1/0\n')
    cases.accept('skipped_keywords', 4, skipped + TETRAHEDRON + skipped)
    cases.accept('points_and_lines', 1, VERTICES + 'p 1\nl 1 2 3\nf 1 3 2\n',
                 'elements: 2 lines with points, polylines or curves ignored')
    free_form = ('cstype bezier\ndeg 3 3\nbmat u 1\nstep 1 1\ncurv 0 1 1 2 3\ncurv2 1 2\n'
                 'surf 0 1 0 1 1 2 \\\n3 4\nparm u 0 1\ntrim 0 1 1\nhole 0 1 1\nscrv 0 1 1\nsp 1\n'
                 'end\ncon 1 0 1 1 2 0 1 1\nctech cparm 1\nstech cparma 1 1\n')
    cases.accept('free_form', 1, VERTICES + free_form + 'f 1 3 2\n',
                 'surfaces: 1 free-form surface not read')
    cases.accept('old_free_form', 1, VERTICES + 'bzp 1 2 3 4\nbsp 1 2 3 4\ncdc 1 2 3 4\n'
                 'cdp 1 2 3 4\nres 1 1\nf 1 3 2\n', '2 free-form surfaces not read')
    cases.accept('calls', 4, 'call /etc/passwd\ncsh touch pwned\n' + TETRAHEDRON,
                 'calls: 2 calls of other files or commands not followed')
    cases.accept('material_files_not_opened', 4,
                 'mtllib /dev/zero\nmtllib ../../../../../../etc/passwd\n' + TETRAHEDRON)
    remarks = 'taken for remarks and ignored, the first begins with '
    cases.accept('dollar_line', 4, '$ given to an archive\n' + TETRAHEDRON, 'unread: 1 line ' + remarks + "'$'")
    cases.accept('slashes_comment', 4, '// exported\n' + TETRAHEDRON + '//f 1 2 3\n$Id$\n',
                 'unread: 3 lines ' + remarks + "'//'")
    cases.accept('slashes_comment_ends_in_backslash', 4,
                 TETRAHEDRON.replace('f', '// path C:\\\nf', 1), remarks)
    cases.refuse('slashes_behind_a_face', VERTICES + 'f 1 3 2 // first\n', "'//' in a face")
    cases.refuse('slash_line', VERTICES + '/ a\nf 1 3 2\n', 'line 5: ')
    cases.accept('material_maps', 2, VERTICES + 'newmtl a\nmap_Kd -s 1 1 1 my picture.png\nmap_ao x\nbump b\n'
                 'disp d\ndecal e\nrefl -type sphere f\nnorm g\nPr 0.5\nPm 0\nsharpness 60\n'
                 'map_Kd C:\\tex\\\nf 1 3 2\nf 1 2 4\n')
    cases.refuse('vertices_only', VERTICES, 'line 4: 4 points and no face; expected a mesh')
    cases.refuse('points_only', VERTICES + 'p 1 2 3 4\n', '4 points and no face')
    for name, content in {'texture_only': 'vt 0 0\nvt 1 0\nvn 0 0 1\n',
                          'faces_only': TETRAHEDRON[len(VERTICES):], 'empty': '',
                          'blank': ' \n\t\n', 'one_byte': 'v', 'comment_only': '#'}.items():
        cases.refuse(name, content)


def line_ends(cases):
    cases.accept('cr', 4, TETRAHEDRON.replace('\n', '\r'))
    cases.accept('crlf', 4, TETRAHEDRON.replace('\n', '\r\n'))
    cases.accept('cr_crlf', 4, TETRAHEDRON.replace('\n', '\r\r\n'))
    cases.accept('crlf_and_lf', 4, VERTICES + TETRAHEDRON[len(VERTICES):].replace('\n', '\r\n'))
    cases.accept('form_feed_is_blank', 4, TETRAHEDRON.replace(' ', '\f'))
    cases.accept('no_final_line_end', 4, TETRAHEDRON[:-1])
    cases.accept('ctrl_z_at_the_end', 4, TETRAHEDRON + '\x1a')
    inside = 'a carriage return inside the line'
    cases.refuse('cr_after_lf_comment', '# c\n' + TETRAHEDRON.replace('\n', '\r'), inside)
    cases.refuse('cr_in_comment', VERTICES + 'f 1 3 2\n# note\rf 1 2 4\r\nf 1 4 3\n', inside)
    cases.refuse('cr_in_group', VERTICES + 'f 1 3 2\ng a\rf 1 2 4\r\nf 1 4 3\n', inside)
    cases.refuse('cr_between_faces', VERTICES + 'f 1 3 2\rf 1 2 4\nf 1 4 3\n', inside)
    cases.refuse('cr_in_continued', VERTICES + 'f 1 3 \\\n2\rf 1 2 4\nf 1 4 3\n', inside)
    cases.refuse('lf_after_cr_comment', '# c\r' + TETRAHEDRON, 'a line feed inside the line')
    cases.refuse('next_line', TETRAHEDRON.replace('\n', '\x85'))
    cases.refuse('line_separator', TETRAHEDRON.replace('\n', '\xe2\x80\xa8'))
    cases.refuse('vertical_tab', TETRAHEDRON.replace('\n', '\v'))
    cases.refuse('zero_byte_in_comment', '# a\0b\n' + TETRAHEDRON)
    cases.refuse('zero_byte_at_the_end', TETRAHEDRON + '\0')
    cases.refuse('ctrl_z_and_more', TETRAHEDRON + '\x1a\nf 1 2 3\n', 'line 9: ')


def encodings_and_strangers(cases):
    cases.accept('byte_order_mark', 4, '\xef\xbb\xbf' + TETRAHEDRON)
    cases.accept('latin1_names', 4, '# \xe9\ng \xfc\xff\n' + TETRAHEDRON)
    strangers = {
        'two_byte_order_marks': b'\xef\xbb\xbf\xef\xbb\xbf' + TETRAHEDRON.encode(),
        'utf16': b'\xff\xfe' + utf16(TETRAHEDRON),
        'utf16_big_endian': b'\xfe\xff' + TETRAHEDRON.encode('utf-16be'),
        'utf16_without_mark': utf16(TETRAHEDRON),
        'utf32': b'\xff\xfe\0\0' + TETRAHEDRON.encode('utf-32le'),
        'html': '<!DOCTYPE html><html><body>404</body></html>\n',
        'json': '{"v":1}',
        'gltf': 'glTF\2\0\0\0',
        'elf': '\x7fELF' + '\0' * 100,
        'gzip': '\x1f\x8b\x08\0' + '\0' * 40,
        'zip': 'PK\x03\x04' + '\0' * 40,
        'lfs_pointer': 'version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n',
        'junk': bytes((i * 97 + i // 7) % 256 for i in range(4096)),
        'text': 'The quick brown fox\njumps over the lazy dog\n',
    }
    for name, content in strangers.items():
        cases.refuse(name, content)


def geometry(cases):
    two = ('o a\n' + VERTICES + 'f 1 3 2\no b\n' + VERTICES +
           'f 5 7 6\ng x y z\ns 1\nf -4 -2 -3\n')
    cases.accept('two_objects', 3, two)
    fanned = 'polygons: 1 face of more than three corners was triangulated'
    cases.accept('concave', 3, 'v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n', fanned)
    cases.accept('not_planar', 2, 'v 0 0 0\nv 1 0 0\nv 1 1 5\nv 0 1 0\nf 1 2 3 4\n', fanned)
    cases.accept('tiny', 4, TETRAHEDRON.replace('1 0 0\n', '1e-200 0 0\n', 1))
    cases.accept('huge', 4, TETRAHEDRON.replace('1 0 0\n', '1e200 0 0\n', 1))
    cases.accept('far_unreferenced', 4, TETRAHEDRON + 'v 1e12 1e12 1e12\n')
    cases.accept('double_faces', 2, VERTICES + 'f 1 2 3\nf 3 2 1\n')
    cases.accept('long_name', 4, 'o ' + 'x' * 5000000 + '\n' + TETRAHEDRON)


def points(cases):
    cases.accept_points('alone', 4, VERTICES)
    cases.accept_points('colours_and_names', 4, 'o scan\n' + VERTICES.replace('\n', ' 0.1 0.2 0.3\n') + 'vn 0 0 1\n')
    cases.accept_points('p_lines', 4, VERTICES + 'p 1 2 3 4\n', 'elements: 1 line with points')
    cases.refuse_points('and_faces', TETRAHEDRON, '4 faces in a file of points')
    cases.refuse_points('and_short_face', VERTICES + 'f 1 2\n', '1 face in a file of points')
    cases.refuse_points('none', 'o a\n', 'without a point')


def all_cases():
    cases = Cases('obj')
    cases.accept('base', 4, TETRAHEDRON)
    for part in (face_forms, vertex_numbers, continued_lines, keywords, line_ends,
                 encodings_and_strangers, geometry, points):
        part(cases)
    return cases
