"""3MF: packages that are damaged or lack parts, and models that do not hold what they promise."""

import io
import zipfile

from cases import FACES, POSITIONS, Cases

RELATION = 'http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'
CORE = 'http://schemas.microsoft.com/3dmanufacturing/core/2015/02'
RELATIONS = (
    '<?xml version="1.0"?><Relationships '
    'xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    f'<Relationship Target="/3D/3dmodel.model" Id="a" Type="{RELATION}"/></Relationships>')
VERTICES = ''.join('<vertex x="%d" y="%d" z="%d"/>' % p for p in POSITIONS)
TRIANGLES = ''.join('<triangle v1="%d" v2="%d" v3="%d"/>' % f for f in FACES)
MESH = f'<mesh><vertices>{VERTICES}</vertices><triangles>{TRIANGLES}</triangles></mesh>'
MODEL = (f'<?xml version="1.0"?><model unit="millimeter" xmlns="{CORE}"><resources>'
         f'<object id="1" type="model">{MESH}</object></resources>'
         '<build><item objectid="1"/></build></model>')


def package(parts, method=zipfile.ZIP_DEFLATED):
    out = io.BytesIO()
    with zipfile.ZipFile(out, 'w', method) as archive:
        for name, text in parts.items():
            archive.writestr(zipfile.ZipInfo(name), text, method)
    return out.getvalue()


def of_model(model, method=zipfile.ZIP_DEFLATED):
    return package({'_rels/.rels': RELATIONS, '3D/3dmodel.model': model}, method)


WHOLE = of_model(MODEL)
CONFIGS = {
    'prusa': '<config><object id="1"><volume firstid="0" lastid="1"><metadata key="volume_type" value="ModelPart"/></volume>'
             '<volume firstid="2" lastid="3"><metadata key="volume_type" value="ParameterModifier"/></volume></object></config>',
    'prusa_negative': '<config><object id="1"><volume firstid="1" lastid="2"><metadata key="volume_type" '
                      'value="NegativeVolume"/></volume></object></config>',
    'prusa_old': '<config><object id="1"><volume firstid="0" lastid="0"><metadata key="modifier" value="1"/></volume></object></config>',
    'bambu': '<config><object id="2"><part id="1" subtype="support_blocker"/></object></config>',
    'bambu_negative': '<config><object id="2"><part id="1" subtype="negative_part"/></object></config>',
}
# Object 2 has object 1 as its component.
COMPOSITE = MODEL.replace('</object>', '</object><object id="2"><components><component objectid="1"/></components></object>').replace(
    '<item objectid="1"/>', '<item objectid="2"/><item objectid="1"/>')


def changes():
    """Models by name, each with one place of MODEL changed, and whether it is refused."""
    refused = {
        'no_x': (' x="1"', ''), 'x_word': ('x="1"', 'x="one"'), 'x_nan': ('x="1"', 'x="nan"'),
        'x_huge': ('x="1"', 'x="1e999"'), 'x_hex': ('x="1"', 'x="0x1"'),
        'v_negative': ('v1="1"', 'v1="-1"'), 'v_large': ('v1="1"', 'v1="4"'),
        'v_wraps': ('v1="1"', 'v1="4294967297"'), 'v_fraction': ('v1="1"', 'v1="1.5"'),
        'no_v2': (' v2="3"', ''), 'id_word': ('id="1" type', 'id="a" type'),
        'no_id': ('<object id="1"', '<object'), 'type_other': ('type="model"', 'type="other"'),
        'type_odd': ('type="model"', 'type="odd"'),
        'surface': ('type="model"', 'type="surface"'), 'item_missing': ('objectid="1"', 'objectid="2"'),
        'no_item': ('<item objectid="1"/>', ''), 'no_build': ('<build><item objectid="1"/></build>', ''),
        'no_triangles': (TRIANGLES, ''), 'no_vertices': (VERTICES, ''), 'no_mesh': (MESH, ''),
        'two_meshes': (MESH, MESH + MESH), 'no_namespace': (f' xmlns="{CORE}"', ''),
        'other_root': ('<model', '<modal'), 'unit_odd': ('millimeter', 'league'),
        'doctype': ('<model', '<!DOCTYPE model><model'), 'unknown_entity': ('x="1"', 'x="&a;"'),
        'utf16': ('version="1.0"', 'version="1.0" encoding="UTF-16"'),
        'control': ('<resources>', '\1<resources>'), 'unbound': ('<resources>', '<q:a/><resources>'),
        'transform_short': ('<item', '<item transform="1 0 0"'),
        'transform_word': ('<item', '<item transform="a b c d e f g h i j k l"'),
        'transform_long': ('<item', '<item transform="1 0 0 0 1 0 0 0 1 0 0 0 1"'),
        'transform_huge': ('<item', '<item transform="1e308 1e308 0 0 1e308 0 0 0 1 1e308 0 0"'),
        'own_component': (MESH, '<components><component objectid="1"/></components>'),
        'not_closed': ('</model>', ''), 'behind': ('</model>', '</model><model/>'),
        'required': ('<model', '<model requiredextensions="z"'),
        'required_known_name': ('<model', '<model requiredextensions="p"'),
    }
    accepted = {
        'plain': ('', ''), 'blank_numbers': ('x="1"', 'x=" 1\n"'), 'comment': ('<build>', '<!--a--><build>'),
        'no_unit': (' unit="millimeter"', ''),
        'metadata': ('<resources>', '<metadata name="a">b</metadata><resources>'),
        'foreign': ('<resources>', '<a:b xmlns:a="urn:a"><a:c/></a:b><resources>'),
        'colours': ('v3="1"', 'v3="1" pid="9" p1="0"'),
        'transform': ('<item', '<item transform="1 0 0 0 1 0 0 0 1 5 6 7"'),
    }
    for table, outcome in ((refused, 'R'), (accepted, 'A')):
        for name, (before, after) in table.items():
            yield name, outcome, MODEL.replace(before, after, 1) if before else MODEL


def models():
    for name, _, model in changes():
        yield name, model
    for cut in range(0, len(MODEL), 150):
        yield f'cut_{cut}', MODEL[:cut]
    for name, config in CONFIGS.items():  # of slicers, behind a zero byte
        yield f'config_{name}', COMPOSITE + '\0' + config


def packages(cases):
    cases.accept('stored', 4, of_model(MODEL, zipfile.ZIP_STORED))
    cases.accept('other_case', 4, package({'_rels/.rels': RELATIONS, '3d/3DMODEL.model': MODEL}))
    cases.refuse('no_relations', package({'3D/3dmodel.model': MODEL}), "part '_rels/.rels'")
    cases.refuse('no_model', package({'_rels/.rels': RELATIONS}), 'it is not in the archive')
    cases.refuse('empty_archive', package({}))
    cases.refuse('two_models', package({'3D/3dmodel.model': MODEL, '_rels/.rels': RELATIONS.replace(
        '</Rel', f'<Relationship Target="/b" Id="b" Type="{RELATION}"/></Rel')}), '2 root models')
    cases.refuse('relations_are_text', package({'_rels/.rels': 'text', '3D/3dmodel.model': MODEL}))
    for cut in (4, 30, 60, len(WHOLE) // 2, len(WHOLE) - 60, len(WHOLE) - 22, len(WHOLE) - 1):
        cases.refuse(f'cut_{cut}', WHOLE[:cut])
    stored = of_model(MODEL, zipfile.ZIP_STORED)
    at = stored.index(b'x="1"') + 3
    cases.refuse('damaged', stored[:at] + b'2' + stored[at + 1:], 'it is damaged')
    central = WHOLE.index(b'PK\1\2')
    encrypted = WHOLE[:central + 8] + b'\1' + WHOLE[central + 9:]
    cases.refuse('encrypted', encrypted)
    blank = MODEL.replace('<resources>', '<resources>' + ' ' * 3_000_000)
    cases.accept('blank', 4, of_model(blank))
    cases.refuse('long_tag', of_model(MODEL.replace('x="1"', f'x="{"0" * 400_000}1"', 1)),
                 'a tag of more than')


def with_config(name):
    part = 'Metadata/model_settings.config' if name.startswith('bambu') else 'Metadata/Slic3r_PE_model.config'
    return package({'_rels/.rels': RELATIONS, '3D/3dmodel.model': COMPOSITE, part: CONFIGS[name]})


def all_cases():
    cases = Cases('3mf')
    for name, outcome, model in changes():
        if outcome == 'R':
            cases.refuse(name, of_model(model))
        else:
            cases.accept(name, 4, of_model(model))
    for cut in range(0, len(MODEL), 61):
        cases.refuse(f'model_cut_{cut}', of_model(MODEL[:cut]))
    packages(cases)
    for name, faces in (('prusa', 4), ('prusa_old', 6), ('bambu', 4)):
        cases.accept(f'config_{name}', faces, with_config(name), 'bodies: left out: 1 ' if name == 'bambu' else 'bodies: left out: 2 ')
    for name in ('prusa_negative', 'bambu_negative'):
        cases.refuse(f'config_{name}', with_config(name), 'has a negative volume')
    return cases
