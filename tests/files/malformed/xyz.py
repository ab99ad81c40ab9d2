"""XYZ and PTS: every row is a point, and no row is lost or made of two."""

from cases import Cases

ROWS = '0 0 0\n1 0 0\n0 1 0\n0 0 1\n'


def rows(cases):
    cases.accept_points('plain', 4, ROWS)
    cases.accept_points('no_last_line_end', 4, ROWS[:-1])
    cases.accept_points('tabs', 4, ROWS.replace(' ', '\t'))
    cases.accept_points('dos', 4, ROWS.replace('\n', '\r\n'))
    cases.accept_points('mac', 4, ROWS.replace('\n', '\r'))
    cases.accept_points('columns', 4, ROWS.replace('\n', ' 255 0 0.5\n'))
    cases.accept_points('column_of_words', 4, ROWS.replace('\n', ' ground\n'))
    cases.accept_points('comments', 4, '# a\n//X Y Z\n; b\n' + ROWS + '# end\n')
    cases.accept_points('comment_in_row', 4, ROWS.replace('1 0 0', '1 0 0 # here'))
    cases.accept_points('heading', 4, 'X Y Z\n' + ROWS)
    cases.accept_points('quoted_heading', 4, '"X" "Y" "Z"\n' + ROWS)
    cases.accept_points('title', 4, 'bracket\n' + ROWS, 'a title before the points ignored')
    cases.accept_points('commas', 4, ROWS.replace(' ', ','))
    cases.accept_points('semicolons', 4, ROWS.replace(' ', ';'))
    cases.accept_points('semicolons_at_ends', 4, 'X;Y;Z;\n' + ROWS.replace(' ', ';').replace('\n', ';\n'))
    cases.accept_points('quoted_cells', 4, '"X","Y","Z","part"\n' + ROWS.replace(' ', ',').replace('\n', ',"a, b #2"\n'))
    cases.accept_points('same_twice', 8, ROWS + ROWS)
    cases.accept_points('byte_order_mark', 4, b'\xef\xbb\xbf' + ROWS.encode())
    cases.accept_points('below_least_double', 4, ROWS.replace('1 0 0', '1e-400 0 0'))
    cases.accept_points('one', 1, '1 2 3\n')
    cases.refuse('read_as_mesh', ROWS, 'points, no faces')


def refused(cases):
    for i, word in enumerate('nan inf 1e400 0x1p3 0,5 abc 1/3'.split()):
        cases.refuse_points(f'coordinate_{i}', ROWS.replace('1 0 0', f'{word} 0 0'), 'line 2: ')
    cases.refuse_points('commas_of_four', ROWS.replace(' ', ',').replace('\n', ',7\n'), 'line 1: 4 columns between commas')
    cases.refuse_points('decimal_commas', ROWS.replace('0', '0,5'), 'line 1: decimal commas')
    cases.refuse_points('decimal_commas_in_cells', ROWS.replace('0', '0,5').replace(' ', ';'), 'line 1: a comma or a blank in')
    cases.refuse_points('tabs_and_decimal_commas', ROWS.replace('1', '1,5').replace(' ', '\t'), "line 2: a comma or a blank in '1,5'")
    cases.refuse_points('pipes', ROWS.replace(' ', '|'), 'line 1: ')
    cases.refuse_points('two_columns', ROWS.replace(' 0\n', '\n'), 'line 1: ')
    cases.refuse_points('row_cut', ROWS.replace('1 0 0', '1 0'), 'line 2: ')
    cases.refuse_points('last_row_cut', ROWS[:-3], 'line 4: ')
    cases.refuse_points('column_missing', '0 0 0 1\n1 0 0 1\n0 1 0\n', "line 3: 3 columns; expected 4, as in the first")
    cases.refuse_points('column_more', '0 0 0\n1 0 0\n0 1 0 5\n', 'line 3: 4 columns; expected 3')
    cases.refuse_points('heading_twice', 'X Y Z\nX Y Z\n' + ROWS, 'line 2: ')
    cases.refuse_points('heading_between', '0 0 0\nX Y Z\n1 0 0\n', 'line 2: ')
    cases.refuse_points('zero_byte', ROWS + '\0\n', 'a zero byte')
    cases.refuse_points('empty', '', 'the file is empty')
    cases.refuse_points('blank', '\n \n', 'without a point')
    cases.refuse_points('comments_alone', '# a\n', 'without a point')
    cases.refuse_points('cr_in_comment', '# a\r# b\n' + ROWS, 'a line feed inside')


def names(cases):
    """The columns that a heading or a comment names, and those that nothing names."""
    numbered = ''.join(f'{100 + i} {row}\n' for i, row in enumerate(ROWS.splitlines()))
    moved = 'x, y and z are columns 2, 3 and 4'
    for name, heading in (('id', 'ID X Y Z\n'), ('comment', '# id x y z\n'), ('slashes', '//ID X Y Z\n'), ('sentence', '# the columns: id x y z\n')):
        cases.accept_points(f'named_{name}', 4, heading + numbered, moved)
    colmap = '# 3D point list\n#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n# Number of points: 4, mean track length: 2\n'
    cases.accept_points('colmap', 4, colmap + ''.join(f'{row} 1 2 3 0.5{" 7 9" * i}\n' for i, row in enumerate(numbered.splitlines())), moved)
    cases.refuse_points('colmap_cut', colmap + numbered.replace('\n', ' 1 2 3 0.5 4 7\n', 3), 'line 7: 4 columns')
    cases.refuse_points('numbered', numbered, 'line 1: a first column of increasing integers')
    cases.refuse_points('numbered_with_gaps', '3 0.5 1 0\n7 1 0 0\n90 0 1 0\n', 'line 1: a first column of increasing integers')
    cases.refuse_points('numbered_under_three_names', 'X Y Z\n' + numbered, 'line 2: a first column of increasing integers')
    cases.accept_points('named_x_of_integers', 4, 'x y z i\n' + numbered)
    cases.refuse_points('places', 'lat lon h\n' + ROWS, 'line 1: names of other coordinates')
    cases.refuse_points('places_in_comment', '# Easting Northing Height\n' + ROWS, 'line 1: names of other coordinates')
    cases.refuse_points('no_z', 'X,Y,X\n' + ROWS.replace(' ', ','), 'line 1: a heading that does not tell which of 3 columns are x, y and z')
    cases.refuse_points('other_names', 'r theta phi\n' + ROWS, 'line 1: a heading that does not tell')
    cases.refuse_points('sentence_of_two_readings', '# exported x y z\n' + numbered, 'line 1: a comment that does not tell')
    cases.refuse_points('two_headings', '# x y z\n# y x z\n' + ROWS, 'line 2: a comment that does not tell')
    cases.refuse_points('joined_files', '# x y z\n' + ROWS + '# y x z\n' + ROWS, 'line 6: a comment that names other columns')
    cases.accept_points('sentence', 4, '# the x axis points right, y up, z to the viewer\n' + ROWS)


def counts(cases):
    cases.accept_points('count', 4, '4\n' + ROWS)
    cases.accept_points('count_and_columns', 4, '4\n' + ROWS.replace('\n', ' -812 91 92 93\n'))
    cases.accept_points('heading_and_count', 4, 'points\n4\n' + ROWS)
    cases.refuse_points('count_less', '3\n' + ROWS, '4 points where the row before them announces 3')
    cases.refuse_points('count_more', '5\n' + ROWS, '4 points where the row before them announces 5')
    cases.refuse_points('count_huge', '18446744073709551615\n' + ROWS, 'announces 18446744073709551615')
    cases.refuse_points('count_twice', '4\n4\n' + ROWS, 'line 2: ')
    cases.refuse_points('count_negative', '-4\n' + ROWS, 'line 1: ')
    cases.refuse_points('count_alone', '4\n', '0 points where the row before them announces 4')
    cases.accept_points('two_scans', 8, '4\n' + ROWS + '4\n' + ROWS, '2 scans')
    cases.accept_points('scans_of_other_columns', 8, '4\n' + ROWS + '4\n' + ROWS.replace('\n', ' -812 9 9 9\n'))
    cases.refuse_points('second_scan_cut', '4\n' + ROWS + '4\n' + ROWS[:-6], '3 points where the row before them announces 4')
    cases.refuse_points('second_scan_missing', '4\n' + ROWS + '4\n', '0 points where the row before them announces 4')
    cases.refuse_points('count_between_rows', '8\n' + ROWS + '4\n' + ROWS, 'line 6: no coordinate')


def all_cases():
    cases = Cases('xyz')
    for part in (rows, refused, names, counts):
        part(cases)
    return cases
