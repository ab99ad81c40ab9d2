"""LAS: the header says where the points are, how they are stored, and how many there are."""

import math
import struct

from cases import Cases

BYTES = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67]
NUMBERS = [(0, 0, 0), (1000, 0, 0), (0, 1000, 0), (0, 0, -1000)]
LAST = 2 ** 31 - 1


def las(format=3, minor=2, numbers=NUMBERS, scale=(1e-3,) * 3, offset=(0, 0, 0), record=None, count=None, begin=None,
        header=None, old_count=None, withheld=(), bits=0, major=1):
    """A file; what is not given is as it should be."""
    record = BYTES[min(format, 10)] if record is None else record
    size = {3: 235, 4: 375, 5: 393}.get(minor, 227)
    count = len(numbers) if count is None else count
    old = (count if format < 6 or minor < 4 else 0) if old_count is None else old_count
    head = bytearray(size)
    head[0:4], head[24], head[25], head[104] = b'LASF', major, minor, format | bits
    struct.pack_into('<HII', head, 94, size if header is None else header, size if begin is None else begin, 0)
    struct.pack_into('<HI', head, 105, record, old)
    struct.pack_into('<6d', head, 131, *scale, *offset)
    if size >= 375:
        struct.pack_into('<Q', head, 247, count)
    body = bytearray()
    for i, xyz in enumerate(numbers):
        row = bytearray(max(record, 16))
        struct.pack_into('<3i', row, 0, *xyz)
        row[15] = (0x80 if format < 6 else 4) if i in withheld else 0
        body += row[:record]
    return bytes(head + body)


def read(cases):
    for format in range(11):
        for minor in range(6):
            cases.accept_points(f'format_{format}_of_1_{minor}', 4, las(format, minor))
    cases.accept_points('wider_records', 4, las(record=47))
    cases.accept_points('offset', 4, las(offset=(4e6, -5e5, 100)))
    cases.accept_points('least_and_most', 2, las(numbers=[(LAST, LAST, LAST), (-LAST - 1,) * 3], scale=(1e-2, 1, 1e290)))
    cases.accept_points('negative_scale', 4, las(scale=(-1e-3, 1e-3, 1e-3)))
    cases.accept_points('between_header_and_points', 4, las(begin=227 + 40, numbers=[(0, 0, 0)] * 2 + NUMBERS, count=4))
    cases.accept_points('behind_points', 4, las() + b'waveforms')
    cases.accept_points('withheld', 2, las(withheld=(1, 3)), 'left out as withheld: 2 points')
    cases.accept_points('withheld_of_1_4', 3, las(6, 4, withheld=(0,)), 'left out as withheld: 1 point')
    cases.accept_points('old_count_too', 4, las(2, 4, old_count=4))
    cases.refuse('read_as_mesh', las(), 'a LAS file (points, no faces)')


def refused(cases):
    for version in ((1, 6), (2, 4), (0, 0)):
        cases.refuse_points('version_%d_%d' % version, las(minor=version[1], major=version[0]), 'expected LAS 1.0 to 1.5')
    for bits in (0x40, 0x80, 0xc0):
        cases.refuse_points(f'compressed_{bits}', las(bits=bits), 'compressed as LAZ')
    cases.refuse_points('format_11', las(format=11, record=80), 'point data format 11')
    for format, record in ((0, 19), (3, 33), (6, 29), (1, 0)):
        cases.refuse_points(f'short_records_{format}', las(format, 4, record=record), 'at least ')
    cases.refuse_points('too_many', las(count=5), 'a file that holds them')
    cases.refuse_points('far_too_many', las(7, 4, count=2 ** 63), 'a file that holds them')
    cases.refuse_points('too_many_in_32_bits', las(count=2 ** 32 - 1))
    cases.refuse_points('too_few', las(count=2), 'byte 107: 2 points announced, 4 records')
    cases.refuse_points('too_few_of_1_4', las(6, 4, count=2), 'byte 247: 2 points announced, 4 records')
    cases.refuse_points('count_not_written', las(count=0), '0 points announced, 4 records')
    cases.refuse_points('none', las(numbers=[]), 'no point')
    cases.refuse_points('all_withheld', las(withheld=range(4)), 'no point that is not withheld')
    cases.refuse_points('two_counts', las(2, 4, old_count=3), 'one count, or 0 here')
    cases.refuse_points('begins_in_header', las(begin=100), 'a file that holds them')
    cases.refuse_points('begins_beyond', las(begin=2 ** 32 - 1), 'a file that holds them')
    cases.refuse_points('short_header_size', las(header=226), 'a header that ends early')
    for size in (4, 100, 226):
        cases.refuse_points(f'cut_at_{size}', las()[:size], 'the file ends')
    cases.refuse_points('cut_at_300', las(6, 4)[:300], 'a header that ends early')
    cases.refuse_points('last_point_cut', las()[:-1], 'a file that holds them')
    for name, number in (('nan', math.nan), ('inf', math.inf), ('zero', 0)):
        cases.refuse_points(f'scale_{name}', las(scale=(1e-3, number, 1e-3)), 'byte 139: a scale or an offset')
    cases.refuse_points('offset_nan', las(offset=(0, 0, math.nan)), 'byte 147: a scale or an offset')
    cases.refuse_points('overflow', las(scale=(1e308, 1, 1)), 'is not finite')


def all_cases():
    cases = Cases('las')
    for part in (read, refused):
        part(cases)
    return cases
