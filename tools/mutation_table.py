"""The error terms of the certificate, and how each is weakened (tools/mutation.py).

A row: a name, the file, the text as it stands (the nth occurrence), its replacements step by step
from one too small to removed, and the tests to run, the cheapest first.
"""

TWO = "shaders/math/two_float.h"
CERTIFIED = "shaders/math/certified.h"
TRIANGLE = "shaders/math/triangle.h"
BOUNDS = "shaders/math/bounds.h"
PAPER = "shaders/paper/bounds_paper.h"
BARY = "shaders/math/bary.h"
DYADIC = "shaders/math/dyadic.h"
CELL = "shaders/report/cell.h"
SIDE = "shaders/report/side.h"
NORMAL = "shaders/report/normal.h"
PARTS = "shaders/math/parts.h"
WIDE = "shaders/survey/wide.h"
TALLY = "shaders/survey/tally.h"
SCORE = "shaders/survey/score.h"
LOWER = "shaders/math/lower.h"
FRAME = "host/mesh/frame.cpp"
LENGTH = "host/base/length.cpp"
TWO_DOUBLE = "host/native/two_double.h"
IN_DOUBLES = "host/native/certified.h"
PLACE = "host/native/place.h"
SEPARATE = "host/native/separate.h"
CELL_IN_DOUBLES = "host/native/cell.h"
BOXES = "host/native/face_tree.h"
LEVELS = "host/native/levels.cpp"
COVERAGE = "host/solve/coverage.cpp"

ON_TWO = ["lib_two_float_test", "lib_attack_test", "lib_model_test"]
ON_CERTIFIED = ["lib_attack_test", "lib_certified_test", "lib_model_test"]
ON_ABOVE = ["lib_attack_test", "lib_triangle_test", "lib_lower_test", "lib_bounds_test", "lib_model_test"]
ON_TRIANGLE = ["lib_attack_test", "lib_triangle_test", "lib_model_test"]
ON_BOUNDS = ["lib_attack_test", "lib_bounds_test", "lib_model_test"]
ON_BARY = ["lib_attack_test", "lib_bary_test", "lib_model_test"]
ON_CELL = ["lib_cell_model_test", "lib_cell_test"]
ON_PARTS = ["lib_parts_model_test", "lib_parts_test"]
ON_TALLY = ["lib_tally_test"]
ON_SIDE = ["lib_side_test"]
ON_NORMAL = ["lib_normal_test"]
ON_LOWER = ["lib_attack_test", "lib_lower_test", "lib_model_test"]
ON_FRAME = ["frame_test"]
ON_LENGTH = ["diagonal_test"]
ON_DOUBLES = ["native_bounds_test"]
ON_CELLS_IN_DOUBLES = ["native_cells_test"]
ON_COVERAGE = ["verify_test"]


def row(name, file, old, new, tests, nth=1):
    return {"name": name, "file": file, "old": old, "new": new, "tests": tests, "nth": nth}


def counts(name, file, text, tests, nth=1, steps=None):
    """A count of ulps, written `text` with its number as {}: one less, then less and less."""
    number = text[text.index("{") + 1:text.index("}")]
    value = float(number.rstrip("f"))
    lower = steps or [v for v in (value - 1, value / 2, value / 4, value / 16, 0.0)
                      if v < value]
    lower = list(dict.fromkeys(lower))
    plain = text.replace("{", "").replace("}", "")
    return row(name, file, plain, [text.replace("{" + number + "}", f"{v!r}f") for v in lower], tests, nth)


INSIDE = "both(v >= 0.0f, both(w >= 0.0f, v + w <= 1.0f - 4.0f * kUlp))"
INSIDE_BUT_V = "both(w >= 0.0f, v + w <= 1.0f - 4.0f * kUlp)"

ROWS = [
    # two_float.h
    row("kUlp2", TWO, "5.6843419e-14f", [f"{2.0 ** -e!r}f" for e in (45, 46, 47, 48, 50)], ON_TWO),
    row("two_sum's low part (vectors)", TWO, "r.lo = e;", ["r.lo = 0.0f * e;"], ON_TWO),
    row("two_sum's low part", TWO, "r.lo = e;", ["r.lo = 0.0f;"], ON_TWO, nth=3),
    row("two_product's low part", TWO, "r.lo = e;", ["r.lo = 0.0f;"], ON_TWO, nth=2),
    row("upper_half's width", TWO, "0xfffff000u", ["0xffffe000u"], ON_TWO),
    row("two_product's last product", TWO, " + al * bl", [""], ON_TWO),
    row("two_difference's low parts", TWO, "d.lo + (a.lo - b.lo)", ["d.lo + a.lo", "d.lo"], ON_TWO),
    row("two_combination's sums", TWO, "((base.lo + s.lo) + t.lo)", ["(base.lo + s.lo)", "base.lo"], ON_TWO),
    row("two_combination's products", TWO, "(p.lo + q.lo)", ["p.lo"], ON_TWO),
    row("two_combination's low factors", TWO, " + (x * u.lo + y * v.lo)", [" + x * u.lo", ""], ON_TWO),
    row("two_dot's products", TWO, "((x.lo + y.lo) + (z.lo + s.lo))", ["((x.lo + y.lo) + s.lo)"], ON_TWO),
    row("two_dot's last sum", TWO, "(t.lo + (dot3(a.hi, b.lo)", ["((dot3(a.hi, b.lo)"], ON_TWO),
    row("two_dot's low factors", TWO, "dot3(a.hi, b.lo) + dot3(a.lo, b.hi)", ["dot3(a.hi, b.lo)"], ON_TWO),

    # certified.h
    row("kUlp", CERTIFIED, "1.1920929e-7f", [f"{2.0 ** -e!r}f" for e in (24, 25)], ON_CERTIFIED),
    row("kTiny", CERTIFIED, "8.6736174e-19f", ["4.3e-19f", "2.2e-19f", "1e-20f", "1e-26f", "0.0f"], ON_CERTIFIED),
    counts("round_up's two ulps", CERTIFIED, "1.0f + (n + {2.0f}) * kUlp", ON_CERTIFIED),
    row("round_up's kTiny", CERTIFIED, " * kUlp) + kTiny", [" * kUlp)"], ON_CERTIFIED),
    counts("round_down's two ulps", CERTIFIED, "1.0f - (n + {2.0f}) * kUlp", ON_CERTIFIED),
    row("round_down's kTiny", CERTIFIED, " * kUlp) - kTiny", [" * kUlp)"], ON_CERTIFIED),
    row("round_down's floor at 0", CERTIFIED, "max(x * (1.0f - (n + 2.0f) * kUlp) - kTiny, 0.0f)",
        ["(x * (1.0f - (n + 2.0f) * kUlp) - kTiny)"], ON_CERTIFIED),
    counts("sqrt_up", CERTIFIED, "round_up(root(x), {6.0f})", ON_CERTIFIED),
    counts("sqrt_down", CERTIFIED, "round_down(root(x), {6.0f})", ON_CERTIFIED),
    counts("norm_up", CERTIFIED, "round_up(root(dot3(v, v)), {8.0f})", ON_CERTIFIED),
    counts("norm_down", CERTIFIED, "round_down(root(dot3(v, v)), {8.0f})", ON_CERTIFIED),
    counts("length_up", CERTIFIED, "round_up(root(square), {8.0f})", ON_CERTIFIED),
    row("next_up", CERTIFIED, "floatBitsToUint(x) + 1u", ["floatBitsToUint(x)"], ON_CERTIFIED),
    row("next_down", CERTIFIED, "floatBitsToUint(x) - 1u", ["floatBitsToUint(x)"], ON_CERTIFIED),
    row("next_up around 0", CERTIFIED, "2.0f * kTiny", ["kTiny", "0.0f"], ON_CERTIFIED),
    row("kSmallSquare", CERTIFIED, "1.2621774e-29f", ["0.0f"], ON_CERTIFIED),
    row("sharp_norm_up's steps", CERTIFIED, "next_up(next_up(s + 0.5f * ratio(e, s)))",
        ["next_up(s + 0.5f * ratio(e, s))", "(s + 0.5f * ratio(e, s))"], ON_CERTIFIED),
    row("sharp_norm_up's low square", CERTIFIED, "+ x.lo;", [";"], ON_CERTIFIED),
    row("sharp_norm_up's small lengths", CERTIFIED, "!(x.hi > 1e-30f)", ["!(x.hi > 1e-34f)", "!(x.hi > 0.0f)"], ON_CERTIFIED),
    row("sharp_norm_up's remainder", CERTIFIED, "((x.hi - square.hi) - square.lo)", ["(x.hi - square.hi)"],
        ON_CERTIFIED),
    row("quotient_down's steps", CERTIFIED, "next_down(next_down(q + remainder / b))",
        ["next_down(q + remainder / b)", "(q + remainder / b)"], ON_CERTIFIED),
    row("quotient_down's kTiny", CERTIFIED, "remainder / b)) - kTiny", ["remainder / b))"], ON_CERTIFIED),
    row("quotient_down's remainder", CERTIFIED, "q + remainder / b", ["q"], ON_CERTIFIED),

    counts("raised", CERTIFIED, "x + ({4.0f} * kUlp", ON_ABOVE, steps=[3.0, 2.0, 1.0, 0.5, 0.0]),
    row("raised's kTiny", CERTIFIED, "x + (4.0f * kUlp * abs(x) + kTiny)", ["x + (4.0f * kUlp * abs(x))"], ON_ABOVE),
    counts("lowered", CERTIFIED, "x - ({4.0f} * kUlp", ON_ABOVE, steps=[3.0, 2.0, 1.0, 0.5, 0.0]),
    row("lowered's kTiny", CERTIFIED, "x - (4.0f * kUlp * abs(x) + kTiny)", ["x - (4.0f * kUlp * abs(x))"], ON_ABOVE),
    counts("sharp_norm_above_up's length", CERTIFIED, "{16.0f} * kUlp2 * s", ON_ABOVE),
    row("sharp_norm_above_up's low square", CERTIFIED, "- square.lo) + x.lo;", ["- square.lo);"], ON_ABOVE, nth=2),
    counts("quotient_above_down's quotient", CERTIFIED, "{64.0f} * kUlp2 * q", ON_ABOVE),
    counts("quotient_above_down's off", CERTIFIED, "round_up(off / l, {16.0f})", ON_ABOVE),
    row("quotient_above_down's length", CERTIFIED, " - q * extra", [""], ON_ABOVE),
    row("quotient_above_down's low reach", CERTIFIED, "- product.lo) + reach.lo)", ["- product.lo))"], ON_ABOVE),

    # triangle.h
    counts("closest_point's guard under 1", TRIANGLE, "1.0f - {4.0f} * kUlp", ON_TRIANGLE, steps=[3.0, 2.0, 1.0, 0.0]),
    row("closest_point's clamp", TRIANGLE, "clamp(t, 0.0f, 1.0f)", ["clamp(t, 0.0f, 1.0000005f)"], ON_TRIANGLE),
    row("closest_point's inside", TRIANGLE, INSIDE, [INSIDE_BUT_V], ON_TRIANGLE),
    row("closest_point's altitude", TRIANGLE, "both(has_inside, in_halves)", ["in_halves"], ON_TRIANGLE),
    row("step_to_foot's room", TRIANGLE, "lowered((1.0f - sum.hi) - sum.lo)", ["(1.0f - sum.hi) - sum.lo", "1.0f - sum.hi"], ON_TRIANGLE),
    row("step_to_foot's room beside the other step", TRIANGLE, "lowered(base_weight_down(c) - step.w)", ["base_weight_down(c) - step.w", "base_weight_down(c)"],
        ON_TRIANGLE),
    counts("Surface::slack, reach", TRIANGLE, "{8.0f} * from.reach", ON_TRIANGLE),
    counts("Surface::slack, radius", TRIANGLE, "{15.0f} * radius_up(s.at)", ON_TRIANGLE),
    counts("Surface::slack, its rounding", TRIANGLE, "radius_up(s.at)), {4.0f})", ON_TRIANGLE),
    row("distance_to_up's slack, sharp", TRIANGLE, "sharp_norm_above_up(offset, s.base) + s.slack",
        ["sharp_norm_above_up(offset, s.base) + 0.1f * s.slack", "sharp_norm_above_up(offset, s.base)"], ON_TRIANGLE),
    row("surface_distance_up's slack", TRIANGLE, "norm_up(rounded(offset)) + s.slack",
        ["norm_up(rounded(offset)) + 0.1f * s.slack", "norm_up(rounded(offset))"], ON_TRIANGLE),
    row("distance_to_up's rounding, sharp", TRIANGLE, "raised(sharp_norm_above_up(offset, s.base) + s.slack)",
        ["(sharp_norm_above_up(offset, s.base) + s.slack)"], ON_TRIANGLE),
    row("distance_to_up's rounding", TRIANGLE, "raised(round_up(norm_up(rounded(offset)) + s.slack, 1.0f) - s.base)",
        ["(round_up(norm_up(rounded(offset)) + s.slack, 1.0f) - s.base)"], ON_TRIANGLE),
    counts("surface_distance_up's sum", TRIANGLE, "rounded(offset)) + s.slack, {1.0f})", ON_TRIANGLE),
    counts("coarse_slack", TRIANGLE, "{12.0f} * kUlp * radius_up(at)", ON_TRIANGLE, steps=[6.0, 3.0, 1.0, 0.5, 0.0]),
    counts("coarse_slack, its rounding", TRIANGLE, "kUlp2 * reach, {4.0f})", ON_TRIANGLE),
    row("a coarse distance's slack", TRIANGLE, "round_up(d + s.slack, 3.0f)",
        ["round_up(d + 0.1f * s.slack, 3.0f)", "round_up(d, 3.0f)"], ON_TRIANGLE),
    counts("a coarse distance's own ulps", TRIANGLE, "d + s.slack, {3.0f})", ON_TRIANGLE),
    row("plain_distance2's clamp", TRIANGLE, "clamp(x, 0.0f, 1.0f)", ["clamp(x, 0.0f, 1.00001f)"], ON_TRIANGLE),
    row("plain_distance2's inside", TRIANGLE, INSIDE, [INSIDE_BUT_V], ON_TRIANGLE, nth=2),
    counts("plain_distance2's guard under 1", TRIANGLE, "1.0f - {4.0f} * kUlp", ON_TRIANGLE, nth=2, steps=[2.0, 0.0]),
    row("radius_up's corners", TRIANGLE, "max(dot3(t.b, t.b), dot3(t.c, t.c))", ["dot3(t.b, t.b)"], ON_TRIANGLE),
    counts("enclosing_radius_up", TRIANGLE, "round_up(r, {1.0f})", ON_TRIANGLE),
    row("enclosing_radius_up's corners", TRIANGLE, "max(norm_up(ab - centre), norm_up(ac - centre))",
        ["norm_up(ab - centre)"], ON_TRIANGLE),
    row("offset_from's third corner", TRIANGLE, "-c.v, u, -c.w, v", ["-c.v, u, 0.0f, v"], ON_TRIANGLE),

    # bounds.h
    counts("kept_bound", BOUNDS, "max(bound + shift, 0.0f), {1.0f})", ON_BOUNDS),
    row("bound_single's corners", BOUNDS, "max(d.x, max(d.y, d.z))", ["max(d.x, d.y)"], ON_BOUNDS),
    counts("bound_u1", BOUNDS, "max(farther, 0.0f), {3.0f})", ON_BOUNDS),
    row("bound_u1's farther corner", BOUNDS, "d.x + max(ab, ca)", ["d.x + ab"], ON_BOUNDS),
    counts("bound_u2", BOUNDS, "max3(d), 0.0f), {1.0f})", ON_BOUNDS),
    row("bound_u2's worst corner", BOUNDS, "enclosing_radius_up(t.at) + max3(d)",
        ["enclosing_radius_up(t.at) + min(d.x, min(d.y, d.z))"], ON_BOUNDS),
    row("bound_cut's larger", BOUNDS, "max(surface_distance_up(p, s), surface_distance_up(p, r))",
        ["min(surface_distance_up(p, s), surface_distance_up(p, r))"], ON_BOUNDS),
    row("bound_cut's second cut", BOUNDS, "max(at_p, at_q)", ["max(at_p, min(at_p, at_q))"], ON_BOUNDS),
    row("bound_pair's corners", BOUNDS, "max(bound_nearer(ds, dr), bound_cut(t, cut, from_cut(ds, dr, s.base), s, r))",
        ["bound_cut(t, cut, from_cut(ds, dr, s.base), s, r)"], ON_BOUNDS),

    # bounds_paper.h
    row("bound_split's side", PAPER, "side.y < 0.0f ? ds.y : dr.y", ["min(ds.y, dr.y)"], ON_BOUNDS),
    row("bound_split's cuts", PAPER, "max(corners, bound_cut(t, cut, side, s, r))", ["corners"], ON_BOUNDS),
    row("bound_third's corner", PAPER, "max(d, max(middles", ["max(min(d, middles), max(middles"], ON_BOUNDS),
    row("bound_third's centroid", PAPER, "max(middles, surface_distance_up(centre, s))",
        ["max(middles, min(middles, surface_distance_up(centre, s)))"], ON_BOUNDS),

    # wide.h and tally.h
    row("wide_sum's carry", WIDE, "a.y + b.y + choose(low < a.x, 1u, 0u)", ["a.y + b.y"], ON_TALLY),
    row("wide_shifted's high word", WIDE, "(low >> bits) | from_high", ["low >> bits"], ON_TALLY),
    row("wide_scaled's carry", WIDE, "more = more + choose(middle < high, 1u, 0u);", [""], ON_TALLY),
    row("wide_scaled's highest word", WIDE, "(middle >> shift) | (more << (32u - shift))", ["middle >> shift"], ON_TALLY),
    row("halvings_of's borrow", TALLY, " - choose(uint(p_low) < uint(q_low), 1u, 0u)", [""], ON_TALLY),
    row("cell_weight from above", TALLY, "wide_sum(w.down, uvec2(1u, 0u))", ["w.down"], ON_TALLY),
    row("share_down's weight", TALLY, "wide_scaled(w.down, uint(share * 16777216.0f), 24u)",
        ["wide_scaled(w.up, uint(share * 16777216.0f), 24u)"], ON_TALLY),
    row("share_up's ceiling", TALLY, "m = m + choose(float(m) < scaled, 1u, 0u);", [""], ON_TALLY),
    row("share_up's unit", TALLY, "wide_sum(wide_scaled(w.up, m, 24u), uvec2(1u, 0u))", ["wide_scaled(w.up, m, 24u)"], ON_TALLY),
    row("weighed's exponent", TALLY, "23 + unit - exponent", ["22 + unit - exponent", "24 + unit - exponent"], ON_TALLY),
    row("weighed's leading bit", TALLY, "(bits & 0x7fffffu) | 0x800000u", ["bits & 0x7fffffu"], ON_TALLY),
    row("weighed_up's unit", TALLY, "choose(bits_of(value) == 0u, 0u, 1u)", ["0u"], ON_TALLY),
    row("weighed_up's weight", TALLY, "uvec2 down = weighed(w.up, value, unit);", ["uvec2 down = weighed(w.down, value, unit);"], ON_TALLY),
    row("tally_bounds' square", TALLY, "round_up(b.highest * t.mean_upper, 1.0f)", ["0.99f * b.highest * t.mean_upper"], ON_TALLY),
    row("lowest_of", TALLY, "max(b.below.least, 0.0f)", ["max(b.below.most, 0.0f)"], ON_TALLY),
    row("within_most's cap", TALLY, "choose(lowest_of(b) > most.up, 0.0f, max(most.up, 0.0f))",
        ["max(most.down, 0.0f)", "max(most.up, 0.0f)"], ON_TALLY),
    row("within_most's lower", TALLY, "b.lower = vec3(0.0f, 0.0f, 0.0f);", [""], ON_TALLY),
    row("within_most's square", TALLY, "round_up(cap * cap, 1.0f), 0.0f)", ["0.99f * cap * cap, 0.0f)"], ON_TALLY),
    row("face_score's limit", SCORE, "min((highest - reached) - tolerance, highest - within)", ["(highest - reached) - tolerance"], ON_TALLY),
    row("face_score's verdict", SCORE, "choose(reached > beyond, 0.0f, max(above, 0.0f))", ["max(above, 0.0f)"], ON_TALLY),
    row("drawn_by's upper", SCORE, "min(max3(upper_of(b) - at), b.highest - least3(at))", ["min(least3(upper_of(b) - at), b.highest - least3(at))", "min(max3(upper_of(b) - at), b.highest - max3(at))"], ON_TALLY),
    row("drawn_by's lower", SCORE, "min(max3(at - lower_of(b)), max3(at) - lowest_of(b))", ["min(least3(at - lower_of(b)), max3(at) - lowest_of(b))", "min(max3(at - lower_of(b)), least3(at) - lowest_of(b))"], ON_TALLY),
    row("drawn_by's ways", SCORE, "max(farther, nearer)", ["farther", "nearer", "min(farther, nearer)"], ON_TALLY),
    row("drawn_of's choice", SCORE, "level.off < affine.off", ["level.off > affine.off"], ON_TALLY),
    row("has_quarters' bits", SCORE, "& 3u) == 0u", ["& 1u) == 0u"], ON_TALLY),
    row("half_points' corner", SCORE, "(split - 1u) % 3u, 3u, half_side", ["split % 3u, 3u, half_side"], ON_TALLY),

    # side.h
    row("side_of_plane's turn", SIDE, "2.0f * off * (norm_up(e) + norm_up(f) + 2.0f * off)", ["0.0f"], ON_SIDE),
    row("side_of_plane's point", SIDE, "area * (2.0f * off + 13.0f * kUlp * away)", ["area * 13.0f * kUlp * away"], ON_SIDE),
    row("side_of_plane's rounding", SIDE, "13.0f * kUlp * away", ["0.0f * away"], ON_SIDE),
    row("turn_error's rounding", SIDE, "10.0f * kUlp * size", ["0.0f * size"], ON_SIDE),
    row("turn_error's off", SIDE, "1.001f * off * (sum + 2.0f * off)", ["0.5f * off * sum", "0.0f"], ON_SIDE),
    row("product_error's area", SIDE, "abs(x) * error + (abs(w) + error)", ["(abs(w) + error)"], ON_SIDE),
    row("product_error's coordinate", SIDE, "(8.0f * kUlp * abs(x) + off)", ["(8.0f * kUlp * abs(x))", "0.0f"], ON_SIDE),
    row("crossing_of's direction", SIDE, "ahead == x ? x : 0", ["x"], ON_SIDE),
    row("may_be_closest's move", SIDE, "minorant_off(t, s) + 2.0f * moved", ["minorant_off(t, s) + moved", "minorant_off(t, s)"], ON_SIDE),
    row("is_off's move", SIDE, "lowest > round_up(moved, 4.0f)", ["lowest >= moved", "lowest > 0.0f"], ON_SIDE),
    row("most_on_edge's rounding", PARTS, "to_end * (other_end - other)), 8.0f)", ["to_end * (other_end - other)), 0.0f)"], ON_SIDE),
    row("most_on_edge's end", PARTS, "max(other, other + to_end", ["min(other, other + to_end"], ON_SIDE),
    row("is_off_but_near's move", SIDE, "most_within(lower, upper, round_up(moved, 4.0f)) + moved", ["most_within(lower, upper, 0.0f) + moved", "most_within(lower, upper, round_up(moved, 4.0f))"], ON_SIDE),
    row("is_off_inside's rounding", SIDE, "lower) - 8.0f * kUlp", ["lower) + 8.0f * kUlp"], ON_SIDE),
    row("class_with's other side", SIDE, "(before != kClassUnseen && before != now)", ["false"], ON_SIDE),

    row("surely_within's share", TALLY, "(within - (1.0f - b.sure)) - 2.0f * kUlp", ["within - (1.0f - b.sure)", "within"], ON_TALLY),
    row("perhaps_within's share", TALLY, "min(share_within(b.below, up).up, b.may)", ["share_within(b.below, up).up"], ON_TALLY),
    row("part_down's share", TALLY, "if (share == 1.0f) return w.down;", ["if (share > 0.9f) return w.down;"], ON_TALLY),
    row("part_up's share", TALLY, "if (share == 1.0f) return w.up;", ["if (share > 0.0f) return w.down;"], ON_TALLY),
    row("counts_to's cells", TALLY, "choose(b.sure == 1.0f, b.highest, 3.0e38f)", ["b.highest"], ON_TALLY),
    row("with_normals' cells", SCORE, "if (of_class != kClassCompared) {", ["if (of_class == kClassUnseen) {"], ON_TALLY),

    # normal.h
    row("cosine_between's first normal", NORMAL, "(m_off + (1.0f + m_off) * n_off)", ["n_off"], ON_NORMAL),
    row("cosine_between's second normal", NORMAL, "(m_off + (1.0f + m_off) * n_off)", ["m_off"], ON_NORMAL),
    row("cosine_between's rounding", NORMAL, "+ 6.0f * kUlp, 4.0f)", [", 4.0f)"], ON_NORMAL),
    row("sign_along's point", NORMAL, "2.0f * off * (far + length + 2.0f * off)", ["2.0f * off * far"], ON_NORMAL),
    row("sign_along's edge", NORMAL, "2.0f * off * (far + length + 2.0f * off)", ["2.0f * off * length", "0.0f"], ON_NORMAL),
    row("sign_along's rounding", NORMAL, "turned + 6.0f * kUlp * far * length", ["turned"], ON_NORMAL),
    row("is_over_edge's rounding", NORMAL, "16.0f * kUlp * far * length * length * width", ["0.0f"], ON_NORMAL),
    row("is_over_edge's point", NORMAL, "(most_length * most_width + 2.0f * most_far", ["(2.0f * most_far"], ON_NORMAL),
    row("is_over_edge's edge", NORMAL, "2.0f * most_far * most_width +", ["0.5f * most_far * most_width +", ""], ON_NORMAL),
    row("is_over_edge's third corner", NORMAL, "+ most_far * most_length)", [")"], ON_NORMAL),
    row("closest_feature's triangle", NORMAL, "round_up(s.slack + t.slack + moved, 2.0f)", ["round_up(t.slack + moved, 2.0f)"], ON_NORMAL),
    row("closest_feature's cell", NORMAL, "round_up(s.slack + t.slack + moved, 2.0f)", ["round_up(s.slack + moved, 2.0f)"], ON_NORMAL),
    row("closest_feature's move", NORMAL, "round_up(s.slack + t.slack + moved, 2.0f)", ["round_up(s.slack + t.slack, 2.0f)"], ON_NORMAL),
    row("closest_feature's other side", NORMAL, "to_next < 0 && cell_along(t, p, r, off) < 0", ["to_next < 0"], ON_NORMAL),
    row("closest_feature's other end", NORMAL, "to_next > 0 && cell_along(t, q, p, off) > 0", ["to_next > 0"], ON_NORMAL),
    row("closest_feature's edge", NORMAL, "is_between && is_cell_over_edge(t, p, q, r, off)", ["is_between"], ON_NORMAL),
    row("has_corners' bits", NORMAL, "both(has_a, both(has_b, has_c))", ["both(has_a, has_b)", "has_c"], ON_NORMAL),
    row("closest_share's excess", NORMAL, "vec3(lowered(x.x), lowered(x.y), lowered(x.z))), 0.0f).up", ["vec3(lowered(x.x), lowered(x.y), lowered(x.z))), 0.0f).up * 0.999f"], ON_NORMAL),
    row("more_by's sum", NORMAL, "raised(x + raised(share * raised(value)))", ["x + share * value"], ON_NORMAL),
    row("with_face's loss", NORMAL, "max(c.high - counts, 0.0f)", ["max(0.99f * c.high - counts, 0.0f)"], ON_NORMAL),
    row("with_face's gain", NORMAL, "of.most - c.low", ["of.least - c.low"], ON_NORMAL),
    row("with_face's doubt", NORMAL, "counts < c.limit_up", ["of.most < c.limit_up", "counts < 0.99f * c.limit_up"], ON_NORMAL),
    row("with_face's share", NORMAL, "of.most >= c.limit_down", ["counts >= c.limit_down", "of.most >= 1.01f * c.limit_down"], ON_NORMAL),
    row("agreement_of's least", NORMAL, "max(c.least, lowered(c.high - c.loss))", ["max(c.low, c.high - 0.99f * c.loss)"], ON_NORMAL),
    row("agreement_of's most", NORMAL, "min(c.high, raised(c.low + c.gain))", ["min(c.high, c.low + 0.99f * c.gain)"], ON_NORMAL),
    row("agreement_of's doubt", NORMAL, "choose(c.doubtful > 0.0f, max(lowered(1.0f - c.doubtful), 0.0f), 1.0f)", ["max(1.0f - 0.99f * c.doubtful, 0.0f)"], ON_NORMAL),

    # parts.h
    counts("shortened", PARTS, "1.0f - {8.0f} * kUlp, norm_up(r)", ON_PARTS, steps=[4.0, 0.0, -32.0]),
    row("kThirdUp", PARTS, "kThirdUp = 0.33333334f", ["kThirdUp = 0.3333333f"], ON_PARTS),
    row("kThirdDown", PARTS, "kThirdDown = 0.33333331f", ["kThirdDown = 0.33333334f"], ON_PARTS),
    row("kSixthUp", PARTS, "kSixthUp = 0.16666667f", ["kSixthUp = 0.1666666f"], ON_PARTS),
    row("mean_down's sum", PARTS, "float off = 2.0f * kUlp", ["float off = 0.0f * kUlp"], ON_PARTS),
    row("kSixthDown", PARTS, "kSixthDown = 0.16666666f", ["kSixthDown = 0.16666670f"], ON_PARTS),
    row("kTwelfthUp", PARTS, "kTwelfthUp = 0.083333336f", ["kTwelfthUp = 0.08333f"], ON_PARTS),
    row("kTwelfthDown", PARTS, "kTwelfthDown = 0.083333328f", ["kTwelfthDown = 0.08333345f"], ON_PARTS),
    counts("mean_size_up", PARTS, "kThirdUp, {13.0f})", ON_PARTS),
    counts("mean_size_down", PARTS, "round_down(thrice_mean_size(s) * kThirdDown, {13.0f})", ON_PARTS),
    counts("mean_over_down", PARTS, "round_down(whole * kThirdDown, {12.0f})", ON_PARTS),
    counts("square_down", PARTS, "kTwelfthDown, {7.0f})", ON_PARTS),
    counts("square_over_down", PARTS, "choose(z.none, whole, cut), {13.0f})", ON_PARTS),
    counts("share_beyond, from below", PARTS, "share - {12.0f} * kUlp", ON_PARTS),
    counts("share_beyond, from above", PARTS, "share + {12.0f} * kUlp", ON_PARTS),
    row("share_of's other side", PARTS, "over.up + under.up", ["over.up"], ON_PARTS),
    counts("cut_part's slack", PARTS, "{5.0f} * kUlp * radius_up(p.at)", ON_PARTS),
    row("cut_part's last share", PARTS, "c.to_first * (1.0f - c.to_second)", ["c.to_first"], ON_PARTS),
    counts("plane_of's normal", PARTS, "1.0f - {8.0f} * kUlp, round_up(norm_up(n.hi)", ON_PARTS, steps=[4.0, 0.0, -32.0]),
    row("plane_of's low part", PARTS, "round_up(norm_up(n.hi) + norm_up(n.lo), 1.0f)", ["norm_up(n.hi)"], ON_PARTS),
    counts("height_off's height", PARTS, "{3.0f} * kUlp * height", ON_PARTS),
    counts("height_off's size", PARTS, "{10.0f} * kUlp2 * size", ON_PARTS),
    row("span_over's slack", PARTS, "max3(sizes(h))) + s.slack", ["max3(sizes(h)))"], ON_PARTS),
    row("span_over's corners", PARTS, "raised(max3(h) + round_up(off, 1.0f))", ["raised(h.x + round_up(off, 1.0f))"], ON_PARTS),
    counts("beside's height", PARTS, "{3.5f} * kUlp * abs(h)", ON_PARTS),
    row("tau's corners", PARTS, "float by_height = round_up(mean_size_up(heights) + tau, 1.0f)",
        ["tau = 0.5f * tau;\n  float by_height = round_up(mean_size_up(heights) + tau, 1.0f)",
         "tau = 0.0f;\n  float by_height = round_up(mean_size_up(heights), 1.0f)"], ON_PARTS),
    row("slack_of", PARTS, "round_up(p.slack + s.slack, 1.0f)", ["p.slack", "s.slack"], ON_PARTS),
    row("part_above's off", PARTS, "choose(b.is_size, tau, 0.0f) + slack", ["choose(b.is_size, tau, 0.0f)"], ON_PARTS),
    counts("part_minorant's part", PARTS, "{4.0f} * radius_up(p.at)", ON_PARTS),
    counts("part_minorant's triangle", PARTS, "{5.0f} * radius_up(r.at)", ON_PARTS),
    row("part_minorant's slack", PARTS, "round_up(rounding, 4.0f) + r.slack", ["round_up(rounding, 4.0f)"], ON_PARTS),
    row("greatest_over's crossings", PARTS, "max(most, at_crossing(s.x, s.y, w.x, w.y))", ["most"], ON_PARTS),
    row("greatest_over's last crossing", PARTS, "max(most, at_crossing(s.z, s.x, w.z, w.x))", ["most"], ON_PARTS),
    row("greatest_over's corners", PARTS, "choose(s.y >= 0.0f, w.y, -3.0e38f)", ["-3.0e38f"], ON_PARTS),
    counts("at_crossing", PARTS, "{8.0f} * kUlp * (abs(wi)", ON_PARTS),
    row("at_crossing's guard", PARTS, "choose(gap > kSmallSquare, z, max(wi, wj))", ["z"], ON_PARTS),
    row("excess's rounding", PARTS, "raised(x.x - y.x), raised(x.y - y.y), raised(x.z - y.z)",
        ["x.x - y.x, x.y - y.y, x.z - y.z"], ON_PARTS),
    row("less's rounding", PARTS, "lowered(x.x - y), lowered(x.y - y), lowered(x.z - y)", ["x.x - y, x.y - y, x.z - y"], ON_PARTS),
    row("excess_of_span's heights", PARTS, "raised(span.most + heights_off)", ["raised(span.most)"], ON_PARTS),
    row("excess_of_span's other side", PARTS, "raised(heights_off - span.least)", ["raised(-span.least)"], ON_PARTS),
    row("excess_of_span's function", PARTS, "less(-heights, e.under)", ["-heights"], ON_PARTS),
    row("with_minorant's over", PARTS, "greatest_over(heights, excess(heights, minorant))", ["0.0f"], ON_PARTS),
    row("with_minorant's under", PARTS, "greatest_over(-heights, excess(-heights, minorant))", ["0.0f"], ON_PARTS),
    row("with_excess's least", PARTS, "b.at = min(b.at, e.at)", ["b.at = e.at"], ON_PARTS),
    row("with_excess's most", PARTS, "b.under = max(b.under, e.under)", ["b.under = e.under"], ON_PARTS),
    row("with_excess's other most", PARTS, "b.over = max(b.over, e.over)", ["b.over = e.over"], ON_PARTS),
    row("part_below's slack", PARTS, "max(over, under) + p.slack", ["max(over, under)"], ON_PARTS),
    row("part_below's other slack", PARTS, "less(below.at, p.slack)", ["below.at"], ON_PARTS),
    row("part_below's side", PARTS, "choose(least3(h) < 0.0f, below.under, 0.0f)", ["0.0f"], ON_PARTS),
    row("part_below's other side", PARTS, "choose(max3(h) > 0.0f, below.over, 0.0f)", ["0.0f"], ON_PARTS),
    row("part_below's mean", PARTS, "lowered(mean_size_down(h) - off)", ["mean_size_down(h)"], ON_PARTS),
    row("part_below's crossing", PARTS, "choose(!crosses, least3(sizes(h)), 0.0f)", ["least3(sizes(h))"], ON_PARTS),
    row("part_below's square", PARTS, "round_up(2.0f * off * mean_size_up(h), 2.0f)", ["0.0f"], ON_PARTS),

    # cell.h
    counts("CellFrame::slack", CELL, "round_up({7.0f} * kUlp * cell.radius", ON_CELL),
    row("CellFrame::slack's reach", CELL, " + 16.0f * kUlp2 * cell.reach", [" + 4.0f * kUlp2 * cell.reach", ""], ON_CELL),
    row("CellFrame::radius", CELL, "cell.radius = radius_up(cell.at)", ["cell.radius = 0.5f * radius_up(cell.at)"], ON_CELL),
    counts("minorant_off's products", CELL, "round_up({5.0f} * kUlp * (t.radius", ON_CELL),
    row("minorant_off's slacks", CELL, "rounding + s.slack + t.slack", ["rounding + s.slack", "rounding"], ON_CELL),
    row("a cell's distance's slacks", CELL, "s.at, inside)) + (s.slack + t.slack)", ["s.at, inside)) + t.slack", "s.at, inside))"], ON_CELL),
    row("a cut's slacks", CELL, "s.at)) + (s.slack + t.slack), 3.0f", ["s.at)), 3.0f"], ON_CELL),
    row("what is beyond the best", CELL, "is_beyond(m.at_corners, g.best)",
        ["is_beyond(m.at_corners, 0.999f * g.best)", "is_beyond(m.at_corners, 0.5f * g.best)"], ON_CELL),
    row("plane_above's cuts", CELL, "max(max(p - on_p, q - on_q), 0.0f)", ["max(p - on_p, 0.0f)", "0.0f"], ON_CELL),
    row("a cut's third piece", CELL, "1.0f - to_p, to_p * (1.0f - to_q)", ["1.0f - to_p, 0.0f"], ON_CELL),
    row("a cut's other side", CELL, "max(ps, pr), to_q, max(qs, qr)", ["min(ps, pr), to_q, min(qs, qr)"], ON_CELL),
    row("the least of all lower bounds", CELL, "g.at_corners = min(g.at_corners, m.at_corners)", ["g.at_corners = m.at_corners"], ON_CELL),

    # bary.h
    counts("LocalCorners::slack", BARY, "{24.0f} * kUlp2", ON_BARY, steps=[23.0, 12.0, 6.0, 1.5, 0.5]),
    counts("LocalCorners::slack, its rounding", BARY, "kUlp2 * p.reach, {3.0f})", ON_BARY),
    counts("LocalCorners::reach", BARY, "norm_up(r.ac.hi), {8.0f})", ON_BARY),
    row("LocalCorners::reach's terms", BARY, "norm_up(r.origin.hi) + norm_up(r.ab.hi) + norm_up(r.ac.hi)",
        ["norm_up(r.origin.hi) + norm_up(r.ab.hi)", "norm_up(r.origin.hi)"], ON_BARY),
    row("without_low_parts", BARY, "max(norm_up(p.b.lo), norm_up(p.c.lo))",
        ["min(norm_up(p.b.lo), norm_up(p.c.lo))", "0.0f"], ON_BARY),
    row("kBaryUnit", BARY, "9.5367431640625e-7f", ["9.5367426e-7f"], ON_BARY),
    row("place's second edge", BARY, "float(point.y) * kBaryUnit", ["0.0f * float(point.y)"], ON_BARY),
    row("middle", DYADIC, "(p.x + q.x) >> 1", ["(p.x + q.x + 1u) >> 1", "((p.x + q.x) >> 2) * 2u"], ON_BARY),
    row("has_middle", DYADIC, "((p.x + q.x) | (p.y + q.y)) & 1u", ["(p.x + q.x) & 1u"], ON_BARY),
    row("the first child", DYADIC, "choose(child == 0u, 0u, 6u - child)", ["choose(child == 0u, 0u, 5u - child)"], ON_BARY),
    row("the third child", DYADIC, "choose(child == 2u, 2u, 4u - child)", ["choose(child == 1u, 2u, 4u - child)"], ON_BARY),
    row("the fourth child", DYADIC, "return uvec3(3u, 4u, 5u);", ["return uvec3(0u, 5u, 4u);"], ON_BARY),

    # lower.h
    counts("coarse_distance_down's corners", LOWER, "{4.25f} * kUlp", ON_LOWER, steps=[4.0, 3.0, 2.0, 1.0, 0.5, 0.0]),
    row("coarse_distance_down's slack", LOWER, " + s.slack * norm_up(r)", [" + 0.1f * s.slack * norm_up(r)", ""],
        ON_LOWER),
    counts("coarse_distance_down's own rounding", LOWER, "norm_up(r), {8.0f})", ON_LOWER),
    counts("coarse_distance_down's step", LOWER, "round_down(farthest, {1.0f})", ON_LOWER),
    row("coarse_distance_down's corner", LOWER, "min(dot3(-s.at.b, r), dot3(-s.at.c, r))", ["dot3(-s.at.b, r)"], ON_LOWER),
    row("fine_separation_down's slack", LOWER, "off = s.slack * norm_up(r.hi)", ["off = 0.1f * s.slack * norm_up(r.hi)", "off = 0.0f"],
        ON_LOWER),
    row("fine_separation_down's corner", LOWER, "smaller(two_dot(s.b, back), two_dot(s.c, back))",
        ["two_dot(s.b, back)"], ON_LOWER),
    row("smaller's low parts", LOWER, "min((x.hi - m.hi) + x.lo, (y.hi - m.hi) + y.lo)",
        ["max((x.hi - m.hi) + x.lo, (y.hi - m.hi) + y.lo)", "0.0f"], ON_LOWER),
    row("coarse_distance_down's rounding", LOWER, "lowered(quotient_down(reach, length) - s.base)",
        ["(quotient_down(reach, length) - s.base)", "reach * (1.0f / length) - s.base"], ON_LOWER),

    # host/mesh/frame.cpp
    row("what two floats leave", FRAME, "return left + subtraction", ["return 0.5 * left + subtraction",
                                                                       "return subtraction"], ON_FRAME),
    row("the frame's subtraction", FRAME, "std::abs(exact) * 0x1p-52",
        ["std::abs(exact) * 0x1p-53", "std::abs(exact) * 0x1p-54", "std::abs(exact) * 0x1p-56", "0.0"], ON_FRAME),
    row("the frame's underflow", FRAME, "scaled_exactly ? 0 : 0x1p-1000",
        ["scaled_exactly ? 0 : 0x1p-1060", "0.0"], ON_FRAME),
    row("the largest displacement", FRAME, "plan.displacement *= 1 + 0x1p-50", ["plan.displacement *= 1"], ON_FRAME),
    row("the sum of three displacements", FRAME, "sum += displaced(", ["sum = displaced("], ON_FRAME),
    row("lower's displacement", FRAME, "add_down(lower, -displacement)",
        ["add_down(lower, -0.5 * displacement)", "lower"], ON_FRAME),
    row("upper's displacement", FRAME, "add_up(upper, displacement)",
        ["add_up(upper, 0.5 * displacement)", "upper"], ON_FRAME),
    row("lower's step", FRAME, "add_down(lower, -displacement)", ["(lower - displacement)"], ON_FRAME),
    row("upper's step", FRAME, "add_up(upper, displacement)", ["(upper + displacement)"], ON_FRAME),
    row("an inexact subtraction", FRAME, "sum_error(given, -centre) == 0 ?", ["true ?"], ON_FRAME),
    row("the joint diagonal's rounding", FRAME, "diagonal(joint) * (1 + 0x1p-40)", ["diagonal(joint)", "0.5 * diagonal(joint)"], ON_FRAME),
    row("the delta of a mesh", FRAME, "is_normal ? delta : 0x1p-1000", ["is_normal ? 0.5 * delta : 0x1p-1000", "0.0"], ON_FRAME),
    row("length_down", FRAME, "? std::nextafter(length, 0.0) : length", ["? length : length"], ON_FRAME),
    row("length_up (frame)", FRAME, "? std::nextafter(length, std::numeric_limits<double>::infinity())",
        ["? length"], ON_FRAME),

    # host/base/length.cpp
    row("the diagonal's share of delta", LENGTH, "kDiagonalPerDelta = 3.4642",
        ["kDiagonalPerDelta = 3.464", "kDiagonalPerDelta = 1.7321", "kDiagonalPerDelta = 0"], ON_LENGTH),
    row("the ulps around a share", LENGTH, "kUlps = 16", ["kUlps = 2", "kUlps = 1", "kUlps = 0"], ON_LENGTH),
    # host/native: doubles
    row("kUlp2 in doubles", TWO_DOUBLE, "0x1p-102", ["0x1p-104", "0x1p-106", "0x1p-108"], ON_DOUBLES),
    row("two_sum's low part in doubles", TWO_DOUBLE, "(a - (s - from_b)) + (b - from_b)", ["0 * from_b"], ON_DOUBLES),
    row("two_product's fused error", TWO_DOUBLE, "std::fma(a, b, -p)", ["0 * p"], ON_DOUBLES),
    row("two_difference's low parts in doubles", TWO_DOUBLE, "d.lo + (a.lo - b.lo)", ["d.lo + a.lo", "d.lo"], ON_DOUBLES),
    row("two_combination's sums in doubles", TWO_DOUBLE, "((base.lo + s.lo) + t.lo)", ["(base.lo + s.lo)", "base.lo"], ON_DOUBLES),
    row("two_combination's products in doubles", TWO_DOUBLE, "(p.lo + q.lo)", ["p.lo"], ON_DOUBLES),
    row("kUlp in doubles", IN_DOUBLES, "0x1p-52", ["0x1p-53", "0x1p-54", "0x1p-56"], ON_DOUBLES),
    row("kTiny in doubles", IN_DOUBLES, "0x1p-500", ["0x1p-536", "0x1p-540", "0.0"], ON_DOUBLES),
    row("round_up in doubles", IN_DOUBLES, "(1.0 + (n + 2.0) * kUlp)", ["(1.0 + (n + 1.0) * kUlp)", "(1.0 + n * kUlp)"], ON_DOUBLES),
    row("round_down in doubles", IN_DOUBLES, "(1.0 - (n + 2.0) * kUlp)", ["(1.0 - (n + 1.0) * kUlp)", "(1.0 - n * kUlp)"], ON_DOUBLES),
    row("length_up in doubles", IN_DOUBLES, "round_up(root(square), 1.0)", ["round_up(root(square), 0.0)", "round_up(root(square), -1.0)"], ON_DOUBLES),
    row("raised in doubles", IN_DOUBLES, "x + (4.0 * kUlp", ["x + (2.0 * kUlp", "x + (1.0 * kUlp", "x + (0.0 * kUlp"], ON_DOUBLES),
    row("lowered in doubles", IN_DOUBLES, "x - (4.0 * kUlp", ["x - (2.0 * kUlp", "x - (1.0 * kUlp", "x - (0.0 * kUlp"], ON_DOUBLES),
    row("sharp_norm_above_up in doubles", IN_DOUBLES, "raised(round_up(norm_up(rounded(v)), 1.0) - base)",
        ["raised(norm_up(rounded(v)) - base)", "norm_up(rounded(v)) - base"], ON_DOUBLES),
    row("quotient_down in doubles", IN_DOUBLES, "round_down(a / b, 1.0)", ["round_down(a / b, 0.0)", "round_down(a / b, -1.0)", "a / b"], ON_DOUBLES),
    row("kCornerError", PLACE, "2.0 * kUlp", ["1.5 * kUlp", "1.25 * kUlp", "1.0 * kUlp", "0.5 * kUlp"], ON_DOUBLES),
    row("kPositionError", SEPARATE, "0x1p-97", ["0x1p-100", "0x1p-104", "0x1p-108", "0.0"], ON_DOUBLES),
    counts("coarse_slack in doubles", TRIANGLE, "{12.0f} * kUlp * radius_up(at)", ON_DOUBLES),
    row("surface_distance_up's slack in doubles", TRIANGLE, "round_up(d + s.slack, 3.0f)", ["round_up(d, 3.0f)"], ON_DOUBLES),
    counts("coarse_distance_down in doubles", LOWER, "{4.25f} * kUlp * radius_up(s.at)", ON_DOUBLES),
    row("coarse_distance_down's slack in doubles", LOWER, " + s.slack * norm_up(r)", [""], ON_DOUBLES),
    row("a part's slack in doubles", BOUNDS, "bound + shift", ["bound"], ON_DOUBLES),
    row("bound_u1 in doubles", BOUNDS, "max(farther, 0.0f), 3.0f", ["max(farther, 0.0f), 1.0f", "max(farther, 0.0f), -2.0f"], ON_DOUBLES),
    row("bound_u2 in doubles", BOUNDS, "max3(d), 0.0f), 1.0f", ["max3(d), 0.0f), 0.0f", "max3(d), 0.0f), -2.0f"], ON_DOUBLES),
    row("enclosing_radius_up in doubles", TRIANGLE, "return round_up(r, 1.0f)", ["return round_up(r, 0.0f)", "return round_up(r, -2.0f)"], ON_DOUBLES),
    counts("CellFrame::slack in doubles", CELL, "round_up({7.0f} * kUlp * cell.radius", ON_CELLS_IN_DOUBLES),
    row("CellFrame::slack's reach in doubles", CELL, " + 16.0f * kUlp2 * cell.reach", [" + 4.0f * kUlp2 * cell.reach", ""], ON_CELLS_IN_DOUBLES),
    row("CellFrame::radius in doubles", CELL, "cell.radius = radius_up(cell.at)", ["cell.radius = 0.5f * radius_up(cell.at)"], ON_CELLS_IN_DOUBLES),
    counts("minorant_off's products in doubles", CELL, "round_up({5.0f} * kUlp * (t.radius", ON_CELLS_IN_DOUBLES),
    row("minorant_off's slacks in doubles", CELL, "rounding + s.slack + t.slack", ["rounding + s.slack", "rounding + t.slack", "rounding"], ON_CELLS_IN_DOUBLES),
    row("a cell's distance's slacks in doubles", CELL, "s.at, inside)) + (s.slack + t.slack)", ["s.at, inside)) + t.slack", "s.at, inside))"], ON_CELLS_IN_DOUBLES),
    row("what is beyond the best in doubles", CELL, "is_beyond(m.at_corners, g.best)", ["is_beyond(m.at_corners, 0.5f * g.best)"], ON_CELLS_IN_DOUBLES),
    row("plane_above's cuts in doubles", CELL, "max(max(p - on_p, q - on_q), 0.0f)", ["max(p - on_p, 0.0f)", "0.0f"], ON_CELLS_IN_DOUBLES),
    row("plane_above's rounding in doubles", CELL, "to_p * at.y, 4.0f", ["to_p * at.y, 0.0f", "to_p * at.y, -4.0f", "to_p * at.y, -12.0f"], ON_CELLS_IN_DOUBLES),
    row("a cut's third piece in doubles", CELL, "1.0f - to_p, to_p * (1.0f - to_q)", ["1.0f - to_p, 0.0f"], ON_CELLS_IN_DOUBLES),
    row("the least of all lower bounds in doubles", CELL, "g.at_corners = min(g.at_corners, m.at_corners)", ["g.at_corners = m.at_corners"], ON_CELLS_IN_DOUBLES),
    row("shortened in doubles", PARTS, "1.0f - 8.0f * kUlp, norm_up(r)) * r", ["1.0f + 1.0f * kUlp, norm_up(r)) * r", "1.0f + 4.0f * kUlp, norm_up(r)) * r"], ON_CELLS_IN_DOUBLES),
    row("a reach's slack", CELL_IN_DOUBLES, "highest + t.radius + t.slack", ["highest + t.radius"], ON_CELLS_IN_DOUBLES),
    row("a reach's float", CELL_IN_DOUBLES, "float_above(far * far)", ["static_cast<float>(far * far)"], ON_CELLS_IN_DOUBLES),
    row("a box's distance's slack", CELL_IN_DOUBLES, " - 0x1p-74 - slack", [" - 0x1p-74"], ON_CELLS_IN_DOUBLES),
    row("a box's distance's underflow", CELL_IN_DOUBLES, " - 0x1p-74", [" - 0x1p-76", ""], ON_CELLS_IN_DOUBLES),
    row("a box's distance's roundings", CELL_IN_DOUBLES, "round_down(root(distance2), 2.0)",
        ["round_down(root(distance2), 1.0)", "round_down(root(distance2), 0.0)", "round_down(root(distance2), -1.0)", "root(distance2)"],
        ON_CELLS_IN_DOUBLES),
    row("floats below", BOXES, "f - (std::fabs(f) * 0x1p-23f", ["f - (std::fabs(f) * 0x1p-24f", "f - (std::fabs(f) * 0x1p-25f"], ON_CELLS_IN_DOUBLES),
    row("floats above", BOXES, "f + (std::fabs(f) * 0x1p-23f", ["f + (std::fabs(f) * 0x1p-24f", "f + (std::fabs(f) * 0x1p-25f"], ON_CELLS_IN_DOUBLES),

    # --verify of a native run
    row("a part that is closed natively", LEVELS, "closed_areas_[c.face] += c.area", ["closed_areas_[c.face] += c.area - 1"], ON_COVERAGE),
    row("a part that is given up natively", LEVELS, "closed_areas_[c->face] += area_of(c->at)",
        ["closed_areas_[c->face] += area_of(c->at) - 1"], ON_COVERAGE),
    row("a part that is open natively", LEVELS, " + c.face] += area_of(c.at)", [" + c.face] += area_of(c.at) - 1"], ON_COVERAGE),
    row("all four children natively", LEVELS, "which < 4", ["which < 3"], ON_COVERAGE),
    row("parts that wait natively", LEVELS, "<std::ptrdiff_t>(refined)", ["<std::ptrdiff_t>(std::min(refined + 1, open_.size()))"], ON_COVERAGE),
    row("parts that sum to the whole", COVERAGE, "closed + open == of_face", ["closed + open <= of_face"], ON_COVERAGE),
]

QUICK = {"kUlp2", "norm_up", "bound_u2's worst corner", "place's second edge"}

# Rows that no test can notice, and why.
EXPECTED_SURVIVORS = {
    "CellFrame::slack's reach in doubles": "A's vertices have no low parts there: what is so small beside the reach is exact in two doubles",
    "enclosing_radius_up in doubles": "norm_up leaves 1.5 u of 3, and three differences are seldom all that wrong",
    "sharp_norm_above_up in doubles": "norm_up has 1.5 u left, and surfaces of 48 bits, which it is for, are not used there",
    "sharp_norm_up's low square": "at most a quarter of an ulp of the length; the two steps are worth more",
    "quotient_down's kTiny": "next_down already gives 0 for what may have been flushed",
    "raised's kTiny": "its argument has a kTiny of its own wherever it is small",
    "lowered's kTiny": "its argument has a kTiny of its own wherever it is small",
    "closest_point's altitude": "steers: ratio gives 0 there, and any point of the triangle is right",
    "Surface::slack, its rounding": "4 ulp of a slack that is several times the largest error found",
    "LocalCorners::slack, its rounding": "3 ulp of a slack that is several times the largest error found",
    "LocalCorners::reach": "8 ulp of a reach that only scales the slack",
    "distance_to_up's rounding, sharp": "the slack is several times the largest error found",
    "coarse_slack, its rounding": "4 ulp of a slack that is several times the largest error found",
    "plain_distance2's guard under 1": "what is outside by an ulp or two of an edge is under the slack",
    "a coarse distance's own ulps": "the slack is several times the largest error found",
    "surface_distance_up's sum": "norm_up leaves 4.7 ulp to spare, the sum costs one",
    "kept_bound": "round_up's own two ulps take the sum's one",
    "enclosing_radius_up": "norm_up leaves 4.7 ulp to spare, the differences cost 2",
    "bound_u1": "norm_up leaves 4.7 ulp to spare, differences and sum cost 2",
    "bound_u2": "enclosing_radius_up leaves 6 ulp to spare, the sum costs one",
    "coarse_distance_down's slack": "kTiny over the direction's length is more, wherever the triangle is that near",
    "coarse_distance_down's own rounding": "8 ulp of an error term that is several times the largest error found",
    "coarse_distance_down's step": "one ulp of a distance beside four of the triangle's size",
    "the largest displacement": "the sum of three is larger than their length by more than its rounding",
}
