"""Errors that are planted into a sound budget, one at a time. Each function changes a copy and says which rules may tell of
it and what the finding has to state:

  corrected  the finding corrects one row or claim: U with this correction alone is that of the sound budget
  bound      nobody but the laboratory knows the correction: the finding states a number that does follow
  missing    a contribution without a number: how large it must be to change the printed U
  stated     the finding states what is right: a verdict, an E_n, a k
"""

import math

from tables import INFINITE, ROOT3, claims_of, coverage_factor, effective, outcome, significant, to_place_of

ROOT12 = math.sqrt(12.0)


def corrected(ids, row=None):
    return {"ids": ids, "row": row.name if row else None, "effect": "corrected"}


def by_divisor(factor, *ids):
    """The number of the row is divided by `factor` times the right divisor."""
    def plant(budget, row, draw):
        row.divisor = row.divisor * factor if factor else 1.0
        row.divisor_text = draw.divisor(row.divisor)
        return corrected(list(ids), row)
    return plant


def divided_by(divisor, *ids):
    def plant(budget, row, draw):
        row.divisor, row.divisor_text = divisor, draw.divisor(divisor)
        return corrected(list(ids), row)
    return plant


def full_as_half(budget, row, draw):
    """The whole width ± a to ± a, 2a, is divided as if it were the half of it."""
    row.stated *= 2.0
    return corrected(["U08"], row)


def ten_times(budget, row, draw):
    """A decimal sign one place off between the source and the table."""
    row.stated = float(f"{10.0 * row.stated:.12g}")
    return corrected(["U08", "U13"], row)


def step_divided(divisor, *ids):
    """A resolution: the whole step is taken, and divided by something."""
    def plant(budget, row, draw):
        step = row.u * ROOT12
        row.stated, row.divisor, row.divisor_text = float(f"{step:.12g}"), divisor, draw.divisor(divisor)
        return corrected(list(ids), row)
    return plant


def resolution_root_twice(budget, row, draw):
    """The half step is divided by √3, and by √3 again."""
    row.stated = float(f"{row.u * ROOT3:.12g}")
    row.divisor, row.divisor_text = 3.0, "3"
    return corrected(["U09", "U08", "W02"], row)


def mean_undivided(budget, row, draw):
    row.divisor, row.divisor_text = 1.0, "1"
    return corrected(["U03"], row)


def single_divided(budget, row, draw):
    row.divisor = math.sqrt(row.n)
    row.divisor_text = draw.divisor(row.divisor)
    return corrected(["U03"], row)


def degrees_infinite(budget, row, draw):
    row.nu = INFINITE
    return corrected(["U01", "U02"], row)


def left_out(budget, row, draw):
    row.in_sum = 0
    return corrected(["K01", "W09"])


def added_twice(budget, row, draw):
    row.in_sum = 2
    return corrected(["K01"])


def added_linearly(budget, row, draw):
    budget.linear = True
    return corrected(["K09", "K01"])


def rounded_down(budget, row, draw):
    """U cut after two digits, though more than half of the last one is lost: more than the digits of u_c and k leave open."""
    right = outcome(budget)
    U = right["U"]
    half = significant(U, 2)[1]
    cut = significant(U - half, 2)[0]
    budget.claimed["U"] = cut
    budget.claimed["value"] = to_place_of(budget.value, cut)
    budget.layout.claim_digits = 4
    found = corrected(["K01"])
    found["printed"] = cut
    u_c, half_u_c = significant(right["u_c"], budget.layout.claim_digits)
    found["fits"] = (right["k"] - 0.006) * (float(u_c) - half_u_c) > float(cut) + half
    return found


def two_of_few(budget, row, draw):
    """k = 2 where ν_eff is small; that the laboratory would have cut ν_eff, this table does not show."""
    found = corrected(["K02"])
    right = outcome(budget)
    found["U"] = coverage_factor(budget.p, right["nu_eff"]) * right["u_c"]
    found["fits"] = right["nu_eff"] < 15.0
    budget.coverage = "two"
    return found


def degrees_added(budget, row, draw):
    """ν_eff as the sum of all finite ν and ten for each of the others."""
    nu = sum(10.0 if math.isinf(row.nu) else row.nu for row in budget.rows)
    budget.claimed.update(nu_eff=nu, k=coverage_factor(budget.p, nu))
    budget.claimed["U"] = budget.claimed["k"] * outcome(budget)["u_c"]
    return corrected(["K01", "K02"])


def factor_loses_digits(budget, row, draw):
    budget.claimed["k"] = f"{outcome(budget)['k']:.0f}"
    return {"ids": ["K13", "K03"], "row": None, "effect": "stated", "number": outcome(budget)["k"], "half": 0.03}


def other_probability(budget, row, draw):
    """k = 2, and 99 % beside it."""
    budget.claimed["p"] = "99 %"
    return {"ids": ["K03"], "row": None, "effect": "stated", "number": coverage_factor(0.99, INFINITE), "half": 0.01}


def unit_slip(smaller):
    """A row in a larger unit is added as if it were in that of the result."""
    def plant(budget, row, draw):
        row.stated = float(f"{row.stated / 1000.0:.12g}")
        row.unit = smaller[row.unit]
        sign = draw.decimal
        row.comment = row.comment.split(";")[-1].split(", ")[-1].strip() if sign == "," else row.comment.split("; ")[-1]
        return corrected(["S01"], row)
    return plant


def sensitivity_times(factor):
    def plant(budget, row, draw):
        row.c *= factor
        return corrected(["S02"], row)
    return plant


def contribution_squared(budget, row, draw):
    """The column of contributions has c² u where the sensitivity stands beside it."""
    row.factor = abs(row.c)
    return corrected(["K01"], row)


def one_source_twice(budget, row, draw):
    """One certificate enters twice, and both rows are added as if they were independent."""
    sound = outcome(budget)["u_c"]
    row.c = 1.0
    name = row.name
    row.name = "first step of the reference attenuator"
    other = budget.copy().row(row.key)
    other.key, other.name = row.key + "2", "second step of the reference attenuator"
    budget.rows.insert(budget.rows.index(row) + 1, other)
    row.comment = other.comment = row.comment.split(", the error")[0]
    assert name != row.name
    return {"ids": ["S10"], "row": other.name, "effect": "bound", "before": "with r = 1:", "number": sound}


def drift_zero(budget, row, draw):
    row.stated, row.divisor, row.divisor_text = 0.0, ROOT3, draw.divisor(ROOT3)
    row.comment = draw.say("not significant", "nicht signifikant")
    return {"ids": ["B02"], "row": None, "effect": "missing"}


def value_as_uncertainty(budget, row, draw):
    """The correction that was applied stands as its own half-width."""
    row.stated = float(f"{3.0 * row.stated:.2g}")
    row.x = f"{row.stated:.12g}"
    row.comment = draw.say("correction applied", "Korrektion angebracht")
    without = budget.copy()
    without.rows = [other for other in without.rows if other.key != row.key]
    return {"ids": ["U23"], "row": row.name, "effect": "bound", "before": "without this row", "number": outcome(without)["U"]}


def below_capability(budget, row, draw):
    U = outcome(budget)["U"]
    budget.capability = float(f"{1.15 * U:.1e}")
    budget.claimed["reported"] = significant(U, 2)[0]
    budget.claimed["value"] = to_place_of(budget.value, budget.claimed["reported"])
    found = corrected(["X01"])
    found["U"] = budget.capability
    return found


def wrong_verdict(budget, row, draw):
    """The value is moved to where the rule says no (or, with a guard band, not yet), and the verdict stays."""
    U = outcome(budget)["U"]
    high = budget.limits[1]
    budget.value = high - 0.5 * U if budget.rule == "DR-03" else high + 0.3 * U
    verdict = claims_of(budget)["verdict"]
    budget.claimed["verdict"] = {"fail": "pass", "nicht erfüllt": "erfüllt"}[verdict]
    return {"ids": ["D04"], "row": None, "effect": "stated", "word": "fail"}


def score_of_one_side(budget, row, draw):
    """E_n with U of the laboratory alone."""
    texts = claims_of(budget)
    difference = float(texts["value"]) - budget.reference[0]
    budget.claimed["en"] = f"{difference / float(texts['U']):.2f}"
    return {"ids": ["N02"], "row": None, "effect": "stated", "number": float(texts["en"]), "half": 0.006}


def drift_twice(budget, row, draw):
    other = budget.copy().row(row.key)
    other.key += "2"
    other.name = draw.say("change of the reference since its last calibration",
                          "Änderung des Normals seit der letzten Kalibrierung")
    budget.rows.append(other)
    return corrected(["S09", "S16"], other)


def row_twice(budget, row, draw):
    other = budget.copy().row(row.key)
    other.key += "2"
    budget.rows.append(other)
    return corrected(["S16"], other)


def swinging_as_rectangular(budget, row, draw):
    row.divisor, row.divisor_text, row.shape = ROOT3, draw.divisor(ROOT3), "rect"
    return corrected(["U20", "U08", "W02"], row)


def percent_of_reading(budget, row, draw):
    row.stated = float(f"{row.stated * float(row.x) / 60.0:.6g}")
    return corrected(["U15"], row)


KINDS = {
    "U of a certificate as u": by_divisor(0.0, "U13", "W02"),
    "U of a certificate divided by √3": divided_by(ROOT3, "U13", "W02"),
    "U of a certificate divided by 3": divided_by(3.0, "U13", "W02"),
    "limit of error as u": divided_by(1.0, "U10", "W02"),
    "limit of error divided by 2": divided_by(2.0, "U24", "W02", "U08"),
    "half-width undivided": divided_by(1.0, "U08", "W02"),
    "half-width divided as the full width": by_divisor(2.0, "U08", "W02"),
    "full width divided as the half": full_as_half,
    "half-width divided by 3": divided_by(3.0, "U08", "W02"),
    "root taken twice": divided_by(3.0 ** 0.25, "U08", "W01", "W02"),
    "triangle divided by √3": divided_by(ROOT3, "W02", "U08"),
    "arcsine divided by √3": divided_by(ROOT3, "W02", "U08"),
    "decimal sign one place off": ten_times,
    "resolution: step divided by √3": step_divided(ROOT3, "U09"),
    "resolution: step undivided": step_divided(1.0, "U09", "W02"),
    "resolution: root taken twice": resolution_root_twice,
    "s of a mean undivided": mean_undivided,
    "s of a single reading divided by √n": single_divided,
    "few readings, ν infinite": degrees_infinite,
    "row left out of the sum": left_out,
    "row added twice": added_twice,
    "contributions added linearly": added_linearly,
    "U rounded down": rounded_down,
    "k = 2 with few degrees of freedom": two_of_few,
    "ν_eff added up": degrees_added,
    "k loses its digits": factor_loses_digits,
    "k = 2 beside 99 %": other_probability,
    "unit slip": unit_slip({"nm": "µm", "µHz": "mHz", "µV": "mV", "mK": "K", "Pa": "kPa"}),
    "sensitivity doubled": sensitivity_times(2.0),
    "sensitivity halved": sensitivity_times(0.5),
    "sensitivity squared": contribution_squared,
    "one certificate twice, no correlation": one_source_twice,
    "drift zero": drift_zero,
    "value as its own uncertainty": value_as_uncertainty,
    "U below the capability": below_capability,
    "verdict against the rule": wrong_verdict,
    "E_n with one U": score_of_one_side,
    "drift twice": drift_twice,
    "row twice": row_twice,
    "swinging quantity as rectangular": swinging_as_rectangular,
    "percentage of the wrong base": percent_of_reading,
}

# Five for each budget: the kind, and the row that it is planted in.
PLANTED = {
    "end_gauge": (("U of a certificate as u", "l_S"), ("half-width divided as the full width", "dt"),
                  ("triangle divided by √3", "da"), ("s of a mean undivided", "d"), ("row left out of the sum", "l_V")),
    "gauge_block": (("half-width undivided", "d_C"), ("U of a certificate divided by √3", "l_S"),
                    ("few readings, ν infinite", "dl"), ("resolution: step divided by √3", "res"), ("unit slip", "drift")),
    "multimeter_dc": (("root taken twice", "drift"), ("s of a single reading divided by √n", "rep"),
                      ("verdict against the rule", None), ("resolution: step undivided", "res"), ("k = 2 beside 99 %", None)),
    "resistor": (("sensitivity doubled", "r"), ("contributions added linearly", None), ("ν_eff added up", None),
                 ("full width divided as the half", "dR_D"), ("row left out of the sum", "dR_TX")),
    "weight_1kg": (("U below the capability", None), ("resolution: root taken twice", "res"), ("row twice", "ecc"),
                   ("drift zero", "drift"), ("decimal sign one place off", "air")),
    "balance_220g": (("resolution: step divided by √3", "dL"), ("s of a mean undivided", "rep"),
                     ("half-width undivided", "ecc"), ("drift twice", "drift"), ("row added twice", "dL")),
    "pt100": (("swinging quantity as rectangular", "stab"), ("U of a certificate as u", "t_ref"),
              ("row left out of the sum", "hom"), ("resolution: step divided by √3", "res"), ("sensitivity squared", "bridge")),
    "pressure_balance": (("sensitivity squared", "h"), ("U of a certificate divided by 3", "A"),
                         ("few readings, ν infinite", "rep"), ("half-width divided as the full width", "t"),
                         ("U rounded down", None)),
    "pressure_gauge": (("percentage of the wrong base", "conv"), ("verdict against the rule", None),
                       ("resolution: step undivided", "res"), ("s of a mean undivided", "rep"), ("root taken twice", "hys")),
    "torque": (("sensitivity halved", "l"), ("k = 2 with few degrees of freedom", None), ("ν_eff added up", None),
               ("drift zero", "dl"), ("resolution: step divided by √3", "dR")),
    "force": (("k loses its digits", None), ("k = 2 with few degrees of freedom", None), ("limit of error as u", "amp"),
              ("row left out of the sum", "repro"), ("half-width undivided", "zero")),
    "pipette": (("half-width divided by 3", "op"), ("U of a certificate as u", "bal"), ("row left out of the sum", "rep"),
                ("k = 2 beside 99 %", None), ("U rounded down", None)),
    "caliper": (("limit of error as u", "ref"), ("limit of error divided by 2", "ref"), ("verdict against the rule", None),
                ("s of a single reading divided by √n", "rep"), ("resolution: root taken twice", "res")),
    "humidity": (("decimal sign one place off", "dp"), ("full width divided as the half", "hom"), ("drift zero", "drift"),
                 ("triangle divided by √3", "hys"), ("U below the capability", None)),
    "flow": (("sensitivity doubled", "t"), ("U of a certificate as u", "m"), ("few readings, ν infinite", "dq"),
             ("value as its own uncertainty", "db"), ("row added twice", "rho")),
    "angle_table": (("E_n with one U", None), ("U of a certificate divided by √3", "ac"), ("row left out of the sum", "flat"),
                    ("row twice", "ecc"), ("s of a mean undivided", "rep")),
    "hardness": (("E_n with one U", None), ("limit of error as u", "ind"), ("few readings, ν infinite", "rep"),
                 ("half-width undivided", "hom"), ("U of a certificate divided by √3", "ref")),
    "attenuator": (("one certificate twice, no correlation", "pads"), ("arcsine divided by √3", "mis"),
                   ("full width divided as the half", "lin"), ("resolution: step divided by √3", "res_i"),
                   ("s of a mean undivided", "rep")),
    "ph_meter": (("U of a certificate as u", "buf"), ("ν_eff added up", None), ("triangle divided by √3", "lj"),
                 ("drift twice", "drift"), ("value as its own uncertainty", "temp")),
    "time_base": (("half-width divided as the full width", "drift"), ("unit slip", "ref"),
                  ("s of a mean undivided", "rep"), ("U rounded down", None), ("half-width undivided", "trig")),
}
