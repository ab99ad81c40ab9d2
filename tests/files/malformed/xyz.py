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
    cases.accept_points('heading', 4, 'X Y Z\n' + ROWS, 'a heading before the points ignored')
    cases.accept_points('quoted_heading', 4, '"X" "Y" "Z"\n' + ROWS, 'a heading')
    cases.accept_points('same_twice', 8, ROWS + ROWS)
    cases.accept_points('byte_order_mark', 4, b'\xef\xbb\xbf' + ROWS.encode())
    cases.accept_points('below_least_double', 4, ROWS.replace('1 0 0', '1e-400 0 0'))
    cases.accept_points('one', 1, '1 2 3\n')
    cases.refuse('read_as_mesh', ROWS, 'points, no faces')


def refused(cases):
    for i, word in enumerate('nan inf 1e400 0x1p3 0,5 abc 1/3'.split()):
        cases.refuse_points(f'coordinate_{i}', ROWS.replace('1 0 0', f'{word} 0 0'), 'line 2: ')
    cases.refuse_points('commas', ROWS.replace(' ', ','), 'line 1: ')
    cases.refuse_points('semicolons', ROWS.replace(' ', ';'))
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


def counts(cases):
    cases.accept_points('count', 4, '4\n' + ROWS)
    cases.accept_points('count_and_columns', 4, '4\n' + ROWS.replace('\n', ' -812 91 92 93\n'))
    cases.accept_points('heading_and_count', 4, 'points\n4\n' + ROWS)
    cases.refuse_points('count_less', '3\n' + ROWS, '4 points where the first row announces 3')
    cases.refuse_points('count_more', '5\n' + ROWS, '4 points where the first row announces 5')
    cases.refuse_points('count_huge', '18446744073709551615\n' + ROWS, 'announces 18446744073709551615')
    cases.refuse_points('count_twice', '4\n4\n' + ROWS, 'line 2: ')
    cases.refuse_points('count_negative', '-4\n' + ROWS, 'line 1: ')
    cases.refuse_points('count_alone', '4\n', '0 points where the first row announces 4')
    cases.refuse_points('two_scans', '4\n' + ROWS + '4\n' + ROWS, 'line 6: ')


def all_cases():
    cases = Cases('xyz')
    for part in (rows, refused, counts):
        part(cases)
    return cases
