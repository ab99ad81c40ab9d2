"""The results that linear_proofs.py shows by Gappa, as a basis for the templates."""

from fractions import Fraction

# By theorem and unit: the largest error, in kUlp^2 (a tenth of a percent is for the terms of the third order).
CLAIMS = {
    "two_difference_a": "3.51", "two_difference_b": "3.51",
    "two_combination_base": "9.51", "two_combination_u": "13.51", "two_combination_v": "10.01",
    "two_dot": "21.51",
    "position_o": "22.01", "position_ab": "18.01", "position_ac": "14.51",
    "step_o": "14.01", "step_ab": "18.01", "step_ac": "14.51",
    "cut_from": "18.51", "cut_to": "21.01",
    "offset_o": "29.51", "offset_p": "16.01", "offset_radius": "57.02", "coarse_origin": "4",
}


def claim(name):
    """A little more than its decimals: bounds are dyadic."""
    return Fraction(-int(-Fraction(CLAIMS.get(name, name)) * 2**20 // 1), 2**20)
