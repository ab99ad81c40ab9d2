"""glTF 2.0: JSON, accessors, views and nodes that do not hold what they promise; and GLB's chunks."""

import base64
import copy
import json
import struct

from cases import FACES, POSITIONS, Cases

BINARY = b''.join(struct.pack('<3f', *p) for p in POSITIONS) + b''.join(
    struct.pack('<3H', *f) for f in FACES)
BASE = {
    'asset': {'version': '2.0'},
    'scene': 0,
    'scenes': [{'nodes': [0]}],
    'nodes': [{'mesh': 0}],
    'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1}]}],
    'accessors': [
        {'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3'},
        {'bufferView': 1, 'componentType': 5123, 'count': 12, 'type': 'SCALAR'},
    ],
    'bufferViews': [
        {'buffer': 0, 'byteLength': 48},
        {'buffer': 0, 'byteOffset': 48, 'byteLength': 24},
    ],
    'buffers': [{'byteLength': 72,
                 'uri': 'data:;base64,' + base64.b64encode(BINARY).decode()}],
}


def text(document):
    return json.dumps(document, separators=(',', ':'))


def changed(path, value):
    """The document with one member changed; None takes it out. The path is 'accessors.0.count'."""
    document = copy.deepcopy(BASE)
    *way, last = [int(word) if word.isdigit() else word for word in path.split('.')]
    at = document
    for word in way:
        at = at[word]
    if value is None:
        del at[last]
    else:
        at[last] = value
    return text(document)


def glb(document, binary=BINARY, version=2, extra=0):
    """A GLB with a binary chunk."""
    body = document.encode()
    body += b' ' * (-len(body) % 4)
    chunks = struct.pack('<I4s', len(body), b'JSON') + body
    chunks += struct.pack('<I4s', len(binary), b'BIN\0') + binary
    return struct.pack('<4sII', b'glTF', version, 12 + len(chunks) + extra) + chunks


# Without it the buffer is a GLB's chunk.
GLB_BASE = changed('buffers.0.uri', None)


def members(cases):
    cases.accept('plain', 4, text(BASE))
    cases.accept('pretty', 4, json.dumps(BASE, indent=1))
    cases.accept('whole_as_float', 4, changed('accessors.0.count', 4.0))
    cases.accept('unknown_members', 4, changed('images', [{'uri': 'missing.png'}]))
    cases.accept('harmless_extension', 4, changed('extensionsRequired', ['KHR_materials_unlit']))
    cases.accept('no_default_scene', 4, changed('scene', None))
    refused = {
        'version_1': ('asset.version', '1.0'), 'version_number': ('asset.version', 2.0),
        'min_version': ('asset.minVersion', '2.1'), 'no_version': ('asset.version', None),
        'scene_missing': ('scene', 1), 'scene_text': ('scene', '0'), 'scenes_object': ('scenes', {}),
        'no_scenes': ('scenes', []), 'root_missing': ('scenes.0.nodes', [1]),
        'root_twice': ('scenes.0.nodes', [0, 0]), 'root_negative': ('scenes.0.nodes', [-1]),
        'root_fraction': ('scenes.0.nodes', [0.5]), 'root_text': ('scenes.0.nodes', ['0']),
        'root_list': ('scenes.0.nodes', [[0]]), 'roots_number': ('scenes.0.nodes', 0),
        'own_child': ('nodes.0.children', [0]), 'child_missing': ('nodes.0.children', [9]),
        'mesh_missing': ('nodes.0.mesh', 1), 'mesh_huge': ('nodes.0.mesh', 2 ** 32 - 1),
        'mesh_huger': ('nodes.0.mesh', 2 ** 70), 'mesh_null': ('nodes.0.mesh', {}),
        'skin': ('nodes.0.skin', 0), 'matrix_short': ('nodes.0.matrix', [1] * 15),
        'matrix_projective': ('nodes.0.matrix', [1] * 16),
        'rotation_zero': ('nodes.0.rotation', [0, 0, 0, 0]),
        'rotation_short': ('nodes.0.rotation', [0, 0, 1]),
        'scale_text': ('nodes.0.scale', ['1', 1, 1]),
        'no_primitives': ('meshes.0.primitives', []),
        'no_attributes': ('meshes.0.primitives.0.attributes', None),
        'no_position': ('meshes.0.primitives.0.attributes', {'NORMAL': 0}),
        'position_missing': ('meshes.0.primitives.0.attributes.POSITION', 7),
        'mode_lines': ('meshes.0.primitives.0.mode', 1), 'mode_7': ('meshes.0.primitives.0.mode', 7),
        'draco': ('extensionsRequired', ['KHR_draco_mesh_compression']),
        'unknown_extension': ('extensionsRequired', ['VENDOR_x']),
        'extensions_object': ('extensionsRequired', {'a': 1}),
    }
    for name, (path, value) in refused.items():
        cases.refuse(name, changed(path, value))
    # An infinite position: a vertex that is not finite is named.
    cases.refuse('scale_overflows', changed('nodes.0.scale', [1e308, 1e308, 1e308]).replace(
        '"scale"', '"translation":[1e308,1e308,1e308],"scale"'), 'is not finite')


def accessors(cases):
    refused = {
        'count_zero': ('count', 0), 'count_large': ('count', 5), 'count_huge': ('count', 4 * 10 ** 9),
        'count_negative': ('count', -4), 'no_count': ('count', None), 'type_vec2': ('type', 'VEC2'),
        'no_type': ('type', None), 'component_double': ('componentType', 5130),
        'component_uint': ('componentType', 5125), 'component_zero': ('componentType', 0),
        'component_wraps': ('componentType', 5126 + 65536),
        'offset_huge': ('byteOffset', 2 ** 53), 'offset_wraps': ('byteOffset', 2 ** 64 - 1),
        'offset_one': ('byteOffset', 1), 'view_missing': ('bufferView', 9),
        'no_view': ('bufferView', None), 'float_normalized': ('normalized', True),
        'normalized_number': ('normalized', 1),
    }
    for name, (key, value) in refused.items():
        cases.refuse(f'accessor_{name}', changed(f'accessors.0.{key}', value))
    for name, value in {'float': 5126, 'signed': 5122}.items():
        cases.refuse(f'indices_{name}', changed('accessors.1.componentType', value))
    cases.refuse('indices_vec3', changed('accessors.1.type', 'VEC3'))
    cases.refuse('indices_eleven', changed('accessors.1.count', 11), '11 corners')
    cases.accept('indices_are_bytes', 4, changed('accessors.1.componentType', 5121))
    cases.refuse('index_out_of_range', changed('accessors.1.bufferView', 0), 'of 4 positions')
    cases.refuse('stride_small', changed('bufferViews.0.byteStride', 8), 'leave their buffer view')
    cases.refuse('stride_large', changed('bufferViews.0.byteStride', 16), 'leave their buffer view')
    sparse = {'count': 1, 'indices': {'bufferView': 1, 'componentType': 5123},
              'values': {'bufferView': 0}}
    cases.accept('sparse', 4, changed('accessors.0.sparse', sparse | {
        'indices': {'bufferView': 1, 'byteOffset': 4, 'componentType': 5123}}))
    for name, part in {'none': {'count': 0}, 'many': {'count': 5}, 'no_values': {'values': {}},
                       'values_missing': {'values': {'bufferView': 8}},
                       'of_float': {'indices': {'bufferView': 1, 'componentType': 5126}},
                       'out_of_order': {'count': 4, 'indices': {'bufferView': 1,
                                                                'componentType': 5123}}}.items():
        cases.refuse(f'sparse_{name}', changed('accessors.0.sparse', sparse | part))


def buffers(cases):
    for name, value in {'huge': 10 ** 12, 'wraps': 2 ** 64 - 1, 'zero': 0, 'one_more': 73}.items():
        cases.refuse(f'view_length_{name}', changed('bufferViews.0.byteLength', value))
        cases.refuse(f'buffer_length_{name}', changed('buffers.0.byteLength', value))
    cases.refuse('view_offset', changed('bufferViews.1.byteOffset', 49))
    cases.refuse('view_buffer_missing', changed('bufferViews.0.buffer', 1))
    for name, uri in {'missing': 'missing.bin', 'above': '../x.bin', 'root': '/etc/hostname',
                      'http': 'http://localhost/x', 'not_base64': 'data:;base64,AAA$',
                      'cut_base64': 'data:;base64,' + 'A' * 93, 'plain_data': 'data:,abc',
                      'empty': '', 'percent': 'a%2', 'zero': 'a%00b'}.items():
        cases.refuse(f'uri_{name}', changed('buffers.0.uri', uri), 'buffers[0]: ')
    packed = {'buffer': 0, 'byteLength': 48, 'byteStride': 12, 'count': 4, 'mode': 'ATTRIBUTES'}
    cases.refuse('meshopt_plain', changed('bufferViews.0.extensions',
                                          {'EXT_meshopt_compression': packed}))
    cases.refuse('meshopt_huge', changed('bufferViews.0.extensions',
                                         {'EXT_meshopt_compression': packed | {'count': 4 * 10 ** 9}}))
    cases.refuse('meshopt_empty', changed('bufferViews.0.extensions',
                                          {'EXT_meshopt_compression': {}}))


def syntax(cases):
    whole = text(BASE)
    for cut in range(0, len(whole), 61):
        cases.refuse(f'cut_{cut}', whole[:cut])
    refused = {
        'list': '[' + whole + ']', 'number': '1', 'behind': whole + '{}', 'comma': whole[:-1] + ',}',
        'comment': '{/**/' + whole[1:], 'twice': '{"scene":0,' + whole[1:],
        'nan': whole.replace('"count":4', '"count":NaN'), 'utf8': whole.replace('asset', '\xff'),
        'control': whole.replace('2.0', '2.0\n'), 'deep_nodes': '{"nodes":' + '[' * 500,
        'digits': whole.replace('"count":4', '"count":4.' + '0' * 5000),
    }
    for name, content in refused.items():
        cases.refuse(name, content)
    cases.accept('deep_extras', 4, '{"extras":' + '[' * 3000 + ']' * 3000 + ',' + whole[1:])
    cases.accept('escapes', 4, whole.replace('"mesh"', '"\\u006desh"'))
    cases.accept('byte_order_mark', 4, '\xef\xbb\xbf' + whole)


def binary_cases():
    cases = Cases('glb')
    whole = glb(GLB_BASE)
    cases.accept('plain', 4, whole)
    cases.accept('chunk_longer', 4, glb(GLB_BASE, BINARY + b'\0\0\0'))
    for cut in (4, 11, 12, 19, 20, 60, len(whole) - 73, len(whole) - 72, len(whole) - 1):
        cases.refuse(f'cut_{cut}', whole[:cut])
        if cut >= 12:  # and a header of that size
            cases.refuse(f'told_cut_{cut}', whole[:8] + struct.pack('<I', cut) + whole[12:cut])
    cases.refuse('version_1', glb(GLB_BASE, version=1), 'GLB version 1')
    cases.refuse('longer', glb(GLB_BASE, extra=1))
    cases.refuse('shorter', glb(GLB_BASE, extra=-4))
    cases.refuse('no_json', whole.replace(b'JSON', b'NOSJ'), 'no JSON')
    cases.refuse('chunk_short', glb(GLB_BASE, BINARY[:-1]), '71 bytes of 72')
    cases.refuse('no_chunk', glb(GLB_BASE, b''), 'it has no data')
    cases.refuse('chunk_huge', whole[:12] + struct.pack('<I', 2 ** 32 - 1) + whole[16:])
    return cases


def all_cases():
    cases = Cases('gltf')
    for part in (members, accessors, buffers, syntax):
        part(cases)
    return cases + binary_cases()
