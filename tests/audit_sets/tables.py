"""Budgets as plain numbers, what follows from them, and how a laboratory prints them.

Everything here is computed without the program: Welch-Satterthwaite and k = t_p(ν_eff) by JCGM 100:2008, G.4.1, with the
quantile of scipy.special.
"""

import copy
import csv
import dataclasses
import io
import math

from scipy.special import ndtri, stdtrit

INFINITE = math.inf
ROOT3 = math.sqrt(3.0)


@dataclasses.dataclass
class Row:
    """One row: u = stated/divisor in the unit of the row, c in the unit of the result per that unit."""
    key: str
    name: str
    unit: str
    x: str  # the estimate as it is printed
    stated: float
    divisor: float
    divisor_text: str
    shape: str  # normal, rect, tri, arcsine, t
    type_a: bool
    nu: float
    c: float
    source: str
    comment: str
    kind: str  # certificate, specification, resolution, limits, mean, pooled, drift
    n: int = 0
    factor: float = 1.0  # by which an erroneous column of contributions is larger than |c| u
    in_sum: int = 1  # how often an erroneous sum counts the row
    stated_digits: int = 0  # digits of what is divided, where it is not printed in full

    @property
    def u(self):
        return self.stated / self.divisor

    @property
    def contribution(self):
        return abs(self.c) * self.u * self.factor


@dataclasses.dataclass
class Layout:
    columns: str  # letters of HEADS
    separator: str = ","
    decimal: str = "."
    claims_above: bool = False
    unit_first: bool = True
    digits: int = 3  # of u and contributions
    claim_digits: int = 4  # of u_c
    heads: int = 0  # which wording


@dataclasses.dataclass
class Budget:
    slug: str
    language: str
    measurand: str
    method: str
    unit: str
    value: float
    rows: list
    layout: Layout
    coverage: str = "t"  # t: k = t_p(ν_eff); two: k = 2; cut: ν_eff cut to a whole number
    p: float = 0.9545
    equation: str = ""
    capability: float = None
    limits: tuple = None
    rule: str = ""
    reference: tuple = None  # value, U
    linear: bool = False  # an erroneous plain sum
    # What is claimed in place of what follows from the rows.
    claimed: dict = dataclasses.field(default_factory=dict)

    def row(self, key):
        return next(row for row in self.rows if row.key == key)

    def copy(self):
        return copy.deepcopy(self)


# What follows from a budget -------------------------------------------------------------------------------------------

def coverage_factor(p, nu):
    return float(ndtri(0.5 + 0.5 * p) if math.isinf(nu) else stdtrit(nu, 0.5 + 0.5 * p))


def effective(contributions, u_c):
    """ν_eff of contributions [(|c| u, ν)]."""
    parts = sum((part / u_c) ** 4 / nu for part, nu in contributions if not math.isinf(nu) and part > 0.0)
    return 1.0 / parts if parts > 0.0 else INFINITE


def outcome(budget, added=0.0):
    """u_c, ν_eff, k and U of the rows; `added` is one more contribution with infinite ν."""
    parts = [(row.contribution, row.nu, row.in_sum) for row in budget.rows] + [(added, INFINITE, 1)]
    if budget.linear:
        u_c = sum(part for part, _, _ in parts)
    else:
        u_c = math.sqrt(sum(times * part * part for part, _, times in parts))
    nu = effective([(part, nu) for part, nu, times in parts if times], u_c)
    if budget.coverage == "two":
        k = 2.0
    else:
        k = coverage_factor(budget.p, max(1.0, math.floor(nu)) if budget.coverage == "cut" and not math.isinf(nu) else nu)
    return {"u_c": u_c, "nu_eff": nu, "k": k, "U": k * u_c}


def reported(budget, found):
    """U with the floor of the capability."""
    return max(found["U"], budget.capability or 0.0)


# Numbers in print -----------------------------------------------------------------------------------------------------

def significant(value, digits):
    """(text, half a unit of its last digit) with some significant digits."""
    if value == 0.0:
        return "0", 0.0
    text = f"{value:.{digits - 1}e}"
    exponent = int(text.split("e")[1])
    place = exponent - digits + 1
    half = 0.5 * 10.0 ** place
    if -6 <= exponent < 6:
        return f"{float(text):.{max(0, -place)}f}", half
    mantissa, power = text.split("e")
    return f"{mantissa}E{int(power)}", half


def as_decimal(text, decimal):
    return text.replace(".", decimal) if decimal != "." else text


def exact(value):
    """All digits of a number that was drawn with few of them."""
    text = f"{value:.12g}"
    return text.replace("e", "E") if "e" in text else text


def to_place_of(value, digits_text):
    """A value printed to the last place of its uncertainty."""
    decimals = len(digits_text.split(".")[1]) if "." in digits_text and "E" not in digits_text else 0
    return f"{value:.{decimals}f}"


def decided(budget, value, U):
    """The verdict of the rule on the printed numbers."""
    low, high = budget.limits
    guard = U if budget.rule == "DR-03" else 0.0
    return low + guard <= value <= high - guard


# Tables ---------------------------------------------------------------------------------------------------------------

HEADS = {
    "q": (("quantity", "Source of uncertainty", "influence quantity"), ("Größe", "Eingangsgröße", "Unsicherheitsquelle")),
    "x": (("estimate", "value", "x_i"), ("Schätzwert", "Wert", "xi")),
    "i": (("unit", "unit", "units"), ("Einheit", "Einheit", "Einheit")),
    "a": (("U or a", "half-width", "stated value"), ("Halbweite", "Unsicherheit", "Halbbreite")),
    "d": (("divisor", "div.", "divisor"), ("Divisor", "Teiler", "Divisor")),
    "s": (("distribution", "prob. distribution", "shape"), ("Verteilung", "Verteilungsform", "Verteilung")),
    "t": (("type", "A/B", "type"), ("Typ", "Typ", "Typ")),
    "u": (("u", "standard uncertainty", "u(xi)"), ("u", "Standardunsicherheit", "u(xi)")),
    "c": (("sensitivity", "sensitivity coefficient", "ci"), ("Empfindlichkeit", "Sensitivitätskoeffizient", "ci")),
    "b": (("contribution", "uncertainty contribution", "ui(y)"), ("Beitrag", "Unsicherheitsbeitrag", "ui(y)")),
    "n": (("nu", "degrees of freedom", "dof"), ("Freiheitsgrade", "Freiheitsgrad", "νi")),
    "r": (("source", "reference", "certificate"), ("Quelle", "Herkunft", "Quelle")),
    "m": (("comment", "remarks", "basis"), ("Bemerkung", "Kommentar", "Erläuterung")),
}
SHAPES = {
    "normal": ("normal", "Normal"), "rect": ("rectangular", "Rechteck"), "tri": ("triangular", "Dreieck"),
    "arcsine": ("U-shaped", "U-förmig"), "t": ("Student t", "Student-t"),
}
STATEMENTS = {
    "measurand": ("measurand", "Messgröße"), "method": ("method", "Verfahren"), "equation": ("equation", "Modell"),
    "value": ("result", "Messergebnis"), "u_c": ("combined standard uncertainty", "kombinierte Standardunsicherheit"),
    "nu_eff": ("effective degrees of freedom", "effektive Freiheitsgrade"),
    "k": ("coverage factor k", "Erweiterungsfaktor k"),
    "U": ("expanded uncertainty U", "erweiterte Messunsicherheit U"),
    "reported": ("reported uncertainty", "angegebene Messunsicherheit"),
    "p": ("coverage probability", "Überdeckungswahrscheinlichkeit"), "capability": ("CMC", "CMC"),
    "low": ("lower limit", "untere Grenze"), "high": ("upper limit", "obere Grenze"),
    "rule": ("decision rule", "Entscheidungsregel"), "verdict": ("verdict", "Konformität"),
    "reference": ("reference value", "Referenzwert"), "reference_U": ("U_ref", "U_ref"), "en": ("E_n", "E_n"),
}
VERDICTS = {True: ("pass", "erfüllt"), False: ("fail", "nicht erfüllt")}


def language_of(budget):
    return 1 if budget.language == "de" else 0


def printed_sensitivity(c):
    return (exact(c), 0.0) if abs(c) in (0.5, 1.0, 2.0) else significant(c, 4)


def cell(budget, row, column):
    digits = budget.layout.digits
    if column == "q":
        return row.name
    if column == "x":
        return row.x
    if column == "i":
        return row.unit
    if column == "a":
        return significant(row.stated, row.stated_digits)[0] if row.stated_digits else exact(row.stated)
    if column == "d":
        return row.divisor_text
    if column == "s":
        return SHAPES[row.shape][language_of(budget)]
    if column == "t":
        return "A" if row.type_a else "B"
    if column == "u":
        return significant(row.u, digits)[0]
    if column == "c":
        return printed_sensitivity(row.c)[0]
    if column == "b":
        return significant(row.contribution, digits)[0]
    if column == "n":
        return "∞" if math.isinf(row.nu) else exact(row.nu)
    return row.source if column == "r" else row.comment


TEXTS = "qistrm"


def claims_of(budget):
    """What the table states of its result: texts by name, in their order."""
    found = outcome(budget)
    found.update({name: budget.claimed[name] for name in ("u_c", "nu_eff", "k", "U")
                  if name in budget.claimed and not isinstance(budget.claimed[name], str)})
    if "u_c" in budget.claimed and "U" not in budget.claimed:
        found["U"] = found["k"] * found["u_c"]
    U = reported(budget, found)
    texts = {"value": "", "u_c": significant(found["u_c"], budget.layout.claim_digits)[0]}
    if not math.isinf(found["nu_eff"]):
        texts["nu_eff"] = f"{found['nu_eff']:.0f}" if found["nu_eff"] >= 100 else f"{found['nu_eff']:.1f}"
    texts["k"] = "2" if budget.coverage == "two" and "k" not in budget.claimed else f"{found['k']:.2f}"
    texts["U"] = significant(U if budget.capability is None else found["U"], 2)[0]
    if budget.capability is not None:
        texts["reported"] = significant(U, 2)[0]
        texts["capability"] = exact(budget.capability)
    texts["p"] = f"{100 * budget.p:.4g} %"
    texts["value"] = to_place_of(budget.value, texts.get("reported", texts["U"]))
    if budget.limits:
        texts["low"], texts["high"] = (exact(limit) for limit in budget.limits)
        texts["rule"] = budget.rule
        conforms = decided(budget, float(texts["value"]), float(texts.get("reported", texts["U"])))
        texts["verdict"] = VERDICTS[conforms][language_of(budget)]
    if budget.reference:
        value, U_ref = budget.reference
        texts["reference"], texts["reference_U"] = exact(value), exact(U_ref)
        score = (float(texts["value"]) - value) / math.hypot(float(texts.get("reported", texts["U"])), U_ref)
        texts["en"] = f"{score:.2f}"
    for name, text in budget.claimed.items():
        if isinstance(text, str):
            texts[name] = text
    return texts


HAVE_UNIT = ("value", "u_c", "U", "reported", "capability", "low", "high", "reference", "reference_U")


def as_csv(budget):
    """The bytes of the table."""
    layout, language = budget.layout, language_of(budget)
    lines = []

    def state(name, text):
        line = [STATEMENTS[name][language]]
        if name in HAVE_UNIT:
            line += ["", budget.unit, text] if layout.unit_first else [text, budget.unit]
        else:
            line += [text]
        lines.append(line)

    decimal = layout.decimal
    texts = {name: as_decimal(text, decimal) if name not in ("rule", "verdict") else text
             for name, text in claims_of(budget).items()}
    state("measurand", budget.measurand)
    if budget.method:
        state("method", budget.method)
    if budget.equation:
        state("equation", budget.equation)
    above = [name for name in texts if layout.claims_above and name in ("value", "U", "k", "p")]
    for name in above:
        state(name, texts[name])
    lines.append([])
    head = []
    for column in layout.columns:
        text = HEADS[column][language][layout.heads]
        head.append(f"{text} [{budget.unit}]" if column == "b" and layout.heads else text)
    lines.append(head)
    for row in budget.rows:
        lines.append([as_decimal(cell(budget, row, column), decimal) if column not in TEXTS else cell(budget, row, column)
                      for column in layout.columns])
    for name, text in texts.items():
        if name not in above:
            state(name, text)
    file = io.StringIO()
    csv.writer(file, delimiter=layout.separator, lineterminator="\n").writerows(lines)
    return file.getvalue().encode("utf-8")


# What the printed digits leave open -----------------------------------------------------------------------------------

def left_open(budget, found):
    """The relative half-width within which U follows from the printed digits of the rows: every row at the end of what
    its digits of u (or of its contribution) and c leave open, k with its two decimals, and a ν_eff that is cut."""
    whole = 0.0
    for row in budget.rows:
        if row.contribution == 0.0:
            continue
        share = (row.contribution / found["u_c"]) ** 2
        shown = row.u if "u" in budget.layout.columns else row.contribution
        text, half = significant(shown, budget.layout.digits)
        c, half_c = printed_sensitivity(row.c) if "c" in budget.layout.columns else ("1", 0.0)
        whole += share * (half / shown + (half_c / abs(float(c)) if float(c) else 0.0))
    if budget.coverage == "cut" and not math.isinf(found["nu_eff"]):
        # The digits do not say on which side of a whole number ν_eff lies, nor always that it was cut.
        nu = math.floor(found["nu_eff"])
        whole += coverage_factor(budget.p, max(1, nu - 1)) / coverage_factor(budget.p, nu + 1) - 1.0
    return whole + 0.005 / found["k"]
